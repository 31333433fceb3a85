// The options of `frep field`, as given and as understood. Tested by tests/cli/field_usage.txt.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model_input.h"
#include "values.h"

namespace frep::cli {

struct FieldOptionTexts {
    ModelOptions model;
    std::optional<std::string> output, section, size, levels, bounds, title;
    bool json = false;
};
void declare_field_options(CommandLine& line, FieldOptionTexts& options);

/// What they mean; the model is not looked at.
struct FieldPlan {
    std::optional<std::pair<int, double>> section;  ///< axis and value
    std::optional<StatedBounds> bounds;
    std::optional<Rectangle> part;  ///< of the plane, from four numbers
    FieldPictureOptions picture;    ///< size and levels
};

/// Errors: invalid_argument, io for a folder of an output file that is not there.
Result<FieldPlan> plan_field(const FieldOptionTexts& options);

}  // namespace frep::cli
