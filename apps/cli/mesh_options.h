// The options of `frep mesh`, as given and as understood. Tested by tests/cli/mesh_usage.txt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model_input.h"
#include "values.h"

namespace frep::cli {

struct MeshOptions {
    ModelOptions model;
    std::optional<std::string> output, format, method, grid, cell, tolerance, iso, bounds, report, require;
    std::optional<std::string> layer, material, overhang, min_wall;
    bool ascii = false, cap = false, json = false, no_prune = false, print_check = false;
};
void declare_mesh_options(CommandLine& line, MeshOptions& options);

/// Where the result goes; nothing of it when only a report is wanted.
struct MeshTarget {
    std::optional<MeshFormat> mesh;
    std::optional<DrawingFormat> drawing;
    bool slices = false;
    bool is_default = false;  ///< nobody named a format: what suits the model
    std::string extension;    ///< ".stl", for messages
};

/// What the options mean; the model is not looked at.
struct MeshPlan {
    std::optional<MeshTarget> target;
    std::vector<std::string> objects;  ///< names of `--object`; one, perhaps empty, unless there is a list
    std::optional<StatedBounds> bounds;
    double iso = 0;
    std::optional<int> cells;
    double cell_length = 0;
    bool is_adaptive = true;  ///< --method of solids
    double tolerance = 0;
    double layer = 0;  ///< > 0: slices of this thickness
    bool cap = false, prune = true;
    std::optional<std::size_t> memory_limit;
    std::vector<std::string> required;
    bool report_on_stdout = false;
    bool wants_check = false;
    bool print_check = false;
    double overhang = 45;              ///< degrees
    std::optional<double> min_wall;    ///< model units
    std::optional<Material> material;  ///< of --material
};

/// Errors: invalid_argument, io for a folder of an output file that is not there.
Result<MeshPlan> plan_mesh(const MeshOptions& options);

}  // namespace frep::cli
