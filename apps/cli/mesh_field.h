// The field of a prepared model as `frep mesh` samples it. Tested by tests/cli/mesh_formats.txt.
#pragma once

#include <memory>
#include <optional>

#include "model_input.h"

namespace frep::cli {

/// F - iso in space, of the prepared model's field. With `colors` it has the object's attributes too, which
/// only attributes() evaluates. Errors: as of make_evaluator and make_sampled_field.
Result<std::unique_ptr<SampledField>> mesh_field(const PreparedModel& prepared, double iso, bool colors);

/// True when the object's header declares three attributes or more: s[1..3] are then its color.
bool has_colors(const PreparedModel& prepared);

/// The model's color (`--@ color`), else that of a material without one.
Color base_color(const PreparedModel& prepared);

/// The unit of the model's numbers (`--@ units`); millimetres, with a warning for a text that names no unit.
LengthUnit model_unit(const PreparedModel& prepared);

/// Warnings about undefined samples and about the sides that the shape touches.
void warn_samples(const PreparedModel& prepared, std::uint64_t undefined, const std::optional<Vec3>& first);
void warn_touches(const std::array<bool, 6>& touches, bool cap, std::string_view what);

}  // namespace frep::cli
