// Tests of reading PLY (io/read_ply.cpp): text and both byte orders, types, further elements, errors.
#include "unit/io/read_test.h"

using namespace frep;
using namespace frep::test;

namespace {

constexpr SceneReadFormat ply = SceneReadFormat::ply;

/// Vertices with a list property and integer colors, an unknown element with lists, faces with a weight.
std::string binary(bool big_endian, std::string_view line_end = "\n") {
    std::string header;
    for (const std::string_view line :
         {"ply", big_endian ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0",
          "comment two words", "element vertex 4", "property double x", "property short y",
          "property float32 z", "property list uchar ushort history", "property uchar red",
          "property uchar green", "property uchar blue", "element extra 2",
          "property list uint double values", "property int8 tag", "element face 2", "property float weight",
          "property list uint8 int32 vertex_index", "end_header"})
        header += std::string(line) + std::string(line_end);
    Bytes bytes{header, big_endian};
    const double x[4] = {0.1, 1, 1, 0};
    for (int i = 0; i < 4; ++i) {
        bytes.add(x[i]).add(static_cast<std::int16_t>(-300 * (i / 2))).add(0.5f);
        bytes.add(static_cast<std::uint8_t>(i));
        for (int k = 0; k < i; ++k) bytes.add(static_cast<std::uint16_t>(999));
        bytes.add(static_cast<std::uint8_t>(255)).add(static_cast<std::uint8_t>(51 * i)).add(std::uint8_t{0});
    }
    for (std::uint32_t i = 0; i < 2; ++i) {
        bytes.add(i);
        for (std::uint32_t k = 0; k < i; ++k) bytes.add(1.5);
        bytes.add(std::int8_t{-1});
    }
    bytes.add(1.0f).add(std::uint8_t{4});
    for (const std::int32_t corner : {0, 1, 2, 3}) bytes.add(corner);
    bytes.add(1.0f).add(std::uint8_t{2}).add(std::int32_t{0}).add(std::int32_t{1});
    return bytes.out;
}

void check_binary(const Decoded& all) {
    REQUIRE(all.scene.objects.size() == 1);
    const Mesh& mesh = all.scene.objects[0].mesh;
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(near(mesh.vertices[0], {0.1, 0, 0.5}));
    CHECK(near(mesh.vertices[2], {1, -300, 0.5}));
    REQUIRE(mesh.colors.size() == 4);
    CHECK(mesh.colors[1] == Color{1, 0.2, 0});
    CHECK(mesh.normals.empty());
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(all.report.dropped ==
          std::vector<std::string>{"1 property of the vertices beyond position, normal and color",
                                   "2 `extra` elements", "1 further property of the faces",
                                   "1 face with fewer than 3 corners"});
    CHECK(all.scene.objects[0].material.base == Color{1, 1, 1});
}

std::string text(std::string_view vertex_properties, std::string_view body, int vertices, int faces) {
    std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) + "\n";
    out += vertex_properties;
    out += "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
    return out + std::string(body);
}
constexpr std::string_view xyz = "property float x\nproperty float y\nproperty float z\n";

}  // namespace

TEST_CASE("PLY: binary of both byte orders, any line ends") {
    check_binary(decoded(binary(false), ply));
    check_binary(decoded(binary(true), ply));
    check_binary(decoded(binary(false, "\r\n"), ply));
    check_binary(decoded(binary(true, "\r"), ply));
}

TEST_CASE("PLY: text with normals and colors as numbers of 0 to 1") {
    const std::string file =
        text(std::string(xyz) +
                 "property float nx\nproperty float ny\nproperty float nz\n"
                 "property float red\nproperty float green\nproperty float blue\n",
             "0 0 0  0 0 1  1 0 0.5\n1 0 0  0 0 2  0 1 7\n0 1 0  0 0 0  0 0 -1\n3 0 1 2\n", 3, 1);
    const Mesh mesh = only_mesh(file, ply);
    REQUIRE(mesh.normals.size() == 3);
    CHECK(near(mesh.normals[1], {0, 0, 1}));  // made a unit vector
    CHECK(near(mesh.normals[2], {0, 0, 0}));
    CHECK(mesh.colors == std::vector<Color>{{1, 0, 0.5}, {0, 1, 1}, {0, 0, 0}});
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("PLY: faces may come before the vertices; float is binary32, double is not") {
    const std::string file =
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
        "property float x\nproperty double y\nproperty int z\nend_header\n3 0 1 2\n0.1 0.1 0\n1 0 0\n0 1 0";
    const Mesh mesh = only_mesh(file, ply);
    CHECK(near(mesh.vertices[0], {double{0.1f}, 0.1, 0}));
    CHECK(mesh.triangles.size() == 1);
}

TEST_CASE("PLY: triangle strips with restarts") {
    const std::string file = "ply\nformat ascii 1.0\nelement vertex 6\n" + std::string(xyz) +
                             "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                             "0 0 0 1 0 0 0 1 0 1 1 0 5 5 5 6 6 6\n8 0 1 2 3 -1 0 1 2\n";
    CHECK(only_mesh(file, ply).triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {0, 1, 2}});
}

TEST_CASE("PLY: counts that the file cannot hold are refused") {
    CHECK(refusal(text(xyz, "0 0 0\n", 2000000000, 0), ply) ==
          "line 10: the file is too short for 2000000000 elements `vertex`");
    CHECK(refusal(text(xyz, "0 0 0\n4000000000 0\n", 1, 1), ply).find("longer than the file") !=
          std::string::npos);
    std::string file = binary(false);
    CHECK(refusal(file.substr(0, file.size() - 1), ply).find("byte ") == 0);
}

TEST_CASE("PLY: errors name the place") {
    CHECK(refusal("plx", ply) == "line 1: expected ply");
    CHECK(refusal("ply\nformat ascii 2.0\n", ply) == "line 2: expected a format and its version 1.0");
    CHECK(refusal("ply\nformat ascii 1.0\nelement vertex -1\n", ply) ==
          "line 3: `-1` is no number of elements");
    CHECK(refusal("ply\nformat ascii 1.0\nproperty float x\n", ply) ==
          "line 3: a property stands before the first element");
    CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n", ply) ==
          "line 4: `half` is no type of a property");
    CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 1\n", ply) ==
          "line 4: the header has no end_header");
    CHECK(refusal(text("property float x\n", "0\n", 1, 0), ply) == "line 8: the vertices have no x, y and z");
    CHECK(refusal(text(xyz, "0 0 0\n1 nan 0\n", 2, 0), ply) ==
          "line 11: vertex 1 has a coordinate that is not finite");
    CHECK(refusal(text(xyz, "0 0 0\n1 a 0\n", 2, 0), ply).find("line 11: ") == 0);
    CHECK(refusal(text(xyz, "0 0 0\n3 0 0 1\n", 1, 1), ply) == "face 0 (from 0) names vertex 1; there are 1");
    CHECK(refusal(text(xyz, "0 0 0\n3 0 0 -1\n", 1, 1), ply) ==
          "line 11: element `face` number 0 names vertex -1");
    CHECK(refusal(text(xyz, "0 0 0\nmore\n", 1, 0), ply) == "line 11: data stand after the last element");
}
