// Tests of io/slice_format.h: the very bytes of two slices, as text and in binary.
#include "frep/io/slice_format.h"

#include <cstring>
#include <limits>

#include "unit/io/scenes.h"

using namespace frep;
using frep::test::contains;

namespace {

std::vector<Slice> two_slices() {
    const Polyline outer{{{0, 0}, {2, 0}, {2, 2}}, true};
    const Polyline hole{{{0.5, 0.25}, {1, 0.5}, {1, 0.25}}, true};
    const Polyline seam{{{0, 0}, {1, 1}}, false};
    return {{0.5, {outer, hole}}, {1, {seam, Polyline{{{1, 1}}, true}}}};
}

std::string encoded(const std::vector<Slice>& slices, const SliceOptions& options = {}) {
    const auto bytes = encode_slices(slices, options);
    REQUIRE(static_cast<bool>(bytes));
    return *bytes;
}

}  // namespace

TEST_CASE("CLI as text") {
    SliceOptions options;
    options.label = "pot 1";
    options.first_thickness = 0.5;
    CHECK(encoded(two_slices(), options) ==
          "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n$$LABEL/1,pot_1\n"
          "$$DIMENSION/0,0,0.5,2,2,1\n$$LAYERS/3\n$$HEADEREND\n$$GEOMETRYSTART\n"
          "$$LAYER/0\n"
          "$$LAYER/0.5\n"
          "$$POLYLINE/1,1,4,0,0,2,0,2,2,0,0\n"
          "$$POLYLINE/1,0,4,0.5,0.25,1,0.5,1,0.25,0.5,0.25\n"
          "$$LAYER/1\n"
          "$$POLYLINE/1,2,2,0,0,1,1\n"
          "$$GEOMETRYEND\n");
}

TEST_CASE("CLI in binary: the geometry follows the header at once") {
    SliceOptions options;
    options.ascii = false;
    const std::string bytes = encoded(two_slices(), options);
    const std::string header =
        "$$HEADERSTART\n$$BINARY\n$$UNITS/1\n$$VERSION/200\n$$DIMENSION/0,0,0.5,2,2,1\n$$LAYERS/"
        "2\n$$HEADEREND";
    REQUIRE(bytes.substr(0, header.size()) == header);
    const std::string geometry = bytes.substr(header.size());
    REQUIRE(geometry.size() == 2 * 6 + 2 * (14 + 4 * 8) + (14 + 2 * 8));
    CHECK(geometry.substr(0, 6) == std::string("\x7f\0\0\0\0\x3f", 6));  // 127, 0.5f
    CHECK(geometry.substr(6, 14) == std::string("\x82\0\1\0\0\0\1\0\0\0\4\0\0\0", 14));
    float x = 0;
    std::memcpy(&x, geometry.data() + 6 + 14 + 8, sizeof x);  // the second point
    CHECK(x == 2.0f);
}

TEST_CASE("CLI: lengths are millimetres, no slices give a valid file") {
    SliceOptions options;
    options.unit = *length_unit("cm");
    const std::string text = encoded(two_slices(), options);
    CHECK(contains(text, "$$LAYER/5\n$$POLYLINE/1,1,4,0,0,20,0,20,20,0,0\n"));
    CHECK(contains(text, "$$LAYERS/2\n"));
    options.first_thickness = 1;  // has no layer to stand below
    CHECK(encoded({}, options) ==
          "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n$$LAYERS/0\n$$HEADEREND\n"
          "$$GEOMETRYSTART\n$$GEOMETRYEND\n");
}

TEST_CASE("CLI: what is refused") {
    const auto refused = [](const std::vector<Slice>& slices, const SliceOptions& options = {}) {
        const auto bytes = encode_slices(slices, options);
        return !bytes && bytes.error().kind == ErrorKind::invalid_argument;
    };
    std::vector<Slice> slices = two_slices();
    slices[1].z = 0.5;
    CHECK(refused(slices));
    slices[1].z = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(slices));
    slices = two_slices();
    slices[0].outlines[1].points[0].x = 1e39;
    CHECK(refused(slices));
    SliceOptions options;
    options.first_thickness = -1;
    CHECK(refused(two_slices(), options));
    options = {};
    options.unit.metres = -1;
    CHECK(refused(two_slices(), options));
}
