// In, on and out by value and gradient.
#include "frep/measure/membership.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>

using namespace frep;

TEST_CASE("on is a distance, whatever the scale of the function") {
    for (const double scale : {1e-9, 1.0, 1e9}) {
        CAPTURE(scale);
        const std::array<double, 3> gradient{3 * scale, 0, 4 * scale};  // length 5
        CHECK(membership(0.49 * scale, gradient, 0.1) == Membership::on);
        CHECK(membership(-0.49 * scale, gradient, 0.1) == Membership::on);
        CHECK(membership(0.51 * scale, gradient, 0.1) == Membership::in);
        CHECK(membership(-0.51 * scale, gradient, 0.1) == Membership::out);
    }
}

TEST_CASE("points without a gradient, and without a value") {
    const std::array<double, 2> none{0, 0};
    CHECK(membership(0, none, 1) == Membership::on);
    CHECK(membership(1e-300, none, 1) == Membership::in);
    CHECK(membership(-1e-300, none, 1) == Membership::out);
    CHECK(membership(std::numeric_limits<double>::quiet_NaN(), none, 1) == Membership::out);
    CHECK(membership(0, {}, 0) == Membership::on);
}
