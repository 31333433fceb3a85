// Files that models name - drawings, fonts, voxels - told of by `frep info`. Tested by
// tests/cli/info_files.txt.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frep::cli {

/// A kind of file that a model names, and the library function that reads it.
struct NamedFile {
    enum class Kind { drawing, font, volume } kind;
    std::string_view what;      ///< "an SVG drawing"
    std::string_view function;  ///< as a call in a model
};

/// The kind of a file by its extension, or by its first bytes; nothing for others.
std::optional<NamedFile> named_file_kind(std::string_view path, std::string_view bytes);

/// Tells what is in a file that is no model: the exit code, or nothing for a file that may be a model. Files
/// beyond 1 GiB are refused.
std::optional<int> describe_file(const std::string& path, bool json);

}  // namespace frep::cli
