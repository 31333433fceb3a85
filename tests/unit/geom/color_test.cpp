// Tests of geom/color.h: the curve of sRGB at its known points, and bytes.
#include "frep/geom/color.h"

#include <doctest/doctest.h>

#include <limits>

using namespace frep;

TEST_CASE("sRGB and linear light") {
    CHECK(linear_from_srgb({0, 1, 0.5}).r == 0);
    CHECK(linear_from_srgb({0, 1, 0.5}).g == doctest::Approx(1));
    CHECK(linear_from_srgb({0, 1, 0.5}).b == doctest::Approx(0.21404114048223255));
    CHECK(srgb_from_linear({0.5, 0.002, 0}).r == doctest::Approx(0.7353569830524495));
    CHECK(srgb_from_linear({0.5, 0.002, 0}).g == doctest::Approx(0.02584));
    for (int i = 0; i <= 255; ++i) {
        const double v = i / 255.0;
        CHECK(color_byte(srgb_from_linear(linear_from_srgb({v, v, v})).g) == i);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(linear_from_srgb({nan, -1, 7}) == Color{0, 0, linear_from_srgb({1, 1, 1}).b});
}

TEST_CASE("components as bytes") {
    CHECK(color_byte(-1) == 0);
    CHECK(color_byte(0.5) == 128);
    CHECK(color_byte(1.5) == 255);
    CHECK(color_byte(std::numeric_limits<double>::quiet_NaN()) == 0);
}
