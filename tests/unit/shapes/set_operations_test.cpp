// Systems of R-functions: the worked values of thesis 1.3.2 and of the theory notes, signs for every pair of
// numbers, set algebra as properties, gradients, intervals; symmetric forms, balanced trees, smooth and
// Ricci's operations.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "frep/shapes/set_operations.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;
using math::Interval;

namespace {

using Dual = math::Dual<double>;

double value(Op op, double a, double b, double p) {
    return meaning<double>(op, std::vector<double>{a, b, p}, {});
}

struct Family {
    const char* name;
    Op conjunction, disjunction;
    std::vector<double> parameters;
};
const std::vector<Family> families{
    {"R_alpha", Op::r_alpha_and, Op::r_alpha_or, {-0.999, -0.5, 0, 0.5, 0.999999, 1}},
    {"R_0^m", Op::r0m_and, Op::r0m_or, {0, 1, 2, 3, 0.5}},
    {"R_p", Op::rp_and, Op::rp_or, {1.01, 1.5, 2, 4, 40}},
};

double sign_of(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// Numbers of both signs over the whole range of magnitudes, and special ones.
std::vector<double> numbers() {
    std::vector<double> out{0, 1, -1, 1e-300, -1e-300, 1e-20, -1e-20, 1e20, 1e300, -1e300, 5e-324, -5e-324};
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> exponent(-30, 30), mantissa(-2, 2);
    for (int i = 0; i < 60; ++i) out.push_back(mantissa(random) * std::pow(10.0, exponent(random)));
    for (int i = 0; i < 40; ++i) out.push_back(mantissa(random));
    return out;
}

}  // namespace

TEST_CASE("worked values of the systems") {
    CHECK(value(Op::r_alpha_and, 3, 4, 0) == Approx(2));
    CHECK(value(Op::r_alpha_or, -3, 4, 0) == Approx(6));
    CHECK(value(Op::r_alpha_and, 3, 4, 0.5) == Approx(2.262965816357).epsilon(1e-12));
    CHECK(value(Op::r_alpha_or, 3, 4, 0.5) == Approx(7.070367516976).epsilon(1e-12));
    CHECK(value(Op::r_alpha_and, -3, 4, 0.5) == Approx(-3.388508353532).epsilon(1e-12));
    CHECK(value(Op::r_alpha_or, -3, 4, 0.5) == Approx(4.721841686865).epsilon(1e-12));
    CHECK(value(Op::r0m_and, 3, 4, 1) == Approx(10));
    CHECK(value(Op::r0m_or, 3, 4, 1) == Approx(60));
    CHECK(value(Op::r0m_and, 3, 4, 2) == Approx(50));
    CHECK(value(Op::r0m_or, 3, 4, 2) == Approx(300));
    CHECK(value(Op::rp_and, 3, 4, 4) == Approx(2.715427705046).epsilon(1e-12));
    CHECK(value(Op::rp_or, 3, 4, 4) == Approx(11.284572294954).epsilon(1e-12));
}

TEST_CASE("R_alpha: alpha 0 is R0, alpha 1 is minimum and maximum") {
    for (const double a : numbers()) {
        for (const double b : numbers()) {
            const double r0 = meaning<double>(Op::r_and, std::vector<double>{a, b}, {});
            const double scale = std::min(1e150, std::max(std::abs(a), std::abs(b)));
            CHECK(std::abs(value(Op::r_alpha_and, a, b, 0) - r0) <= 4e-15 * scale + 1e-307);
            const double least = std::max(-1e150, std::min(1e150, std::min(a, b)));
            CHECK(value(Op::r_alpha_and, a, b, 1) == Approx(least).epsilon(1e-14));
        }
    }
}

TEST_CASE("signs are those of minimum and maximum for every pair") {
    for (const Family& family : families) {
        CAPTURE(family.name);
        for (const double p : family.parameters) {
            CAPTURE(p);
            std::size_t wrong = 0;
            for (const double a : numbers()) {
                for (const double b : numbers()) {
                    wrong += sign_of(value(family.conjunction, a, b, p)) != sign_of(std::min(a, b));
                    wrong += sign_of(value(family.disjunction, a, b, p)) != sign_of(std::max(a, b));
                    // De Morgan, to the bit
                    wrong += value(family.disjunction, a, b, p) != -value(family.conjunction, -a, -b, p);
                    wrong += value(family.conjunction, a, b, p) != value(family.conjunction, b, a, p);
                }
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("the formulas, against direct evaluation where nothing cancels") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-2, 2), alphas(-0.9, 1), powers(1.1, 9), exponents(0, 3);
    for (int i = 0; i < 20000; ++i) {
        const double a = uniform(random), b = uniform(random);
        const double alpha = alphas(random), p = powers(random), m = exponents(random);
        const double root = std::sqrt(a * a + b * b - 2 * alpha * a * b);
        const double scale = std::abs(a) + std::abs(b);
        CHECK(std::abs(value(Op::r_alpha_and, a, b, alpha) - (a + b - root) / (1 + alpha)) <=
              1e-14 * scale / (1 + alpha));
        const double norm = std::pow(std::pow(std::abs(a), p) + std::pow(std::abs(b), p), 1 / p);
        CHECK(std::abs(value(Op::rp_and, a, b, p) - (a + b - norm)) <= 1e-14 * scale);
        const double r0 = a + b - std::hypot(a, b);
        CHECK(std::abs(value(Op::r0m_or, a, b, m) -
                       (a + b + std::hypot(a, b)) * std::pow(std::hypot(a, b), m)) <=
              1e-13 * (1 + scale) * std::pow(scale, m));
        CHECK(std::abs(value(Op::r0m_and, a, b, m) - r0 * std::pow(std::hypot(a, b), m)) <=
              1e-13 * (1 + scale) * std::pow(scale, m));
    }
}

TEST_CASE("parameters out of range leave no value") {
    const auto undefined = [](double v) { return v != v; };
    CHECK(undefined(value(Op::r_alpha_and, 1, 2, -1)));
    CHECK(undefined(value(Op::r_alpha_and, 1, 2, 1.0001)));
    CHECK(undefined(value(Op::r0m_or, 1, 2, -0.1)));
    CHECK(undefined(value(Op::rp_and, 1, 2, 1)));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Family& family : families) {
        const double p = family.parameters[2];
        CHECK(undefined(value(family.conjunction, nan, 2, p)));
        CHECK(undefined(value(family.disjunction, 1, nan, p)));
        CHECK(undefined(value(family.disjunction, 1, 2, nan)));
    }
}

TEST_CASE("gradients agree with differences, and are 1 and 1 at the corner") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-2, 2);
    const double h = 1e-6;
    for (const Family& family : families) {
        for (const Op op : {family.conjunction, family.disjunction}) {
            for (int i = 0; i < 500; ++i) {
                const double a = uniform(random), b = uniform(random);
                const double p = family.conjunction == Op::r_alpha_and ? 0.3 : 2.6;
                const std::vector<Dual> at{Dual::variable(a, 0), Dual::variable(b, 1), Dual::variable(p, 2)};
                const Dual r = meaning<Dual>(op, at, {});
                CHECK(r.value == value(op, a, b, p));
                CHECK(r.d[0] ==
                      Approx((value(op, a + h, b, p) - value(op, a - h, b, p)) / (2 * h)).epsilon(1e-4));
                CHECK(r.d[1] ==
                      Approx((value(op, a, b + h, p) - value(op, a, b - h, p)) / (2 * h)).epsilon(1e-4));
                CHECK(r.d[2] ==
                      Approx((value(op, a, b, p + h) - value(op, a, b, p - h)) / (2 * h)).epsilon(1e-4));
            }
        }
    }
    for (const Op op : {Op::r_alpha_and, Op::r_alpha_or, Op::rp_and, Op::rp_or}) {
        const double p = op == Op::r_alpha_and || op == Op::r_alpha_or ? 0.3 : 3;
        const Dual r =
            meaning<Dual>(op, std::vector<Dual>{Dual::variable(0, 0), Dual::variable(0, 1), Dual(p)}, {});
        CHECK(r.value == 0);
        CHECK(r.d[0] == 1);
        CHECK(r.d[1] == 1);
    }
    // R_0^m is smooth there: the partials vanish
    const Dual flat = meaning<Dual>(
        Op::r0m_and, std::vector<Dual>{Dual::variable(0, 0), Dual::variable(0, 1), Dual(1)}, {});
    CHECK(flat.value == 0);
    CHECK(flat.d[0] == 0);
    CHECK(flat.d[1] == 0);
    CHECK(value(Op::r0m_or, 0, 0, 5e-7) == 0);
    CHECK(value(Op::r0m_or, 1, 0, std::numeric_limits<double>::infinity()) == 2);
    // on the boundary of one solid within the other the value is that of a distance: partials 1 and 0
    for (const Op op : {Op::r_alpha_and, Op::rp_and}) {
        const Dual r = meaning<Dual>(
            op,
            std::vector<Dual>{Dual::variable(0, 0), Dual::variable(2, 1), Dual(op == Op::rp_and ? 3 : 0.4)},
            {});
        CHECK(r.d[0] == Approx(1));
        CHECK(r.d[1] == Approx(0));
    }
}

