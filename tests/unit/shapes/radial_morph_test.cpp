// Metamorphosis by radial functions: the frames at both ends are the shapes, the published areas of a circle
// that becomes a square, shapes of space, points of boundaries, bad arguments.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/shapes/radial.h"
#include "frep/shapes/surface_points.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;

/// The area where f >= 0 at time t, z standing for time.
double area(const Expression& f, double t, double half) {
    constexpr int n = 160;
    int count = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
            count += at(f, half * ((2 * i + 1.0) / n - 1), half * ((2 * k + 1.0) / n - 1), t) >= 0;
    return count * (2 * half / n) * (2 * half / n);
}

}  // namespace

TEST_CASE("a circle becomes a square: areas of the sections") {
    // 24 points each with an inner one 0.2 inside, value 1; times 0 and 2
    shapes::RadialProblem problem{.used = {true, true, true, false}, .points = {}, .values = {{}}};
    const auto add = [&](double x, double y, double z, double nx, double ny) {
        problem.points.push_back({x, y, z, 0});
        problem.values[0].push_back(0);
        problem.points.push_back({x - 0.2 * nx, y - 0.2 * ny, z, 0});
        problem.values[0].push_back(1);
    };
    for (int i = 0; i < 24; ++i) {
        const double c = std::cos(2 * pi * i / 24), s = std::sin(2 * pi * i / 24);
        add(c, s, 0, c, s);
        // of the square: six points a side from its first corner on, where the normal is the diagonal
        const double along = -1 + (i % 6) / 3.0, n = i % 6 == 0 ? std::sqrt(0.5) : 1;
        const double back = i % 6 == 0 ? -n : 0;
        const double turned[4][4] = {
            {1, along, n, back}, {-along, 1, -back, n}, {-1, -along, -n, -back}, {along, -1, back, -n}};
        const double* q = turned[i / 6];
        add(q[0], q[1], 2, q[2], q[3]);
    }
    const shapes::RadialFit fit = shapes::fit_radial(problem);
    Sketch s;
    const Expression f = shapes::radial_sum(s.build, {s.x[0], s.x[1], s.x[2], s.number(0)}, fit.sums[0]);
    // at the ends the shapes' own areas; between them another program's, whose points lay elsewhere
    const double expected[5] = {3.14, 4.07, 4.50, 4.48, 4.0};
    const double tolerance[5] = {0.01, 0.06, 0.06, 0.06, 0.02};
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(area(f, 0.5 * static_cast<double>(i), 2) == Approx(expected[i]).epsilon(tolerance[i]));
}

TEST_CASE("the frames at both ends are the shapes, whatever their parts and holes") {
    Sketch s;
    const Expression ring = min(1.0 - hypot(s.x[0], s.x[1]), hypot(s.x[0], s.x[1]) - 0.45);
    const Expression disks = max(0.5 - hypot(s.x[0] - 0.7, s.x[1]), 0.4 - hypot(s.x[0] + 0.8, s.x[1] - 0.3));
    Items box = s.list({-1.5, -1.5, 1.5, 1.5});
    const Expression f = s.call("hfRadialMorph", {s.x, s.x[2], ring, disks, 0, 1, box, 0.15, 0.1});
    CHECK(s.warnings.empty());
    CHECK(area(f, 0, 1.5) == Approx(pi * (1 - 0.45 * 0.45)).epsilon(0.01));
    CHECK(area(f, 1, 1.5) == Approx(pi * (0.25 + 0.16)).epsilon(0.02));
    CHECK(at(f, 0, 0, 0) < 0);
    CHECK(at(f, 0.7, 0, 1) > 0);
    CHECK(at(f, -0.8, 0.3, 1) > 0);
    CHECK(at(f, 0, 0.1, 1) < 0);
    // near the outline the values are about distances
    CHECK(at(f, 0.95, 0, 0) == Approx(0.05).epsilon(0.1));
    // between them there is something
    CHECK(area(f, 0.5, 1.5) > 1);
}

