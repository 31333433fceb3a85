// Writing a picture of a model: a PNG file with the texts of the model's annotations. Tested by tests/cli.
#pragma once

#include <string>

#include "frep/frep.h"

namespace frep::cli {

/// Writes the picture to `path`, or to standard output for `-`. Gives 0 or the exit code of what went wrong,
/// which is then printed.
int write_picture(const Image& image, const Model& model, const std::string& path);

}  // namespace frep::cli
