// The box that a measure looks at, with the axes of space that count. Tested by
// tests/unit/measure/measured_box_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "frep/base/result.h"
#include "frep/math/vec.h"

namespace frep::measuring {

/// A box; along an axis that is not measured both ends are 0.
struct Cell {
    std::array<double, 3> low{}, high{};

    /// A point of the cell: the middle of each side, rounded.
    double middle(std::size_t axis) const { return low[axis] + 0.5 * (high[axis] - low[axis]); }
};

struct MeasuredBox {
    Cell cell;
    std::vector<std::size_t> axes;  ///< those that are measured, ascending
    double longest = 0;             ///< side along one of them
};

/// `box` along `axes`. Error invalid_argument: a side that is not > 0 or has no end, fewer than `fewest`
/// axes.
Result<MeasuredBox> measured_box(const Box3& box, const std::array<bool, 3>& axes, std::size_t fewest = 0);

}  // namespace frep::measuring
