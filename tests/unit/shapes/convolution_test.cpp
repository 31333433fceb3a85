// Convolution surfaces: the closed forms against published values, quadrature and additivity; the factor S^3;
// degenerate elements.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;

double op_value(Op op, std::vector<double> lead, std::vector<double> block) {
    return meaning<double>(op, lead, block);
}
double cauchy(double s, double r2) { return 1 / ((1 + s * s * r2) * (1 + s * s * r2)); }

/// Composite Gauss rule of 3 points.
template <class F>
double integral(F f, double a, double b, int parts = 400) {
    double sum = 0;
    const double h = (b - a) / parts, o = std::sqrt(0.6) * h / 2;
    for (int i = 0; i < parts; ++i) {
        const double m = a + (i + 0.5) * h;
        sum += h / 18 * (5 * f(m - o) + 8 * f(m) + 5 * f(m + o));
    }
    return sum;
}

double arc(double x, double y, double z, double r, double theta, double s) {
    return op_value(Op::conv_arc, {x, y, z}, {0, 0, 0, 1, 0, 0, 0, 1, 0, r, theta, s, 1});
}
double arc_by_quadrature(double x, double y, double z, double r, double theta, double s) {
    return integral(
        [=](double t) {
            const double dx = x - r * std::cos(t), dy = y - r * std::sin(t);
            return cauchy(s, dx * dx + dy * dy + z * z);
        },
        0, theta);
}

}  // namespace

TEST_CASE("points") {
    CHECK(op_value(Op::conv_point, {1, 0, 0}, {0, 0, 0, 1}) == 0.25);
    CHECK(op_value(Op::conv_point, {1, 0, 0}, {0, 0, 0, 2}) == Approx(0.04).epsilon(1e-15));
}

TEST_CASE("segments: value, quadrature, additivity, degenerate ones") {
    CHECK(op_value(Op::conv_line, {0, 1, 0}, {-1, 0, 0, 1, 0, 0, 1}) ==
          Approx(0.384271604508).epsilon(1e-12));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int i = 0; i < 200; ++i) {
        double a[3], b[3], p[3], m[3];
        for (int k = 0; k < 3; ++k) a[k] = uniform(random), b[k] = uniform(random), p[k] = uniform(random);
        for (int k = 0; k < 3; ++k) m[k] = 0.3 * a[k] + 0.7 * b[k];
        const double s = std::exp(0.5 * uniform(random));
        const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        const double whole =
            op_value(Op::conv_line, {p[0], p[1], p[2]}, {a[0], a[1], a[2], b[0], b[1], b[2], s});
        const double numeric = length * integral(
                                            [&](double t) {
                                                double r2 = 0;
                                                for (int k = 0; k < 3; ++k)
                                                    r2 += std::pow(p[k] - a[k] - t * (b[k] - a[k]), 2);
                                                return cauchy(s, r2);
                                            },
                                            0, 1);
        CHECK(whole == Approx(numeric).epsilon(1e-9));
        const double split =
            op_value(Op::conv_line, {p[0], p[1], p[2]},
                     {a[0], a[1], a[2], m[0], m[1], m[2], s, m[0], m[1], m[2], b[0], b[1], b[2], s});
        CHECK(split == Approx(whole).epsilon(1e-13));
        CHECK(op_value(Op::conv_line, {p[0], p[1], p[2]}, {a[0], a[1], a[2], b[0], b[1], b[2], 0}) ==
              Approx(length).epsilon(1e-14));
    }
    CHECK(op_value(Op::conv_line, {0, 1, 0}, {1, 1, 1, 1, 1, 1, 1}) == 0);
    CHECK(op_value(Op::conv_line, {1, 1, 1}, {1, 1, 1, 1, 1, 1, 1}) == 0);
}

