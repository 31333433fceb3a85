// The box that a verb works in, in space: --bounds, else the model's `--@ bounds` line, else found by
// intervals. Tested by tests/cli.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model_input.h"
#include "values.h"

namespace frep::cli {

/// The box for a prepared model: `stated` if there is one, else the annotation, else automatic_bounds() with
/// a warning when the shape has no end. An axis that no coordinate takes spans -10..10 unless stated. Errors:
/// invalid_argument for a rectangle of a model that uses all three axes, cancelled.
Result<Box3> choose_box(const PreparedModel& prepared, const std::optional<StatedBounds>& stated,
                        SampledField& field, const Job& job);

/// "-x, +z": the sides that are true.
std::string side_list(const std::array<bool, 6>& sides);

}  // namespace frep::cli
