// Implementation of measured_box.h.
#include "frep/measure/measured_box.h"

#include <algorithm>

#include <fmt/format.h>

namespace frep::measuring {

Result<MeasuredBox> measured_box(const Box3& box, const std::array<bool, 3>& axes, std::size_t fewest) {
    const std::array<double, 3> low{box.min.x, box.min.y, box.min.z}, high{box.max.x, box.max.y, box.max.z};
    MeasuredBox out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!axes[axis]) continue;
        const double side = high[axis] - low[axis];
        if (!(side > 0) || !(side - side == 0))
            return Error{ErrorKind::invalid_argument, "the box is empty or has no end"};
        out.cell.low[axis] = low[axis];
        out.cell.high[axis] = high[axis];
        out.longest = std::max(out.longest, side);
        out.axes.push_back(axis);
    }
    if (out.axes.size() < fewest)
        return Error{ErrorKind::invalid_argument,
                     fmt::format("a shape to be measured has {} or three axes", fewest == 2 ? "two" : "one")};
    return out;
}

}  // namespace frep::measuring
