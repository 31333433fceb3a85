// Sums of sizes and moments of parts of cells, about a point, in outward rounding; and what they say of
// centroid and inertia. Tested by tests/unit/measure/shape_measure_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "frep/math/interval.h"
#include "frep/measure/cell_bounds.h"
#include "frep/measure/clip.h"

namespace frep::measuring {

/// The part of a cell that belongs to the shape holds `sure`; what else may belong has `rest` at most. Both
/// as shares of the cell.
struct CellPart {
    Cell cell;
    PartMoments sure;
    double rest = 1;
};

/// The cell that judge() left open.
CellPart cell_part(const Cell& cell, const CellBounds& bounds, int dimension);

/// The size of a cell, along the measured axes.
math::Interval cell_size(const Cell& cell, const std::vector<std::size_t>& axes);

/// Size and moments about `origin`.
struct MomentSums {
    std::array<double, 3> origin{};
    math::Interval size = 0;
    std::array<math::Interval, 3> first{};   ///< of x_i - origin_i
    std::array<math::Interval, 6> second{};  ///< order of PartMoments::second, by axis of space

    /// Adds the part of a cell that is at least `part.sure` and at most that and `part.rest`.
    void add(const CellPart& part, const std::vector<std::size_t>& axes);
    /// Adds a whole cell.
    void add_whole(const Cell& cell, const std::vector<std::size_t>& axes);
    void add(const MomentSums& other);
    /// The same about another point. Exact up to rounding where the size is known; else wider.
    MomentSums about(const std::array<double, 3>& point) const;
};

/// Centroid and inertia of a shape with these sums. `box`: where the shape lies.
struct CentralMoments {
    std::array<math::Interval, 3> centroid;
    std::array<math::Interval, 6> inertia;  ///< order of ShapeMeasure::inertia
};
CentralMoments central_moments(const MomentSums& sums, const Cell& box, const std::vector<std::size_t>& axes);

}  // namespace frep::measuring
