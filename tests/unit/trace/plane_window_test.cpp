// Tests of eval/plane.h and trace/plane_window.h.
#include "frep/trace/plane_window.h"

#include <doctest/doctest.h>

using namespace frep;

TEST_CASE("planes across the axes have right and up in the order of the alphabet") {
    const Plane z = Plane::across(2, 5), y = Plane::across(1, 5), x = Plane::across(0, 5);
    CHECK(z.point({1, 2}) == Vec3{1, 2, 5});
    CHECK(y.point({1, 2}) == Vec3{1, 5, 2});
    CHECK(x.point({1, 2}) == Vec3{5, 1, 2});
    for (int axis = 0; axis < 3; ++axis) {
        const Plane plane = Plane::across(axis, 5);
        CHECK(plane.normal() == axis);
        CHECK(plane.flat(plane.point({3, 4})) == Vec2{3, 4});
    }
}

TEST_CASE("a window holds the rectangle around its middle, pixels are square") {
    const Rectangle part{{-1, 2}, {3, 4}};
    const auto w = Window::around(part, 200, 300);
    REQUIRE(static_cast<bool>(w));
    CHECK(w->step == doctest::Approx(4.0 / 200));
    const Rectangle seen = w->rectangle();
    CHECK(seen.min.x == doctest::Approx(-1));
    CHECK(seen.max.x == doctest::Approx(3));
    CHECK(seen.min.y == doctest::Approx(0));
    CHECK(seen.max.y == doctest::Approx(6));
    CHECK(w->y(0) > w->y(1));
    const auto margin = Window::around(part, 200, 100, 0.1);
    REQUIRE(static_cast<bool>(margin));
    CHECK(margin->step == doctest::Approx(4.0 / 160));
    CHECK(margin->x(20) == doctest::Approx(-1));
}

TEST_CASE("what cannot be shown is an error") {
    const double inf = 1 / 0.0;
    CHECK_FALSE(static_cast<bool>(Window::around({{0, 0}, {0, 1}}, 10, 10)));
    CHECK_FALSE(static_cast<bool>(Window::around({{0, 0}, {1, -1}}, 10, 10)));
    CHECK_FALSE(static_cast<bool>(Window::around({{0, 0}, {inf, 1}}, 10, 10)));
    CHECK_FALSE(static_cast<bool>(Window::around({{0, 0}, {0 / 0.0, 1}}, 10, 10)));
    CHECK_FALSE(static_cast<bool>(Window::around({{-1.7e308, 0}, {1.7e308, 1}}, 10, 10)));
    CHECK_FALSE(static_cast<bool>(Window::around({{1, 1}, {1 + 1e-14, 1 + 1e-14}}, 100, 100)));
}
