// Rotation about a line, shears, general affine maps, reflection and folding: worked values, inverses,
// lengths and volumes that must stay.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

void check_point(const Items& t, double x, double y, double z, double p, double q, double r) {
    CHECK(at(t[0], x, y, z) == Approx(p));
    CHECK(at(t[1], x, y, z) == Approx(q));
    CHECK(at(t[2], x, y, z) == Approx(r));
}

constexpr double third_turn = 2.0943951023931953;

}  // namespace

TEST_CASE("rotation about a line") {
    Sketch s;
    // a third of a turn about (1, 1, 1) takes x to y, y to z, z to x: the point comes from one axis before
    Items origin = s.list({0, 0, 0}), diagonal = s.list({2, 2, 2});
    Items t = s.x;
    CHECK(at(s.call("hfRotate3D", {t, origin, diagonal, third_turn}), 0, 0, 0) == 1);
    check_point(t, 1, 2, 3, 2, 3, 1);
    // about axes through the origin it is the rotation of the old library, bit for bit in meaning
    const char* const names[] = {"hfRotate3DX", "hfRotate3DY", "hfRotate3DZ"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Items direction = s.list({0, 0, 0});
        direction[axis] = s.number(0.25);
        Items about = s.x, old = s.x;
        s.call("hfRotate3D", {about, origin, direction, 0.7});
        s.call(names[axis], {old, 0.7});
        check_point(about, 1, 2, 3, at(old[0], 1, 2, 3), at(old[1], 1, 2, 3), at(old[2], 1, 2, 3));
    }
    // the line itself stays; back again
    Items place = s.list({1, -2, 0.5}), along = s.list({1, 2, -1});
    t = s.x;
    s.call("hfRotate3D", {t, place, along, 1.1});
    check_point(t, 3, 2, -1.5, 3, 2, -1.5);
    s.call("hfRotate3D", {t, place, along, -1.1});
    check_point(t, 0.3, 0.4, -5, 0.3, 0.4, -5);
    CHECK(s.warnings.empty());
    CHECK(at(s.call("hfRotate3D", {t, place, origin, 1}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 1);
}

TEST_CASE("shears move one coordinate by the two others") {
    Sketch s;
    Items t = s.x;
    s.call("hfShearX", {t, 0.5, 2});
    check_point(t, 1, 2, 3, 1 - 0.5 * 2 - 2 * 3, 2, 3);
    t = s.x;
    s.call("hfShearY", {t, 0.5, 2});
    check_point(t, 1, 2, 3, 1, 2 - 0.5 * 1 - 2 * 3, 3);
    t = s.x;
    s.call("hfShearZ", {t, 0.5, 2});
    check_point(t, 1, 2, 3, 1, 2, 3 - 0.5 * 1 - 2 * 2);
    s.call("hfShearZ", {t, -0.5, -2});
    check_point(t, 1, 2, 3, 1, 2, 3);
}

TEST_CASE("an affine map moves points forward by its matrix") {
    Sketch s;
    const double m[12] = {1, 2, 0, 5, 0, 1, 3, -1, 1, 0, 2, 0.5};
    Items matrix = s.list({1, 2, 0, 5, 0, 1, 3, -1, 1, 0, 2, 0.5});
    Items t = s.x;
    s.call("hfAffine3D", {t, matrix});
    const double p[3] = {0.3, -1.2, 2.5};
    double image[3];
    for (int i = 0; i < 3; ++i)
        image[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3];
    check_point(t, image[0], image[1], image[2], p[0], p[1], p[2]);
    Items singular = s.list({1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0}), few = s.list({1, 2});
    CHECK(at(s.call("hfAffine3D", {t, singular}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfAffine3D", {t, few}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 2);
}

TEST_CASE("mirroring twice is nothing, and keeps distances; a fold keeps one side") {
    Sketch s;
    Items place = s.list({1, 0, 0.5}), normal = s.list({3, 0, 4});
    Items once = s.x;
    s.call("hfMirror3D", {once, place, normal});
    // (6, 7, 8.5): height (5*3 + 8*4)/5 = 9.4, moved by 18.8 along (0.6, 0, 0.8)
    check_point(once, 6, 7, 8.5, 6 - 11.28, 7, 8.5 - 15.04);
    Items twice = once;
    s.call("hfMirror3D", {twice, place, normal});
    check_point(twice, 6, 7, 8.5, 6, 7, 8.5);
    Items folded = s.x;
    s.call("hfFold3D", {folded, place, normal});
    check_point(folded, 6, 7, 8.5, 6, 7, 8.5);
    check_point(folded, 6 - 11.28, 7, 8.5 - 15.04, 6, 7, 8.5);
    const auto d = gradient_at(folded[0], -4, 1, -4).d;
    CHECK(d[0] == Approx(1 - 2 * 0.36));
    CHECK(d[2] == Approx(-2 * 0.48));
    Items zero = s.list({0, 0, 0});
    CHECK(at(s.call("hfFold3D", {folded, place, zero}), 0, 0, 0) == shapes::error_value);
}
