// Tests of reading OBJ and MTL (io/read_obj.cpp, read_mtl.cpp).
#include <map>

#include "unit/io/read_test.h"

using namespace frep;
using namespace frep::test;

namespace {

constexpr SceneReadFormat obj = SceneReadFormat::obj;
constexpr std::string_view corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

ReadOptions with_file(std::string name, std::string content) {
    ReadOptions options;
    options.read_companion = [name, content](std::string_view wanted) -> Result<std::string> {
        if (wanted != name) return Error{ErrorKind::io, "no such file"};
        return content;
    };
    return options;
}

}  // namespace

TEST_CASE("OBJ: quads, all forms of corners, negative indices, continued lines") {
    const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}};
    const std::string head(corners);
    CHECK(only_mesh(head + "f 1 2 3 4\n", obj).triangles == square);
    CHECK(only_mesh(head + "vt 0 0\nf 1/1 2/1 3/1 4/1", obj).triangles == square);
    CHECK(only_mesh(head + "f -4 -3 -2 -1\r\n", obj).triangles == square);
    CHECK(only_mesh(head + "f 1 2 \\\n 3\\\r\n 4 # quad", obj).triangles == square);
    CHECK(only_mesh("# c\n\n  v 0 0 0\nv 1 0 0\nv 1 1 0\rf 1 2 3\nv 7 7 7\nf -1 1 2", obj).triangles ==
          std::vector<Triangle>{{0, 1, 2}, {3, 0, 1}});
}

TEST_CASE("OBJ: normals stay where every vertex has one only") {
    const std::string head = std::string(corners) + "vn 0 0 1\nvn 0 0 -1\n";
    CHECK(near(only_mesh(head + "f 1//1 2//1 3//1 4//1\n", obj).normals.at(3), {0, 0, 1}));
    CHECK(near(only_mesh(head + "f 1//-2 2//-2 3//-1\n", obj).normals.at(2), {0, 0, -1}));
    CHECK(only_mesh(head + "f 1//1 2//1 3\n", obj).normals.empty());
    const Decoded sharp = decoded(head + "f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n", obj);
    CHECK(sharp.scene.objects[0].mesh.normals.empty());
    CHECK(sharp.report.dropped == std::vector<std::string>{"1 object's normals, which differ at one vertex"});
}

TEST_CASE("OBJ: colors of vertices") {
    CHECK(only_mesh("v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 0 0 1\nf 1 2 3", obj).colors ==
          std::vector<Color>{{1, 0, 0}, {0, 0.5, 0}, {0, 0, 1}});
    CHECK(only_mesh("v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 0 1 0 0 0 1\nf 1 2 3", obj).colors[1] ==
          Color{0, 0.2, 0});
    const Decoded some = decoded("v 0 0 0 1 0 0\nv 1 0 0 1.0\nv 0 1 0\nf 1 2 3", obj);
    CHECK(some.scene.objects[0].mesh.colors.empty());
    CHECK(some.report.dropped.size() == 1);
}

TEST_CASE("OBJ: objects keep their own vertices, in the file's order") {
    const Decoded all =
        decoded(std::string(corners) + "o lid of pot\nf 4 3 2\ng foot\nf 1 2 4\no empty\n", obj);
    REQUIRE(all.scene.objects.size() == 2);
    CHECK(all.scene.objects[0].name == "lid of pot");
    CHECK(all.scene.objects[1].name == "foot");
    CHECK(near(all.scene.objects[0].mesh.vertices.at(0), {1, 0, 0}));
    CHECK(all.scene.objects[0].mesh.triangles == std::vector<Triangle>{{2, 1, 0}});
    CHECK(all.scene.objects[1].mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("OBJ: materials come from the library that the caller reads") {
    const std::string file =
        "mtllib a b.mtl\n" + std::string(corners) + "usemtl red one\nf 1 2 3\nusemtl lost\nf 1 3 4\n";
    const ReadOptions options = with_file(
        "a b.mtl",
        "newmtl red one\nKa 1 1 1\nKd 0.5 0.25 2\nPr 0.1\nPm 1\nPc 0.75\nnewmtl other\nKd spectral x.rfl\n");
    const Decoded all = decoded(file, obj, options);
    REQUIRE(all.scene.objects.size() == 2);
    const Material& red = all.scene.objects[0].material;
    CHECK(red.base == Color{0.5, 0.25, 1});
    CHECK(red.roughness == 0.1);
    CHECK(red.metallic == 1);
    CHECK(red.clearcoat == 0.75);
    CHECK(all.scene.objects[1].material.base == Material{}.base);
    CHECK(decoded(file, obj).report.dropped == std::vector<std::string>{"1 material library"});
    CHECK(decoded("mtllib no.mtl\n", obj, options).report.dropped.at(0).find("`no.mtl`") !=
          std::string::npos);
}

TEST_CASE("OBJ: a file without faces gives its points; other elements are counted") {
    const Decoded all = decoded("v 1 2 3\nv 4 5 6\nl 1 2\np 1\nvt 0 0\n", obj);
    CHECK(all.scene.objects.at(0).mesh.vertices.size() == 2);
    CHECK(all.report.dropped == std::vector<std::string>{"1 texture coordinate", "2 line or point elements"});
    CHECK(decoded("", obj).scene.objects.empty());
}

TEST_CASE("OBJ: errors name the line") {
    CHECK(refusal("v 0 0\n", obj) == "line 1: a vertex needs 3 numbers");
    CHECK(refusal("\nv 0 0 zero\n", obj) == "line 2: expected a number in a vertex, found `zero`");
    CHECK(refusal("v 0 0 1e999\n", obj) == "line 1: the coordinate is not finite");
    CHECK(refusal("v 0 0 0\n\nf 1 1 2\n", obj) == "line 3: a face names vertex `2`; 1 stand before it");
    CHECK(refusal("v 0 0 0\nf 1 1 0\n", obj).find("`0`") != std::string::npos);
    CHECK(refusal("v 0 0 0\nf 1 1 -2\n", obj).find("`-2`") != std::string::npos);
    CHECK(refusal("v 0 0 0\nf 1//1 1//1 1//1\n", obj).find("names normal `1//1`") != std::string::npos);
}
