// Offsets and shells: radii of worked examples, lengths of functions that are no distances, refusals.
#include "frep/shapes/offsets.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

TEST_CASE("an iso offset of a ball by c has the radius sqrt(R^2 + c)") {
    Sketch s;
    Items centre = s.list({0, 0, 0});
    const Expression f = s.call("hfIsoOffset", {s.call("hfSphere", {s.x, centre, 2.0}), 5.0});
    CHECK(at(f, 3, 0, 0) == Approx(0).epsilon(1e-12).scale(1));
    CHECK(at(f, 2.9, 0, 0) > 0);
    CHECK(at(f, 0, 3.1, 0) < 0);
}

TEST_CASE("a normal offset grows by its length, whatever the gradient") {
    Sketch s;
    Items centre = s.list({0.5, 0, 0});
    const Expression ball = s.call("hfSphere", {s.x, centre, 1.0});
    for (const double d : {0.5, -0.25, 0.0}) {
        CAPTURE(d);
        const Expression f = s.call("hfNormalOffset", {s.x, ball, d});
        for (const double turn : {0.0, 1.0, 2.5}) {
            const double r = 1.0 + d;
            const double x = 0.5 + r * std::cos(turn), y = 0.6 * r * std::sin(turn),
                         z = 0.8 * r * std::sin(turn);
            CHECK(at(f, x, y, z) == Approx(0).epsilon(1e-12).scale(1));
        }
        // 1 - (r - d)^2 on the way from the centre
        CHECK(at(f, 0.5 + 0.8, 0, 0) == Approx(1.0 - (0.8 - d) * (0.8 - d)));
    }
    // the centre, where there is no normal, keeps its value
    CHECK(at(s.call("hfNormalOffset", {s.x, ball, 0.5}), 0.5, 0, 0) == 1.0);
    CHECK(s.warnings.empty());
}

TEST_CASE("normal offsets go through set operations and blends") {
    Sketch s;
    const Expression wall = s.x[0] * 3.0, floor = s.x[1] * 5.0;
    const Expression corner = s.call("hfNormalOffset", {s.x, r_and(wall, floor), 0.2});
    CHECK(at(corner, -0.2, 4, 0) == Approx(0).epsilon(1e-2).scale(1));
    const Expression blend = s.call("hfNormalOffset", {s.x, s.call("hfSmoothUni", {wall, floor, 0.1}), 0.2});
    CHECK(at(blend, -0.2, -4, 0) == Approx(0).epsilon(1e-12).scale(1));
    CHECK(s.warnings.empty());
}

TEST_CASE("a normal offset has the gradient of differences") {
    Sketch s;
    const Expression f =
        s.call("hfNormalOffset", {s.x, 1.0 - square(s.x[0]) - 2.0 * square(s.x[1]) - s.x[2] * s.x[0], 0.3});
    const double p[3] = {0.7, -0.4, 0.3}, h = 1e-6;
    const auto dual = gradient_at(f, p[0], p[1], p[2]);
    CHECK(dual.d[0] == Approx((at(f, p[0] + h, p[1], p[2]) - at(f, p[0] - h, p[1], p[2])) / (2 * h)));
    CHECK(dual.d[1] == Approx((at(f, p[0], p[1] + h, p[2]) - at(f, p[0], p[1] - h, p[2])) / (2 * h)));
    CHECK(dual.d[2] == Approx((at(f, p[0], p[1], p[2] + h) - at(f, p[0], p[1], p[2] - h)) / (2 * h)));
}

TEST_CASE("shells have their walls inside the solid") {
    Sketch s;
    const Expression ball = 2.0 - hypot(hypot(s.x[0], s.x[1]), s.x[2]);
    const Expression squares = 4.0 - square(s.x[0]) - square(s.x[1]) - square(s.x[2]);
    for (const Expression& f :
         {s.call("hfIsoShell", {ball, 0.5}), s.call("hfNormalShell", {s.x, squares, 0.5})}) {
        CHECK(at(f, 1.4, 0, 0) < 0);
        CHECK(at(f, 0, 1.6, 0) > 0);
        CHECK(at(f, 0, 0, 1.9) > 0);
        CHECK(at(f, 2.1, 0, 0) < 0);
        CHECK(at(f, 1.5, 0, 0) == Approx(0).epsilon(1e-12).scale(1));
    }
}

TEST_CASE("functions without derivatives, or of other coordinates, are refused by name") {
    Sketch s;
    const Expression noise = apply(Op::lattice_noise, {s.x[0], s.x[1], s.x[2]});
    CHECK(at(s.call("hfNormalOffset", {s.x, noise, 0.1}), 0, 0, 0) == shapes::error_value);
    REQUIRE(s.warnings.size() == 1);
    CHECK(s.warnings[0].find("lattice_noise") != std::string::npos);
    const Expression time(s.graph, s.graph.coordinate(3));
    CHECK(at(s.call("hfNormalOffset", {s.x, s.x[0] * time, 0.1}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 2);
}
