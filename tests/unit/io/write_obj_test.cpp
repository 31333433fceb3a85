// Tests of the Wavefront writer: the very lines of two tetrahedra and their material library.
#include "unit/io/scenes.h"

using namespace frep;
using namespace frep::test;

TEST_CASE("OBJ: objects, colors, normals and numbers that run on") {
    const EncodedFiles files = encoded_files(two_tetrahedra(), MeshFormat::obj, {.stem = "my pot"});
    CHECK(files.bytes ==
          "# frep\n# title: T<1> \n# author: \xc3\x84\n# license: CC0\n# source: a & b\n"
          "mtllib my_pot.mtl\n"
          "o a<b>&\"c\"\n"
          "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 1\n"
          "usemtl a<b>&\"c\"\n"
          "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
          "o a<b>&\"c\"_2\n"
          "v 2 0 0\nv 3 0 0\nv 2 1 0\nv 2 0 1\n"
          "vn -1 0 0\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\n"
          "usemtl a<b>&\"c\"_2\n"
          "f 5//1 7//3 6//2\nf 5//1 6//2 8//4\nf 5//1 8//4 7//3\nf 6//2 7//3 8//4\n");
    REQUIRE(files.side_files.size() == 1);
    CHECK(files.side_files[0].name == "my_pot.mtl");
    const std::string& library = files.side_files[0].bytes;
    CHECK(contains(library, "newmtl a<b>&\"c\"\nKa 0 0 0\nKd 1 1 1\n"));
    CHECK(contains(library, "newmtl a<b>&\"c\"_2\nKa 0 0 0\nKd 1 0.5 0\nKs 1 0.5 0\n"));
    CHECK(contains(library, "Pr 0.25\nPm 1\nPc 1\n"));
}

TEST_CASE("OBJ: without a stem there is no side file and no name of one") {
    const EncodedFiles files = encoded_files(two_tetrahedra(), MeshFormat::obj);
    CHECK(files.side_files.empty());
    CHECK_FALSE(contains(files.bytes, "mtl"));
    CHECK(encoded({}, MeshFormat::obj) == "# frep\n");
}

TEST_CASE("OBJ: a colored vertex is the product of its color and the base in linear light") {
    Scene scene = two_tetrahedra();
    scene.objects.resize(1);
    scene.objects[0].material.base = {1, 0.5, 0};
    // White times the base is the base; green times the base keeps the base's green.
    const std::string text = encoded(scene, MeshFormat::obj);
    CHECK(contains(text, "\nv 0 0 1 1 0.5 0\n"));
    CHECK(contains(text, "\nv 1 0 0 0 0.5 0\n"));
    CHECK(contains(text, "\nv 0 1 0 0 0 0\n"));
}

TEST_CASE("side files go beside the main file") {
    CHECK(stem_of_path("a/b.c/pot.v2.obj") == "pot.v2");
    CHECK(stem_of_path("pot") == "pot");
    CHECK(stem_of_path("a/.obj") == ".obj");
    CHECK(stem_of_path("") == "");
}
