// Derivatives as nodes: against the gradients of the engines at points, against difference quotients over
// boxes, at jumps, and through the formulas of the blends.
#include "frep/field/derivative.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "frep/field/spelled_out.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using math::Interval;

namespace {

struct Case {
    std::string name;
    std::function<Expression(Sketch&)> make;
};

Expression disc(Sketch& s) { return 1.0 - square(s.x[0]) - square(s.x[1]); }
Expression bar(Sketch& s) { return 0.3 - abs(s.x[1] - 0.2) + 0.1 * s.x[2]; }
Expression ball(Sketch& s) { return 0.8 - sqrt(square(s.x[0] - 0.4) + square(s.x[1]) + square(s.x[2])); }

Case with_operands(const char* name, Op op, std::vector<double> numbers) {
    return {name, [op, numbers](Sketch& s) {
                std::vector<NodeId> ids{disc(s).id(), bar(s).id()};
                if (op == Op::bounded_uni || op == Op::bounded_int) ids.push_back(ball(s).id());
                for (const double number : numbers) ids.push_back(s.graph.constant(number));
                return Expression(s.graph, s.graph.make(op, ids));
            }};
}

/// Functions that have a derivative but for creases.
const std::vector<Case>& smooth_cases() {
    using S = Sketch;
    static const std::vector<Case> all = {
        {"arithmetic", [](S& s) { return (s.x[0] - 2.0 * s.x[1]) * s.x[2] / (3.0 + s.x[1]) - -s.x[0]; }},
        {"square, root", [](S& s) { return sqrt(square(s.x[0]) + 2.0) + abs(s.x[1]); }},
        {"min, max", [](S& s) { return max(min(s.x[0], s.x[1]), s.x[2] * 0.5); }},
        {"hypot", [](S& s) { return hypot(s.x[0] + 0.1, s.x[1] * s.x[2]); }},
        {"exp, log", [](S& s) { return exp(s.x[0]) * log(3.0 + s.x[1]) + log10(4.0 + s.x[2]); }},
        {"circular", [](S& s) { return sin(s.x[0]) * cos(s.x[1]) + tan(0.4 * s.x[2]); }},
        {"inverse", [](S& s) { return asin(0.3 * s.x[0]) + acos(0.3 * s.x[1]) * atan(s.x[2]); }},
        {"angle", [](S& s) { return atan2(s.x[0], s.x[1] + 3.0) * s.x[2]; }},
        {"hyperbolic", [](S& s) { return sinh(s.x[0]) + cosh(s.x[1]) * tanh(s.x[2]); }},
        {"powers", [](S& s) { return pow(s.x[0], 3.0) + pow(s.x[1], 2.0) + pow(2.5 + s.x[1], s.x[2]); }},
        {"r0", [](S& s) { return r_or(r_and(disc(s), bar(s)), ball(s)); }},
        with_operands("r_alpha_and", Op::r_alpha_and, {0.4}),
        with_operands("r_alpha_or", Op::r_alpha_or, {-0.5}),
        with_operands("r0m_and", Op::r0m_and, {2}),
        with_operands("r0m_or", Op::r0m_or, {1}),
        with_operands("rp_and", Op::rp_and, {3}),
        with_operands("rp_or", Op::rp_or, {2.5}),
        with_operands("blend_uni", Op::blend_uni, {0.3, 0.5, 0.7}),
        with_operands("blend_int", Op::blend_int, {-0.3, 0.5, 0.7}),
        with_operands("point_uni", Op::point_uni, {0.3, 0.9, 0.7}),
        with_operands("point_int", Op::point_int, {0.3, 0.5, 0.7}),
        with_operands("bounded_uni", Op::bounded_uni, {0.3, 0.5, 0.7, 0.6}),
        with_operands("bounded_int", Op::bounded_int, {-0.3, 0.5, 0.7, 0.6}),
        with_operands("no extent", Op::point_uni, {0.3, 0, 0.7}),
        with_operands("no bound", Op::bounded_uni, {0.3, 0.5, 0.7, 0}),
    };
    return all;
}

/// Functions that jump as well.
const std::vector<Case>& jumping_cases() {
    using S = Sketch;
    static const std::vector<Case> all = {
        {"steps", [](S& s) { return floor(2.0 * s.x[0]) + ceil(s.x[1]) + round(s.x[2]) + sign(s.x[0]); }},
        {"remainder", [](S& s) { return remainder(s.x[0] * s.x[1], 0.4) + trunc(3.0 * s.x[2]); }},
        {"conditions",
         [](S& s) {
             return select(logical_or(less(s.x[0], s.x[1]), equal(s.x[2], 0.5)), s.x[0], 3.0 * s.x[2]);
         }},
        {"branch cut", [](S& s) { return atan2(s.x[0], s.x[1]); }},
    };
    return all;
}

std::vector<double> random_point(std::mt19937& random, double half_size) {
    std::uniform_real_distribution<double> in(-half_size, half_size);
    return {in(random), in(random), in(random)};
}

Interval span_of(double a, double b) { return {std::fmin(a, b), std::fmax(a, b)}; }

/// Checks f(b) - f(a) against the slopes' enclosures over the box that a and b span; true where they bind.
bool difference_is_enclosed(const Expression& f, std::span<const Expression> slopes,
                            const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<Interval> box;
    for (std::size_t k = 0; k < 3; ++k) box.push_back(span_of(a[k], b[k]));
    Interval bound(0.0);
    for (std::size_t k = 0; k < 3; ++k)
        bound = bound + evaluate<Interval>(slopes[k], box) * Interval(b[k] - a[k]);
    if (bound.maybe_undefined || bound.is_empty() || !(bound.hi - bound.lo < 1e6)) return false;
    const double difference = evaluate<double>(f, b) - evaluate<double>(f, a);
    CAPTURE(difference);
    CAPTURE(bound.lo);
    CAPTURE(bound.hi);
    CHECK(difference >= bound.lo - 1e-9);
    CHECK(difference <= bound.hi + 1e-9);
    return true;
}

}  // namespace

