// Jets hold what functions do: values and derivatives at points, difference quotients over boxes.
#include "frep/measure/jet.h"

#include <array>
#include <random>
#include <string>

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;
using namespace frep::measuring;
using math::Interval;

namespace {

ClauseTape tape_of(const std::string& body) {
    auto tape = make_clause_tape(space_field_of(body));
    REQUIRE(tape);
    return *tape;
}

Jet jet_over(const std::string& body, const std::array<Interval, 3>& box) {
    const std::array<std::size_t, 3> all{0, 1, 2};
    JetMachine machine;
    return machine.run(tape_of(body), box, all, true);
}

bool holds_nearly(const Interval& v, double number) { return v.lo - 1e-9 <= number && number <= v.hi + 1e-9; }

/// One function for each rule, smooth for coordinates in 0.2 .. 0.9.
constexpr const char* smooth[] = {
    "x[1]*x[2] + 2*x[3] - x[1]",
    "x[1]/(x[2] + x[3]^2)",
    "3/x[2] - x[1]/2",
    "sqrt(x[1]^2 + x[2]^2) - x[3]",
    "sqrt(x[1] + 2*x[2]*x[3])",
    "exp(x[1]*x[2]) + log(x[3] + x[1])",
    "sin(2*x[1] + x[2])*cos(x[3]*x[1])",
    "tan(x[1]*x[2]) + atan(3*x[3]) - asin(x[1]*x[3]) + acos(x[2]*x[2])",
    "atan2(x[2] + x[3], x[1] - 2*x[3])",
    "sinh(x[1]) + cosh(x[2]*x[3]) - tanh(x[3] - x[1])",
    "x[1]^3 + x[2]^0.5 + (x[1] + x[3])^(-1.5)",
    "abs(x[1] + x[2]) + abs(-x[3] - 1) + min(x[1], 5) + max(x[2], -5)",
    "(x[1] - 0.1) & (x[2]*x[3] + 0.3)",
    "(x[1]*x[2] - 2) | (x[3] - 3)",
    "mod(x[1] + x[2], 7) + x[3]",
    "hfBlendUni(x[1] - 0.5, x[2]*x[3] - 0.4, 0.3, 0.5, 0.7)",
    "hfBlendInt(x[1] - 0.5, x[2] - x[3], -0.3, 0.5, 0.7)",
    "hfPointBlendUni(x[1] - 0.95, x[2]*x[3] - 0.9, 0.2, 2, 3)",
    "hfPointBlendUni(x[1] - 0.95, x[2]*x[3] - 0.9, 0.2, 0.5, 0.6)",
    "hfPointBlendInt(x[1] - 0.3, x[2] - 0.4, -0.2, 0.3, 0.3)",
    "hfBoundedBlendUni(x[1] - 0.5, x[2] - 0.95, x[3], 0.2, 0.3, 0.4, 0.5)",
};

}  // namespace

TEST_CASE("derivatives at a point are those of the engines") {
    for (const char* body : smooth) {
        CAPTURE(body);
        const Field field = space_field_of(std::string("my_model = ") + body + ";");
        const auto evaluator = make_evaluator(field);
        REQUIRE(evaluator);
        const auto gradient = [&](std::array<double, 3> p, double& value) {
            const double* point[] = {&p[0], &p[1], &p[2]};
            std::array<double, 3> d{};
            double* partials[] = {&d[0], &d[1], &d[2]};
            (*evaluator)->gradients(point, 1, &value, partials);
            return d;
        };
        const auto tape = make_clause_tape(field);
        REQUIRE(tape);
        const std::array<std::size_t, 3> all{0, 1, 2};
        JetMachine machine;
        const std::array<double, 3> p{0.35, 0.61, 0.47};
        const std::array<Interval, 3> point{p[0], p[1], p[2]};
        const Jet jet = machine.run(*tape, point, all, true);
        double value = 0, unused = 0;
        const auto d = gradient(p, value);
        CHECK(holds_nearly(jet.value, value));
        CHECK(jet.value.hi - jet.value.lo < 1e-9);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(holds_nearly(jet.first[k], d[k]));
            CHECK(jet.first[k].hi - jet.first[k].lo < 1e-8);
        }
        constexpr double step = 1e-5;
        for (std::size_t n = 0; n < pairs.size(); ++n) {
            const auto [i, j] = pairs[n];
            std::array<double, 3> a = p, b = p;
            a[j] -= step;
            b[j] += step;
            const double second = (gradient(b, unused)[i] - gradient(a, unused)[i]) / (2 * step);
            CAPTURE(n);
            CHECK(jet.second[n].lo - 1e-6 * (1 + std::abs(second)) <= second);
            CHECK(second <= jet.second[n].hi + 1e-6 * (1 + std::abs(second)));
            CHECK(jet.second[n].hi - jet.second[n].lo < 1e-6);
        }
    }
}

