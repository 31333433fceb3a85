// Tests of io/mesh_format.h: the very bytes of a tetrahedron in each format, empty meshes, refusals.
#include "frep/io/mesh_format.h"

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <limits>

#include "frep/io/file.h"
#include "unit/geom/shapes.h"
#include "unit/io/scenes.h"

using namespace frep;

namespace {

std::string encoded(const Mesh& mesh, MeshFormat format, bool ascii = false) {
    Result<std::string> bytes = encode_mesh(mesh, format, {.ascii = ascii});
    REQUIRE(static_cast<bool>(bytes));
    return *bytes;
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T value{};
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);  // the tests run on little-endian machines
    return value;
}

Mesh tetrahedron_with_normals() {
    Mesh mesh = test::tetrahedron();
    mesh.normals = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
    return mesh;
}

}  // namespace

TEST_CASE("the extension names the format") {
    CHECK(*mesh_format_from_path("a/b.off") == MeshFormat::off);
    CHECK(*mesh_format_from_path("B.PLY") == MeshFormat::ply);
    CHECK(*mesh_format_from_path("x.tar.Stl") == MeshFormat::stl);
    CHECK(*mesh_format_from_path("a.obj") == MeshFormat::obj);
    CHECK(*mesh_format_from_path("a.glb") == MeshFormat::glb);
    CHECK(*mesh_format_from_path("a.wrl") == MeshFormat::vrml);
    CHECK(*mesh_format_from_path("a.x3d") == MeshFormat::x3d);
    CHECK(*mesh_format_from_path("a.3MF") == MeshFormat::threemf);
    CHECK(*mesh_format_from_path("a.pov") == MeshFormat::pov);
    for (const char* path : {"", "plain", "a.stl/plain", "a.txt", "stl"}) {
        const Result<MeshFormat> format = mesh_format_from_path(path);
        REQUIRE_FALSE(static_cast<bool>(format));
        CHECK(format.error().kind == ErrorKind::invalid_argument);
        CHECK(format.error().message.find(".ply") != std::string::npos);
    }
}

TEST_CASE("OFF: shortest decimals of binary64") {
    Mesh mesh = test::tetrahedron();
    mesh.vertices[3] = {0.1, -0.0, 1e-20};
    CHECK(encoded(mesh, MeshFormat::off) ==
          "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0.1 0 1e-20\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    CHECK(encoded({}, MeshFormat::off) == "OFF\n0 0 0\n");
}

TEST_CASE("PLY as text") {
    CHECK(encoded(tetrahedron_with_normals(), MeshFormat::ply, true) ==
          "ply\nformat ascii 1.0\ncomment frep\nelement vertex 4\n"
          "property float x\nproperty float y\nproperty float z\n"
          "property float nx\nproperty float ny\nproperty float nz\n"
          "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0 -1 0 0\n1 0 0 1 0 0\n0 1 0 0 1 0\n0 0 1 0 0 0.1\n"
          "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
}

TEST_CASE("PLY in binary") {
    const std::string header =
        "ply\nformat binary_little_endian 1.0\ncomment frep\nelement vertex 4\n"
        "property float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string bytes = encoded(test::tetrahedron(), MeshFormat::ply);
    REQUIRE(bytes.size() == header.size() + 4 * 12 + 4 * 13);
    CHECK(bytes.substr(0, header.size()) == header);
    // Vertex 1 is (1, 0, 0): 1.0f is 00 00 80 3f.
    CHECK(bytes.substr(header.size() + 12, 12) == std::string("\0\0\x80\x3f\0\0\0\0\0\0\0\0", 12));
    // The first face is 3: 0 2 1.
    CHECK(bytes.substr(header.size() + 48, 13) == std::string("\3\0\0\0\0\2\0\0\0\1\0\0\0", 13));
    const std::string with_normals = encoded(tetrahedron_with_normals(), MeshFormat::ply);
    CHECK(with_normals.size() == header.size() + 3 * std::strlen("property float nx\n") + 4 * 24 + 4 * 13);
    CHECK(with_normals.find("property float nz\n") != std::string::npos);
}

TEST_CASE("several objects are joined, with the colors of all where one has some") {
    Scene scene = test::two_tetrahedra();
    scene.objects[0].mesh.triangles.resize(1);
    scene.objects[1].mesh.triangles.resize(1);
    CHECK(test::encoded(scene, MeshFormat::off) ==
          "COFF\n8 2 0\n0 0 0 1.0000 0.0000 0.0000 1.0\n1 0 0 0.0000 1.0000 0.0000 1.0\n"
          "0 1 0 0.0000 0.0000 1.0000 1.0\n0 0 1 1.0000 1.0000 1.0000 1.0\n"
          "2 0 0 1.0000 0.5000 0.0000 1.0\n3 0 0 1.0000 0.5000 0.0000 1.0\n"
          "2 1 0 1.0000 0.5000 0.0000 1.0\n2 0 1 1.0000 0.5000 0.0000 1.0\n3 0 2 1\n3 4 6 5\n");
    const std::string text = test::encoded(scene, MeshFormat::ply, true);
    CHECK(test::contains(
        text, "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"));
    CHECK(test::contains(text, "\n1 0 0 0 255 0\n"));
    CHECK(test::contains(text, "\n3 0 0 255 128 0\n"));
    CHECK(test::contains(text, "\n3 0 2 1\n3 4 6 5\n"));
    const std::string binary = test::encoded(scene, MeshFormat::ply);
    REQUIRE(binary.size() > 8 * 15 + 2 * 13);
    const std::string body = binary.substr(binary.size() - 8 * 15 - 2 * 13);
    CHECK(body.substr(15 + 12, 3) == std::string("\0\xff\0", 3));  // the second vertex is green
    CHECK(body.substr(8 * 15 + 13) == std::string("\3\4\0\0\0\6\0\0\0\5\0\0\0", 13));
    CHECK(number_at<std::uint32_t>(test::encoded(scene, MeshFormat::stl), 80) == 2);
}

TEST_CASE("a mesh with colors keeps them, one without gets none") {
    Mesh mesh = test::tetrahedron();
    CHECK(encoded(mesh, MeshFormat::ply).find("uchar red") == std::string::npos);
    mesh.colors.assign(4, {0.2, 0.4, 0.6});
    CHECK(encoded(mesh, MeshFormat::ply, true).find("\n1 0 0 51 102 153\n") != std::string::npos);
}

TEST_CASE("a file is written with its side files") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "frep-write-files-test";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / "pot.obj").string();
    const EncodedFiles files =
        test::encoded_files(test::two_tetrahedra(), MeshFormat::obj, {.stem = stem_of_path(path)});
    CHECK(static_cast<bool>(write_files(path, files)));
    CHECK(*read_file(path, 10000) == files.bytes);
    CHECK(*read_file((folder / "pot.mtl").string(), 10000) == files.side_files.at(0).bytes);
    CHECK_FALSE(static_cast<bool>(write_files((folder / "none" / "pot.obj").string(), files)));
    std::filesystem::remove_all(folder);
}

