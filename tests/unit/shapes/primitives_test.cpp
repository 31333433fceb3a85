// Algebraic primitives: zeros on their surfaces, signs, degenerate sizes.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

TEST_CASE("surfaces are where they should be") {
    Sketch s;
    Items c = s.list({0.3, -0.2, 0.5});
    CHECK(at(s.call("hfSphere", {s.x, c, 1.7}), 2.0, -0.2, 0.5) == Approx(0));
    CHECK(at(s.call("hfSphere", {s.x, c, 2.0}), 0.3, -0.2, 0.5) == 4);
    CHECK(at(s.call("hfEllipsoid", {s.x, c, 1.0, 2.0, 3.0}), 0.3, 1.8, 0.5) == Approx(0));
    CHECK(at(s.call("hfCylinderY", {s.x, c, 2.0}), 2.3, 99, 0.5) == Approx(0));
    CHECK(at(s.call("hfEllCylZ", {s.x, c, 2.0, 3.0}), 0.3, 2.8, 99) == Approx(0));
    CHECK(at(s.call("hfTorusX", {s.x, c, 2.0, 0.5}), 0.8, 1.8, 0.5) == Approx(0));
    CHECK(at(s.call("hfTorusX", {s.x, c, 2.0, 0.5}), 0.3, -0.2, 0.5) == Approx(0.25 - 4));
    CHECK(at(s.call("hfConeZ", {s.x, c, 2.0}), 2.3, -0.2, 1.5) == Approx(0));
    CHECK(at(s.call("hfEllConeX", {s.x, c, 2.0, 3.0}), 1.3, 1.8, 0.5) == Approx(0));
    CHECK(at(s.call("hfSuperell", {s.x, c, 1.0, 2.0, 1.5, 1.0, 1.0}), 0.3, 1.8, 0.5) == Approx(0));
    const Expression block = s.call("hfBlock", {s.x, c, 1.0, 2.0, 1.5});
    CHECK(at(block, 1.3, 0.8, 1.0) == Approx(0));
    CHECK(at(block, 0.8, 0.8, 1.25) > 0);
    CHECK(at(block, 1.4, 0.8, 1.25) < 0);
    CHECK(s.warnings.empty());
}

TEST_CASE("degenerate sizes: the error value, at compile time where they are known") {
    Sketch s;
    Items c = s.list({0, 0, 0});
    CHECK(at(s.call("hfEllipsoid", {s.x, c, 1.0, 1e-7, 1.0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfBlock", {s.x, c, 1.0, -1.0, 1.0}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 2);
    const Expression f = s.call("hfBlock", {s.x, c, 1.0, s.x[1], 1.0});
    CHECK(at(f, 0.5, -1, 0.5) == shapes::error_value);
    CHECK(at(f, 0.5, 1, 0.5) != shapes::error_value);
    CHECK(s.warnings.size() == 2);
}

TEST_CASE("sizes may be fields") {
    Sketch s;
    Items c = s.list({0, 0, 0});
    const Expression f = s.call("hfSphere", {s.x, c, s.x[2]});
    CHECK(at(f, 1, 0, 2) == -1);
}
