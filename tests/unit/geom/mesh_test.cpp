// Tests of geom/mesh.h: validity, merging of equal positions, mean normals.
#include "frep/geom/mesh.h"

#include <doctest/doctest.h>

#include "unit/geom/shapes.h"

using namespace frep;

TEST_CASE("a mesh is valid when every index names a vertex") {
    Mesh mesh = test::tetrahedron();
    CHECK(is_valid(mesh));
    CHECK(is_valid(Mesh{}));
    mesh.triangles[2][1] = 4;
    CHECK_FALSE(is_valid(mesh));
    mesh = test::tetrahedron();
    mesh.normals.resize(3);
    CHECK_FALSE(is_valid(mesh));
}

TEST_CASE("coordinates side by side are rounded to binary32") {
    Mesh mesh;
    mesh.vertices = {{1 + 1e-9, 1 - 1e-9, 2 + 1e-9}, {1, 1, 2}};
    CHECK(merge_equal_positions(mesh).vertices.size() == 1);
    mesh.vertices.push_back({5, 6, 7});
    CHECK(collapses(mesh, {0, 1, 2}));
    CHECK_FALSE(collapses(mesh, {0, 1, 2}, {.as_float32 = false}));
    CHECK(rounded_to_binary32(0.1) == 0.100000001490116119384765625);
}

TEST_CASE("merging joins equal positions and drops what collapses") {
    const Mesh twice = test::together(test::tetrahedron(), test::tetrahedron({1e-9, 0, 0}));
    const Mesh as_float = merge_equal_positions(twice);
    // Vertices at 0 and 1e-9 differ in binary32 as well; those at 1 and 1 + 1e-9 do not.
    CHECK(as_float.vertices.size() == 7);
    CHECK(as_float.triangles.size() == 8);
    CHECK(merge_equal_positions(twice, {.as_float32 = false}).vertices.size() == 8);

    Mesh sliver;
    sliver.vertices = {{1, 0, 0}, {1 + 1e-9, 0, 0}, {0, 1, 0}};
    sliver.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    sliver.triangles = {{0, 1, 2}};
    const Mesh merged = merge_equal_positions(sliver);
    CHECK(merged.triangles.empty());
    REQUIRE(merged.vertices.size() == 2);
    CHECK(merged.normals[0] == Vec3{1, 0, 0});
    CHECK(merged.normals[1] == Vec3{0, 0, 1});
}

TEST_CASE("negative zero is the same place as zero") {
    Mesh mesh;
    mesh.vertices = {{0.0, 0, 0}, {-0.0, 0, 0}};
    CHECK(merge_equal_positions(mesh, {.as_float32 = false}).vertices.size() == 1);
}

TEST_CASE("mean normals point outward and are zero where nothing is") {
    Mesh mesh = test::tetrahedron();
    mesh.vertices.push_back({9, 9, 9});
    const std::vector<Vec3> normals = mean_normals(mesh);
    REQUIRE(normals.size() == 5);
    const Vec3 centre{0.25, 0.25, 0.25};
    for (std::size_t v = 0; v < 4; ++v) {
        CHECK(length(normals[v]) == doctest::Approx(1));
        CHECK(dot(normals[v], mesh.vertices[v] - centre) > 0);
    }
    CHECK(normals[4] == Vec3{0, 0, 0});
}
