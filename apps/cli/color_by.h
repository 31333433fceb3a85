// `--color-by NAME=A:B:N`: a coordinate or parameter mapped to color. N states of the model stand in one
// picture, from blue to red. Tested by tests/cli/render_matrix.txt.
#pragma once

#include "moving_model.h"
#include "render_options.h"

namespace frep::cli {

inline constexpr int most_colored_states = 256;

/// Replaces the prepared model by the union of its states, each with its color; colors of the model's own are
/// gone. Errors: as of MovingModel::make() and MovingModel::set(); over_limit when the union has too many
/// nodes.
Status color_by(PreparedModel& prepared, const Steps& steps);

/// The same for the option, where it is given. Errors: invalid_argument, and as above.
Status take_color_by(const RenderOptionTexts& options, PreparedModel& prepared);

/// The color of a share in 0..1: blue, cyan, green, yellow, red.
Color ramp_color(double share);

}  // namespace frep::cli