TEST_CASE("derivatives have the values of the engines' gradients") {
    std::mt19937 random(1);
    for (const std::vector<Case>* cases : {&smooth_cases(), &jumping_cases()})
        for (const Case& c : *cases) {
            CAPTURE(c.name);
            Sketch s;
            const Expression f = c.make(s);
            const auto slopes = derivatives(f, s.x, AtJumps::ignored);
            REQUIRE(slopes);
            for (int i = 0; i < 200; ++i) {
                const auto p = random_point(random, 1.5);
                const auto expected = gradient_at(f, p[0], p[1], p[2]);
                for (std::size_t k = 0; k < 3; ++k)
                    CHECK(evaluate<double>((*slopes)[k], p) ==
                          doctest::Approx(expected.d[k]).epsilon(1e-9).scale(1));
            }
        }
}

TEST_CASE("enclosures of derivatives bound all difference quotients, unless they are flagged") {
    std::mt19937 random(2);
    for (const std::vector<Case>* cases : {&smooth_cases(), &jumping_cases()})
        for (const Case& c : *cases) {
            CAPTURE(c.name);
            Sketch s;
            const Expression f = c.make(s);
            const auto slopes = derivatives(f, s.x);
            REQUIRE(slopes);
            int binding = 0;
            for (int i = 0; i < 300; ++i) {
                const auto a = random_point(random, 1.4);
                auto b = random_point(random, i % 2 ? 0.5 : 0.05);
                for (std::size_t k = 0; k < 3; ++k) b[k] += a[k];
                binding += difference_is_enclosed(f, *slopes, a, b) ? 1 : 0;
            }
            CHECK(binding > 60);  // not by flagging everything
        }
}

TEST_CASE("the formulas of blends and R-functions have the values of their kernels") {
    std::mt19937 random(3);
    int found = 0;
    for (const Case& c : smooth_cases()) {
        CAPTURE(c.name);
        Sketch s;
        const Expression f = c.make(s);
        const auto formula = spelled_out(s.graph, f.id());
        if (!formula) continue;
        ++found;
        CHECK(formula->id() != f.id());
        for (int i = 0; i < 200; ++i) {
            const auto p = random_point(random, 1.5);
            CHECK(evaluate<double>(*formula, p) ==
                  doctest::Approx(evaluate<double>(f, p)).epsilon(1e-12).scale(1));
        }
    }
    CHECK(found == 14);
}

TEST_CASE("at a jump there is no derivative, or that of the side where the point is") {
    Sketch s;
    const Expression f = select(less(s.x[0], 0.0), s.x[0] * 2.0, s.x[0] * 3.0 + 1.0);
    const std::vector<double> jump = {0, 0, 0};
    const std::vector<Interval> around = {{-0.1, 0.1}, 0.0, 0.0}, beside = {{0.1, 0.2}, 0.0, 0.0};
    const auto strict = derivatives(f, s.x), lenient = derivatives(f, s.x, AtJumps::ignored);
    REQUIRE(strict);
    REQUIRE(lenient);
    CHECK(std::isnan(evaluate<double>((*strict)[0], jump)));
    CHECK(evaluate<double>((*lenient)[0], jump) == 3.0);
    CHECK(evaluate<Interval>((*strict)[0], around).maybe_undefined);
    const Interval clear = evaluate<Interval>((*strict)[0], beside);
    CHECK_FALSE(clear.maybe_undefined);
    CHECK(clear.lo == doctest::Approx(3.0));
    CHECK(clear.hi == doctest::Approx(3.0));
}

TEST_CASE("the edge of a set operation has a bounded derivative") {
    Sketch s;
    const auto slopes = derivatives(r_and(s.x[0], s.x[1]), s.x);
    REQUIRE(slopes);
    const std::vector<Interval> box = {{-1, 1}, {-1, 1}, 0.0};
    const Interval range = evaluate<Interval>((*slopes)[0], box);
    CHECK_FALSE(range.maybe_undefined);
    CHECK(range.lo <= 0.0);
    CHECK(range.lo > -1e-9);
    CHECK(range.hi >= 2.0);
    CHECK(range.hi < 2.0 + 1e-9);
}

TEST_CASE("nodes may stand for themselves") {
    Sketch s;
    const Expression radius = hypot(s.x[0], s.x[1]);
    const Expression variables[] = {radius};
    const auto slopes = derivatives(square(radius) * s.x[2], variables);
    REQUIRE(slopes);
    REQUIRE(slopes->size() == 1);
    CHECK(at((*slopes)[0], 3, 4, 0.5) == doctest::Approx(5.0));
}

TEST_CASE("operations without a formula are named") {
    Sketch s;
    const Expression f = apply(Op::lattice_noise, {s.x[0], s.x[1], s.x[2]});
    const auto slopes = derivatives(f + s.x[0], s.x);
    REQUIRE_FALSE(slopes);
    CHECK(slopes.error().kind == ErrorKind::invalid_argument);
    CHECK(slopes.error().message.find("lattice_noise") != std::string::npos);
    const Expression free = apply(Op::lattice_noise, {s.number(0.1), s.number(0.2), s.number(0.3)});
    CHECK(derivatives(free + s.x[0], s.x));
}

TEST_CASE("a chain as deep as graphs may be is derived without recursion") {
    Sketch s;
    Expression f = s.x[0];
    for (int i = 0; i < 50'000; ++i) f = sin(f) + 0.001 * s.x[1];
    CHECK(derivatives(f, s.x));
}
