// Tests of contour/block_arena.h: places are aligned and apart, whatever the sizes and the threads.
#include "frep/contour/block_arena.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "frep/base/parallel.h"
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