TEST_CASE("STL in binary: no date, not 'solid', 50 bytes a facet") {
    const std::string bytes = encoded(test::tetrahedron(), MeshFormat::stl);
    REQUIRE(bytes.size() == 84 + 4 * 50);
    CHECK(bytes.substr(0, 5) != "solid");
    CHECK(bytes == encoded(test::tetrahedron(), MeshFormat::stl));
    CHECK(number_at<std::uint32_t>(bytes, 80) == 4);
    CHECK(number_at<float>(bytes, 84 + 8) == -1.0f);  // facet 0 looks down
    CHECK(number_at<float>(bytes, 84 + 28) == 1.0f);  // its second corner is (0, 1, 0)
    CHECK(number_at<std::uint16_t>(bytes, 84 + 48) == 0);
    CHECK(number_at<float>(bytes, 84 + 150) == doctest::Approx(0.57735027f));
    CHECK(encoded({}, MeshFormat::stl).size() == 84);
}

TEST_CASE("STL as text") {
    Mesh mesh = test::tetrahedron();
    mesh.triangles.resize(1);
    CHECK(encoded(mesh, MeshFormat::stl, true) ==
          "solid frep\nfacet normal 0 0 -1\n outer loop\n  vertex 0 0 0\n  vertex 0 1 0\n  vertex 1 0 0\n"
          " endloop\nendfacet\nendsolid frep\n");
    CHECK(encoded({}, MeshFormat::stl, true) == "solid frep\nendsolid frep\n");
    mesh.triangles = {{0, 0, 1}};  // degenerate: a zero normal, never NaN
    CHECK(encoded(mesh, MeshFormat::stl, true).find("facet normal 0 0 0\n") != std::string::npos);
}

TEST_CASE("what a format cannot hold is refused") {
    Mesh mesh = test::tetrahedron();
    mesh.vertices[2].y = 1e39;
    CHECK(static_cast<bool>(encode_mesh(mesh, MeshFormat::off)));
    for (const MeshFormat format :
         {MeshFormat::ply, MeshFormat::stl, MeshFormat::obj, MeshFormat::glb, MeshFormat::vrml,
          MeshFormat::x3d, MeshFormat::threemf, MeshFormat::pov}) {
        const Result<std::string> bytes = encode_mesh(mesh, format);
        REQUIRE_FALSE(static_cast<bool>(bytes));
        CHECK(bytes.error().message.find("vertex 2") != std::string::npos);
    }
    mesh.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(static_cast<bool>(encode_mesh(mesh, MeshFormat::off)));
    mesh = test::tetrahedron();
    mesh.triangles[0][0] = 7;
    CHECK_FALSE(static_cast<bool>(encode_mesh(mesh, MeshFormat::off)));
    Scene scene = test::two_tetrahedra();
    scene.objects[1].mesh.vertices[0].x = 1e37;
    scene.unit = *length_unit("m");
    CHECK(static_cast<bool>(encode_scene(scene, MeshFormat::threemf)));  // 3MF knows the metre
    scene.unit = {"km", 1000};
    CHECK_FALSE(static_cast<bool>(encode_scene(scene, MeshFormat::threemf)));
    CHECK_FALSE(static_cast<bool>(encode_scene(scene, MeshFormat::glb)));
    CHECK(static_cast<bool>(encode_scene(scene, MeshFormat::stl)));
    scene.unit = {"nothing", 0};
    CHECK_FALSE(static_cast<bool>(encode_scene(scene, MeshFormat::stl)));
}
