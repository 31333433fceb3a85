// What `frep mesh` makes: surfaces of one or several solids as a scene, outlines of 2-D objects as a drawing,
// slices of a solid.
#pragma once

#include <vector>

#include "mesh_options.h"

namespace frep::cli {

/// Meshes the objects, writes the file and the report, prints what is to be said; the exit code.
int run_solid(const MeshOptions& options, const MeshPlan& plan, const std::vector<PreparedModel>& models,
              double start);

/// `frep mesh` for 2-D objects: outlines as a drawing. Tested by tests/cli/mesh_outlines.txt.
int run_outlines(const MeshOptions& options, const MeshPlan& plan, const std::vector<PreparedModel>& models,
                 double start);

/// `frep mesh --layer`: slices of a solid. Tested by tests/cli/mesh_layers.txt.
int run_layers(const MeshOptions& options, const MeshPlan& plan, const PreparedModel& prepared, double start);

}  // namespace frep::cli
