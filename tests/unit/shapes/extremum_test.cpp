// Projections, sums, offsets, sweeps: worked values, whole models through the engines, what is refused.
#include "frep/shapes/extremum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "frep/frep.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

struct At {
    double value;
    std::array<double, 3> gradient;
};

/// F and its gradient at a point, of a model's text.
At model_at(const std::string& body, double x, double y, double z) {
    const Model model(Source("test.hf", "my_model(x[3], a[1])\n{\n" + body + "\n}\n"));
    const auto field = model.field();
    REQUIRE(field);
    const auto evaluator = make_evaluator(*field, {});
    REQUIRE(evaluator);
    const double* const point[] = {&x, &y, &z};
    At out{};
    double* const partials[] = {&out.gradient[0], &out.gradient[1], &out.gradient[2]};
    (*evaluator)->gradients(point, 1, &out.value, partials);
    return out;
}

}  // namespace

TEST_CASE("the projection of a ball is a disk") {
    const std::string body = "my_model = hfProjection(x, 1 - x[1]^2 - x[2]^2 - x[3]^2, 3, -2, 2, 1e-6);";
    for (const double x : {-1.5, 0.0, 0.3, 1.0}) {
        const At f = model_at(body, x, 0.5, 7);
        CHECK(f.value == Approx(1 - x * x - 0.25).epsilon(1e-6));
        CHECK(f.gradient[0] == Approx(-2 * x));
        CHECK(f.gradient[1] == Approx(-1));
        CHECK(f.gradient[2] == 0);
    }
}

TEST_CASE("a ball along a segment is a capsule, by hand and by hfSweepPolygon") {
    const std::string by_hand = R"(
        array p[3];
        t = hfVariable(0, 2);
        p = [x[1] - t, x[2] - t, x[3]];
        my_model = hfMaximum(0.25 - p[1]^2 - p[2]^2 - p[3]^2, t, 1e-6);)";
    const std::string ready = R"(
        array points[9];
        points = [0, 0, 0,  1, 1, 0,  2, 2, 0];
        my_model = hfSweepPolygon(x, 0.25 - x[1]^2 - x[2]^2 - x[3]^2, points, 1e-6);)";
    for (const std::string& body : {by_hand, ready}) {
        for (const double s : {-0.4, 0.3, 1.7, 2.6}) {
            const double x = s + 0.2, y = s - 0.2, foot = std::clamp((x + y) / 2, 0.0, 2.0);
            const double want = 0.25 - (x - foot) * (x - foot) - (y - foot) * (y - foot) - 0.01;
            const At f = model_at(body, x, y, 0.1);
            CHECK(f.value == Approx(want).epsilon(1e-6));
            CHECK(f.gradient[0] == Approx(-2 * (x - foot)).epsilon(1e-3));
            CHECK(f.gradient[2] == Approx(-0.2));
        }
    }
}

TEST_CASE("a ball along a Bezier curve") {
    const std::string body = R"(
        array p[12];
        p = [0, 0, 0,  1, 0, 0,  1, 1, 0,  1, 1, 1];
        my_model = hfSweepBezier(x, 0.04 - x[1]^2 - x[2]^2 - x[3]^2, p, 1e-6);)";
    double most = -1e9;
    for (int i = 0; i <= 100000; ++i) {
        const double t = i / 100000.0, s = 1 - t;
        const double b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
        const double x = b1 + b2 + b3, y = b2 + b3, z = b3;
        most = std::max(most, 0.04 - std::pow(0.7 - x, 2) - std::pow(0.4 - y, 2) - std::pow(0.3 - z, 2));
    }
    CHECK(model_at(body, 0.7, 0.4, 0.3).value == Approx(most).epsilon(2e-6));
}

TEST_CASE("the Minkowski sum of two balls") {
    const std::string body = R"(
        array low[3], high[3];
        low = [-3, -3, -3];
        high = [3, 3, 3];
        r = sqrt(x[1]^2 + x[2]^2 + x[3]^2);
        my_model = hfMinkowskiSum(x, 1 - r, 0.5 - r, low, high, 1e-2);)";
    for (const double s : {0.2, 0.9, 1.5, 2.0}) {
        const double r = s * std::sqrt(1 + 0.04 + 0.25);
        const At f = model_at(body, s, 0.2 * s, -0.5 * s);
        CHECK(std::abs(f.value - (r >= 0.5 ? (1.5 - r) / 2 : 0.5)) <= 1.5e-2);
        if (r < 0.7) continue;
        // the gradient points to the origin
        CHECK(f.gradient[0] < 0);
        CHECK(f.gradient[1] / f.gradient[0] == Approx(0.2).epsilon(0.2));
        CHECK(f.gradient[2] / f.gradient[0] == Approx(-0.5).epsilon(0.2));
    }
}

