// Tests of the POV-Ray writer. povray itself renders the files in tests/validators where it is installed.
#include "unit/io/scenes.h"

using namespace frep;
using namespace frep::test;

TEST_CASE("POV-Ray: declarations, the swap of Y and Z, textures") {
    const std::string text = encoded(two_tetrahedra(), MeshFormat::pov);
    CHECK(contains(text, "#version 3.7;"));
    CHECK(contains(text,
                   "#declare Frep_a_b_c_ = mesh2 {\n vertex_vectors {\n  4,\n  <0,0,0>,\n  <1,0,0>,\n  "
                   "<0,0,1>,\n  <0,1,0>\n }"));
    CHECK(contains(text, "#declare Frep_a_b_c__2 = mesh2 {"));
    CHECK(contains(text, " normal_vectors {\n  4,\n  <-1,0,0>,\n  <1,0,0>,\n  <0,0,1>,\n  <0,1,0>\n }"));
    CHECK(contains(text, " texture_list {\n  4,\n  texture { pigment { color rgb <0,0,1> }"));
    CHECK(contains(text, " face_indices {\n  4,\n  <0,2,1>,2,0,1,\n"));  // red, blue, green
    CHECK(contains(text, " face_indices {\n  4,\n  <0,2,1>,\n"));        // without colors
    CHECK(count_of(text, "inside_vector") == 2);
    CHECK(contains(text, "#ifndef (Frep_Include)\n object { Frep_a_b_c_ }\n object { Frep_a_b_c__2 }\n"));
    CHECK(count_of(text, "{") == count_of(text, "}"));
}

TEST_CASE("POV-Ray: an open mesh has no inside, a scene without triangles no object") {
    Scene scene;
    Mesh mesh = tetrahedron();
    mesh.triangles.resize(3);
    scene.objects.push_back({"12\n}", mesh, {}});
    const std::string text = encoded(scene, MeshFormat::pov);
    CHECK_FALSE(contains(text, "inside_vector"));
    CHECK(contains(text, "// object: 12 }\n#declare Frep_Object12_"));
    const std::string empty = encoded({}, MeshFormat::pov);
    CHECK_FALSE(contains(empty, "mesh2"));
    CHECK(contains(empty, "camera"));
}
