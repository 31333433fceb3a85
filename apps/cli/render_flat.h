// `frep render` for models that leave an axis of space free: a picture of the plane shape, filled with the
// model's color. Tested by tests/cli/render_flat.txt.
#pragma once

#include "model_input.h"
#include "render_options.h"

namespace frep::cli {

/// The exit code of a model of the plane that is no picture, or of an option that has no meaning there, which
/// is printed. Nothing where all is well.
std::optional<int> refuse_flat(const RenderOptionTexts& options, const PreparedModel& prepared);

/// The picture of the part `box` of a plane shape. Stated bounds fill it, a box that was found has a margin;
/// without a stated size the longer side has `longer_side` pixels.
PlaneRenderOptions flat_picture(const RenderOptionTexts& options, const RenderPlan& plan,
                                const PreparedModel& prepared, const Box3& box, double longer_side = 1200);

/// Makes and writes the picture of a model with an unused_axis(); gives the exit code.
int render_flat(const RenderOptionTexts& options, const RenderPlan& plan, const PreparedModel& prepared);

}  // namespace frep::cli
