// Chooses the reader of a voxel file. See read_volume.h.
#include "frep/io/read_volume.h"

#include <cmath>

#include <fmt/format.h>

#include "frep/io/read_formats.h"
#include "frep/io/read_volume_formats.h"

namespace frep {

namespace reading {

std::optional<Error> size_error(const std::array<std::size_t, 3>& size) {
    std::size_t product = 1;
    for (const std::size_t n : size) {
        if (n < 2) return Error{ErrorKind::io, "an axis has fewer than 2 samples"};
        if (n > most_samples / product)
            return Error{ErrorKind::over_limit, fmt::format("{} x {} x {} samples, {} are the most", size[0],
                                                            size[1], size[2], most_samples)};
        product *= n;
    }
    return std::nullopt;
}

bool is_placed(const Volume& volume) {
    for (const Vec3& axis : volume.axes)
        if (!is_finite(axis)) return false;
    const double spans = dot(cross(volume.axes[0], volume.axes[1]), volume.axes[2]);
    return is_finite(volume.origin) && is_finite(spans) && spans != 0;
}

}  // namespace reading

Result<VolumeFile> read_volume(std::string_view bytes, const ReadBeside& read_beside) {
    if (reading::is_nrrd(bytes)) return reading::read_nrrd(bytes, read_beside);
    if (reading::is_vdb(bytes)) return reading::read_vdb(bytes);
    return Error{ErrorKind::io, "neither NRRD nor OpenVDB"};
}

}  // namespace frep
