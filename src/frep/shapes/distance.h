// The distance-like family: primitives whose value is the signed Euclidean distance to their surface (exact
// for the cone up to its inner side, the cylinder, torus and ellipsoid), positive inside, in model units; and
// SARDF set operations, which keep values near distances. A wrong array size gives error_value with a
// warning. Sources: Fayolle, Pasko, Schmitt and Mirenkov 2006; HyperFun library. Tested by
// tests/unit/shapes/distance_test.cpp; kernels: field/kernels/distance.h.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Double infinite cone along an axis, slope R: distance to the cone's nearer generating line.
template <int axis>
Expression distance_cone(Build& build, Array x, Array center, Expression slope);

/// Infinite cylinder of radius R about the line through `center` along `direction`.
Expression distance_cylinder(Build& build, Array x, Array center, Array direction, Expression radius);

/// Torus about an axis: ring radius R, tube radius r0.
template <int axis>
Expression distance_torus(Build& build, Array x, Array center, Expression ring, Expression tube);

/// Ellipsoid of semi-axes a, b, c; undefined where one of them is 0.
Expression distance_ellipsoid(Build& build, Array x, Array center, Expression a, Expression b, Expression c);

/// Block from its minimum corner: SARDF intersection (R = 0.2, alpha = 0) of its six half-spaces.
Expression distance_block(Build& build, Array x, Array vertex, Expression dx, Expression dy, Expression dz);

/// SARDF intersection, union and subtraction: fillet radius R, and angle alpha (radians) of the outer sector.
Expression sardf_intersection(Build& build, Expression f1, Expression f2, Expression radius,
                              Expression alpha);
Expression sardf_union(Build& build, Expression f1, Expression f2, Expression radius, Expression alpha);
Expression sardf_subtraction(Build& build, Expression f1, Expression f2, Expression radius, Expression alpha);

/// min and max with a circular fillet of radius r where |f1 - f2| <= r.
Expression distance_blend_intersection(Build& build, Expression f1, Expression f2, Expression radius);
Expression distance_blend_union(Build& build, Expression f1, Expression f2, Expression radius);

/// Partial Fourier sum of a sawtooth of amplitude 1/a and frequency f with n - 1 terms; undefined for n above
/// 10001.
Expression sawtooth(Build& build, Expression t, Expression n, Expression a, Expression f);

}  // namespace frep::shapes
