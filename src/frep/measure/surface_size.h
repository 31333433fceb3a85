// The area of a surface (the length of an outline) from samples: an estimate. The level set F = 0 of the
// function that is linear in the Kuhn simplices of a lattice (marching tetrahedra, Doi and Koide 1991) is
// measured on a lattice and on one of twice its step; their difference tells how far the finer one may be
// off. Tested by tests/unit/measure/surface_size_test.cpp.
#pragma once

#include <array>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/field_pool.h"
#include "frep/math/vec.h"

namespace frep {

struct SurfaceSize {
    double size = 0;   ///< area, or length
    double error = 0;  ///< an estimate: the difference between the two lattices, no bound
};

/// The size of the surface of {F >= 0} in `box`, which is divided into about `cells` cells along its longest
/// measured side (8..1024); what lies in the sides of the box does not count. Undefined is outside. The same
/// bytes for any number of threads. Errors: invalid_argument for fewer than two axes, an empty box, a number
/// out of range; cancelled.
Result<SurfaceSize> estimate_surface(FieldPool& fields, const Box3& box, const std::array<bool, 3>& axes,
                                     int cells, const Job& job);

}  // namespace frep