TEST_CASE("offsets by a radius: a ball, grown and shrunk") {
    const auto body = [](const char* r) {
        return "my_model = hfOffsetRadius(x, 1 - x[1]^2 - x[2]^2 - x[3]^2, " + std::string(r) + ", 1e-3);";
    };
    for (const double s : {0.1, 0.8, 1.1, 1.6}) {
        const double x = 0.8 * s, z = -0.6 * s;  // at the distance s
        const double grown = 1 - std::pow(std::max(0.0, s - 0.4), 2), shrunk = 1 - std::pow(s + 0.4, 2);
        CHECK(model_at(body("0.4"), x, 0, z).value == Approx(grown).epsilon(2e-3));
        CHECK(model_at(body("-0.4"), x, 0, z).value == Approx(shrunk).epsilon(2e-3));
    }
    CHECK(model_at(body("0.4"), 1.4, 0, 0).value == Approx(0).epsilon(2e-3));
    CHECK(model_at(body("0"), 0.5, 0, 0).value == Approx(0.75));
}

TEST_CASE("several variables, the smallest value, a search in a search") {
    const std::string over = R"(
        array t[2];
        t = [hfVariable(-1, 1), hfVariable(-1, 1)];
        my_model = hfMinimumOver((x[1] - t[1])^2 + (x[2] - t[2])^2, t, 1e-6);)";
    CHECK(model_at(over, 1.5, 0.3, 0).value == Approx(0.25).epsilon(1e-5));
    CHECK(model_at(over, 0.5, 0.3, 0).value == Approx(0).epsilon(1e-5));
    const std::string nested = R"(
        u = hfVariable(0, 1);
        y = hfMaximum(0 - (u - x[1])^2 - (u - x[2])^2, u, 1e-6);
        my_model = hfProjection(x, y, 1, 0, 1, 1e-2);)";
    CHECK(model_at(nested, 5, 0.5, 0).value == Approx(0).epsilon(0.02));
    CHECK(model_at(nested, 5, 2.0, 0).value == Approx(-1).epsilon(0.02));
}

TEST_CASE("wrong arguments are refused with a reason") {
    Sketch s;
    const Expression ball = 1.0 - square(s.x[0]) - square(s.x[1]) - square(s.x[2]);
    const auto refused = [&](const char* name, std::vector<Argument> arguments, const char* reason) {
        const std::size_t before = s.warnings.size();
        const Expression f = s.call(name, std::move(arguments));
        CAPTURE(name);
        CHECK(s.graph.constant_value(f.id()) == shapes::error_value);
        REQUIRE(s.warnings.size() > before);
        CHECK(s.warnings.back().find(reason) != std::string::npos);
    };
    Expression t = s.call("hfVariable", {0, 1});
    refused("hfMaximum", {ball, s.x[0], 1e-6}, "hfVariable");
    refused("hfMinimum", {ball, 3, 1e-6}, "hfVariable");
    refused("hfMaximum", {ball * t, t, 0}, "tolerance");
    refused("hfMaximum", {ball * t, t, s.x[1]}, "depends on the point");
    refused("hfVariable", {0, math::infinity}, "finite");
    refused("hfProjection", {s.x, ball, 4, -1, 1, 1e-6}, "number of an item");
    refused("hfProjection", {s.x, ball, 1.5, -1, 1, 1e-6}, "number of an item");
    Items moved{s.x[0] - 1.0, s.x[1], s.x[2]}, two = s.list({0, 0}), seven = s.list({1, 2, 3, 4, 5, 6, 7});
    refused("hfProjection", {moved, ball, 1, -1, 1, 1e-6}, "another way");
    refused("hfMinkowskiSum", {s.x, ball, ball, two, two, 1e-2}, "items");
    refused("hfOffsetRadius", {s.x, ball, s.x[0], 1e-3}, "one finite number");
    refused("hfSweepPolygon", {s.x, ball, seven, 1e-3}, "points");
    refused("hfSweepBezier", {s.x, ball, seven, 1e-3}, "four points");
}
