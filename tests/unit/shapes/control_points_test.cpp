// Blends by control points: extents from points on the surfaces, projection of points beside them, errors on
// the edge; fillets and chamfers against their circles and lines; functions at fixed points.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/shapes/control_points.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

/// Zero of a falling function of one variable on a..b, by bisection.
template <class F>
double root(F f, double a, double b) {
    for (int i = 0; i < 100; ++i) {
        const double m = 0.5 * (a + b);
        (f(m) >= 0 ? a : b) = m;
    }
    return 0.5 * (a + b);
}

/// Sphere and cylinder of the worked example: f1 = 1 - |P|^2, f2 = 1/4 - x^2 - y^2.
struct SphereAndCylinder : Sketch {
    Expression sphere = 1.0 - (square(x[0]) + square(x[1]) + square(x[2]));
    Expression cylinder = 0.25 - (square(x[0]) + square(x[1]));
};

}  // namespace

TEST_CASE("two half-planes: the extents are the values at the other point") {
    Sketch s;
    Items p1 = s.list({0, 2, 0}), p2 = s.list({1, 0, 0});
    const Expression f = s.call("hfControlBlendUni", {s.x, -s.x[0], -s.x[1], 1.0, p1, p2});
    CHECK(s.warnings.empty());
    CHECK(at(f, 0.3, 0.4, 0) == Approx(0.382746017699).epsilon(1e-11));
    const auto height = [&](double x) { return root([&](double y) { return at(f, x, y, 0); }, 0, 3); };
    CHECK(height(0.25) == Approx(1.043713249).epsilon(1e-8));
    CHECK(height(0.5) == Approx(0.427480004).epsilon(1e-8));
    CHECK(height(0.75) == Approx(0.055324713).epsilon(1e-7));
    CHECK(height(1.2) == Approx(0).epsilon(1e-9));
}

TEST_CASE("a sphere on a cylinder touches both at the control points") {
    SphereAndCylinder s;
    Items p1 = s.list({0.8, 0, 0.6}), p2 = s.list({0.5, 0, 1.2});
    const Expression f = s.call("hfControlBlendUni", {s.x, s.sphere, s.cylinder, 0.15, p1, p2});
    const auto profile = [&](double z) { return root([&](double x) { return at(f, x, 0, z); }, 0, 2); };
    CHECK(profile(0.6) == Approx(0.8).epsilon(1e-9));
    CHECK(profile(0.7) == Approx(0.723531576).epsilon(1e-8));
    CHECK(profile(0.9) == Approx(0.603597349).epsilon(1e-8));
    CHECK(profile(1.2) == Approx(0.5).epsilon(1e-9));
    // bounded by values, not by place: the same blend below
    CHECK(profile(-0.9) == Approx(0.603597349).epsilon(1e-8));
}

TEST_CASE("points beside the surface are moved onto it") {
    SphereAndCylinder s;
    Items p1 = s.list({0.8, 0, 0.6}), p2 = s.list({0.5, 0, 1.2});
    Items q1 = s.list({0.84, 0, 0.63}), q2 = s.list({0.53, 0, 1.2});
    const Expression on = s.call("hfControlBlendUni", {s.x, s.sphere, s.cylinder, 0.15, p1, p2});
    const Expression near = s.call("hfControlBlendUni", {s.x, s.sphere, s.cylinder, 0.15, q1, q2});
    CHECK(s.warnings.empty());
    CHECK(at(near, 0.6, 0.1, 0.9) == Approx(at(on, 0.6, 0.1, 0.9)).epsilon(1e-9));
}

TEST_CASE("points on the edge, far points and moving points are refused") {
    SphereAndCylinder s;
    const double z = std::sqrt(0.75);
    Items edge = s.list({0.5, 0, z}), p1 = s.list({0.8, 0, 0.6}), p2 = s.list({0.5, 0, 1.2});
    Items far = s.list({9, 0, 0}), moving{s.x[0], s.number(0), s.number(0)}, pair = s.list({1, 2});
    const auto refused = [&](Items& a, Items& b, const char* text) {
        const std::size_t before = s.warnings.size();
        const Expression f = s.call("hfControlBlendUni", {s.x, s.sphere, s.cylinder, 0.15, a, b});
        CHECK(at(f, 0, 0, 0) == shapes::error_value);
        REQUIRE(s.warnings.size() == before + 1);
        CHECK(s.warnings.back().find(text) != std::string::npos);
    };
    refused(edge, p2, "p1 lies on the edge");
    refused(p1, edge, "p2 lies on the edge");
    refused(far, p2, "p1 does not lie near surface 1");
    refused(moving, p2, "depends on the point");
    refused(pair, p2, "3 items");
    refused(p1, p1, "are one");
    const Expression other{s.graph, s.graph.coordinate(4)};
    s.call("hfControlBlendUni", {s.x, s.sphere + other, s.cylinder, 0.15, p1, p2});
    CHECK(s.warnings.back().find("no function of x alone") != std::string::npos);
}

TEST_CASE("functions of moved coordinates take points of the moved system") {
    Sketch s;
    Items moved{s.x[0] - 5.0, s.x[1], s.x[2]};
    Items p1 = s.list({0, 2, 0}), p2 = s.list({1, 0, 0});
    const Expression f = s.call("hfControlBlendUni", {moved, -moved[0], -moved[1], 1.0, p1, p2});
    CHECK(s.warnings.empty());
    CHECK(at(f, 5.3, 0.4, 0) == Approx(0.382746017699).epsilon(1e-11));
}

