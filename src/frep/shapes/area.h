// Areas of the plane as functions: the true signed distance to the boundary of a union of filled contours,
// with holes, islands and overlaps, for op outline_distance (field/kernels/outline.h); and the library
// functions that read areas from files. Tested by tests/unit/shapes/area_test.cpp.
#pragma once

#include <vector>

#include "frep/base/result.h"
#include "frep/geom/area.h"
#include "frep/shapes/library.h"

namespace frep::shapes {

/// The data of op outline_distance for an area. Edges that have the same on both sides (overlaps, seams
/// between parts) count for the sign and not for the distance; an edge nearer than 1e-9 of the larger side to
/// others, so that its sides are in doubt, counts for both. Errors: those of arrange(); invalid_argument when
/// nothing is bounded.
Result<std::vector<double>> area_data(const Area& area);

/// The box of an area's vertices: low x, low y, high x, high y.
struct AreaBox {
    double low[2], high[2];
};
AreaBox box_of(const Area& area);

}  // namespace frep::shapes
