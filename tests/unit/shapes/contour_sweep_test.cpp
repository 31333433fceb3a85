// Sweeps of contours: prisms, mitres, closed frames, curves against the section that is found by searching
// the curve, the frame against its differential equation, what is refused.
#include "frep/shapes/contour_sweep.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "frep/math/vec.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

struct Swept {
    Sketch s;
    Expression f;

    Swept(const char* name, std::initializer_list<double> points, std::initializer_list<double> side,
          Expression (*contour)(const Items&)) {
        Items p = s.list(points), q = s.list(side);
        f = s.call(name, {s.x, contour(s.x), p, q});
        REQUIRE(s.warnings.empty());
    }
    double operator()(Vec3 p) const { return at(f, p.x, p.y, p.z); }
    math::Dual<double> gradient(Vec3 p) const { return gradient_at(f, p.x, p.y, p.z); }
};

Expression ellipse(const Items& x) { return 1.0 - square(x[0] / 0.3) - square(x[1] / 0.1); }
Expression flat_ellipse(const Items& x) { return 0.001 * ellipse(x); }
/// Their gradients in the middle are a tenth of the axes.
Expression to_side(const Items& x) { return 0.1 * x[0] - square(x[0]) - square(x[1]); }
Expression upwards(const Items& x) { return 0.1 * x[1] - square(x[0]) - square(x[1]); }
Expression along(const Items& x) { return 0.001 * x[2]; }

/// A cubic Bezier curve.
Vec3 bezier(const std::array<Vec3, 4>& p, double t) {
    const double s = 1 - t;
    return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}
Vec3 bezier_velocity(const std::array<Vec3, 4>& p, double t) {
    const double s = 1 - t;
    return 3 * s * s * (p[1] - p[0]) + 6 * s * t * (p[2] - p[1]) + 3 * t * t * (p[3] - p[2]);
}

}  // namespace

TEST_CASE("a contour along a segment is a prism with flat ends") {
    const Swept bar("hfSweepContourPolygon", {0, 0, 0, 0, 0, 2}, {2, 0, 7}, ellipse);
    // side is x, upwards z x x = y; the ends are 0.5 away
    CHECK(bar({0.1, 0.05, 0.5}) == Approx(std::min(1 - 1.0 / 9 - 0.25, 0.5)));
    CHECK(bar({0.1, 0.05, 1.5}) == Approx(0.5));
    CHECK(bar({0.25, 0.05, 1}) == Approx(1 - 0.25 / 0.36 * 1.0 - 0.25));
    CHECK(bar({0, 0, -0.3}) == Approx(-0.3));
    CHECK(bar({0, 0, 2.3}) == Approx(-0.3));
    CHECK(bar({0.6, 0, 3}) == Approx(-3));
}

TEST_CASE("corners have mitres") {
    // along x, then along y; side is z, so that upwards is x cross z = -y, then y cross z = x
    const Swept angle("hfSweepContourPolygon", {-2, 0, 0, 0, 0, 0, 0, 2, 0}, {0, 0, 1}, ellipse);
    const auto want = [](double z, double up) { return 1 - std::pow(z / 0.3, 2) - std::pow(up / 0.1, 2); };
    for (const double z : {0.0, 0.1, -0.35}) {
        for (const double up : {-0.06, 0.0, 0.07, 0.2}) {
            // ends are farther away than the values are large
            CHECK(angle({-1.0, -up, z}) == Approx(want(z, up)));
            CHECK(angle({up, 1.0, z}) == Approx(want(z, up)));
            CHECK(angle({up, -up, z}) == Approx(want(z, up)));  // on the mitre
        }
    }
    CHECK(angle({0.09, -0.09, 0}) > 0);  // the outer corner is full
    CHECK(angle({0.11, -0.11, 0}) < 0);
    CHECK(angle({-0.09, 0.09, 0}) > 0);
}

TEST_CASE("a path that ends where it begins is closed, without ends") {
    const Swept frame("hfSweepContourPolygon", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0}, {0, 0, 1},
                      ellipse);
    for (const double a : {-1.05, -1.0, -0.96}) {
        const double want = 1 - std::pow((a + 1) / 0.1, 2);
        CHECK(frame({a, a, 0}) == Approx(want));
        CHECK(frame({a, 0.3, 0}) == Approx(want));
        CHECK(frame({-a, -a, 0}) == Approx(want));
        CHECK(frame({a, -a, 0}) == Approx(want));
    }
    CHECK(frame({0, 0, 0}) < 0);
    // t goes once about: an eighth of the way is the middle of the first side
    const Swept share("hfSweepContourPolygon", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0}, {0, 0, 1},
                      along);
    CHECK(share({0, -1, 0}) == Approx(0.001 / 8));
    CHECK(share({-1, 0, 0}) == Approx(0.007 / 8));
}

TEST_CASE("a closed path in space meets its own frame") {
    const Swept u("hfSweepContourPolygon", {0, 0, 0, 1, 0, 0, 1, 1, 0.7, 0, 1, 0, 0, 0, 0}, {0, 0, 1},
                  to_side);
    // both sides of the first corner: the same on either side of its plane
    const Vec3 normal = Vec3{0, -1, 0} + Vec3{1, 0, 0};
    for (const Vec3 off : {Vec3{0.1, 0.1, 0}, Vec3{0, 0, 0.1}, Vec3{-0.05, -0.05, 0.1}})
        CHECK(u(off + 1e-9 * normal) == Approx(u(off - 1e-9 * normal)).epsilon(1e-5));
}