TEST_CASE("ranges hold the values, and keep a sign that is sure") {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> uniform(-2, 2), share(0, 1), wide(0, 0.5);
    for (const Family& family : families) {
        CAPTURE(family.name);
        for (const Op op : {family.conjunction, family.disjunction}) {
            std::size_t outside = 0, unsure = 0;
            for (int i = 0; i < 4000; ++i) {
                const double p = family.parameters[static_cast<std::size_t>(i) % family.parameters.size()];
                const double a = uniform(random), b = uniform(random);
                const Interval x{a, a + wide(random)}, y{b, b + wide(random)},
                    q{p, p + (i % 3 == 0 && p < 0.9 ? 0.05 : 0)};
                const Interval range = meaning<Interval>(op, std::vector<Interval>{x, y, q}, {});
                const auto within = [&](const Interval& r) { return r.lo + share(random) * (r.hi - r.lo); };
                for (int k = 0; k < 10; ++k) {
                    const double v = value(op, within(x), within(y), within(q));
                    outside += !(v >= range.lo && v <= range.hi);
                }
                const bool conjunction = op == family.conjunction;
                const bool is_positive = conjunction ? a > 0 && b > 0 : a > 0 || b > 0;
                const bool is_negative = conjunction ? x.hi < 0 || y.hi < 0 : x.hi < 0 && y.hi < 0;
                unsure += (is_positive && !(range.lo > 0)) || (is_negative && !(range.hi < 0));
            }
            CHECK(outside == 0);
            CHECK(unsure == 0);
        }
    }
}

