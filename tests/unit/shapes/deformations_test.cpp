// Bending, free-form deformation and the spline warp: worked values, points that must stay, arc lengths,
// inverses by the formula of the paper, gradients, enclosures.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;

struct Point {
    double x, y, z;
};
Point at_point(const Items& t, const Point& p) {
    return {at(t[0], p.x, p.y, p.z), at(t[1], p.x, p.y, p.z), at(t[2], p.x, p.y, p.z)};
}
void check_same(const Point& a, const Point& b) {
    CHECK(a.x == Approx(b.x));
    CHECK(a.y == Approx(b.y));
    CHECK(a.z == Approx(b.z));
}

/// Barr's forward bend of x towards y: curvature k from x1 to x2, x0 stays.
Point bent(const Point& p, double x1, double x2, double x0, double k) {
    const double on_arc = std::min(std::max(p.x, x1), x2), rest = p.x - on_arc, theta = k * (on_arc - x0);
    const double c = std::cos(theta), s = std::sin(theta);
    return {x0 + s * (1 / k - p.y) + c * rest, 1 / k - c * (1 / k - p.y) + s * rest, p.z};
}

}  // namespace

TEST_CASE("bends are the inverse of Barr's map") {
    for (const double k : {0.3, -0.3, 0.9, 1e-3, 1e-9}) {
        for (const double x0 : {-1.0, 0.5, 2.0}) {
            Sketch s;
            Items t = s.x;
            CHECK(at(s.call("hfBendX", {t, -1, 2, x0, 3 * k}), 0, 0, 0) == 1);
            for (const Point p : {Point{-1, 0, 0}, Point{0.4, 0.5, 1}, Point{1.7, -0.6, -2},
                                  Point{3.5, 0.3, 0}, Point{-2.2, -0.4, 1}}) {
                CAPTURE(k);
                CAPTURE(x0);
                CAPTURE(p.x);
                if (std::abs(k) < 1e-6) {  // 1/k - (1/k - y) of the forward map loses the digits
                    CHECK(at(t[0], p.x, p.y, p.z) == Approx(p.x).epsilon(1e-7));
                    CHECK(at(t[1], p.x, p.y, p.z) == Approx(p.y).epsilon(1e-7));
                } else {
                    check_same(at_point(t, bent(p, -1, 2, x0, k)), p);
                }
            }
        }
    }
}

TEST_CASE("a bend keeps the length of the axis and goes on straight") {
    Sketch s;
    Items t = s.x;
    s.call("hfBendX", {t, 0, 2, 0, pi});  // half a circle of radius 2/pi about (0, 2/pi)
    const double r = 2 / pi;
    for (double a = 0; a <= pi; a += 0.25)
        check_same(at_point(t, {r * std::sin(a), r - r * std::cos(a), 3}), {r * a, 0, 3});
    check_same(at_point(t, {-5, 0.4, 0}), {-5, 0.4, 0});  // before the arc
    check_same(at_point(t, {-5, 2 * r, 0}), {7, 0, 0});   // past it, backwards
    check_same(at_point(t, {-5, 2 * r - 0.1, 0}), {7, 0.1, 0});
    // no bend is no change, and a constant one is not needed
    Items plain = s.x;
    s.call("hfBendX", {plain, 0, 2, 0.3, 0});
    check_same(at_point(plain, {1.2, 0.7, 0.1}), {1.2, 0.7, 0.1});
    // a whole turn closes a bar to a ring: both ends meet, seen from both sides
    Items ring = s.x;
    s.call("hfBendX", {ring, -1, 1, 0, 2 * pi});
    const double top = 2 / pi;
    CHECK(at(ring[0], -1e-9, top, 0) == Approx(-1));
    CHECK(at(ring[0], 1e-9, top, 0) == Approx(1));
    CHECK(s.warnings.empty());
    s.call("hfBendX", {t, 0, 1, 0, 7});
    CHECK(s.warnings.size() == 1);
    CHECK(at(s.call("hfBendX", {t, 1, 0, 0, 1}), 0, 0, 0) == shapes::error_value);
}

