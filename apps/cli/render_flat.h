// `frep render` for models that leave an axis of space free: a picture of the plane shape, filled with the
// model's color. Tested by tests/cli/render_flat.txt.
#pragma once

#include "model_input.h"
#include "render_options.h"

namespace frep::cli {

/// Makes and writes the picture of a model with an unused_axis(); gives the exit code.
int render_flat(const RenderOptionTexts& options, const RenderPlan& plan, const PreparedModel& prepared);

}  // namespace frep::cli
