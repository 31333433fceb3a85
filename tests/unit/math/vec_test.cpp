// Points and boxes.
#include <doctest/doctest.h>

#include "frep/math/vec.h"

TEST_CASE("vectors and boxes") {
    using frep::Box3;
    using frep::Vec3;
    const Vec3 a{1, 2, 3}, b{4, 5, 6};
    CHECK(dot(a, b) == 32);
    CHECK(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}) == Vec3{0, 0, 1});
    CHECK(length(Vec3{2, 3, 6}) == 7);
    CHECK((2.0 * a - b) / 2.0 == Vec3{-1, -0.5, 0});
    const Box3 box = Box3::cube(10);
    CHECK(box.min == Vec3{-10, -10, -10});
    CHECK(box.contains({10, -10, 0}));
    CHECK_FALSE(box.contains({10.5, 0, 0}));
    CHECK(Box3{{0, 0, 0}, {2, 3, 6}}.diagonal() == 7);
}
