// Tests of reading STL (io/read_stl.cpp): both forms written by hand, and what tells them apart.
#include <limits>

#include "unit/io/read_test.h"

using namespace frep;
using namespace frep::test;

namespace {

constexpr SceneReadFormat stl = SceneReadFormat::stl;

/// A binary file with this header and these corners, nine numbers a facet.
std::string binary(std::string header, const std::vector<float>& corners, std::uint16_t attribute = 0) {
    header.resize(80, ' ');
    Bytes bytes{header};
    bytes.add(static_cast<std::uint32_t>(corners.size() / 9));
    for (std::size_t i = 0; i < corners.size(); i += 9) {
        for (int k = 0; k < 3; ++k) bytes.add(0.0f);
        for (std::size_t k = 0; k < 9; ++k) bytes.add(corners[i + k]);
        bytes.add(attribute);
    }
    return bytes.out;
}

// two triangles of the square (0,0)-(1,1), at height 2
const std::vector<float> square{0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 0, 2, 1, 1, 2, 0, 1, 2};

void check_square(const Mesh& mesh) {
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(near(mesh.vertices[0], {0, 0, 2}));
    CHECK(near(mesh.vertices[3], {0, 1, 2}));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

std::string text_square() {
    std::string out = "solid  a square \r\n";
    for (std::size_t i = 0; i < square.size(); i += 9) {
        out += "  FACET normal 0 0 1\n outer loop\n";
        for (std::size_t k = 0; k < 9; k += 3)
            out += "  vertex " + std::to_string(square[i + k]) + " +" + std::to_string(square[i + k + 1]) +
                   " 2e0\n";
        out += " endloop\n endfacet\n";
    }
    return out + "endsolid a square\n";
}

}  // namespace

TEST_CASE("STL: binary, with equal positions joined") {
    check_square(only_mesh(binary("made by hand", square), stl));
    CHECK(decoded(binary("", square), stl).report.dropped.empty());
    CHECK(decoded(binary("", square, 7), stl).report.dropped ==
          std::vector<std::string>{"2 facet attributes"});
    CHECK(only_mesh(binary("", {}), stl).vertices.empty());
}

TEST_CASE("STL: text") {
    const Decoded all = decoded(text_square(), stl);
    REQUIRE(all.scene.objects.size() == 1);
    CHECK(all.scene.objects[0].name == "a square");
    check_square(all.scene.objects[0].mesh);
    CHECK(decoded("solid\nendsolid\n", stl).scene.objects.size() == 1);
    // several solids are several objects
    CHECK(decoded(text_square() + text_square(), stl).scene.objects.size() == 2);
}

TEST_CASE("STL: a binary file that begins with solid is binary") {
    check_square(only_mesh(binary("solid facet outer loop vertex endsolid", square), stl));
    std::string padded = binary("solid of an exporter", square);
    padded.append(5, '\0');  // some programs pad
    CHECK(decoded(padded, stl).report.dropped == std::vector<std::string>{"5 trailing bytes"});
}

TEST_CASE("STL: coordinates are binary32 in both forms") {
    const std::string text =
        "solid\nfacet normal 0 0 0\nouter loop\nvertex 0.1 1e-60 -1e-60\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid";
    CHECK(only_mesh(text, stl).vertices[0].x == double{0.1f});
    CHECK(only_mesh(text, stl).vertices[0].y == 0);
}

TEST_CASE("STL: collapsed triangles are dropped and counted") {
    const Decoded all = decoded(binary("", {1, 2, 3, 1, 2, 3, 4, 5, 6}), stl);
    CHECK(all.scene.objects[0].mesh.triangles.empty());
    CHECK(all.report.dropped == std::vector<std::string>{"1 triangle that names a vertex twice"});
}

TEST_CASE("STL: errors name the place") {
    CHECK(refusal("", stl).find("too short") != std::string::npos);
    std::string cut = binary("", square);
    cut.resize(150);
    CHECK(refusal(cut, stl) == "byte 80: 2 facets need 184 bytes, the file has 150");
    CHECK(refusal(binary("", {0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0}), stl) ==
          "byte 120: facet 0 has a coordinate that is not finite");
    CHECK(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x\n", stl) ==
          "line 4: expected a number, found `x`");
    CHECK(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 inf\n", stl) ==
          "line 4: the coordinate is not finite");
    CHECK(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 1e99\n", stl) ==
          "line 4: the coordinate is not finite");
    CHECK(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nendloop", stl) ==
          "line 5: expected vertex, found `endloop`");
    CHECK(refusal("solid a\n", stl) == "line 2: the file ends where facet or endsolid is expected");
}