TEST_CASE("a contour along a curve of the plane lies where the nearest place of the curve says") {
    const std::array<Vec3, 4> p{Vec3{-1, -0.5, 0}, Vec3{-0.2, 1.5, 0}, Vec3{0.4, -1.2, 0}, Vec3{1, 0.6, 0}};
    const Swept pipe("hfSweepContourBezier", {-1, -0.5, 0, -0.2, 1.5, 0, 0.4, -1.2, 0, 1, 0.6, 0}, {0, 0, 1},
                     flat_ellipse);
    for (int i = 1; i < 40; ++i) {
        const double t = i / 40.0;
        const Vec3 c = bezier(p, t), v = bezier_velocity(p, t) / length(bezier_velocity(p, t));
        for (const double up : {-0.12, -0.05, 0.0, 0.08}) {
            const Vec3 to_up = cross(v, {0, 0, 1});
            const Vec3 q = c + up * to_up + Vec3{0, 0, 0.2};
            const double want = 1 - std::pow(0.2 / 0.3, 2) - std::pow(up / 0.1, 2);
            CAPTURE(t);
            CAPTURE(up);
            CHECK(std::abs(pipe(q) * 1000 - want) < 1e-3);
        }
    }
}

TEST_CASE("the frame along a curve is rotation-minimizing, and the gradient is that of the contour") {
    const std::array<Vec3, 4> p{Vec3{-1, -0.5, 0}, Vec3{0.5, 1.5, 0.8}, Vec3{-0.4, -1.2, 1.6},
                                Vec3{1, 0.6, 0.4}};
    const std::initializer_list<double> points{-1, -0.5, 0, 0.5, 1.5, 0.8, -0.4, -1.2, 1.6, 1, 0.6, 0.4};
    const Swept u("hfSweepContourBezier", points, {0, 0, 1}, to_side);
    const Swept v("hfSweepContourBezier", points, {0, 0, 1}, upwards);
    // N' = -(N . T') T (no turn about the tangent), by the midpoint rule
    Vec3 t0 = bezier_velocity(p, 0) / length(bezier_velocity(p, 0));
    Vec3 n = Vec3{0, 0, 1} - t0 * t0.z;
    n = n / length(n);
    constexpr int steps = 20000;
    for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const Vec3 t1 = bezier_velocity(p, t) / length(bezier_velocity(p, t));
        const Vec3 half = n - 0.5 * dot(n, t1 - t0) * t0;
        n = n - dot(half, t1 - t0) * (0.5 * (t0 + t1));
        t0 = t1;
        if (i % 1000 != 500) continue;
        const Vec3 c = bezier(p, t);
        const auto du = u.gradient(c), dv = v.gradient(c);
        const Vec3 b = cross(t1, n);
        CAPTURE(t);
        CHECK(std::abs(du.value) < 1e-5);
        for (const auto& [got, want] :
             {std::pair(du.d[0], n.x), std::pair(du.d[1], n.y), std::pair(du.d[2], n.z),
              std::pair(dv.d[0], b.x), std::pair(dv.d[1], b.y), std::pair(dv.d[2], b.z)})
            CHECK(std::abs(got * 10 - want) < 2e-3);
    }
}

TEST_CASE("the share of the path is that of its length") {
    const Swept share("hfSweepContourBezier", {0, 0, 0, 0, 0, 0.2, 0, 0, 0.5, 0, 0, 3}, {1, 0, 0}, along);
    for (const double z : {0.3, 1.0, 2.5}) CHECK(share({0, 0, z}) == Approx(0.001 * z / 3).epsilon(1e-3));
}

TEST_CASE("wrong contours and paths are refused with a reason") {
    Sketch s;
    const auto refused = [&](const char* name, Items points, Items side, const char* reason) {
        const std::size_t before = s.warnings.size();
        const Expression f = s.call(name, {s.x, ellipse(s.x), points, side});
        CAPTURE(reason);
        CHECK(s.graph.constant_value(f.id()) == shapes::error_value);
        REQUIRE(s.warnings.size() > before);
        CHECK(s.warnings.back().find(reason) != std::string::npos);
    };
    const char* polygon = "hfSweepContourPolygon";
    const char* bezier = "hfSweepContourBezier";
    const Items z = s.list({0, 0, 1}), two = s.list({0, 0, 0, 1, 0, 0});
    refused(polygon, s.list({0, 0, 0}), z, "two or more points");
    refused(polygon, s.list({0, 0, 0, 1}), z, "two or more points");
    refused(bezier, two, z, "4, 7, 10");
    refused(polygon, two, s.list({0, 1}), "3 items");
    refused(polygon, two, s.list({5, 0, 0}), "parallel");
    refused(polygon, two, s.list({0, 0, 0}), "parallel");
    refused(polygon, s.list({0, 0, 0, 0, 0, 0}), z, "the same");
    refused(polygon, s.list({0, 0, 0, 1, 0, 0, 0, 0, 0.001}), z, "turns back");
    refused(polygon, {s.x[0], z[0], z[0], z[0], z[1], z[2]}, z, "depend on the point");
    refused(polygon, s.list({0, 0, 0, 1e200, 0, 0}), z, "must be numbers");
    refused(polygon, two, {s.x[0], z[0], z[2]}, "side");
    refused(bezier, s.list({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), z, "stands still");
}
