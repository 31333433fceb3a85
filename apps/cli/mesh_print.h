// The print check of `frep mesh`: as lines to read and as a part of the report.
// Tested by tests/cli/mesh_print.txt.
#pragma once

#include <string>
#include <vector>

#include "frep/frep.h"
#include "json.h"
#include "mesh_options.h"

namespace frep::cli {

/// Runs the check as the plan says. Errors: as of print_check().
Result<PrintReport> run_print_check(const Mesh& mesh, const MeshPlan& plan, const LengthUnit& unit,
                                    const Job& job);

/// The report's "print" part, and a summary of a few lines.
Json print_json(const PrintReport& report, const MeshPlan& plan);
std::string print_text(const PrintReport& report, const MeshPlan& plan);

/// A sentence when a wall thinner than --min-wall was found.
std::vector<std::string> broken_walls(const PrintReport& report, const MeshPlan& plan);

}  // namespace frep::cli
