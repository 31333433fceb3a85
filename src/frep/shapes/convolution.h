// Convolution surfaces with the Cauchy kernel h(r) = 1/(1 + S^2 r^2)^2: the integral of h over points,
// segments, polylines, triangles, meshes and arcs, minus a threshold T. Exact closed forms; S is the kernel
// width of each element in 1/units. Wrong array sizes give error_value with a warning; elements of length or
// area 0 count 0. Source: McCormack and Sherstyuk 1998. Tested by tests/unit/shapes/convolution_test.cpp;
// kernels: field/kernels/convolution.h.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Points; `points` holds 3 numbers for every item of S.
Expression conv_point(Build& build, Array x, Array points, Array s, Expression threshold);

/// Segments; `begin` and `end` hold 3 numbers each for every item of S.
Expression conv_line(Build& build, Array x, Array begin, Array end, Array s, Expression threshold);

/// A polyline of as many segments as S has items; `points` holds 3 numbers for each of its ends.
Expression conv_curve(Build& build, Array x, Array points, Array s, Expression threshold);

/// Triangles, 9 numbers each. With `weighted`, each integral is multiplied by S^3 as the old library does.
template <bool weighted>
Expression conv_triangle(Build& build, Array x, Array points, Array s, Expression threshold);

/// A mesh: 3 numbers a vertex, 3 one-based vertex numbers a triangle; a number out of range is undefined.
template <bool weighted>
Expression conv_mesh(Build& build, Array x, Array vertices, Array triangles, Array s, Expression threshold);

/// Arcs of `theta` degrees (0..360) from the local x axis; the local frame is the model's, turned by `angle`
/// degrees about `axis` and moved to `center`. Integral over the angle, or over the arc length.
template <bool by_length>
Expression conv_arc(Build& build, Array x, Array center, Array radius, Array theta, Array axis, Array angle,
                    Array s, Expression threshold);

/// Segments with the surface at about distance R from their ends: S and T follow from R, and the running sum
/// is clamped to 1.
Expression conv_line_radius(Build& build, Array x, Array begin, Array end, Expression radius);

}  // namespace frep::shapes
