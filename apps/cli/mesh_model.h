// What the kinds of `frep mesh` ask of a prepared model, and its warnings. Tested by
// tests/cli/mesh_formats.txt.
#pragma once

#include <optional>

#include "model_input.h"

namespace frep::cli {

/// The model's color (`--@ color`), else that of a material without one.
Color base_color(const PreparedModel& prepared);

/// The unit of the model's numbers (`--@ units`); millimetres, with a warning for a text that names no unit.
LengthUnit model_unit(const PreparedModel& prepared);

/// Warnings about undefined samples and about the sides that the shape touches.
void warn_samples(const PreparedModel& prepared, std::uint64_t undefined, const std::optional<Vec3>& first);
void warn_touches(const std::array<bool, 6>& touches, bool cap, std::string_view what);

}  // namespace frep::cli
