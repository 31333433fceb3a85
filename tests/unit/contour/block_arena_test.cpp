// Tests of contour/block_arena.h: places are aligned and apart, whatever the sizes and the threads; and of
// contour/block_index.h.
#include "frep/contour/block_arena.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "frep/base/parallel.h"
#include "frep/contour/block_index.h"
#include "unit/contour/test_fields.h"

using namespace frep;
using namespace frep::contouring;

TEST_CASE("places of an arena are aligned and do not overlap") {
    struct Place {
        std::uintptr_t begin = 0, end = 0;
    };
    constexpr std::size_t count = 4000;
    BlockArena arena;
    std::vector<Place> places(count);
    Job job;
    job.threads = 4;
    parallel_for(job, count, [&](std::size_t i) {
        // Mostly small, some larger than any piece.
        const auto random = static_cast<std::size_t>(1e6 * (1 + test::noise(i, 0)));
        const std::size_t bytes = i % 500 == 0 ? std::size_t{3} << 20 : 1 + random % 5000;
        const std::size_t alignment = std::size_t{1} << i % 7;
        void* const at = arena.allocate(bytes, alignment);
        const auto begin = reinterpret_cast<std::uintptr_t>(at);
        if (begin % alignment == 0) places[i] = {begin, begin + bytes};
        *static_cast<char*>(at) = 1;
        *(static_cast<char*>(at) + bytes - 1) = 1;
    });
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.begin < b.begin; });
    CHECK(places.front().begin > 0);
    for (std::size_t i = 0; i + 1 < count; ++i) CHECK(places[i].end <= places[i + 1].begin);
}

TEST_CASE("the blocks around a block, at the sides of the lattice too") {
    BlockArena arena;
    std::vector<StoredBlock> blocks;
    constexpr std::uint32_t last = 5, far = (1u << 21) - 2;
    const auto is_there = [](const Lattice& at) { return (at[0] + 2 * at[1] + 3 * at[2]) % 4 != 1; };
    std::vector<std::uint64_t> codes{morton_code({far, far, far})};
    for (std::uint32_t i = 0; i < (last + 1) * (last + 1) * (last + 1); ++i) {
        const Lattice at{i % (last + 1), i / (last + 1) % (last + 1), i / ((last + 1) * (last + 1))};
        if (is_there(at)) codes.push_back(morton_code(at));
    }
    std::sort(codes.begin(), codes.end());
    for (const std::uint64_t code : codes) {
        DualBlock block;
        block.code = code;
        blocks.push_back(store(block, arena));
    }
    const BlockIndex index(blocks);
    for (std::uint32_t i = 0; i < codes.size(); ++i) {
        const Lattice here = morton_decode(codes[i]);
        const std::array<std::uint32_t, 27> around = index.around(i);
        for (std::uint32_t n = 0; n < 27; ++n) {
            // Shifted by one, so that -1 is 0.
            const Lattice there{here[0] + n % 3, here[1] + n / 3 % 3, here[2] + n / 9};
            const bool is_in = there[0] > 0 && there[1] > 0 && there[2] > 0;
            const std::uint64_t code =
                is_in ? morton_code({there[0] - 1, there[1] - 1, there[2] - 1}) : ~std::uint64_t{0};
            const auto found = std::find(codes.begin(), codes.end(), code);
            const bool exists = is_in && found != codes.end();
            CHECK(around[n] ==
                  (exists ? static_cast<std::uint32_t>(found - codes.begin()) : BlockIndex::none));
        }
    }
}
