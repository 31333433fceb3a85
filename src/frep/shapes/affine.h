// Affine maps of space and the fold at a plane: as in transforms.h each changes the array `point` in place by
// the inverse map, so that the solid that is evaluated there moves forward, and returns 1. Angles are
// radians, lengths model units. Arrays of wrong size and constants that make a map singular give error_value
// with a warning. Tested by tests/unit/shapes/affine_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Rotation by `angle` about the line through `origin` along `direction` (of any length but 0), counter-
/// clockwise for who looks against the direction (Rodrigues 1840).
Expression rotate_about(Build& build, ArrayInOut point, Array origin, Array direction, Expression angle);

/// Shear along `axis`: the coordinate moves by s1 and s2 times the two other ones, in the order x, y, z.
template <int axis>
Expression shear(Build& build, ArrayInOut point, Expression s1, Expression s2);

/// The affine map X -> M X + T; `matrix` has 12 items, the rows (M T) one after the other.
Expression affine(Build& build, ArrayInOut point, Array matrix);

/// Reflection at the plane through `origin` across `normal` (of any length but 0).
Expression mirror(Build& build, ArrayInOut point, Array origin, Array normal);

/// Fold at that plane: what lies on the side that the normal points to appears on both sides.
Expression fold(Build& build, ArrayInOut point, Array origin, Array normal);

}  // namespace frep::shapes
