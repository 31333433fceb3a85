// Implementation of animate_options.h.
#include "animate_options.h"

#include <fmt/format.h>

#include "values.h"

namespace frep::cli {

namespace {

Error usage(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }
Error about(std::string_view option, const Error& error) {
    return {error.kind, fmt::format("{}: {}", option, error.message)};
}

/// Options of all pictures that mean nothing in an animation, or stand in its way.
Status check_output(const AnimateOptionTexts& options, AnimatePlan& plan) {
    if (!options.look.output)
        return usage("-o FILE is missing: where the animation goes (.gif, .apng or .mp4)");
    const std::string& path = *options.look.output;
    if (path == "-") return usage("an animation cannot go to standard output");
    const auto kind = movie_kind(path);
    if (!kind)
        return usage(fmt::format("no animation format for '{}'; there are .gif, .apng and .mp4", path));
    plan.kind = *kind;
    if (const Status status = check_folder(path); !status) return status;
    if (options.report)
        if (const Status status = check_folder(*options.report); !status) return status;
    if (plan.kind == MovieKind::mp4)
        if (const auto program = find_ffmpeg(); !program) return program.error();
    return {};
}

}  // namespace

void declare_animate_options(CommandLine& line, AnimateOptionTexts& options) {
    line.text("-o,--output", options.look.output, "FILE", "the animation: .gif, .apng or .mp4");
    line.text("--along", options.along, "NAME=A..B", "the coordinate or parameter that moves, and its range");
    line.text("--frames", options.frames, "N", "frames (default 60)");
    line.text("--fps", options.fps, "F", "frames a second (default 25)");
    line.flag("--turntable", options.turntable, "the camera goes round the object once");
    line.flag("--even", options.even, "choose the values so that each frame changes as much as the others");
    line.flag("--back", options.back, "show the frames forwards and backwards");
    line.flag("--once", options.once, "do not repeat");
    line.text("--frame-report", options.report, "FILE.json",
              "size, components and change of each frame; - for standard output");
    line.flag("--keep-frames", options.keep, "leave the frames in FILE.frames/ when the animation is done");
    declare_look_options(line, options.look);
}

Result<AnimatePlan> plan_animate(const AnimateOptionTexts& options) {
    AnimatePlan plan;
    if (const Status status = check_output(options, plan); !status) return status.error();
    auto look = plan_look(options.look);
    if (!look) return look.error();
    plan.look = std::move(*look);
    if (!options.look.size) {
        plan.look.picture.width = 480;
        plan.look.picture.height = 360;
    }
    plan.look.picture.framed_all_round = options.turntable;
    if (options.along) {
        const auto along = parse_along(*options.along);
        if (!along) return about("--along", along.error());
        plan.along = *along;
    }
    if (!plan.along && !options.turntable)
        return usage("nothing moves: give --along NAME=A..B, --turntable, or both");
    if (options.even && !plan.along) return usage("--even needs --along");
    if (options.frames) {
        const auto count = parse_integer(*options.frames, 2, AnimatePlan::most_frames);
        if (!count) return about("--frames", count.error());
        plan.frames = static_cast<int>(*count);
    }
    if (options.fps) {
        const auto rate = parse_positive(*options.fps);
        if (!rate) return about("--fps", rate.error());
        if (!(*rate >= 0.1 && *rate <= 100)) return usage("--fps: the rate must lie in 0.1..100");
        plan.movie.frames_per_second = *rate;
    }
    plan.movie.loops = !options.once;
    return plan;
}

}  // namespace frep::cli
