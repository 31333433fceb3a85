// Arrays of copies: symmetry under the turn and the step, nothing cut, exact quarters, grids, bad counts.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A ball beside the axis that reaches far into its neighbours.
Expression ball(Sketch& s, double x, double y, double z, double r) {
    Items center = s.list({x, y, z});
    return s.call("hfSphere", {s.x, center, r});
}

}  // namespace

TEST_CASE("a polar array is the union of all copies, none cut") {
    Sketch s;
    const Expression piece = ball(s, 1, 0.3, 0.2, 1.1);
    const Expression ring = s.call("hfPolarArrayZ", {s.x, piece, 7});
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-2.5, 2.5);
    for (int i = 0; i < 500; ++i) {
        const double x = place(random), y = place(random), z = place(random);
        bool inside = false;
        for (int k = 0; k < 7; ++k) {
            const double c = std::cos(2 * pi * k / 7), n = std::sin(2 * pi * k / 7);
            inside = inside || at(piece, x * c + y * n, y * c - x * n, z) >= 0;
        }
        CHECK((at(ring, x, y, z) >= 0) == inside);
    }
    CHECK(s.warnings.empty());
}

TEST_CASE("a polar array does not change when it is turned by a sector") {
    Sketch s;
    s.build.set_system = {shapes::SetSystem::Kind::min_max, 0};  // the order of the copies does not matter
    const Expression piece = ball(s, 1, 0.3, 0.2, 0.6);
    const char* const names[] = {"hfPolarArrayX", "hfPolarArrayY", "hfPolarArrayZ"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Expression ring = s.call(names[axis], {s.x, piece, 5});
        const double c = std::cos(2 * pi / 5), n = std::sin(2 * pi / 5);
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        double p[3] = {0.7, -0.4, 0.9}, q[3] = {0.7, -0.4, 0.9};
        q[u] = c * p[u] - n * p[v];
        q[v] = n * p[u] + c * p[v];
        CHECK(at(ring, p[0], p[1], p[2]) == Approx(at(ring, q[0], q[1], q[2])));
        CHECK(at(ring, p[0], p[1], p[2]) != Approx(at(piece, p[0], p[1], p[2])));
    }
    // quarters are exact
    const Expression cross = s.call("hfPolarArrayZ", {s.x, piece, 4});
    CHECK(at(cross, 0.7, -0.4, 0.9) == at(cross, 0.4, 0.7, 0.9));
    CHECK(at(cross, 0.7, -0.4, 0.9) == at(cross, -0.7, 0.4, 0.9));
    CHECK(at(s.call("hfPolarArrayZ", {s.x, piece, 1}), 0.2, 0.3, 0.4) == at(piece, 0.2, 0.3, 0.4));
}

TEST_CASE("the first copy goes towards the next axis") {
    Sketch s;
    const Expression piece = ball(s, 1, 0, 0, 0.1);
    const Expression two = s.call("hfPolarArrayZ", {s.x, piece, 12});
    CHECK(at(two, std::cos(pi / 6), std::sin(pi / 6), 0) > 0);
    const Expression plane = s.call("hfPolarArrayY", {s.x, piece, 12});
    CHECK(at(plane, std::cos(pi / 6), 0, -std::sin(pi / 6)) > 0);
    CHECK(at(plane, std::cos(pi / 12), 0, -std::sin(pi / 12)) < 0);
}

TEST_CASE("linear arrays, and arrays of arrays") {
    Sketch s;
    const Expression piece = ball(s, 0, 0, 0, 0.5);
    Items right = s.list({2, 0, 0.5}), up = s.list({0, 3, 0});
    const Expression row = s.call("hfLinearArray", {s.x, piece, right, 4});
    for (int i = -1; i <= 4; ++i) CHECK((at(row, 2 * i, 0, 0.5 * i) >= 0) == (i >= 0 && i < 4));
    const Expression grid = s.call("hfLinearArray", {s.x, row, up, 3});
    for (int j = -1; j <= 3; ++j) CHECK((at(grid, 6, 3 * j, 1.5) >= 0) == (j >= 0 && j < 3));
    CHECK(at(grid, 5, 3, 1.5) < 0);
    // of a transformed point: the array moves with it
    Items t = s.x, d = s.list({1});
    s.call("hfShift3D", {t, 0.0, 0.0, 10.0});
    Items origin = s.list({0, 0, 0});
    const Expression high = s.call("hfSphere", {t, origin, 0.5});
    CHECK(at(s.call("hfLinearArray", {t, high, d, 2}), 1, 0, 10) > 0);
}

TEST_CASE("arrays refuse what they cannot do") {
    Sketch s;
    const Expression piece = ball(s, 1, 0, 0, 0.1);
    Items plane = {s.x[0], s.x[1]}, line = {s.x[0]}, d = s.list({1}), none;
    CHECK(at(s.call("hfPolarArrayZ", {s.x, piece, 0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfPolarArrayZ", {s.x, piece, 1001}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfPolarArrayZ", {s.x, piece, s.x[0]}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfPolarArrayX", {plane, piece, 3}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfPolarArrayZ", {plane, piece, 3}), 0, 0, 0) == shapes::error_value);  // needs z too
    CHECK(at(s.call("hfLinearArray", {s.x, piece, none, 3}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfLinearArray", {line, piece, d, 3}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 7);
    const Expression disk = 0.25 - square(s.x[0] - 1.0) - square(s.x[1]);
    CHECK(at(s.call("hfPolarArrayZ", {plane, disk, 3}), -0.5, 0.866, 0) > 0);
}
