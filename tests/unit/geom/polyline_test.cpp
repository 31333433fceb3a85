// Tests of geom/polyline.h.
#include "frep/geom/polyline.h"

#include <doctest/doctest.h>

using namespace frep;

TEST_CASE("areas and lengths of outlines") {
    const Polyline square{{{1, 1}, {4, 1}, {4, 3}, {1, 3}}, true};
    CHECK(signed_area(square) == 6);
    CHECK(length(square) == 10);
    const Polyline hole{{{1, 3}, {4, 3}, {4, 1}, {1, 1}}, true};
    CHECK(signed_area(hole) == -6);
    const Polyline open{square.points, false};
    CHECK(signed_area(open) == 0);
    CHECK(length(open) == 8);
    CHECK(length(Polyline{}) == 0);
    CHECK(length(Polyline{{{1, 1}}, true}) == 0);
}
