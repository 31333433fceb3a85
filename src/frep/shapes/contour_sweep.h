// Sweeps of a contour: a shape of the plane that is carried along a path in space, perpendicular to it, and
// may change on the way (sweeping by a contour: A. Pasko, A. Savchenko, V. Savchenko 1996). No search: the
// path is cut into pieces (path.h), and in each of them the place along the path of a point is a formula.
// Tested by tests/unit/shapes/contour_sweep_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// The contour f, a function of the 3 items of x, along the polygon of `points`, three items each, two or
/// more. In f the items are: to the side, upwards, and the share of the path's length, 0 to 1. `side` (3
/// items) is where the first of them points where the path begins; upwards is along x side. Corners have
/// mitres; a path that ends where it begins is closed; others have flat ends. points and side are numbers.
Expression sweep_contour_polygon(Build& build, Array x, Expression f, Array points, Array side);

/// The same along cubic Bezier curves, each beginning where the one before ends: 4, 7, 10, ... points.
Expression sweep_contour_bezier(Build& build, Array x, Expression f, Array points, Array side);

}  // namespace frep::shapes
