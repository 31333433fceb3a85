// OpenVDB (K. Museth, VDB: high-resolution sparse volumes with dynamic topology, 2013), by its library: the
// first grid of one number a voxel becomes dense over the box of its active voxels. Level sets are negative
// inside: their sign is turned. The grid's map must be linear. Tested by tests/unit/io/read_vdb_test.cpp.
#include "frep/io/read_formats.h"
#include "frep/io/read_volume_formats.h"

#ifdef FREP_HAS_OPENVDB

#include <algorithm>
#include <exception>
#include <istream>
#include <streambuf>

#include <fmt/format.h>

#define IMATH_HALF_NO_LOOKUP_TABLE  // no half numbers here, so nothing of Imath is to be linked
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

namespace frep::reading {

namespace {

/// Reads memory that it does not copy.
class MemoryBuffer : public std::streambuf {
  public:
    explicit MemoryBuffer(std::string_view bytes) {
        char* begin = const_cast<char*>(bytes.data());  // only read
        setg(begin, begin, begin + bytes.size());
    }

  protected:
    pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override {
        const off_type size = egptr() - eback();
        const off_type from = way == std::ios_base::beg   ? 0
                              : way == std::ios_base::cur ? gptr() - eback()
                                                          : size;
        if (offset < -from || offset > size - from) return pos_type(off_type(-1));
        setg(eback(), eback() + from + offset, egptr());
        return pos_type(from + offset);
    }
    pos_type seekpos(pos_type at, std::ios_base::openmode mode) override {
        return seekoff(off_type(at), std::ios_base::beg, mode);
    }
};

template <class Grid>
Result<VolumeFile> dense(const Grid& grid) {
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) return Error{ErrorKind::io, "the grid has no active voxel"};
    VolumeFile out;
    Volume& volume = out.volume;
    for (int axis = 0; axis < 3; ++axis)
        volume.size[static_cast<std::size_t>(axis)] =
            static_cast<std::size_t>(std::int64_t{box.max()[axis]} - box.min()[axis] + 1);
    if (const auto error = size_error(volume.size)) return *error;
    if (!grid.transform().isLinear()) return Error{ErrorKind::io, "the grid's map is not linear"};
    const auto place = [&](double i, double j, double k) -> Vec3 {
        const openvdb::Vec3d p = grid.transform().indexToWorld(
            openvdb::Vec3d(box.min().x() + i, box.min().y() + j, box.min().z() + k));
        return {p.x(), p.y(), p.z()};
    };
    volume.origin = place(0, 0, 0);
    volume.axes = {place(1, 0, 0) - volume.origin, place(0, 1, 0) - volume.origin,
                   place(0, 0, 1) - volume.origin};
    if (!is_placed(volume)) return Error{ErrorKind::io, "the grid's map does not span space"};
    openvdb::tools::Dense<typename Grid::ValueType, openvdb::tools::LayoutXYZ> samples(box);
    openvdb::tools::copyToDense(grid, samples, /*serial=*/true);
    const double sign = grid.getGridClass() == openvdb::GRID_LEVEL_SET ? -1.0 : 1.0;
    volume.values.reserve(samples.valueCount());
    for (std::size_t i = 0; i < samples.valueCount(); ++i) {
        volume.values.push_back(sign * static_cast<double>(samples.data()[i]));
        if (!is_finite(volume.values.back())) return Error{ErrorKind::io, "a sample is not finite"};
    }
    return out;
}

Result<VolumeFile> read_grids(std::string_view bytes) {
    // The library would print a warning of its own for versions to come.
    constexpr std::uint32_t oldest = openvdb::OPENVDB_FILE_VERSION_ROOTNODE_MAP;
    const std::uint32_t version = bytes.size() < 12 ? 0 : load<std::uint32_t>(bytes.data() + 8);
    if (version < oldest || version > openvdb::OPENVDB_FILE_VERSION)
        return Error{ErrorKind::io, fmt::format("OpenVDB format {} is not read: {} to {} are", version,
                                                oldest, std::uint32_t{openvdb::OPENVDB_FILE_VERSION})};
    openvdb::initialize();
    MemoryBuffer buffer(bytes);
    std::istream in(&buffer);
    in.exceptions(std::ios::badbit | std::ios::failbit);
    openvdb::io::Stream stream(in, /*delayLoad=*/false);
    const openvdb::GridPtrVecPtr grids = stream.getGrids();
    for (std::size_t i = 0; grids && i < grids->size(); ++i) {
        const openvdb::GridBase& grid = *(*grids)[i];
        const auto finish = [&](Result<VolumeFile> volume) {
            if (volume && grids->size() > 1)
                volume->notes.push_back(
                    fmt::format("of {} grids, `{}` is read", grids->size(), grid.getName()));
            return volume;
        };
        if (grid.isType<openvdb::FloatGrid>())
            return finish(dense(static_cast<const openvdb::FloatGrid&>(grid)));
        if (grid.isType<openvdb::DoubleGrid>())
            return finish(dense(static_cast<const openvdb::DoubleGrid&>(grid)));
        if (grid.isType<openvdb::Int32Grid>())
            return finish(dense(static_cast<const openvdb::Int32Grid&>(grid)));
    }
    return Error{ErrorKind::io, "there is no grid of float, double or int32 numbers"};
}

}  // namespace

Result<VolumeFile> read_vdb(std::string_view bytes) {
    try {
        return read_grids(bytes);
    } catch (const std::exception& problem) {
        return Error{ErrorKind::io, fmt::format("a damaged OpenVDB file: {}", problem.what())};
    }
}

}  // namespace frep::reading

#else

namespace frep::reading {

Result<VolumeFile> read_vdb(std::string_view) {
    return Error{ErrorKind::io,
                 "this build of frep reads no OpenVDB files (it was built without libopenvdb)"};
}

}  // namespace frep::reading

#endif

namespace frep::reading {

bool is_vdb(std::string_view bytes) {
    return bytes.size() >= 8 && load<std::uint64_t>(bytes.data()) == 0x56444220;
}

}  // namespace frep::reading
