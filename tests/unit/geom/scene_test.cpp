// Tests of geom/scene.h: units by their names, objects joined to one mesh.
#include "frep/geom/scene.h"

#include <doctest/doctest.h>

using namespace frep;

TEST_CASE("length units by name") {
    CHECK(length_unit("mm")->metres == 0.001);
    CHECK(length_unit("Inches")->metres == 0.0254);
    CHECK(length_unit("CM")->name == "cm");
    CHECK(length_unit("metre")->metres == 1);
    CHECK_FALSE(length_unit("parsec"));
    CHECK_FALSE(length_unit(""));
}

TEST_CASE("objects become one mesh") {
    Scene scene;
    scene.objects.resize(3);
    scene.objects[0].mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}};
    scene.objects[0].material.base = {1, 0, 0};
    scene.objects[2].mesh = {
        {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {}, {{0, 1, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}}};
    const Mesh all = merged(scene);
    CHECK(is_valid(all));
    CHECK(all.vertices.size() == 6);
    CHECK(all.normals.empty());
    REQUIRE(all.colors.size() == 6);
    CHECK(all.colors[2] == Color{1, 0, 0});
    CHECK(all.colors[5] == Color{0, 0, 1});
    REQUIRE(all.triangles.size() == 2);
    CHECK(all.triangles[1] == Triangle{3, 5, 4});
}
