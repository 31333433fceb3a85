// The distance-like family: SARDF operations, distance to an ellipsoid against a search, sawtooth.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

double op_value(Op op, std::vector<double> a) { return meaning<double>(op, a, {}); }
double sardf(double x, double y, double r, double alpha) { return op_value(Op::sardf_int, {x, y, r, alpha}); }
double ellipsoid(double x, double y, double z, double a, double b, double c) {
    return op_value(Op::ellipsoid_distance, {x, y, z, a, b, c});
}

/// Distance to an ellipsoid by refining a grid of angles.
double searched_distance(const double* p, const double* e) {
    double best = 1e300, u0 = 0, v0 = 0, span = 3.2;
    for (int round = 0; round < 60; ++round) {
        double bu = u0, bv = v0;
        for (int i = -10; i <= 10; ++i)
            for (int j = -10; j <= 10; ++j) {
                const double u = u0 + span * i / 10, v = v0 + span * j / 10;
                const double q[3] = {e[0] * std::cos(u) * std::cos(v), e[1] * std::sin(u) * std::cos(v),
                                     e[2] * std::sin(v)};
                const double d = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
                if (d < best) best = d, bu = u, bv = v;
            }
        u0 = bu, v0 = bv;
        span *= round < 4 ? 0.7 : 0.5;
    }
    double inside = 1;
    for (int k = 0; k < 3; ++k) inside -= p[k] * p[k] / (e[k] * e[k]);
    return inside >= 0 ? best : -best;
}

}  // namespace

TEST_CASE("SARDF: identities, axes, level circles") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-3, 3);
    for (int i = 0; i < 5000; ++i) {
        const double x = uniform(random), y = uniform(random), r = 0.1 + std::abs(uniform(random));
        const double alpha = 0.1 * std::abs(uniform(random)), d = sardf(x, y, r, alpha);
        CHECK(d == sardf(y, x, r, alpha));
        if (x < 0 && y > 0) CHECK(d == x);
        if (x > 0 && y > 0) {
            CHECK(d <= std::min(x, y));
            CHECK(d >= 0);
            const double a = d <= r ? 2 * std::sqrt(r * d) : d + r;  // centre of the level circle of d
            if (d < std::min(x, y)) CHECK(std::hypot(x - a, y - a) == Approx(a - d).epsilon(1e-9));
        }
        if (x < 0 && y < 0) CHECK(d <= std::min(x, y));
    }
    CHECK(sardf(-3, -4, 1, 0) == Approx(-5));
    CHECK(sardf(5e-8, 1, 1, 0.2) == 0);
    CHECK(sardf(5e-8, -1, 1, 0.2) == -1);
    CHECK(sardf(5e-8, -5e-8, 1, 0.2) == 0);
    CHECK(sardf(-1, -1, 1, 0.39269908169872414) ==
          Approx(-1 / std::sqrt(2.0) * 1.7071067811865475).epsilon(1e-9));
    CHECK(std::isnan(sardf(std::nan(""), 1, 1, 0)));
    CHECK(std::isnan(sardf(1, 1, std::nan(""), 0)));
}

TEST_CASE("SARDF grows with both operands and falls with the radius") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int i = 0; i < 50000; ++i) {
        const double x = uniform(random), y = uniform(random), r = 0.05 + std::abs(uniform(random));
        const double dx = std::abs(uniform(random)) * (i % 2 ? 1 : 1e-3),
                     alpha = 0.2 * std::abs(uniform(random));
        CHECK(sardf(x, y, r, alpha) <= sardf(x + dx, y, r, alpha) + 1e-14);
        CHECK(sardf(x, y, r + dx, alpha) <= sardf(x, y, r, alpha) + 1e-14);
    }
}