TEST_CASE("the clamped sum is clamped as it grows") {
    const std::vector<double> twice = {-5, 0, 0, 5, 0, 0, -5, 0, 0, 5, 0, 0};
    CHECK(op_value(Op::conv_line_clamped, {0, 0, 0, 1}, twice) == 1);
    CHECK(op_value(Op::conv_line_clamped, {0, 3, 0, 1}, twice) ==
          2 * op_value(Op::conv_line, {0, 3, 0}, {-5, 0, 0, 5, 0, 0, 1}));
}

TEST_CASE("triangles: values, quadrature, additivity, infinite plane, degenerate ones") {
    const std::vector<double> corners = {-1, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto value = [](std::vector<double> p, std::vector<double> t, double s) {
        t.push_back(s);
        t.push_back(1);
        return op_value(Op::conv_triangle, p, t);
    };
    CHECK(value({0, 0, 1}, corners, 1) == Approx(0.188068672114).epsilon(1e-12));
    CHECK(value({0, 0, 1}, corners, 2) == Approx(0.026238782847).epsilon(1e-11));
    CHECK(value({0, 0, 1}, corners, 0) == Approx(1.0).epsilon(1e-15));
    CHECK(value({0, 0, 0.5}, {-1e5, -1e5, 0, 1e5, -1e5, 0, 0, 2e5, 0}, 1) ==
          Approx(2.513274122872).epsilon(1e-8));
    CHECK(value({0, 0, 1}, {0, 0, 0, 1, 1, 1, 2, 2, 2}, 1) == 0);
    CHECK(value({0, 0, 1}, {0, 0, 0, 0, 0, 0, 2, 2, 2}, 1) == 0);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    for (int i = 0; i < 20; ++i) {
        std::vector<double> t(9), p(3), m(3);
        for (double& v : t) v = uniform(random);
        for (double& v : p) v = uniform(random);
        const double s = std::exp(0.5 * uniform(random)), whole = value(p, t, s);
        double u[3], v[3];
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = t[3 + k] - t[k];
            v[k] = t[6 + k] - t[k];
            m[k] = 0.4 * t[k] + 0.6 * t[3 + k];
        }
        const double area2 =
            std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
        const double numeric =
            area2 * integral(
                        [&](double a) {
                            return (1 - a) *
                                   integral(
                                       [&](double b) {
                                           double r2 = 0;
                                           for (std::size_t k = 0; k < 3; ++k)
                                               r2 += std::pow(p[k] - t[k] - a * u[k] - (1 - a) * b * v[k], 2);
                                           return cauchy(s, r2);
                                       },
                                       0, 1, 60);
                        },
                        0, 1, 60);
        CHECK(whole == Approx(numeric).epsilon(1e-6));
        const double parts = value(p, {t[0], t[1], t[2], m[0], m[1], m[2], t[6], t[7], t[8]}, s) +
                             value(p, {m[0], m[1], m[2], t[3], t[4], t[5], t[6], t[7], t[8]}, s);
        CHECK(parts == Approx(whole).epsilon(1e-11));
        const double turned = value(p, {t[6], t[7], t[8], t[3], t[4], t[5], t[0], t[1], t[2]}, s);
        CHECK(turned == Approx(whole).epsilon(1e-12));
    }
}

TEST_CASE("arcs: values, quadrature, any angle") {
    CHECK(arc(0.7, 0.3, 0.2, 1.2, 1, 0.9) == Approx(0.639544985884).epsilon(1e-11));
    CHECK(arc(0, 0, 0.5, 1.2, 2 * pi, 0.9) == Approx(1.119660642522).epsilon(1e-11));
    CHECK(arc(1.2, 0, 0, 1.2, 2 * pi, 0.9) == Approx(1.552816927938).epsilon(1e-11));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int i = 0; i < 300; ++i) {
        const double x = i % 7 ? uniform(random) : 0, y = i % 5 ? uniform(random) : 0, z = uniform(random);
        const double r = 0.2 + std::abs(uniform(random)), s = std::exp(0.5 * uniform(random));
        const double theta = i % 11 ? pi + 1.5 * uniform(random) : 2 * pi;
        CHECK(arc(x, y, z, r, theta, s) == Approx(arc_by_quadrature(x, y, z, r, theta, s)).epsilon(1e-9));
    }
    CHECK(arc(0.3, 0.2, 0.1, 1, 0, 1) == 0);
}