TEST_CASE("the three bends are one, with the axes in turn") {
    Sketch s;
    Items x = s.x, y = s.x, z = s.x;
    s.call("hfBendX", {x, -1, 1, 0.2, 1.3});
    s.call("hfBendY", {y, -1, 1, 0.2, 1.3});
    s.call("hfBendZ", {z, -1, 1, 0.2, 1.3});
    const Point p = at_point(x, {0.7, 0.4, -0.3});
    check_same(at_point(y, {-0.3, 0.7, 0.4}), {p.z, p.x, p.y});
    check_same(at_point(z, {0.4, -0.3, 0.7}), {p.y, p.z, p.x});
}

TEST_CASE("bends: gradients are those of differences, enclosures hold and get narrow") {
    Sketch s;
    Items t = s.x;
    s.call("hfBendX", {t, -1, 1, 0, 2.2});
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> place(-1.4, 1.4);
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        const double x = place(random), y = 0.4 * place(random), h = i % 2 ? 0.1 : 1e-4;
        for (std::size_t k = 0; k < 2; ++k) {
            const math::Interval range = range_over(t[k], {{x - h, x + h}, {y - h, y + h}, {0, 0}});
            double low = math::infinity, high = -math::infinity;
            for (int j = 0; j < 9; ++j) {
                const double v = at(t[k], x + h * (j % 3 - 1), y + h * (j / 3 - 1), 0);
                CHECK(range.contains(v));
                low = std::min(low, v);
                high = std::max(high, v);
            }
            worst = std::max(worst, range.width() / (high - low));
            const auto d = gradient_at(t[k], x, y, 0).d;
            const double e = 1e-6;
            CHECK(d[0] == Approx((at(t[k], x + e, y, 0) - at(t[k], x - e, y, 0)) / (2 * e)).epsilon(1e-4));
            CHECK(d[1] == Approx((at(t[k], x, y + e, 0) - at(t[k], x, y - e, 0)) / (2 * e)).epsilon(1e-4));
        }
    }
    CHECK(worst < 12);
}

