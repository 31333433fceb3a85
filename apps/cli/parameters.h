// Parameter values from `-a V,V,...` and `--param NAME=V`. Tested by tests/cli.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frep/frep.h"

namespace frep::cli {

/// A value for every parameter of the object: those of `-a`, then the named ones, then the defaults of the
/// file's `--@ param` lines, else 0. Too many or too few values are a warning. Nothing when a value or name
/// is wrong, which is printed (exit code 2).
std::optional<std::vector<double>> read_parameters(const Model& model, std::size_t object,
                                                   const std::optional<std::string>& values,
                                                   const std::vector<std::string>& named);

}  // namespace frep::cli
