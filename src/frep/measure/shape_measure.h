// Volume (area), centroid and inertia of a shape from its function, each with an interval that surely holds
// the true number. The box is divided where the shape's share of a cell is least known; cells inside count
// whole, cells outside not at all, and in the others the shape lies between two pieces of the cell whose
// moments are known (cell_bounds.h, clip.h), so that the width of the result shrinks with the square of the
// cells. All sums are rounded outward (docs/numerics.md, rule 4). Tested by
// tests/unit/measure/shape_measure_test.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/evaluator.h"
#include "frep/math/interval.h"
#include "frep/math/vec.h"

namespace frep {

struct ShapeMeasureOptions {
    Box3 bounds;                                 ///< what lies outside is not counted
    std::array<bool, 3> axes{true, true, true};  ///< those measured: three, or two for a shape of the plane
    double relative_error = 1e-3;                ///< of the size: half the interval over its middle
    std::size_t max_cells = 0;                   ///< undecided cells held at a time; 0 = most_cells()
    EvaluatorOptions evaluator;
};

/// Numbers of a shape of density 1. Axes that are not measured have 0.
struct ShapeMeasure {
    math::Interval size;                     ///< volume, or area
    std::array<math::Interval, 3> centroid;  ///< the box where the size may be 0
    /// About the centroid: integrals of y^2 + z^2, x^2 + z^2, x^2 + y^2, then of -xy, -xz, -yz; in the plane
    /// the third is the polar one. Model units to the 5th (4th).
    std::array<math::Interval, 6> inertia;
    bool is_reached = false;       ///< the size is within the relative error
    bool is_cancelled = false;     ///< the job was cancelled; what was reached until then
    bool has_planes = false;       ///< linear bounds were used, not signs alone
    bool maybe_undefined = false;  ///< F may be undefined in an undecided cell; such points count as outside
    std::array<bool, 6> cut{};     ///< sides -x +x -y +y -z +z of the box that the shape surely reaches
    std::size_t evaluated = 0;     ///< cells looked at
    std::size_t open = 0;          ///< cells in which the shape's share is not fully known
};

/// The default of max_cells: fewer for a field with loops that depend on the point, whose enclosures are
/// dear.
std::size_t most_cells(const Field& field);

/// Measures `field`, a field of x, y, z (field_in_space()). The same bytes for any number of threads; a
/// cancelled job depends on when. Errors: invalid_argument for a box that is empty or not finite along a
/// measured axis, fewer than two axes, a relative error that is not > 0; those of make_evaluator().
Result<ShapeMeasure> measure_shape(const Field& field, const ShapeMeasureOptions& options, const Job& job);

}  // namespace frep