TEST_CASE("shapes of space, with time as a fourth coordinate") {
    Sketch s;
    const Expression t(s.graph, s.graph.coordinate(3));
    const Expression ball = 1.0 - sqrt(square(s.x[0]) + square(s.x[1]) + square(s.x[2]));
    const Expression block = min(min(0.8 - abs(s.x[0]), 0.8 - abs(s.x[1])), 0.8 - abs(s.x[2]));
    Items box = s.list({-1.2, -1.2, -1.2, 1.2, 1.2, 1.2});
    const Expression f = s.call("hfRadialMorph", {s.x, t, ball, block, -1, 1, box, 0.35, 0.2});
    CHECK(s.warnings.empty());
    const auto value = [&](double x, double y, double z, double time) {
        return evaluate<double>(f, {x, y, z, time});
    };
    for (const double u : {-1.0, 0.0, 0.6}) {
        const double w = std::sqrt(1 - u * u);
        CHECK(std::abs(value(u, w, 0, -1)) < 0.03);
        CHECK(std::abs(value(0.8, 0.5 * u, 0.3 * u, 1)) < 0.06);
    }
    CHECK(value(0, 0, 0, 0) > 0);
    CHECK(value(1.3, 0, 0, 0) < 0);
}

TEST_CASE("points of a boundary lie on it, evenly, with the direction inwards") {
    Sketch s;
    const Expression disk = 1.0 - square(s.x[0] - 0.1) - square(s.x[1]);
    const shapes::SurfaceSearch search{2, {{-1.5, -1.5, 0}, {1.5, 1.5, 0}}, 0.2};
    const auto found = shapes::surface_points(s.build, disk, s.x, search);
    REQUIRE(found.problem.empty());
    CHECK(found.points.size() > 2 * pi / 0.4);
    CHECK(found.points.size() < 2 * pi / 0.2);
    for (std::size_t i = 0; i < found.points.size(); ++i) {
        const auto& p = found.points[i];
        CHECK(std::hypot(p.place.x - 0.1, p.place.y) == Approx(1));
        CHECK(p.inward.x == Approx(0.1 - p.place.x));
        CHECK(p.inward.y == Approx(-p.place.y));
        for (std::size_t k = 0; k < i; ++k) CHECK(length(p.place - found.points[k].place) >= 0.2);
    }
}

TEST_CASE("what cannot be a metamorphosis is refused with a reason") {
    Sketch s;
    const Expression disk = 1.0 - square(s.x[0]) - square(s.x[1]);
    Items box = s.list({-2, -2, 2, 2}), odd = s.list({1, 2, 3}), empty = s.list({-2, 2, 2, 2});
    Items small = s.list({-0.1, -0.1, 0.1, 0.1}), line = {s.x[0]};
    const auto refused = [&](std::vector<Argument> arguments) {
        s.warnings.clear();
        return at(s.call("hfRadialMorph", std::move(arguments)), 0, 0, 0) == shapes::error_value &&
               s.warnings.size() == 1;
    };
    CHECK(refused({s.x, s.x[2], disk, disk, 1, 1, box, 0.2, 0.1}));
    CHECK(refused({s.x, s.x[2], disk, disk, 0, 1, box, 0, 0.1}));
    CHECK(refused({s.x, s.x[2], disk, disk, 0, 1, box, 0.2, -0.1}));
    CHECK(refused({s.x, s.x[2], disk, disk, 0, s.x[0], box, 0.2, 0.1}));
    CHECK(refused({s.x, s.x[2], disk, disk, 0, 1, odd, 0.2, 0.1}));
    CHECK(refused({s.x, s.x[2], disk, disk, 0, 1, empty, 0.2, 0.1}));
    CHECK(refused({line, s.x[2], disk, disk, 0, 1, box, 0.2, 0.1}));
    CHECK(refused({s.x, s.x[2], disk, disk, 0, 1, small, 0.01, 0.1}));
    CHECK(s.warnings[0].find("no boundary") != std::string::npos);
    CHECK(refused({s.x, s.x[2], disk, disk, 0, 1, box, 1e-5, 0.1}));
    const Expression stripes = sin(30.0 * s.x[0]);
    CHECK(refused({s.x, s.x[2], disk, stripes, 0, 1, box, 0.05, 0.1}));
    CHECK(s.warnings[0].find("enlarge the spacing") != std::string::npos);
    Expression deep = disk;  // many operations at very many points
    for (int i = 0; i < 3000; ++i) deep = deep * 1.0001;
    CHECK(refused({s.x, s.x[2], disk, deep, 0, 1, box, 0.02, 0.1}));
    CHECK(s.warnings[0].find("too many evaluations") != std::string::npos);
    Items other = {s.x[0], s.x[1]};
    CHECK(refused({other, s.x[2], disk + s.x[2], disk, 0, 1, box, 0.2, 0.1}));
}
