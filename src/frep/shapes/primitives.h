// Algebraic primitives: sphere, ellipsoid, cylinders, tori, block, superellipsoid, cones. Every builder gives
// F >= 0 inside, in the square of the model's units unless it is scaled to 1; none is a distance. Sizes other
// than 3 of `x` or `center`, and degenerate sizes, give error_value with a warning. Source: HyperFun library
// (Adzhiev and others 1999); tested by tests/unit/shapes/primitives_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Ball of radius R: R^2 - X^2 - Y^2 - Z^2 with (X,Y,Z) = x - center.
Expression sphere(Build& build, Array x, Array center, Expression radius);

/// Ellipsoid of semi-axes a, b, c; |a|, |b| or |c| < 1e-6 is an error.
Expression ellipsoid(Build& build, Array x, Array center, Expression a, Expression b, Expression c);

/// Infinite cylinder of radius R along axis 0, 1 or 2: R^2 minus the square distance to the axis.
template <int axis>
Expression cylinder(Build& build, Array x, Array center, Expression radius);

/// Infinite cylinder over an ellipse of semi-axes a, b (the lower-numbered coordinate first).
template <int axis>
Expression elliptic_cylinder(Build& build, Array x, Array center, Expression a, Expression b);

/// Torus about an axis: ring radius R, tube radius r0.
template <int axis>
Expression torus(Build& build, Array x, Array center, Expression ring, Expression tube);

/// Axis-parallel block from its minimum corner: R-intersection of three slabs; a negative size is an error.
Expression block_solid(Build& build, Array x, Array vertex, Expression dx, Expression dy, Expression dz);

/// Superellipsoid (Barr 1981) with exponents s1 (along z) and s2 (in the xy plane).
Expression superellipsoid(Build& build, Array x, Array center, Expression a, Expression b, Expression c,
                          Expression s1, Expression s2);

/// Double infinite cone along an axis; R is the slope radius per height.
template <int axis>
Expression cone(Build& build, Array x, Array center, Expression slope);

/// Double infinite cone over an ellipse; slopes a and b of the two other coordinates in order.
template <int axis>
Expression elliptic_cone(Build& build, Array x, Array center, Expression a, Expression b);

}  // namespace frep::shapes
