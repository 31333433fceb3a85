// The options of `frep mesh`, as given and as understood. Tested by tests/cli/mesh_usage.txt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model_input.h"

namespace frep::cli {

struct MeshOptions {
    ModelOptions model;
    std::optional<std::string> output, format, method, grid, cell, tolerance, iso, bounds, report, require;
    bool ascii = false, cap = false, json = false, no_prune = false;
};
void declare_mesh_options(CommandLine& line, MeshOptions& options);

/// What they mean; the model is not looked at.
struct MeshPlan {
    std::optional<MeshFormat> format;  ///< nothing when no mesh is written
    std::optional<Box3> bounds;
    double iso = 0;
    ContourOptions contour;
    std::vector<std::string> required;
    bool wants_check = false;
};

/// Errors: invalid_argument, io for a folder of an output file that is not there.
Result<MeshPlan> plan_mesh(const MeshOptions& options);

}  // namespace frep::cli
