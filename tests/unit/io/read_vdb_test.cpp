// OpenVDB files, written by the library: a level set, a fog volume, maps, kinds of grids; files cut anywhere.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "frep/io/read_volume.h"

#ifdef FREP_HAS_OPENVDB

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

using namespace frep;
using doctest::Approx;

/// OpenVDB 10 loses the nodes that it made when the rest of a cut file is missing: no leak of ours. Asked for
/// by the leak sanitizer, by nobody else.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:openvdb\n"; }

namespace {

std::string bytes_of(const openvdb::GridPtrVec& grids, std::uint32_t compression) {
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.setCompression(compression);
    stream.write(grids);
    return out.str();
}

/// Centre (1, 2, 3), radius 4, half a unit a voxel.
openvdb::FloatGrid::Ptr sphere() {
    openvdb::initialize();
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(4.0f, openvdb::Vec3f(1, 2, 3), 0.5f);
}

Vec3 place_of(const Volume& v, std::size_t i, std::size_t j, std::size_t k) {
    return v.origin + v.axes[0] * static_cast<double>(i) + v.axes[1] * static_cast<double>(j) +
           v.axes[2] * static_cast<double>(k);
}

}  // namespace

TEST_CASE("a level set is the distance, positive inside, in its narrow band") {
    for (const std::uint32_t compression :
         {std::uint32_t{openvdb::io::COMPRESS_NONE}, std::uint32_t{openvdb::io::COMPRESS_ZIP},
          openvdb::io::COMPRESS_BLOSC | std::uint32_t{openvdb::io::COMPRESS_ACTIVE_MASK}}) {
        const auto read = read_volume(bytes_of({sphere()}, compression));
        if (!read) FAIL(read.error().message);
        const Volume& v = read->volume;
        CHECK(read->notes.empty());
        CHECK(v.axes[1] == Vec3{0, 0.5, 0});
        REQUIRE(v.values.size() == v.size[0] * v.size[1] * v.size[2]);
        std::size_t wrong = 0, at = 0;
        for (std::size_t k = 0; k < v.size[2]; ++k)
            for (std::size_t j = 0; j < v.size[1]; ++j)
                for (std::size_t i = 0; i < v.size[0]; ++i) {
                    const double want =
                        std::clamp(4 - length(place_of(v, i, j, k) - Vec3{1, 2, 3}), -1.5, 1.5);
                    if (std::fabs(v.values[at++] - want) > 1e-5) ++wrong;
                }
        CHECK(wrong == 0);
    }
}

TEST_CASE("values of other grids keep their sign; the first grid of numbers is read") {
    openvdb::initialize();
    auto fog = openvdb::DoubleGrid::create(-1.0);
    fog->tree().setValue(openvdb::Coord(-3, 0, 2), 5.0);
    fog->tree().setValue(openvdb::Coord(1, 4, 3), 7.0);
    fog->setTransform(openvdb::math::Transform::createLinearTransform(2.0));
    auto marks = openvdb::BoolGrid::create(false);
    const auto read = read_volume(bytes_of({marks, fog, sphere()}, openvdb::io::COMPRESS_ZIP));
    REQUIRE(read);
    CHECK(read->notes.size() == 1);
    const Volume& v = read->volume;
    CHECK(v.size == std::array<std::size_t, 3>{5, 5, 2});
    CHECK(v.origin == Vec3{-6, 0, 4});
    CHECK(v.values.front() == 5);
    CHECK(v.values.back() == 7);
    CHECK(v.values[1] == -1);
    CHECK(read_volume(bytes_of({marks}, openvdb::io::COMPRESS_ZIP)).error().message ==
          "there is no grid of float, double or int32 numbers");
    CHECK(read_volume(bytes_of({openvdb::FloatGrid::create()}, openvdb::io::COMPRESS_ZIP)).error().message ==
          "the grid has no active voxel");
}

TEST_CASE("grids whose box is too large are refused before it is made") {
    openvdb::initialize();
    auto wide = openvdb::FloatGrid::create(0.0f);
    wide->tree().setValue(openvdb::Coord(-2'000'000'000, 0, 0), 1.0f);
    wide->tree().setValue(openvdb::Coord(2'000'000'000, 2'000'000'000, 5), 1.0f);
    const auto read = read_volume(bytes_of({wide}, openvdb::io::COMPRESS_ZIP));
    REQUIRE(!read);
    CHECK(read.error().kind == ErrorKind::over_limit);
}

TEST_CASE("lengths that a file states are compared with what it has, before memory is taken for them") {
    auto fog = openvdb::FloatGrid::create(0.0f);
    fog->setName("fog");
    fog->insertMeta("what", openvdb::StringMetadata("this is a text"));
    fog->tree().setValue(openvdb::Coord(0, 0, 0), 1.0f);
    fog->tree().setValue(openvdb::Coord(1, 1, 1), 1.0f);
    const std::string whole = bytes_of({fog}, openvdb::io::COMPRESS_ZIP);
    REQUIRE(read_volume(whole));
    for (const char* text : {"fog", "Tree_float_5_4_3", "what", "this is a text", "UniformScaleMap"}) {
        CAPTURE(text);
        const std::size_t at = whole.find(text);
        REQUIRE(at != std::string::npos);
        std::string lying = whole;
        lying[at - 1] = '\x7f';  // the highest byte of its length
        const auto read = read_volume(lying);
        REQUIRE(!read);
        CHECK(read.error().message == "a damaged OpenVDB file: IoError: it ends too early");
    }
    std::string later = whole;
    later[8] = '\xff';
    CHECK(read_volume(later).error().message.find("is not read") != std::string::npos);
}

TEST_CASE("a file cut anywhere is refused") {
    auto fog = openvdb::FloatGrid::create(0.0f);
    for (int i = 0; i < 3; ++i) fog->tree().setValue(openvdb::Coord(i, 2 * i, 3 * i), 1.0f);
    const std::string whole = bytes_of({fog}, openvdb::io::COMPRESS_ZIP);
    REQUIRE(read_volume(whole));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto read = read_volume(std::string_view(whole).substr(0, size));
        CHECK(!read);
        if (!read) CHECK(!read.error().message.empty());
    }
}

#endif