TEST_CASE("SARDF gradients") {
    Sketch s;
    const Expression f = s.call("hfDInt", {s.x[0], s.x[1], s.x[2], 0.3});
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.1, 2);
    for (int i = 0; i < 2000; ++i) {
        const double p[3] = {uniform(random), uniform(random), uniform(random)}, h = 1e-6;
        const auto d = gradient_at(f, p[0], p[1], p[2]);
        CHECK(d.value == at(f, p[0], p[1], p[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            double q[3] = {p[0], p[1], p[2]};
            q[k] += h;
            const double up = at(f, q[0], q[1], q[2]);
            q[k] -= 2 * h;
            CHECK(d.d[k] == Approx((up - at(f, q[0], q[1], q[2])) / (2 * h)).epsilon(1e-4));
        }
    }
    CHECK(gradient_at(f, 0, 1, 1).d[0] == 1);
    CHECK(gradient_at(f, 0, 0, 1).d[1] == 1);
}

TEST_CASE("fillets of constant radius") {
    CHECK(op_value(Op::sardf_blend, {1, 1, 1}) == Approx(1 - 1 + 1 / std::sqrt(2.0)));
    CHECK(op_value(Op::sardf_blend, {1, 2, 1}) == Approx(1));
    CHECK(op_value(Op::sardf_blend, {1, 5, 1}) == 1);
    CHECK(op_value(Op::sardf_blend, {1, 5, -1}) == 1);
    Sketch s;
    const Expression u = s.call("hfDBlendUni", {s.x[0], s.x[1], 1.3}),
                     i = s.call("hfDBlendInt", {-s.x[0], -s.x[1], 1.3});
    CHECK(at(u, 0.3, 0.4, 0) == -at(i, 0.3, 0.4, 0));
}

TEST_CASE("distance to an ellipsoid") {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(-3, 3);
    for (int i = 0; i < 60; ++i) {
        double p[3], e[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = (i >> k) % 3 == 0 && i % 2 == 0 ? 0 : uniform(random);  // planes of symmetry too
            e[k] = i % 5 == 0 ? 1.5 : 0.3 + std::abs(uniform(random));
        }
        if (i % 5 == 1) e[1] = e[0];
        CHECK(ellipsoid(p[0], p[1], p[2], e[0], e[1], e[2]) == Approx(searched_distance(p, e)).epsilon(1e-7));
    }
    CHECK(ellipsoid(0, 0, 0, 3, 1, 2) == 1);
    CHECK(ellipsoid(0, 0, 0, 2, 2, 2) == 2);
    CHECK(ellipsoid(5, 0, 0, 2, 1, 1) == -3);
    CHECK(ellipsoid(1, 1e-300, 0, 2, 1, 1) == Approx(ellipsoid(1, 0, 0, 2, 1, 1)));
    CHECK(ellipsoid(1.2, 1e-9, 0, 2, 1, 0.5) == Approx(ellipsoid(1.2, 0, 0, 2, 1, 0.5)).epsilon(1e-8));
    CHECK(std::isnan(ellipsoid(1, 1, 1, 0, 1, 1)));
    CHECK(std::isnan(ellipsoid(std::nan(""), 1, 1, 1, 1, 1)));
    for (int i = 0; i < 2000; ++i) {  // near the surface, and for slender ones
        const double u = uniform(random), v = 0.5 * uniform(random), d = 1e-3 * uniform(random);
        const double a = 2, b = 1, c = i % 2 ? 0.7 : 2e-2;
        const double x = a * std::cos(u) * std::cos(v), y = b * std::sin(u) * std::cos(v),
                     z = c * std::sin(v);
        double n[3] = {x / a / a, y / b / b, z / c / c};
        const double length = std::hypot(n[0], n[1], n[2]);
        if (c < 0.1 && d < 0) continue;
        CHECK(ellipsoid(x + std::abs(d) * n[0] / length, y + std::abs(d) * n[1] / length,
                        z + std::abs(d) * n[2] / length, a, b, c) == Approx(-std::abs(d)).epsilon(1e-7));
    }
}

TEST_CASE("gradient of the ellipsoid's distance") {
    Sketch s;
    Items center = s.list({0, 0, 0});
    const Expression f = s.call("hfDEllipsoid", {s.x, center, 2.0, 1.0, s.x[2] + 1.5});
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 500; ++i) {
        const double p[3] = {2.5 * uniform(random), 1.5 * uniform(random), uniform(random)}, h = 1e-6;
        const auto d = gradient_at(f, p[0], p[1], p[2]);
        CHECK(d.value == at(f, p[0], p[1], p[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            double q[3] = {p[0], p[1], p[2]};
            q[k] += h;
            const double up = at(f, q[0], q[1], q[2]);
            q[k] -= 2 * h;
            CHECK(d.d[k] == Approx((up - at(f, q[0], q[1], q[2])) / (2 * h)).epsilon(2e-4));
        }
    }
}

TEST_CASE("sawtooth") {
    const auto direct = [](double t, int n, double a, double f) {
        double sum = 0;
        for (int i = 1; i < n; ++i) sum += std::sin(2 * 3.14159265358979323846 * i * f * t) / i;
        return n <= 1 ? 0 : (0.5 - sum) * 2 / (a * 3.14159265358979323846);
    };
    for (const int n : {0, 1, 2, 3, 10, 200})
        CHECK(op_value(Op::sawtooth, {0.3, double(n), 1.5, 0.7}) ==
              Approx(direct(0.3, n, 1.5, 0.7)).epsilon(1e-12));
    CHECK(std::isnan(op_value(Op::sawtooth, {0.3, 1e9, 1.5, 0.7})));
    CHECK(std::isnan(op_value(Op::sawtooth, {0.3, std::nan(""), 1.5, 0.7})));
}

TEST_CASE("distance primitives") {
    Sketch s;
    Items center = s.list({0, 0, 0}), u = s.list({1, 1, 0}), corner = s.list({-1, -1, -1});
    CHECK(at(s.call("hfDTorusZ", {s.x, center, 2.0, 0.5}), 2, 0, 0) == 0.5);
    CHECK(at(s.call("hfDCylinder", {s.x, center, u, 1.0}), 3, 3, 0.25) == Approx(0.75));
    CHECK(at(s.call("hfDConeZ", {s.x, center, 1.0}), 0, 0, 1) == Approx(std::sqrt(0.5)));
    const Expression block = s.call("hfDBlock", {s.x, corner, 2.0, 2.0, 2.0});
    CHECK(at(block, 0, 0, 0) > 0);
    CHECK(at(block, 0.99, 0, 0) == Approx(0.01));
    CHECK(at(block, 1.5, 0, 0) == Approx(-0.5));
}
