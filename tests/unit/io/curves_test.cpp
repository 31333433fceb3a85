// Polygons of curves: they stay within the tolerance, need few pieces, and enclose the area of the curve.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/io/curves.h"

using namespace frep;
using namespace frep::reading;
using doctest::Approx;

namespace {

double area(const std::vector<Vec2>& v) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 a = v[i], b = v[(i + 1) % v.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * sum;
}

}  // namespace

TEST_CASE("a circle becomes a polygon within the tolerance, with about as few corners as that needs") {
    for (const double tolerance : {1e-2, 1e-4, 1e-5}) {
        CAPTURE(tolerance);
        CurveWriter out;
        out.ellipse({3, -2}, 5, 5);
        const auto polygons = polygons_of(out.contours(), tolerance, 100'000);
        REQUIRE(polygons.size() == 1);
        const auto& v = polygons[0];
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Vec2 a = v[i], b = v[(i + 1) % v.size()];
            CHECK(std::hypot(a.x - 3, a.y + 2) == Approx(5).epsilon(1e-7));
            CHECK(5 - std::hypot(0.5 * (a.x + b.x) - 3, 0.5 * (a.y + b.y) + 2) <= 1.001 * tolerance);
        }
        const double least = std::acos(-1.0) / std::acos(1 - tolerance / 5);
        CHECK(static_cast<double>(v.size()) < 1.5 * least + 16);
    }
}

TEST_CASE("a parabola's segment has two thirds of the area of its triangle") {
    CurveWriter out;
    out.move({0, 0});
    out.line({4, 0});
    out.quadratic({2, 6}, {0, 0});
    const auto polygons = polygons_of(out.contours(), 1e-7, 100'000);
    REQUIRE(polygons.size() == 1);
    CHECK(area(polygons[0]) == Approx(2.0 / 3 * 0.5 * 4 * 6).epsilon(1e-6));
}

TEST_CASE("contours without corners are left out, repeated points dropped") {
    CurveWriter out;
    out.move({0, 0});
    out.line({0, 0});
    out.line({1, 0});
    out.move({5, 5});
    out.move({0, 0});
    for (const Vec2 p : {Vec2{1, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 0}}) out.line(p);
    const auto polygons = polygons_of(out.contours(), 0.1, 100'000);
    REQUIRE(polygons.size() == 1);
    CHECK(polygons[0].size() == 3);
    CHECK(box_of({}).is_empty());
    CHECK(box_of(out.contours()).larger_side() == 1);
}

TEST_CASE("maps apply to points, the inner one first") {
    const Affine turn{0, 1, -1, 0, 0, 0}, shift{1, 0, 0, 1, 10, 0};
    CHECK((shift * turn)({1, 0}) == Vec2{10, 1});
    CHECK((turn * shift)({1, 0}) == Vec2{0, 11});
    CurveWriter out(shift);
    out.move({0, 0});
    out.line({1, 0});
    CHECK(out.contours()[0].start == Vec2{10, 0});
    CHECK(out.contours()[0].segments[0].to == Vec2{11, 0});
}

TEST_CASE("with a limit, curves stop early") {
    CurveWriter out;
    for (int i = 0; i < 1000; ++i) out.ellipse({0, 0}, 1, 1);
    std::size_t count = 0;
    for (const auto& polygon : polygons_of(out.contours(), 0, 5000)) count += polygon.size();
    CHECK(count > 5000);
    CHECK(count < 5000 + 20 * 2000);
}
