// The options of `frep convert` and its two halves: mesh files to mesh files, a model to an exchange form.
// Tested by tests/cli/convert.txt.
#pragma once

#include <optional>
#include <string>

#include "model_input.h"

namespace frep::cli {

struct ConvertOptions {
    ModelOptions model;  ///< its input is the model or the mesh file
    std::optional<std::string> output, format, unit, bounds, max_gradient;
    bool merge = false, ascii = false, json = false;
};

/// A model as an isosurface of POV-Ray; `target` is the format that -o names. Gives the exit code.
int convert_model(const ConvertOptions& options, MeshFormat target);

/// Writes the files to -o: 0, or the exit code of a failure, which is printed.
int write_converted(const ConvertOptions& options, const EncodedFiles& files);

/// ".stl", ".pov": the extension of a format.
std::string_view format_extension(MeshFormat format);

}  // namespace frep::cli
