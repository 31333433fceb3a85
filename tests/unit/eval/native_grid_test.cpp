// Native code on grids against native code on points, which native_code_test.cpp compares with the reference
// engine: random fields, grids of odd sizes and of several parts, in and out of the domain.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>

#include "frep/eval/native_code.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

template <class Real>
bool same_bits(Real a, Real b) {
    return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0;
}

template <class Real>
std::vector<Real> axis(Random& random, std::size_t count, bool wild) {
    std::vector<Real> at(count);
    for (Real& x : at) x = static_cast<Real>(wild ? random_coordinate(random) : random.real(-2, 2));
    return at;
}

/// Samples where the grid and the same points in columns differ.
template <class Real>
std::size_t differing(const ClauseTape& tape, const NativeOptions& options, std::array<std::size_t, 3> size,
                      Random& random, bool wild, bool gaps = true) {
    const auto code = NativeCode<Real>::compile(tape, options);
    REQUIRE(code.has_value());
    const auto x = axis<Real>(random, size[0], wild), y = axis<Real>(random, size[1], wild),
               z = axis<Real>(random, size[2], wild);
    // Rows and layers stand apart; what is between them must stay.
    const std::size_t row = size[0] + (gaps ? 3 : 0), layer = row * size[1] + (gaps ? 5 : 0);
    const Real between = 12345;
    std::vector<Real> out(layer * size[2] + 20, between);
    NativeGrid<Real> grid{x, y, z, out.data(), row, layer};
    code->run(grid);
    std::size_t count = 0;
    std::vector<Real> ys(size[0]), zs(size[0]), expected(size[0]);
    for (std::size_t k = 0; k < size[2]; ++k) {
        for (std::size_t j = 0; j < size[1]; ++j) {
            ys.assign(size[0], y[j]);
            zs.assign(size[0], z[k]);
            const Real* const in[3] = {x.data(), ys.data(), zs.data()};
            code->run(in, size[0], expected.data());
            const Real* const got = out.data() + k * layer + j * row;
            for (std::size_t i = 0; i < size[0]; ++i) count += same_bits(got[i], expected[i]) ? 0 : 1;
            for (std::size_t i = size[0]; i < row; ++i) count += got[i] == between ? 0 : 1;
        }
    }
    for (std::size_t i = layer * size[2]; i < out.size(); ++i) count += out[i] == between ? 0 : 1;
    return count;
}

}  // namespace

TEST_CASE("random fields on grids") {
    if (!NativeCode<double>::is_available()) {
        std::puts("skipped: 1 (no native code in this build or on this machine)");
        return;
    }
    const std::vector<math::Interval> domain(3, math::Interval(-2.0, 2.0));
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        RandomOptions made;
        made.operations = 3 + static_cast<int>(seed % 80);
        made.region_percent = 0;
        made.coordinates = seed % 5 == 0 ? 2 : 3;
        const Field field = RandomField(seed, made).make();
        const auto tape = make_clause_tape(field);
        REQUIRE(tape.has_value());
        Random random(seed);
        const std::array<std::size_t, 3> size = {1 + random.below(70), 1 + random.below(40),
                                                 1 + random.below(7)};
        for (const Isa isa : {Isa::avx2, Isa::avx512}) {
            if (isa > machine_isa()) continue;
            NativeOptions options{isa, {}};
            if (seed % 2 == 0) options.domain = {domain.data(), static_cast<std::size_t>(field.coordinates)};
            INFO("seed ", seed, " ", name_of(isa));
            CHECK(differing<double>(*tape, options, size, random, seed % 3 == 0) == 0);
            CHECK(differing<float>(*tape, options, size, random, seed % 3 == 0) == 0);
            CHECK(differing<float>(*tape, options, size, random, false, false) == 0);
            CHECK(differing<double>(*tape, options, {33, 5, 4}, random, false, false) == 0);
        }
    }
}

TEST_CASE("a grid of many parts") {
    if (!NativeCode<double>::is_available()) return;
    RandomOptions made;
    made.operations = 400;
    made.region_percent = 0;
    const Field field = RandomField(7, made).make();
    const auto tape = make_clause_tape(field);
    Random random(1);
    CHECK(differing<float>(*tape, {}, {600, 50, 3}, random, false) == 0);
    CHECK(differing<double>(*tape, {}, {37, 3, 70}, random, false) == 0);
}