TEST_CASE("gradient of an arc on its axis") {
    Sketch s;
    Items center = s.list({0, 0, 0}), radius = s.list({1.2}), theta = s.list({100}), axis = s.list({0, 0, 1}),
          angle = s.list({0}), width = s.list({0.9});
    const Expression f = s.call("hfConvArc", {s.x, center, radius, theta, axis, angle, width, 0.0});
    const auto d = gradient_at(f, 0, 0, 0.3);
    const double h = 1e-5;
    CHECK(d.d[0] == Approx((at(f, h, 0, 0.3) - at(f, -h, 0, 0.3)) / (2 * h)).epsilon(1e-5));
    CHECK(d.d[1] == Approx((at(f, 0, h, 0.3) - at(f, 0, -h, 0.3)) / (2 * h)).epsilon(1e-5));
    CHECK(d.d[2] == Approx((at(f, 0, 0, 0.3 + h) - at(f, 0, 0, 0.3 - h)) / (2 * h)).epsilon(1e-5));
}

TEST_CASE("the factor S^3 of the old triangles, and the exact ones") {
    for (const double width : {0.5, 0.8, 1.0, 1.3, 2.0}) {
        Sketch s;
        Items corners = s.list({0, 0, 0, 2, 0.3, 0, 0.5, 1.5, 0.4}), numbers = s.list({1, 2, 3}),
              widths = s.list({width});
        const double old_value = at(s.call("hfConvTriangle", {s.x, corners, widths, 0.0}), 0.4, 0.5, 0.6);
        const double exact = at(s.call("hfConvTriangleExact", {s.x, corners, widths, 0.0}), 0.4, 0.5, 0.6);
        CHECK(old_value == Approx(width * width * width * exact).epsilon(1e-14));
        CHECK(at(s.call("hfConvMesh", {s.x, corners, numbers, widths, 0.0}), 0.4, 0.5, 0.6) == old_value);
        CHECK(at(s.call("hfConvMeshExact", {s.x, corners, numbers, widths, 0.0}), 0.4, 0.5, 0.6) == exact);
        CHECK(s.warnings.empty());
    }
}

TEST_CASE("arc length is the radius times the angle integral") {
    Sketch s;
    Items center = s.list({0.3, -0.2, 0.5}), radius = s.list({1.5}), theta = s.list({200}),
          axis = s.list({0.2, 1, 0.4}), angle = s.list({35}), width = s.list({0.9});
    const double by_angle =
        at(s.call("hfConvArc", {s.x, center, radius, theta, axis, angle, width, 0.0}), 1, 0, 0);
    const double by_length =
        at(s.call("hfConvArcLength", {s.x, center, radius, theta, axis, angle, width, 0.0}), 1, 0, 0);
    CHECK(by_length == Approx(1.5 * by_angle).epsilon(1e-14));
}

TEST_CASE("mesh vertices may be chosen by the point; out of range is undefined") {
    Sketch s;
    Items corners = s.list({0, 0, 0, 2, 0.3, 0, 0.5, 1.5, 0.4}), widths = s.list({1});
    Items fixed = s.list({1, 2, 3}), chosen = fixed;
    chosen[0] = s.x[0];
    const Expression f = s.call("hfConvMesh", {s.x, corners, chosen, widths, 0.0});
    const Expression g = s.call("hfConvMesh", {s.x, corners, fixed, widths, 0.0});
    CHECK(at(f, 1, 0.5, 0.5) == at(g, 1, 0.5, 0.5));
    CHECK(std::isnan(at(f, 4, 0.5, 0.5)));
}

TEST_CASE("a thousand points are one node") {
    Sketch s;
    Items points(3000, s.number(0.5)), widths(1000, s.number(1));
    const std::size_t before = s.graph.size();
    s.call("hfConvPoint", {s.x, points, widths, 0.1});
    CHECK(s.graph.size() <= before + 3);
}