TEST_CASE("set algebra: the signs of laws, at random points and for every system") {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> uniform(-1, 1);
    using Kind = shapes::SetSystem::Kind;
    const shapes::SetSystem systems[] = {
        {Kind::r0, 0}, {Kind::min_max, 0}, {Kind::r_alpha, 0.5}, {Kind::r0m, 1}, {Kind::rp, 3}};
    for (const auto& system : systems) {
        Sketch s;
        const Expression &a = s.x[0], &b = s.x[1], &c = s.x[2];
        const auto unite = [&](Expression f, Expression g) { return shapes::disjunction(system, f, g); };
        const auto meet = [&](Expression f, Expression g) { return shapes::conjunction(system, f, g); };
        const auto minus = [&](Expression f, Expression g) { return shapes::subtraction(system, f, g); };
        const std::pair<Expression, Expression> laws[] = {
            {unite(a, unite(b, c)), unite(unite(a, b), c)},
            {meet(a, meet(b, c)), meet(meet(a, b), c)},
            {meet(a, unite(b, c)), unite(meet(a, b), meet(a, c))},
            {unite(a, meet(b, c)), meet(unite(a, b), unite(a, c))},
            {-unite(a, b), meet(-a, -b)},
            {minus(a, unite(b, c)), meet(minus(a, b), minus(a, c))},
            {unite(a, meet(a, b)), a},
            {meet(a, unite(a, b)), a},
        };
        for (int i = 0; i < 2000; ++i) {
            const double x = uniform(random), y = uniform(random), z = uniform(random);
            for (const auto& [left, right] : laws)
                CHECK(sign_of(at(left, x, y, z)) == sign_of(at(right, x, y, z)));
        }
    }
}

