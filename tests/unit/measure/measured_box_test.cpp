#include "frep/measure/measured_box.h"

#include <doctest/doctest.h>

using namespace frep;
using namespace frep::measuring;

TEST_CASE("a measured box has the axes that count") {
    const auto box = measured_box({{-1, 5, 2}, {3, 5, 4}}, {true, false, true}, 2);
    REQUIRE(box);
    CHECK(box->axes == std::vector<std::size_t>{0, 2});
    CHECK(box->longest == 4);
    CHECK(box->cell.low == std::array<double, 3>{-1, 0, 2});
    CHECK(box->cell.high == std::array<double, 3>{3, 0, 4});
    CHECK(box->cell.middle(2) == 3);
}

TEST_CASE("wrong boxes are refused") {
    CHECK_FALSE(measured_box({{0, 0, 0}, {1, 0, 1}}, {true, true, true}));
    CHECK_FALSE(measured_box({{0, 0, 0}, {1, -1, 1}}, {true, true, true}));
    CHECK_FALSE(measured_box(Box3::cube(1e308), {true, true, true}));
    CHECK_FALSE(measured_box(Box3::cube(1), {true, false, false}, 2));
    CHECK(measured_box(Box3::cube(1), {true, false, false}, 1));
}
