// Voxel files as volumes: NRRD with its data in the file or beside it (a text header and a raw file), and
// OpenVDB. Tested by tests/unit/io/read_nrrd_test.cpp and read_vdb_test.cpp; the page: docs/outlines.md.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/volume.h"

namespace frep {

/// Samples that a file may have; its volume takes 8 bytes for each.
inline constexpr std::size_t most_samples = std::size_t{1} << 27;

struct VolumeFile {
    Volume volume;
    std::vector<std::string> notes;  ///< what was left out, a sentence each
};

/// Content of a file that a header names, relative to the header.
using ReadBeside = std::function<Result<std::string>(std::string_view)>;

/// A volume in one of the formats, which the first bytes tell. Larger values are inside; a level set of
/// OpenVDB, negative inside, has its sign turned. Errors: io for what is malformed or not a volume, with the
/// line of a header; over_limit for more than `most_samples`; what read_beside answers.
Result<VolumeFile> read_volume(std::string_view bytes, const ReadBeside& read_beside = {});

}  // namespace frep
