// Space transformations: in place, inverse maps, quirks.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

/// Checks the point after a call.
void check_point(const Items& t, double x, double y, double z, double p, double q, double r) {
    CHECK(at(t[0], x, y, z) == Approx(p));
    CHECK(at(t[1], x, y, z) == Approx(q));
    CHECK(at(t[2], x, y, z) == Approx(r));
}

}  // namespace

TEST_CASE("affine maps return 1 and change the array") {
    Sketch s;
    Items t = s.x;
    CHECK(at(s.call("hfScale3D", {t, 2.0, 4.0, 5.0}), 0, 0, 0) == 1);
    check_point(t, 2, 4, 10, 1, 1, 2);
    t = s.x;
    s.call("hfShift3D", {t, 2.0, 4.0, 5.0});
    check_point(t, 2, 4, 10, 0, 0, 5);
    Items fixed = s.list({1, 2, 3});
    t = s.x;
    s.call("hfStretch3D", {t, fixed, 2.0, 4.0, 5.0});
    check_point(t, 3, 6, 8, 2, 3, 4);
    CHECK(s.warnings.empty());
    s.call("hfScale3D", {t, 0.0, 1.0, 1.0});
    CHECK(s.warnings.size() == 1);
    CHECK(std::isinf(at(t[0], 1, 1, 1)));
}

TEST_CASE("rotations and twists") {
    Sketch s;
    const double c = std::cos(0.7), n = std::sin(0.7);
    Items t = s.x;
    s.call("hfRotate3DX", {t, 0.7});
    check_point(t, 1, 2, 3, 1, 2 * c + 3 * n, -2 * n + 3 * c);
    t = s.x;
    s.call("hfRotate3DY", {t, 0.7});
    check_point(t, 1, 2, 3, c - 3 * n, 2, 3 * c + n);
    t = s.x;
    s.call("hfRotate3DZ", {t, 0.7});
    check_point(t, 1, 2, 3, c + 2 * n, -n + 2 * c, 3);
    t = s.x;
    s.call("hfTwistZ", {t, 0.0, 1.0, 0.0, 0.7});  // not clamped: at z = 2 the angle is 1.4
    check_point(t, 1, 0, 2, std::cos(1.4), -std::sin(1.4), 2);
}

TEST_CASE("tapers are clamped; a scale of 0 counts as 1") {
    Sketch s;
    Items t = s.x;
    s.call("hfTaperX", {t, -1.0, 2.0, 0.5, 2.0});
    check_point(t, -5, 1, 1, -5, 2, 2);
    check_point(t, 5, 1, 1, 5, 0.5, 0.5);
    check_point(t, 0.5, 1, 1, 0.5, 0.8, 0.8);
    t = s.x;
    s.call("hfTaperZ", {t, 0.0, 1.0, 1.0, 0.0});
    check_point(t, 1, 1, 2, 1, 1, 2);
    check_point(t, 1, 1, 0.5, 2, 2, 0.5);
    t = s.x;
    s.call("hfTaperY", {t, 1.0, -1.0, 2.0, 4.0});  // bounds the wrong way: below p1 comes first
    check_point(t, 4, 0, 4, 2, 0, 2);
    check_point(t, 4, 3, 4, 1, 3, 1);
}

TEST_CASE("space mapping moves the neighbourhood of a point") {
    Sketch s;
    Items source = s.list({0, 0, 0}), target = s.list({0.5, 0, 0}), b = s.list({2, 2, 2});
    Items t = s.x;
    s.call("hfSpaceMapCubic", {t, source, target, b});
    check_point(t, 0.5, 0, 0, 0, 0, 0);    // the target shows what was at the source
    check_point(t, 3.5, 0, 0, 3.5, 0, 0);  // at the rim: 2 (1 + 0.5) = 3 beside the target
    check_point(t, 9, 9, 9, 9, 9, 9);
    const double r = 1 / 3.0, w = std::pow(1 - r, 3) / (1 + r);
    check_point(t, 1.5, 0, 0, 1.5 - 0.5 * w, 0, 0);
    t = s.x;
    s.call("hfSpaceMapExp", {t, source, target, b});
    check_point(t, 1.5, 0, 0, 1.5 - 0.5 * std::exp(-1 / 9.0), 0, 0);
}