TEST_CASE("symmetric forms and balanced trees") {
    Sketch s;
    const auto both = [&](const char* name, std::initializer_list<double> list, double m) {
        Items items = s.list(list);
        return at(s.call(name, {items, m}), 0, 0, 0);
    };
    CHECK(both("hfSymmetricInt", {1, 2, 3}, 0) == 48);
    CHECK(both("hfSymmetricInt", {1, -2, 3}, 0) == -4);
    CHECK(both("hfSymmetricUni", {1, -2, 3}, 0) == 8);
    CHECK(both("hfSymmetricUni", {-1, -2, -3}, 0) == -48);
    CHECK(both("hfSymmetricInt", {1, -2, 3}, 1) == -8);  // |-2|^1 (-4)
    // (1 & 2) & 3 and 1 & (2 & 3) differ; a list is read in pairs
    Items list = s.list({1, 2, 3});
    CHECK(at(s.call("hfIntersectionOf", {list}), 0, 0, 0) == Approx(0.668194285708).epsilon(1e-11));
    CHECK(at(s.call("hfUnionOf", {list}), 0, 0, 0) == Approx(14.270668864468).epsilon(1e-11));
    Items empty;
    CHECK(at(s.call("hfUnionOf", {empty}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 1);
    // values far outside grow with the depth of the tree, not with the number of operands
    Items many;
    for (int i = 0; i < 64; ++i) many.push_back(s.x[0] - 1.0);
    const double far = at(s.call("hfIntersectionOf", {many}), -9, 0, 0);
    CHECK(far == Approx(-10 * std::pow(2 + std::sqrt(2.0), 6)).epsilon(1e-9));
}

TEST_CASE("smooth operations are exact beyond their width") {
    Sketch s;
    const Expression f = s.call("hfSmoothUni", {s.x[0], s.x[1], 0.5});
    CHECK(at(f, 1, 0.5, 0) == 1);
    CHECK(at(f, 0.25, -0.3, 0) == 0.25);
    CHECK(at(f, 0, 0, 0) == Approx(0.125));  // k/4
    const Expression g = s.call("hfSmoothInt", {s.x[0], s.x[1], 0.5});
    CHECK(at(g, 0, 0, 0) == Approx(-0.125));
    const Expression h = s.call("hfSmoothSub", {s.x[0], s.x[1], 0.5});
    CHECK(at(h, 0.1, -0.1, 0) == Approx(0.1 - 0.125));
    CHECK(at(s.call("hfSmoothUni", {s.x[0], s.x[1], 0.0}), 0.2, 0.1, 0) == 0.2);
    CHECK(at(s.call("hfSmoothUni", {s.x[0], s.x[1], -1.0}), 0.2, 0.1, 0) == shapes::error_value);
}

TEST_CASE("Ricci's operations tend to minimum and maximum") {
    Sketch s;
    for (const double p : {2.0, 8.0, 32.0}) {
        const Expression f = s.call("hfRicciUni", {s.x[0], s.x[1], p});
        const Expression g = s.call("hfRicciInt", {s.x[0], s.x[1], p});
        // both surfaces at once: the union adds 1 - 2^(-1/p), the intersection takes 2^(1/p) - 1
        CHECK(at(f, 0, 0, 0) == Approx(1 - std::pow(2, -1 / p)));
        CHECK(at(g, 0, 0, 0) == Approx(1 - std::pow(2, 1 / p)));
        CHECK(at(f, 0.3, -2, 0) == Approx(1 - std::pow(std::pow(0.7, -p) + std::pow(3, -p), -1 / p)));
    }
}

TEST_CASE("symmetric difference by the file's system") {
    Sketch s;
    s.build.set_system = {shapes::SetSystem::Kind::min_max, 0};
    const Expression f = s.call("hfSymDiff", {s.x[0], s.x[1]});
    for (const double a : {-1.0, 0.5, 2.0})
        for (const double b : {-2.0, 0.25, 1.0})
            CHECK(at(f, a, b, 0) == std::max(std::min(a, -b), std::min(b, -a)));
}
