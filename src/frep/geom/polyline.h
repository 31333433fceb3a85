// Polyline: connected points of the plane, plain data: contours of 2-D shapes and slices of solids.
// The solid lies to the left of the direction of travel: outer outlines run counter-clockwise, holes
// clockwise. Tested by tests/unit/geom/polyline_test.cpp.
#pragma once

#include <vector>

#include "frep/math/vec.h"

namespace frep {

/// Points in model units. A closed polyline does not repeat its first point at the end.
struct Polyline {
    std::vector<Vec2> points;
    bool closed = false;
};

/// The area that a closed polyline encloses, positive when it runs counter-clockwise; 0 for an open one.
double signed_area(const Polyline& line);

/// The length of the line, with the closing piece of a closed one.
double length(const Polyline& line);

/// A plane section of a solid: its outlines at the height `z`.
struct Slice {
    double z = 0;
    std::vector<Polyline> outlines;
};

}  // namespace frep
