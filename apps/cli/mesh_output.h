// Where `frep mesh` puts its files and its report. Tested by tests/cli/mesh.txt.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh_options.h"

namespace frep::cli {

/// Writes the files to -o, if there is one: 0, or the exit code of a failure, which is printed.
int write_output(const MeshOptions& options, const EncodedFiles& files);

/// Puts the report where the options say, prints the broken promises: 0, 3, or the code of a failure.
int deliver_report(const MeshOptions& options, const std::string& bytes,
                   const std::vector<std::string>& broken);

/// " to pot.stl", " to standard output", or nothing.
std::string destination(const MeshOptions& options);

}  // namespace frep::cli
