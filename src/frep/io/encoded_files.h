// What an encoder makes: the bytes of a file and of the files that belong beside it.
// Tested by tests/unit/io/mesh_format_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"

namespace frep {

/// A file that another one names; it belongs in the same folder.
struct SideFile {
    std::string name;  ///< without folder
    std::string bytes;
};

struct EncodedFiles {
    std::string bytes;                 ///< of the main file
    std::vector<SideFile> side_files;  ///< usually none
};

/// The name of `path` without its folder and its last extension: "pot" for "a/pot.obj".
std::string stem_of_path(std::string_view path);

/// Writes the main file to `path` and its side files into the same folder, side files first. Errors: io, as
/// of write_file.
Status write_files(const std::string& path, const EncodedFiles& files);

}  // namespace frep
