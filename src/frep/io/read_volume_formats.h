// The readers that read_volume() chooses from (private to io), and what they share.
#pragma once

#include <optional>

#include "frep/io/read_volume.h"

namespace frep::reading {

bool is_nrrd(std::string_view bytes);
Result<VolumeFile> read_nrrd(std::string_view bytes, const ReadBeside& read_beside);

bool is_vdb(std::string_view bytes);
Result<VolumeFile> read_vdb(std::string_view bytes);

/// What is wrong with the size of a grid, nothing when it can be read: 2 samples an axis at least,
/// `most_samples` altogether.
std::optional<Error> size_error(const std::array<std::size_t, 3>& size);

/// True when the axes span space and all numbers are finite.
bool is_placed(const Volume& volume);

}  // namespace frep::reading