TEST_CASE("jets over boxes hold those of all their points") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> number(0, 1);
    const std::array<std::size_t, 3> all{0, 1, 2};
    for (const char* body : smooth) {
        CAPTURE(body);
        const ClauseTape tape = tape_of(std::string("my_model = ") + body + ";");
        JetMachine machine;
        for (int n = 0; n < 60; ++n) {
            std::array<double, 3> low{};
            std::array<Interval, 3> box;
            const double side = n % 2 == 0 ? 0.2 : 0.02;
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = 0.2 + (0.7 - side) * number(random);
                box[k] = {low[k], low[k] + side};
            }
            const Jet whole = machine.run(tape, box, all, true);
            for (int m = 0; m < 5; ++m) {
                std::array<Interval, 3> point;
                for (std::size_t k = 0; k < 3; ++k) point[k] = low[k] + side * number(random);
                const Jet one = machine.run(tape, point, all, true);
                const auto overlap = [](const Interval& a, const Interval& b) {
                    return a.lo <= b.hi && b.lo <= a.hi;
                };
                CHECK(overlap(whole.value, one.value));
                for (std::size_t k = 0; k < 3; ++k) CHECK(overlap(whole.first[k], one.first[k]));
                for (std::size_t k = 0; k < 6; ++k) CHECK(overlap(whole.second[k], one.second[k]));
            }
        }
    }
}

TEST_CASE("at creases the gradient holds both sides, the second derivatives nothing") {
    const Interval side(-1.0, 1.0);
    for (const char* body :
         {"my_model = min(x[1], 2*x[2]);", "my_model = max(3*x[1], -x[2]);", "my_model = abs(x[1]) + x[2];",
          "my_model = x[1] & x[2];", "my_model = x[1] | (x[2] - x[1]);"}) {
        CAPTURE(body);
        const Jet jet = jet_over(body, {side, side, side});
        CHECK(jet.second[0].hi == math::infinity);
        CHECK(jet.first[0].hi - jet.first[0].lo >= 1);
        CHECK(jet.first[0].hi < 10);
        CHECK(jet.first[2].lo == 0);
        CHECK(jet.first[2].hi == 0);
    }
    const Jet crease = jet_over("my_model = min(x[1], 2*x[2]);", {side, side, side});
    CHECK(crease.first[0].contains(0));
    CHECK(crease.first[0].contains(1));
    CHECK(crease.first[1].contains(2));
}

TEST_CASE("a function that jumps has no derivatives, and one that does not has") {
    const Interval side(-1.0, 1.0);
    for (const char* body :
         {"my_model = floor(x[1]);", "f = 1; if (x[1] < 0.3) then f = 2; endif; my_model = f;",
          "my_model = atan2(x[1], x[2] - 3);", "my_model = 1/x[1];", "my_model = sqrt(x[1]);"}) {
        CAPTURE(body);
        const Jet jet = jet_over(body, {side, side, side});
        CHECK(jet.first[0].hi == math::infinity);
    }
    CHECK(jet_over("my_model = floor(x[1]);", {Interval(0.1, 0.9), side, side}).moves == 0);
    const Jet taken =
        jet_over("f = 1; if (x[1] < 3) then f = x[1]; endif; my_model = f;", {side, side, side});
    CHECK(taken.first[0].contains(1));
    CHECK(taken.first[0].hi < 1.1);
}

TEST_CASE("the second derivatives of a ball are exact") {
    const Jet jet = jet_over("my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;",
                             {Interval(-1.0, 1.0), Interval(0.0, 2.0), Interval(3.0, 4.0)});
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(jet.second[k].contains(-2));
        CHECK(jet.second[k].hi - jet.second[k].lo < 1e-12);
        CHECK(jet.second[3 + k].lo == 0);
        CHECK(jet.second[3 + k].hi == 0);
    }
}
