// The options of `frep animate`, as given and as understood. Tested by tests/cli/animate.txt.
#pragma once

#include <optional>
#include <string>

#include "movie_file.h"
#include "moving_model.h"
#include "render_options.h"

namespace frep::cli {

struct AnimateOptionTexts {
    RenderOptionTexts look;
    std::optional<std::string> along, frames, fps, report;
    bool turntable = false, even = false, back = false, once = false, keep = false;
};
void declare_animate_options(CommandLine& line, AnimateOptionTexts& options);

struct AnimatePlan {
    static constexpr int most_frames = 10000;

    RenderPlan look;
    MovieKind kind = MovieKind::gif;
    MovieOptions movie;
    std::optional<Along> along;
    int frames = 60;
};

/// Errors: invalid_argument; io for a folder that is not there, or an .mp4 without ffmpeg.
Result<AnimatePlan> plan_animate(const AnimateOptionTexts& options);

}  // namespace frep::cli
