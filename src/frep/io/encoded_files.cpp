// Implementation of encoded_files.h.
#include "frep/io/encoded_files.h"

#include "frep/io/file.h"

namespace frep {

std::string stem_of_path(std::string_view path) {
    const std::size_t slash = path.find_last_of('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    const std::size_t dot = name.find_last_of('.');
    return std::string(dot == std::string_view::npos || dot == 0 ? name : name.substr(0, dot));
}

Status write_files(const std::string& path, const EncodedFiles& files) {
    const std::size_t slash = path.find_last_of('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    for (const SideFile& side : files.side_files) {
        if (Status ok = write_file(folder + side.name, side.bytes); !ok) return ok;
    }
    return write_file(path, files.bytes);
}

}  // namespace frep
