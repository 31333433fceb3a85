// Space transformations: each changes the array `point` in place by the inverse map, so that the solid that
// is evaluated there moves forward, and returns 1. Angles are radians, lengths model units. A `point` without
// 3 items gives error_value with a warning. Sources: Barr 1984 (twist, taper); Savchenko and Pasko 1998 and
// the HyperFun library (space mapping by control points). Tested by tests/unit/shapes/transforms_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Scaling about the origin by sx, sy, sz; a scale of 0 is warned of and gives infinities.
Expression scale(Build& build, ArrayInOut point, Expression sx, Expression sy, Expression sz);

/// Translation by (dx, dy, dz).
Expression shift(Build& build, ArrayInOut point, Expression dx, Expression dy, Expression dz);

/// Rotation about axis 0, 1 or 2 by `angle`, from the next axis towards the one after it.
template <int axis>
Expression rotate(Build& build, ArrayInOut point, Expression angle);

/// Rotation about an axis by an angle that is a1 at coordinate p1 and a2 at p2, linear, not clamped.
template <int axis>
Expression twist(Build& build, ArrayInOut point, Expression p1, Expression p2, Expression a1, Expression a2);

/// Scaling across an axis by s1 below p1, s2 above p2, linear between; a scale within 1e-6 of 0 counts as 1.
template <int axis>
Expression taper(Build& build, ArrayInOut point, Expression p1, Expression p2, Expression s1, Expression s2);

/// Scaling about the fixed point x0.
Expression stretch(Build& build, ArrayInOut point, Array fixed, Expression sx, Expression sy, Expression sz);

/// Moves the neighbourhoods of the points `source` to `target`, one after the other, within an ellipsoid of
/// semi-axes b (1 + |target - source|) about the target; 3 numbers a point in each array.
Expression space_map_cubic(Build& build, ArrayInOut point, Array source, Array target, Array extent);

/// The same with a weight exp(-r^2) that reaches everywhere.
Expression space_map_exponential(Build& build, ArrayInOut point, Array source, Array target, Array extent);

}  // namespace frep::shapes
