// Tests of geom/predicates.h: signs against determinants in 128-bit integers, where the plain determinant in
// doubles fails, and symmetries.
#include "frep/geom/predicates.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "unit/geom/exact_reference.h"

using namespace frep;
using test::Random;
using test::Wide;

namespace {

struct Integers {
    std::int64_t x, y, z;
    Vec3 scaled(int exponent) const {
        return {std::ldexp(static_cast<double>(x), exponent), std::ldexp(static_cast<double>(y), exponent),
                std::ldexp(static_cast<double>(z), exponent)};
    }
};

int sign_of(Wide v) { return (v > 0) - (v < 0); }

int reference_orient3d(const Integers& a, const Integers& b, const Integers& c, const Integers& d) {
    const auto rest = [&d](const Integers& p) { return Integers{p.x - d.x, p.y - d.y, p.z - d.z}; };
    const Integers p = rest(a), q = rest(b), r = rest(c);
    return sign_of(Wide{p.x} * (Wide{q.y} * r.z - Wide{q.z} * r.y) -
                   Wide{p.y} * (Wide{q.x} * r.z - Wide{q.z} * r.x) +
                   Wide{p.z} * (Wide{q.x} * r.y - Wide{q.y} * r.x));
}

}  // namespace

TEST_CASE("the sides of a plane and of a line") {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
    CHECK(orient3d(a, b, c, {0, 0, -1}) == 1);
    CHECK(orient3d(a, b, c, {0, 0, 1}) == -1);
    CHECK(orient3d(a, b, c, {7, -5, 0}) == 0);
    CHECK(orient2d({0, 0}, {1, 0}, {0, 1}) == 1);
    CHECK(orient2d({0, 0}, {0, 1}, {1, 0}) == -1);
    CHECK(orient2d({0, 0}, {1, 1}, {-3, -3}) == 0);
}

TEST_CASE("exact next to a plane, for coordinates of 38 bits") {
    Random random(1);
    int zeros = 0, ones = 0;
    for (int i = 0; i < 20000; ++i) {
        // d = a + u (b - a) + v (c - a) with whole u and v lies in the plane; then it moves by 0 or 1.
        const int bits = 4 + random.below(30);
        const std::int64_t range = std::int64_t{1} << bits;
        const auto coordinate = [&] {
            return static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(2 * range)) - range;
        };
        const Integers a{coordinate(), coordinate(), coordinate()};
        const Integers b{coordinate(), coordinate(), coordinate()};
        const Integers c{coordinate(), coordinate(), coordinate()};
        const std::int64_t u = random.below(9) - 4, v = random.below(9) - 4;
        Integers d{a.x + u * (b.x - a.x) + v * (c.x - a.x), a.y + u * (b.y - a.y) + v * (c.y - a.y),
                   a.z + u * (b.z - a.z) + v * (c.z - a.z) + random.below(3) - 1};
        const int exponent = random.below(61) - 40;
        const int expected = reference_orient3d(a, b, c, d);
        CAPTURE(i);
        const Vec3 pa = a.scaled(exponent), pb = b.scaled(exponent), pc = c.scaled(exponent),
                   pd = d.scaled(exponent);
        CHECK(orient3d(pa, pb, pc, pd) == expected);
        CHECK(orient3d(pb, pc, pa, pd) == expected);
        CHECK(orient3d(pb, pa, pc, pd) == -expected);
        CHECK(orient3d(pd, pb, pc, pa) == -expected);
        const Wide area = (Wide{a.x} - c.x) * (b.y - c.y) - (Wide{a.y} - c.y) * (b.x - c.x);
        CHECK(orient2d({pa.x, pa.y}, {pb.x, pb.y}, {pc.x, pc.y}) == sign_of(area));
        (expected == 0 ? zeros : ones) += 1;
    }
    CHECK(zeros > 3000);
    CHECK(ones > 3000);
}

TEST_CASE("exact for coordinates of very different sizes") {
    // One corner moves by the last bit of a coordinate of 2^-30 beside coordinates of 2^20.
    const double big = 0x1p20, tiny = 0x1p-30;
    const double step = 0x1p-53;
    for (int k = -2; k <= 2; ++k) {
        const double height = tiny + k * step;
        const int expected = (k < 0) - (k > 0);
        CHECK(orient3d({0, 0, tiny}, {big, 0, tiny}, {0, big, tiny}, {big / 3, big / 7, height}) == expected);
        CHECK(orient2d({0, tiny}, {big, tiny}, {big / 3, height}) == -expected);
    }
    // The classroom example of Kettner et al. (2008): points next to the line through (12,12) and (24,24).
    for (int i = 0; i < 64; ++i) {
        for (int j = 0; j < 64; ++j) {
            const Vec2 p{0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53};
            CHECK(orient2d(p, {12, 12}, {24, 24}) == sign_of(Wide{j} - i));
        }
    }
    // The extremes of binary32.
    const double most = 0x1.fffffep127, least = 0x1p-149;
    CHECK(orient3d({most, 0, 0}, {0, most, 0}, {-most, -most, 0}, {0, 0, least}) == -1);
    CHECK(orient3d({least, 0, 0}, {0, least, 0}, {0, 0, 0}, {0, 0, -least}) == 1);
}
