// Sweeps: solids that move along a line or a curve (Sourin, Pasko 1996). Searches over the parameter of the
// path, proved to a tolerance (field/search.h). For contours see contour_sweep.h. Tested by
// tests/unit/shapes/extremum_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// All places of f, a function of the items of x, while its origin moves along the polygon of `points`: items
/// of x for each point, two points at least.
Expression sweep_polygon(Build& build, Array x, Expression f, Array points, Expression tolerance);

/// The same along the Bezier curve of the third degree with four control points.
Expression sweep_bezier(Build& build, Array x, Expression f, Array points, Expression tolerance);

}  // namespace frep::shapes
