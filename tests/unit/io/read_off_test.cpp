// Tests of reading OFF (io/read_off.cpp).
#include "unit/io/read_test.h"

using namespace frep;
using namespace frep::test;

namespace {
constexpr SceneReadFormat off = SceneReadFormat::off;
}

TEST_CASE("OFF: comments, quads, free line ends, colors of faces") {
    const Decoded all = decoded(
        "OFF # keyword\n# counts\n4 3 0\n0 0 0.1 1 0 0\n1 1 0\n\n0 1 0\n4 0 1 2 3 255 0 0\n3 0 1 2 0.5 0.5 "
        "0.5 1\n2 0 1\n",
        off);
    const Mesh& mesh = all.scene.objects.at(0).mesh;
    CHECK(near(mesh.vertices.at(0), {0, 0, 0.1}));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    CHECK(all.report.dropped ==
          std::vector<std::string>{"2 face colors", "1 face with fewer than 3 corners"});
    CHECK(only_mesh("3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", off).triangles.size() == 1);  // no keyword, no edges
    CHECK(only_mesh("OFF 0 0 0", off).vertices.empty());
}

TEST_CASE("OFF: colors and normals of vertices") {
    const std::string ends = "\n3 0 1 2\n";
    CHECK(only_mesh("COFF\n3 1 0\n0 0 0 255 0 51 255\n1 0 0 0 0 0 255\n0 1 0 0 0 0 255" + ends, off)
              .colors.at(0) == Color{1, 0, 0.2});
    CHECK(only_mesh("COFF\n3 1 0\n0 0 0 1 0 0.5\n1 0 0 0 0 0\n0 1 0 0 0 0" + ends, off).colors.at(0) ==
          Color{1, 0, 0.5});
    CHECK(near(only_mesh("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 3 0\n0 1 0 0 0 1" + ends, off).normals.at(1),
               {0, 1, 0}));
    const Mesh both = only_mesh(
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 0 .1 .2\n1 0 0 0 1 0 0 0 0 0 0\n0 1 0 0 0 1 0 0 0 0 0" + ends, off);
    CHECK(both.colors.at(0) == Color{1, 1, 0});
    CHECK(both.normals.size() == 3);
}

TEST_CASE("OFF: errors name the line; counts are not trusted") {
    CHECK(refusal("", off) == "line 1: the file is empty");
    CHECK(refusal("4OFF\n1 0 0\n", off) == "line 1: expected OFF, COFF, NOFF or CNOFF, found `4OFF`");
    CHECK(refusal("OFF BINARY\n", off) == "line 1: binary OFF is not read");
    CHECK(refusal("OFF\n0 -1 0\n", off) == "line 2: expected the number of faces, found `-1`");
    CHECK(refusal("OFF\n4000000000 1 0\n0 0 0\n", off) ==
          "line 2: the file is too short for 4000000000 vertices");
    CHECK(refusal("OFF\n1 1 0\n0 0 0\n4000000000 0 0\n", off) ==
          "line 4: the file is too short for 4000000000 corners");
    CHECK(refusal("OFF\n1 1 0\n0 0 nan\n3 0 0 0\n", off) ==
          "line 3: expected a finite number in vertex 0, found `nan`");
    CHECK(refusal("OFF\n1 1 0\n0 0 0\n3 0 0 1\n", off) == "line 4: face 0 names vertex `1`; there are 1");
    CHECK(refusal("OFF\n1 1 0\n0 0 0\n3 0 0 0\n7\n", off) == "line 5: `7` stands after the last face");
    CHECK(refusal("COFF\n1 0 0\n0 0 0 1\n", off) == "line 3: vertex 0 has 1 numbers after its position");
}
