// Free-form volumes: trivariate Bezier and B-spline functions over a box, and voxel data. Box arrays hold
// xmin, ymin, zmin, xmax, ymax, zmax; control values are indexed i m n + j n + k, where i runs with x, j with
// z and k with y. Wrong sizes give error_value with a warning. Source: Miura, Pasko and Savchenko 1996.
// Tested by tests/unit/shapes/freeform_test.cpp; kernels: field/kernels/freeform.h.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Bernstein sum of l m n control values (at most 21 an axis), R-intersected with its box.
Expression bezier_volume(Build& build, Array x, Expression l, Expression m, Expression n, Array box,
                         Array values);

/// Cubic B-spline sum of l m n control values, surrounded by three layers of value -15, over the box enlarged
/// by three cells a side, R-intersected with the enlarged box.
Expression bspline_volume(Build& build, Array x, Expression l, Expression m, Expression n, Array box,
                          Array values);

/// Trilinear density of a file of 150 x 200 x 192 bytes over [-1,1]^3, minus level; density 0 outside.
Expression voxels_old(Build& build, Array x, std::string_view file, Expression level);

/// The same for nx x ny x nz bytes (x runs fastest, then y, then z).
Expression voxels_sized(Build& build, Array x, std::string_view file, Expression nx, Expression ny,
                        Expression nz, Expression level);

}  // namespace frep::shapes
