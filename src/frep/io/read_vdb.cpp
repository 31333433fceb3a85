// OpenVDB (K. Museth, VDB: high-resolution sparse volumes with dynamic topology, 2013), by its library: the
// first grid of one number a voxel becomes dense over the box of its active voxels. Level sets are negative
// inside: their sign is turned. The grid's map must be linear. Tested by tests/unit/io/read_vdb_test.cpp.
#include "frep/io/read_formats.h"
#include "frep/io/read_volume_formats.h"

#ifdef FREP_HAS_OPENVDB

#include <algorithm>
#include <exception>
#include <istream>
#include <memory>
#include <optional>
#include <streambuf>

#include <fmt/format.h>

#define IMATH_HALF_NO_LOOKUP_TABLE  // no half numbers here, so nothing of Imath is to be linked
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
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

/// The lengths that a file states before its texts and metadata: the library takes memory for them, up to 4
/// GiB each, before it finds that the file is shorter.
class StatedLengths {
  public:
    StatedLengths(std::string_view bytes, std::istream& in)
        : bytes_(bytes), at_(static_cast<std::size_t>(in.tellg())) {}

    StatedLengths& text() { return skip(number()); }
    StatedLengths& skip(std::size_t count) {
        if (count > bytes_.size() - at_) throw openvdb::IoError("it ends too early");
        at_ += count;
        return *this;
    }
    StatedLengths& metadata() {
        for (std::uint32_t count = number(); count > 0; --count) text().text().text();  // name, type, value
        return *this;
    }

  private:
    std::uint32_t number() {
        const std::size_t at = at_;
        skip(sizeof(std::uint32_t));
        return load<std::uint32_t>(bytes_.data() + at);
    }

    std::string_view bytes_;
    std::size_t at_;
};

/// Reads grids one by one up to the first of numbers, as openvdb::io::Stream reads all of them.
class GridReader : public openvdb::io::Archive {
  public:
    explicit GridReader(std::string_view bytes) : bytes_(bytes) {}

    Result<VolumeFile> read() {
        MemoryBuffer buffer(bytes_);
        std::istream in(&buffer);
        in.exceptions(std::ios::badbit | std::ios::failbit);
        readHeader(in);
        auto versions = std::make_shared<openvdb::io::StreamMetadata>();
        openvdb::io::setStreamMetadataPtr(in, versions, /*transfer=*/false);
        openvdb::io::setVersion(in, libraryVersion(), fileVersion());
        openvdb::io::setDataCompression(in, compression());
        StatedLengths(bytes_, in).metadata();
        openvdb::MetaMap().readMeta(in);
        const std::int32_t count = readGridCount(in);
        for (std::int32_t i = 0; i < count; ++i) {
            StatedLengths(bytes_, in).text().text().text();  // name, type, parent
            openvdb::io::GridDescriptor descriptor;
            const openvdb::GridBase::Ptr grid = descriptor.read(in);
            StatedLengths(bytes_, in)
                .skip(sizeof(std::uint32_t))
                .metadata()
                .text();  // compression; type of map
            readGrid(grid, descriptor, in);
            auto volume = volume_of(*grid);
            if (!volume) continue;
            if (*volume && count > 1)
                (*volume)->notes.push_back(
                    fmt::format("of {} grids, `{}` is read", count, reading::object_name(grid->getName())));
            return std::move(*volume);
        }
        return Error{ErrorKind::io, "there is no grid of float, double or int32 numbers"};
    }

  private:
    /// Nothing for grids of other things than numbers.
    static std::optional<Result<VolumeFile>> volume_of(const openvdb::GridBase& grid) {
        if (grid.isType<openvdb::FloatGrid>()) return dense(static_cast<const openvdb::FloatGrid&>(grid));
        if (grid.isType<openvdb::DoubleGrid>()) return dense(static_cast<const openvdb::DoubleGrid&>(grid));
        if (grid.isType<openvdb::Int32Grid>()) return dense(static_cast<const openvdb::Int32Grid&>(grid));
        return std::nullopt;
    }

    std::string_view bytes_;
};

Result<VolumeFile> read_grids(std::string_view bytes) {
    // Versions before are of 2013; of ones to come the library would print a warning of its own.
    constexpr std::uint32_t oldest = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
    constexpr std::uint32_t newest = openvdb::OPENVDB_FILE_VERSION;
    const std::uint32_t version = bytes.size() < 12 ? 0 : load<std::uint32_t>(bytes.data() + 8);
    if (version < oldest || version > newest)
        return Error{ErrorKind::io,
                     fmt::format("OpenVDB format {} is not read: {} to {} are", version, oldest, newest)};
    openvdb::initialize();
    return GridReader(bytes).read();
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