TEST_CASE("a fillet is a circle on the bisector, and near it elsewhere") {
    Sketch s;
    const double r = 0.7;
    const Expression f = s.call("hfFilletUni", {-s.x[0], -s.x[1], r});
    // the circle of radius r about (r, r) passes (d, d), d = r (1 - 1/sqrt 2)
    const double d = root([&](double t) { return at(f, t, t, 0); }, 0, r);
    CHECK(d == Approx(r * (1 - std::sqrt(0.5))).epsilon(1e-9));
    for (double x = 0.05; x < r; x += 0.05) {
        const double y = root([&](double t) { return at(f, x, t, 0); }, 0, r);
        CHECK(std::abs(std::hypot(r - x, r - y) - r) <= 0.0136 * r);
    }
    // the rounded edge of a corner is the same circle inside
    const Expression g = s.call("hfFilletInt", {s.x[0], s.x[1], r});
    const double e = root([&](double t) { return -at(g, t, t, 0); }, 0, r);
    CHECK(e == Approx(d).epsilon(1e-9));
    const Expression c = s.call("hfChamferUni", {-s.x[0], -s.x[1], r});
    CHECK(root([&](double t) { return at(c, t, t, 0); }, 0, r) == Approx(r / 2).epsilon(1e-9));
    // beyond the legs nothing changes, bit for bit
    CHECK(at(f, r, -0.1, 0) == meaning<double>(Op::r_or, std::vector<double>{-r, 0.1}, {}));
}

TEST_CASE("a function at a point is a number; parameters stay") {
    Sketch s;
    Items p = s.list({1, 2, 3});
    const Expression f = square(s.x[0]) + s.x[1] * s.x[2];
    const Expression v = s.call("hfAt", {s.x, p, f});
    REQUIRE(s.graph.constant_value(v.id()));
    CHECK(*s.graph.constant_value(v.id()) == 7);
    const Expression scale{s.graph, s.graph.parameter(0)};
    const Expression w = s.call("hfAt", {s.x, p, f * scale});
    CHECK(!s.graph.constant_value(w.id()));
    CHECK(s.graph.depends_on_parameters(w.id()));
    CHECK(!s.graph.depends_on_point(w.id()));
    // at a point that moves: a space mapping
    Items turned{s.x[1], s.x[0], s.x[2]};
    CHECK(at(s.call("hfAt", {s.x, turned, f}), 1, 2, 3) == 4 + 3);
    CHECK(at(s.call("hfAt", {s.x, p, Expression(s.graph, s.graph.coordinate(5))}), 0, 0, 0) ==
          shapes::error_value);
}

TEST_CASE("of a union only the part at the control point is blended, wherever the other parts are") {
    for (const bool by_max : {false, true}) {
        CAPTURE(by_max);
        SphereAndCylinder s;
        const auto unite = [&](Expression a, Expression b) { return by_max ? max(a, b) : r_or(a, b); };
        const auto far = [&](double at) { return 0.5 - square(s.x[0] - at) - square(s.x[1] - 1.0); };
        const Expression all = unite(unite(far(5), s.sphere), unite(far(-6), far(7)));
        const Expression other = unite(s.cylinder, far(9));
        Items p1 = s.list({0.8, 0, 0.6}), p2 = s.list({0.5, 0, 1.2});
        const Expression f = s.call("hfControlBlendUni", {s.x, all, other, 0.15, p1, p2});
        CHECK(s.warnings.empty());
        // the profile of the blend of sphere and cylinder alone
        const auto profile = [&](double z) { return root([&](double x) { return at(f, x, 0, z); }, 0, 2); };
        CHECK(profile(0.7) == Approx(0.723531576).epsilon(1e-8));
        CHECK(profile(0.9) == Approx(0.603597349).epsilon(1e-8));
        for (const double x : {5.0, -6.0, 7.0, 9.0}) CHECK(at(f, x, 1, 0) > 0);
    }
}

TEST_CASE("of an intersection only the face at the control point is blended") {
    Sketch s;
    // a corner of three planes; the edge of the first two is rounded, the third stays plain
    const Expression corner = r_and(r_and(-s.x[0], -s.x[2]), 5.0 + s.x[2]);
    Items p1 = s.list({0, -1, -1}), p2 = s.list({-1, 0, -1});
    const Expression f = s.call("hfControlBlendInt", {s.x, corner, -s.x[1], -0.4, p1, p2});
    CHECK(s.warnings.empty());
    const Expression plain =
        apply(Op::point_int, {-s.x[0], -s.x[1], s.number(-0.4), s.number(1), s.number(1)});
    for (const double turn : {0.1, 0.4, 0.7}) {
        const auto on = [&](const Expression& g) {
            return root([&](double r) { return at(g, r - 1, r * turn - 1, -2); }, 0, 3);
        };
        CHECK(on(f) == Approx(on(plain)).epsilon(1e-9));
    }
    CHECK(at(f, -1, -1, 0.01) < 0);
    CHECK(at(f, -1, -1, -0.01) > 0);
}
