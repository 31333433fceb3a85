// The library function that makes a solid of a voxel file. Tested by tests/unit/shapes/volume_test.cpp.
#include <fmt/format.h>

#include "frep/io/read_volume.h"
#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

/// A file that stands beside another one: "scans/a.raw" for "a.raw" beside "scans/a.nhdr".
std::string beside(std::string_view file, std::string_view name) {
    const std::size_t slash = file.rfind('/');
    return std::string(slash == std::string_view::npos ? "" : file.substr(0, slash + 1)) + std::string(name);
}

/// The coordinate along one axis of the grid, in samples.
Expression along(Array x, Vec3 origin, Vec3 row) {
    const double o[3] = {origin.x, origin.y, origin.z}, r[3] = {row.x, row.y, row.z};
    Expression sum;
    bool begun = false;
    for (std::size_t i = 0; i < 3; ++i) {
        if (r[i] == 0) continue;
        const Expression term = (x[i] - o[i]) * r[i];
        sum = begun ? sum + term : term;
        begun = true;
    }
    return sum;
}

Expression volume(Build& build, Array x, std::string_view file, Expression level) {
    if (x.size() != 3) return build.error("x must have 3 items");
    if (!build.read_file) return build.error("there is no file access here");
    Result<VolumeFile> content = Error{};
    {
        const Result<std::string> bytes = build.read_file(file);
        if (!bytes) return build.constant(error_value);  // reported by who reads
        content =
            read_volume(*bytes, [&](std::string_view name) { return build.read_file(beside(file, name)); });
    }
    if (!content) return build.refused(fmt::format("{}: {}", file, content.error().message));
    if (build.left_out)
        for (const std::string& note : content->notes) build.left_out(fmt::format("{}: {}", file, note));
    Volume& grid = content->volume;
    const Vec3* a = grid.axes.data();
    const double spans = frep::dot(frep::cross(a[0], a[1]), a[2]);
    Expression at[3], box;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 row = frep::cross(a[(i + 1) % 3], a[(i + 2) % 3]) / spans;
        const double last = static_cast<double>(grid.size[i] - 1), apart = 1.0 / length(row);
        const Expression u = along(x, grid.origin, row);
        at[i] = min(max(u, 0.0), last);
        const Expression slab = min(u, last - u) * apart;
        box = i == 0 ? slab : min(box, slab);
    }
    std::vector<double> data = std::move(grid.values);
    data.insert(data.begin(), {static_cast<double>(grid.size[0]), static_cast<double>(grid.size[1]),
                               static_cast<double>(grid.size[2])});
    const NodeId lead[] = {at[0].id(), at[1].id(), at[2].id()};
    const Expression values(build.graph, build.graph.make_block(Op::voxels, lead, std::move(data)));
    return min(values - level, box);
}

}  // namespace

Rows volume_rows() {
    return {
        row<&volume>(
            "hfVolume", "x, file, level",
            {"Solid of a voxel file (NRRD, raw data with an NRRD header, OpenVDB): where its values reach "
             "the level.",
             "min(trilinear value - level, distance to the nearest face of the grid's box)",
             {},
             "The file says sizes, spacing, directions and origin. The solid ends at the grid's box. A "
             "level set of OpenVDB is negative inside; its sign is turned, so that level 0 is its surface. "
             "docs/outlines.md says what is read."},
            false),
    };
}

}  // namespace frep::shapes
