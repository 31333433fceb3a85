// Implementation of box.h.
#include "box.h"

#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "terminal.h"

namespace frep::cli {

namespace {

/// The box of the model's `--@ bounds` line in space: an axis takes the pair of the coordinate that it
/// carries. Nothing when there is no line or an axis in use has no pair.
std::optional<Box3> annotated_bounds(const PreparedModel& prepared) {
    const std::vector<double>& pairs = prepared.model.program().annotations.bounds;
    if (pairs.empty()) return std::nullopt;
    const auto& coordinates = prepared.map.coordinates;
    double low[3] = {-10, -10, -10}, high[3] = {10, 10, 10};
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < coordinates.size(); ++i) {
            if (coordinates[i].axis != axis) continue;
            const std::size_t pair = pairs.size() == 2 ? 0 : i;
            if (2 * pair + 1 >= pairs.size()) return std::nullopt;
            low[axis] = pairs[2 * pair];
            high[axis] = pairs[2 * pair + 1];
            break;
        }
        if (!(low[axis] < high[axis])) return std::nullopt;
    }
    return Box3{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

/// The stated box in space; a rectangle lies across the last axis that no coordinate takes.
Result<Box3> stated_bounds(const PreparedModel& prepared, const StatedBounds& stated) {
    if (!stated.is_flat) return stated.box;
    const std::optional<int> free = unused_axis(prepared);
    if (!free)
        return Error{ErrorKind::invalid_argument,
                     "--bounds: four numbers bound a 2-D model; this one is 3-D and needs six, "
                     "ax,bx,ay,by,az,bz"};
    const Plane low = Plane::across(*free, -10), high = Plane::across(*free, 10);
    return Box3{low.point({stated.box.min.x, stated.box.min.y}),
                high.point({stated.box.max.x, stated.box.max.y})};
}

}  // namespace

std::string side_list(const std::array<bool, 6>& sides) {
    std::string out;
    for (std::size_t s = 0; s < 6; ++s)
        if (sides[s]) out += fmt::format("{}{}", out.empty() ? "" : ", ", side_names()[s]);
    return out;
}

Result<Box3> choose_box(const PreparedModel& prepared, const std::optional<StatedBounds>& stated,
                        SampledField& field, const Job& job) {
    if (stated) return stated_bounds(prepared, *stated);
    if (const auto box = annotated_bounds(prepared)) return *box;
    BoundsOptions options;
    for (int axis = 0; axis < 3; ++axis)
        options.axes[static_cast<std::size_t>(axis)] = prepared.map.uses(axis);
    const auto found = automatic_bounds(field, options, job);
    if (!found) return found.error();
    if (found->unbounded)
        print_warning(
            fmt::format("no bounds found: the shape may reach beyond 10000 at {}; the box is "
                        "-10..10 (--bounds states another)",
                        side_list(found->reaches)));
    return found->box;
}

}  // namespace frep::cli
