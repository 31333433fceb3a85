// Parameter values from `-a V,V,...` and `--param NAME=V`. Tested by tests/cli.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/frep.h"

namespace frep::cli {

/// A value for every parameter of the object: those of `-a`, then the named ones, then the defaults of the
/// file's `--@ param` lines, else 0. Too many or too few values are a warning. Nothing when a value or name
/// is wrong, which is printed (exit code 2).
std::optional<std::vector<double>> read_parameters(const Model& model, std::size_t object,
                                                   const std::optional<std::string>& values,
                                                   const std::vector<std::string>& named);

/// The number, from 1, of the parameter that `name` means: the name of a `--@ param` line, or a[3], a3.
std::optional<std::size_t> find_parameter(const Model& model, std::size_t object, std::string_view name);

}  // namespace frep::cli
