// Files as wholes: bounded reading, and writing that leaves either the complete new file or the old state.
// POSIX. Error messages name the path and the cause. Tested by tests/unit/io/file_test.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "frep/base/result.h"

namespace frep {

/// The bytes of the regular file `path` (a link is followed). Errors (io): missing, a directory, a pipe or a
/// device (never waits on one), not readable; over_limit: longer than `max_bytes`.
Result<std::string> read_file(const std::string& path, std::size_t max_bytes);

/// Puts `bytes` in place of the file `path`: written to a temporary file in the same folder, synchronised,
/// then renamed. On failure nothing new is left and an old file is untouched. An old file keeps its
/// permissions, a new one gets those of the umask; a read-only file is refused; through a link the link's
/// target is replaced. A device or a pipe (/dev/null, /dev/stdout) is written to directly. Errors: io.
Status write_file(const std::string& path, std::string_view bytes);

}  // namespace frep
