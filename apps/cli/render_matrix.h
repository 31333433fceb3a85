// `frep render --matrix`: several states of a model in one picture. Tested by tests/cli/render_matrix.txt.
#pragma once

#include "moving_model.h"
#include "render_options.h"

namespace frep::cli {

/// What `--matrix NAME=A:B:N[,NAME=A:B:N]` says: states across, and down.
struct MatrixPlan {
    static constexpr int most_states = 400;
    std::vector<Steps> steps;  ///< one or two
};
Result<MatrixPlan> parse_matrix(std::string_view text);

/// Makes and writes the picture; gives the exit code.
int render_matrix(const RenderOptionTexts& options, const RenderPlan& plan, const MatrixPlan& matrix,
                  PreparedModel& prepared);

}  // namespace frep::cli
