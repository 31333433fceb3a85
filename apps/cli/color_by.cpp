// Implementation of color_by.h.
#include "color_by.h"

#include <algorithm>
#include <array>

namespace frep::cli {

Color ramp_color(double share) {
    static constexpr std::array<Color, 5> ramp = {
        {{0.17, 0.27, 0.60}, {0.16, 0.58, 0.68}, {0.42, 0.70, 0.38}, {0.94, 0.76, 0.24}, {0.80, 0.24, 0.18}}};
    const double at = std::clamp(share, 0.0, 1.0) * (ramp.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
    const Color &a = ramp[below], &b = ramp[below + 1];
    const double t = at - static_cast<double>(below);
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

Status take_color_by(const RenderOptionTexts& options, PreparedModel& prepared) {
    if (!options.color_by) return {};
    const auto steps = parse_steps(*options.color_by, most_colored_states);
    const Status status = steps ? color_by(prepared, *steps) : Status(steps.error());
    if (!status) return Error{status.error().kind, "--color-by: " + status.error().message};
    return {};
}

Status color_by(PreparedModel& prepared, const Steps& steps) {
    auto model = MovingModel::make(prepared, steps.along);
    if (!model) return model.error();
    std::vector<ColoredPart> parts;
    std::size_t nodes = 0;
    for (const double value : evenly_spaced(steps.along, steps.count)) {
        if (const Status status = model->set(value); !status) return status;
        const Color color = ramp_color((value - steps.along.from) / (steps.along.to - steps.along.from));
        ColoredPart part{prepared.field(), {}, {color.r, color.g, color.b}};
        for (std::size_t c = 0; c < prepared.map.coordinates.size(); ++c)
            if (prepared.map.coordinates[c].axis < 0)
                part.frozen.emplace_back(static_cast<int>(c), prepared.map.coordinates[c].value);
        nodes += part.field.graph->size();
        if (nodes > Graph::node_limit)
            return Error{ErrorKind::over_limit,
                         "the states of the model are too large for one picture; use fewer"};
        parts.push_back(std::move(part));
    }
    prepared.lowered.field = colored_union(parts);
    return {};
}

}  // namespace frep::cli
