// Hypertexture: the formula written out, nothing beyond the falloff, bounds, bad arguments.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

double noise(double x, double y, double z) {
    Sketch s;
    return at(s.call("hfA_NoiseP", {s.x}), x, y, z);
}

}  // namespace

TEST_CASE("octaves of noise, weighted near the surface") {
    Sketch s;
    const Expression f = 1.0 - sqrt(square(s.x[0]) + square(s.x[1]) + square(s.x[2]));
    const Expression free = s.call("hfHypertexture", {s.x, f, 0.3, 2.5, 3, 0});
    const Expression near = s.call("hfHypertexture", {s.x, f, 0.3, 2.5, 3, 0.5});
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> place(-1.2, 1.2);
    int moved = 0;
    for (int i = 0; i < 60; ++i) {
        const double x = place(random), y = place(random), z = place(random), g = at(f, x, y, z);
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const double q = 2.5 * (1 << k);
            sum += noise(q * x + 0.31 * k, q * y + 0.57 * k, q * z + 0.83 * k) / (1 << k);
        }
        const double w = std::abs(g) < 0.5 ? std::pow(1 - g * g / 0.25, 3) : 0;
        CHECK(at(free, x, y, z) == Approx(g + 0.3 * sum));
        CHECK(at(near, x, y, z) == Approx(g + 0.3 * w * sum));
        if (w == 0) CHECK(at(near, x, y, z) == g);
        moved += w > 0;
    }
    CHECK(moved > 10);
    CHECK(moved < 60);
}

TEST_CASE("far from the surface a range is that of the solid alone") {
    Sketch s;
    const Expression f = s.x[0];
    const Expression g = s.call("hfHypertexture", {s.x, f, 0.3, 4, 5, 0.5});
    const math::Interval range = range_over(g, {{0.6, 0.7}, {-9, 9}, {-9, 9}});
    CHECK(range.lo == Approx(0.6));
    CHECK(range.hi == Approx(0.7));
    // a falloff that depends on the point may be 0 in places
    const Expression h = s.call("hfHypertexture", {s.x, f, 0.3, 4, 2, s.x[1]});
    CHECK(at(h, 0.2, -1, 0.3) == at(s.call("hfHypertexture", {s.x, f, 0.3, 4, 2, 0}), 0.2, -1, 0.3));
    CHECK(at(h, 0.2, 0.1, 0.3) == 0.2);
}

TEST_CASE("octaves are known whole numbers") {
    Sketch s;
    Items plane = {s.x[0], s.x[1]};
    CHECK(at(s.call("hfHypertexture", {s.x, s.x[0], 1, 1, 0, 1}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfHypertexture", {s.x, s.x[0], 1, 1, 13, 1}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfHypertexture", {s.x, s.x[0], 1, 1, s.x[0], 1}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfHypertexture", {plane, s.x[0], 1, 1, 2, 1}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 4);
}
