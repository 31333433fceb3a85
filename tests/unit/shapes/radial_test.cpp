// Interpolation by radial functions: the values are met, published examples come out, side conditions hold,
// enclosures and gradients of the kernel, bad input.
#include "frep/shapes/radial.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;
using shapes::RadialFit;
using shapes::RadialProblem;

namespace {

/// The function of x, y, z at time t.
Expression function(Sketch& s, const std::vector<double>& sum, double t = 0) {
    return shapes::radial_sum(s.build, {s.x[0], s.x[1], s.x[2], s.number(t)}, sum);
}

/// Points that are scattered over a box, with values.
RadialProblem scattered(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-3, 3);
    RadialProblem problem{.used = {true, true, true, true}, .points = {}, .values = {{}, {}}};
    for (std::size_t i = 0; i < count; ++i) {
        problem.points.push_back({place(random), place(random), place(random), place(random)});
        problem.values[0].push_back(place(random));
        problem.values[1].push_back(i % 3 == 0);
    }
    return problem;
}

}  // namespace

TEST_CASE("the functions take the values at the points") {
    for (const std::size_t count : {1u, 2u, 5u, 40u, 150u}) {
        const RadialProblem problem = scattered(count, count);
        const RadialFit fit = shapes::fit_radial(problem);
        REQUIRE(fit.problem.empty());
        REQUIRE(fit.sums.size() == 2);
        double worst = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t column = 0; column < 2; ++column) {
                Sketch s;
                const auto& p = problem.points[i];
                const double v = at(function(s, fit.sums[column], p[3]), p[0], p[1], p[2]);
                worst = std::max(worst, std::abs(v - problem.values[column][i]));
            }
        CHECK(worst < 1e-9);
    }
}

TEST_CASE("the weights cannot be seen by linear functions") {
    const RadialFit fit = shapes::fit_radial(scattered(60, 7));
    const std::vector<double>& sum = fit.sums[0];
    double moments[5] = {}, size = 0;
    for (std::size_t i = 5; i < sum.size(); i += 5) {
        moments[4] += sum[i + 4];
        for (std::size_t k = 0; k < 4; ++k) moments[k] += sum[i + 4] * sum[i + k];
        size += std::abs(sum[i + 4]);
    }
    for (const double m : moments) CHECK(std::abs(m) < 1e-8 * size);
}

TEST_CASE("six points of a sphere with inner and outer points: published values") {
    // spec: 6 unit axis points, offset 0.1 with values +-0.1, kernel r^3 with a linear polynomial
    RadialProblem problem{.used = {true, true, true, false}, .points = {}, .values = {{}}};
    for (const double radius : {1.0, 0.9, 1.1})
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                shapes::RadialPoint p{};
                p[axis] = sign * radius;
                problem.points.push_back(p);
                problem.values[0].push_back(1.0 - radius);
            }
    const RadialFit fit = shapes::fit_radial(problem);
    Sketch s;
    const Expression f = function(s, fit.sums[0]);
    const double c = 1 / std::sqrt(3.0);
    CHECK(at(f, 0, 0, 0) == Approx(0.570806).epsilon(1e-5));
    CHECK(at(f, c, c, c) == Approx(0.019666).epsilon(1e-4));
    CHECK(at(f, 2, 0, 0) == Approx(-1.042063).epsilon(1e-5));
}

TEST_CASE("a carrier less its interpolation: the volume spline's example") {
    RadialProblem problem{.used = {true, true, true, false}, .points = {}, .values = {{}}};
    const double size[3] = {1.2, 1, 0.8};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            shapes::RadialPoint p{};
            p[axis] = sign * size[axis];
            problem.points.push_back(p);
            problem.values[0].push_back(1 - size[axis] * size[axis]);
        }
    const RadialFit fit = shapes::fit_radial(problem);
    Sketch s;
    const Expression u = function(s, fit.sums[0]);
    CHECK(at(u, 0, 0, 0) == Approx(0.254142).epsilon(1e-5));
    CHECK(1 - 4 - at(u, 2, 0, 0) == Approx(-1.852093).epsilon(1e-6));
}

TEST_CASE("enclosures of sums that cancel: they hold, and shrink as the values do") {
    const RadialFit fit = shapes::fit_radial(scattered(80, 11));
    Sketch s;
    const Expression f = shapes::radial_sum(s.build, {s.x[0], s.x[1], s.x[2], s.x[0] * 0.5}, fit.sums[0]);
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> place(-4, 4), unit(-1, 1);
    double excess = 0;
    for (int i = 0; i < 400; ++i) {
        const double h = std::pow(10.0, -(i % 7)), m[3] = {place(random), place(random), place(random)};
        const Box box{{m[0] - h, m[0] + h}, {m[1] - h, m[1] + h}, {m[2] - h, m[2] + h}};
        const math::Interval range = range_over(f, box);
        CHECK(!range.maybe_undefined);
        double low = math::infinity, high = -math::infinity;
        for (int j = 0; j < 40; ++j) {
            double p[3];
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = m[k] + h * (j < 8 ? ((j >> k) & 1 ? 1 : -1) : unit(random));
            const double v = at(f, p[0], p[1], p[2]);
            CHECK(range.contains(v));
            low = std::min(low, v);
            high = std::max(high, v);
        }
        if (h <= 0.01) excess = std::max(excess, range.width() / (high - low));
    }
    CHECK(excess < 4);  // term by term it is thousands
}

TEST_CASE("gradients of the kernel, at centres too") {
    const RadialProblem problem = scattered(30, 13);
    const RadialFit fit = shapes::fit_radial(problem);
    Sketch s;
    const Expression f = function(s, fit.sums[0], problem.points[0][3]);
    const auto& c = problem.points[0];
    for (const auto& p : {std::array<double, 3>{c[0], c[1], c[2]}, std::array<double, 3>{0.4, -1, 2}}) {
        const auto d = gradient_at(f, p[0], p[1], p[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            auto low = p, high = p;
            low[k] -= 1e-5;
            high[k] += 1e-5;
            const double slope = (at(f, high[0], high[1], high[2]) - at(f, low[0], low[1], low[2])) / 2e-5;
            CHECK(d.d[k] == Approx(slope).epsilon(1e-4));
        }
    }
}

TEST_CASE("points that coincide or lie in a line, and bad ones") {
    RadialProblem line{.used = {true, true, true, true}, .points = {}, .values = {{}}};
    for (int i = 0; i < 6; ++i) {
        line.points.push_back({1.0 * i, 2.0 * i, 0, 0});
        line.values[0].push_back(i * i);
    }
    line.points.push_back(line.points[2]);
    line.values[0].push_back(99);  // of equal points the first one counts
    const RadialFit fit = shapes::fit_radial(line);
    REQUIRE(fit.problem.empty());
    CHECK(fit.sums[0].size() == 5 * 7);
    Sketch s;
    CHECK(at(function(s, fit.sums[0]), 2, 4, 0) == Approx(4));
    CHECK(!shapes::fit_radial({}).problem.empty());
    line.points[1][0] = math::infinity;
    CHECK(!shapes::fit_radial(line).problem.empty());
    line.points[1][0] = 1;
    line.values[0][1] = math::quiet_nan;
    CHECK(!shapes::fit_radial(line).problem.empty());
    CHECK(!shapes::fit_radial(scattered(shapes::most_radial_points + 1, 1)).problem.empty());
}