TEST_CASE("free-form deformation: the lattice's displacements by Bernstein polynomials") {
    Sketch s;
    Items box = s.list({-1, -1, -1, 1, 1, 1});
    // 3 x 1 x 1 control points: the middle one moves by (0, 0.5, 0)
    Items moves = s.list({0, 0, 0, 0, 0.5, 0, 0, 0, 0});
    Items t = s.x;
    CHECK(at(s.call("hfFreeForm3D", {t, 3, 1, 1, box, moves}), 0, 0, 0) == 1);
    check_same(at_point(t, {0, 1, 2}), {0, 1 - 0.5 * 0.5, 2});  // 2 u (1 - u) = 1/2
    check_same(at_point(t, {0.5, 1, 2}), {0.5, 1 - 0.5 * 2 * 0.75 * 0.25, 2});
    check_same(at_point(t, {1, 1, 2}), {1, 1, 2});
    check_same(at_point(t, {9, 1, 2}), {9, 1, 2});  // the rim's displacement is 0
    // equal displacements move the solid as a whole, beyond the box too
    Items all = s.list({1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3});
    t = s.x;
    s.call("hfFreeForm3D", {t, 2, 2, 2, box, all});
    check_same(at_point(t, {4, 0.5, -7}), {3, -1.5, -10});
    // order of the control points: the last one but z runs along y
    Items corner = s.list({0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    t = s.x;
    s.call("hfFreeForm3D", {t, 2, 2, 2, box, corner});
    check_same(at_point(t, {-1, 1, -1}), {-1, 1, -1.5});
    CHECK(s.warnings.empty());
    CHECK(at(s.call("hfFreeForm3D", {t, 2, 2, 3, box, corner}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfFreeForm3D", {t, 0, 2, 2, box, corner}), 0, 0, 0) == shapes::error_value);
    Items flat = s.list({-1, -1, 1, 1, 1, 1});
    CHECK(at(s.call("hfFreeForm3D", {t, 2, 2, 2, flat, corner}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 3);
}

TEST_CASE("free-form deformation: steps invert the forward map") {
    Sketch s;
    Items box = s.list({-1, -1, -1, 1, 1, 1});
    Items moves = s.list({0, 0, 0, 0.3, 0.4, 0, 0, 0, 0});
    const auto forward = [](const Point& p) {
        const double u = 0.5 * (p.x + 1), w = 2 * u * (1 - u);
        return Point{p.x + 0.3 * w, p.y + 0.4 * w, p.z};
    };
    for (const Point p : {Point{0, 0, 0}, Point{0.5, -0.3, 0.1}, Point{-0.8, 0.2, 0.9}}) {
        const auto error = [&](int steps) {
            Items t = s.x;
            s.call("hfFreeForm3D", {t, 3, 1, 1, box, moves, steps});
            const Point q = at_point(t, forward(p));
            return std::hypot(q.x - p.x, q.y - p.y);
        };
        CHECK(error(30) < 1e-9);
        CHECK(error(6) <= 0.5 * error(3));
        Items once = s.x, one = s.x;
        s.call("hfFreeForm3D", {once, 3, 1, 1, box, moves});
        s.call("hfFreeForm3D", {one, 3, 1, 1, box, moves, 1});
        CHECK(at(once[1], p.x, p.y, p.z) == at(one[1], p.x, p.y, p.z));
    }
    CHECK(s.warnings.empty());
    Items steep = s.list({0, 0, 0, 1.5, 0, 0, 0, 0, 0});
    Items t = s.x;
    s.call("hfFreeForm3D", {t, 3, 1, 1, box, steep, 8});
    CHECK(s.warnings.size() == 1);
    CHECK(at(s.call("hfFreeForm3D", {t, 3, 1, 1, box, moves, 65}), 0, 0, 0) == shapes::error_value);
}

TEST_CASE("the spline warp takes each source to its target, and affine maps everywhere") {
    Sketch s;
    Items source = s.list({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, -1, -1, 0.5, 0.5, 0.5});
    Items target = s.list({0, 0, 0.3, 1, 0.2, 0, 0, 1, 0, 0, -0.1, 1, -1, -1, -1, 0.9, 0.5, 0.4});
    Items t = s.x;
    CHECK(at(s.call("hfSpaceMapSpline", {t, source, target}), 0, 0, 0) == 1);
    for (std::size_t i = 0; i < source.size(); i += 3) {
        const auto value = [&](const Expression& e) { return at(e, 0, 0, 0); };
        const Point from{value(source[i]), value(source[i + 1]), value(source[i + 2])};
        check_same(at_point(t, {value(target[i]), value(target[i + 1]), value(target[i + 2])}), from);
    }
    // of an affine map nothing but the affine map is left: x -> 2x + y, y -> y, z -> z - 3
    Items corners = s.list({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 3, 1});
    Items moved = s.list({0, 0, -3, 2, 0, -3, 1, 1, -3, 0, 0, -2, 7, 3, -2});
    t = s.x;
    s.call("hfSpaceMapSpline", {t, corners, moved});
    check_same(at_point(t, {2 * 5.0 - 4, -4, 6 - 3}), {5, -4, 6});
    // one point moves everything; a plane of points is no trouble
    Items one = s.list({1, 1, 1}), there = s.list({1, 3, 1});
    t = s.x;
    s.call("hfSpaceMapSpline", {t, one, there});
    check_same(at_point(t, {8, 8, 8}), {8, 6, 8});
    Items plane = s.list({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}),
          bulged = s.list({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5});
    t = s.x;
    s.call("hfSpaceMapSpline", {t, plane, bulged});
    check_same(at_point(t, {1, 1, 0.5}), {1, 1, 0});
    CHECK(s.warnings.empty());
    Items none;
    CHECK(at(s.call("hfSpaceMapSpline", {t, none, none}), 0, 0, 0) == shapes::error_value);
    Items moving = {s.x[0], s.x[1], s.x[2]};
    CHECK(at(s.call("hfSpaceMapSpline", {t, moving, one}), 0, 0, 0) == shapes::error_value);
}
