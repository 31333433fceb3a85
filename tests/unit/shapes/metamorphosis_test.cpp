// Metamorphosis: the worked values of space-time bounded blending ("two disks to a cross"), smoothed
// half-cylinders, exactness at both ends, colors, linear and bilinear mixing.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

/// Coordinates x, y and time.
struct Crossing : Sketch {
    Expression t = x[2];
    Expression disk_1 = 1.0 - square(x[0] - 1.0) - square(x[1]);
    Expression disk_2 = 1.0 - square(x[0] + 1.5) - square(x[1]);
    Expression g1 = r_or(disk_1, disk_2);
    Expression bar_1 = r_and(r_and(r_and(x[0] + 1.0, -x[0]), x[1] - 2.0), 5.0 - x[1]);
    Expression bar_2 = r_and(r_and(r_and(x[1] - 3.0, 4.0 - x[1]), x[0] + 2.0), 1.0 - x[0]);
    Expression g2 = r_or(bar_1, bar_2);
};

}  // namespace

TEST_CASE("two disks to a cross: published parameters") {
    Crossing s;
    const Expression f = s.call("hfSpaceTimeBlend", {s.g1, s.g2, s.t, 0, 1, 10, 5, 2, 2, 0.75});
    CHECK(at(f, 0, 0, -2.5) == Approx(0.551941116).epsilon(1e-8));
    CHECK(at(f, 1, 0, -5) == Approx(1.039476445).epsilon(1e-8));
    CHECK(at(f, -0.5, 3.5, 5) == Approx(0.779367526).epsilon(1e-8));
    CHECK(at(f, -0.5, 2, 0.5) == Approx(2.040900657).epsilon(1e-8));
    CHECK(at(f, 0, 0, 0.5) == Approx(0.715122898).epsilon(1e-8));
    CHECK(at(f, 4, 6, 0.5) == Approx(-13.685885555).epsilon(1e-8));
}

TEST_CASE("the first and the last frame are the two shapes") {
    Crossing s;
    const Expression f = s.call("hfSpaceTimeBlend", {s.g1, s.g2, s.t, 0, 1, 10, 5, 2, 2, 0.75});
    const Expression g =
        s.call("hfSpaceTimeBlendSmooth", {s.g1, s.g2, s.t, 0, 1, 10, 5, 2, 2, 0.75, -1.0, 5});
    for (double x = -5; x <= 5; x += 0.37) {
        for (double y = -3; y <= 7; y += 0.41) {
            for (const Expression& morph : {f, g}) {
                CHECK((at(morph, x, y, -10) >= 0) == (at(s.g1, x, y, 0) >= 0));
                CHECK((at(morph, x, y, 10) >= 0) == (at(s.g2, x, y, 0) >= 0));
            }
        }
    }
}

TEST_CASE("smoothed half-cylinders shrink before they end, and are plain before") {
    Sketch s;
    const Expression g = s.x[0], t = s.x[2];
    const Expression f = s.call("hfSmoothHalfCylinderBefore", {g, t, 0, -1, 1, 1, 1, -5});
    CHECK(at(f, 1, 0, -1) == Approx(-0.046312328).epsilon(1e-7));
    CHECK(at(f, 1, 0, -3) == Approx(0.824116898).epsilon(1e-8));
    CHECK(at(f, 0.5, 0, -2) == Approx(0.201169051).epsilon(1e-8));
    CHECK(at(f, 0, 0, -2) == Approx(-0.253741733).epsilon(1e-8));
    CHECK(at(f, 1, 0, 0) == Approx(-0.856070568).epsilon(1e-8));
    CHECK(at(f, 1, 0, 0.5) == Approx(-1.469845932).epsilon(1e-8));
    const Expression plain = s.call("hfHalfCylinderBefore", {g, t, 0});
    CHECK(at(f, 1, 0, -6) == at(plain, 1, 0, -6));
    CHECK(at(plain, 1, 0, -6) == Approx(0.917237470).epsilon(1e-8));
    // the other end is the mirror image
    const Expression after = s.call("hfSmoothHalfCylinderAfter", {g, t, 0, -1, 1, 1, 1, 5});
    CHECK(at(after, 1, 0, 3) == at(f, 1, 0, -3));
    CHECK(at(s.call("hfHalfCylinderAfter", {g, t, 0}), 1, 0, 6) == at(plain, 1, 0, -6));
}

TEST_CASE("a disk's smoothed sections have the computed radii") {
    Sketch s;
    const Expression disk = 1.0 - square(s.x[0]) - square(s.x[1]);
    const Expression f = s.call("hfSmoothHalfCylinderBefore", {disk, s.x[2], 0, -1, 1, 1, 1, -5});
    const auto radius = [&](double t) {
        double low = 0, high = 2;
        for (int i = 0; i < 60; ++i) {
            const double m = 0.5 * (low + high);
            (at(f, m, 0, t) >= 0 ? low : high) = m;
        }
        return low;
    };
    CHECK(radius(-5) == Approx(1).epsilon(1e-9));
    CHECK(radius(-3) == Approx(0.991331).epsilon(1e-5));
    CHECK(radius(-2) == Approx(0.856388).epsilon(1e-5));
    CHECK(radius(-1.2) == Approx(0.381955).epsilon(1e-5));
    CHECK(at(f, 0, 0, -1.05) < 0);
}

TEST_CASE("a cone of space-time goes from ball to ball") {
    Sketch s;
    Items c1 = s.list({-2, 1}), c2 = s.list({4, 3}), wrong = s.list({1, 2, 3});
    const Expression f = s.call("hfTimeCone", {s.x, s.x[2], 10, c1, 1, c2, 2});
    CHECK(at(f, -2, 1.99, -9.999) > 0);
    CHECK(at(f, -2, 2.01, -9.999) < 0);
    CHECK(at(f, 1, 2, 0) > 0);
    CHECK(at(f, 1, 3.49, 0) > 0);
    CHECK(at(f, 1, 3.51, 0) < 0);
    CHECK(at(f, 4, 3, 10.01) < 0);
    CHECK(at(s.call("hfTimeCone", {s.x, s.x[2], 10, c1, 1, wrong, 2}), 0, 0, 0) == shapes::error_value);
}

TEST_CASE("colors: inside each shape its own, between them by distance") {
    Sketch s;
    Items out = s.list({0, 0, 0}), red = s.list({1, 0, 0}), blue = s.list({0, 0, 1});
    s.call("hfA_SpaceTimeColor", {s.x[0], s.x[1], out, red, blue});
    CHECK(at(out[0], 1, -3, 0) == 1);
    CHECK(at(out[2], -1, 2, 0) == 1);
    CHECK(at(out[0], -1, -3, 0) == Approx(0.75));
    CHECK(at(out[2], -1, -3, 0) == Approx(0.25));
    CHECK(at(out[0], 0, 0, 0) == 1);
}

TEST_CASE("linear and bilinear mixing") {
    Sketch s;
    CHECK(at(s.call("hfMorph", {s.x[0], s.x[1], 0.25}), 4, 8, 0) == 5);
    const Expression f = s.call("hfMorphBilinear", {1.0, 2.0, 3.0, 5.0, s.x[0], s.x[1]});
    CHECK(at(f, 0, 0, 0) == 1);
    CHECK(at(f, 1, 0, 0) == 2);
    CHECK(at(f, 0, 1, 0) == 3);
    CHECK(at(f, 1, 1, 0) == 5);
    CHECK(at(f, 0.5, 0.5, 0) == 2.75);
}
