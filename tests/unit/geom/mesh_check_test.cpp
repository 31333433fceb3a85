// Tests of geom/mesh_check.h on meshes whose counts are known by hand, each kind of fault once.
#include "frep/geom/mesh_check.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "unit/geom/shapes.h"

using namespace frep;
using test::tetrahedron;
using test::together;

TEST_CASE("a tetrahedron") {
    const MeshReport r = check(tetrahedron());
    CHECK(r.vertices == 4);
    CHECK(r.triangles == 4);
    CHECK(r.components == 1);
    CHECK(r.boundary_edges == 0);
    CHECK(r.nonmanifold_edges == 0);
    CHECK(r.nonmanifold_vertices == 0);
    CHECK(r.misoriented_edges == 0);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.genus == 0.0);
    CHECK(r.closed);
    CHECK(r.manifold);
    CHECK(r.oriented);
    CHECK(r.area == doctest::Approx(1.5 + 0.8660254037844386).epsilon(1e-14));
    CHECK(r.volume.value() == doctest::Approx(1.0 / 6).epsilon(1e-14));
    CHECK(r.centroid.value().x == doctest::Approx(0.25).epsilon(1e-14));
    CHECK(r.centroid.value().z == doctest::Approx(0.25).epsilon(1e-14));
    CHECK(r.bounds.value() == Box3{{0, 0, 0}, {1, 1, 1}});
}

TEST_CASE("measures do not depend on the place of the mesh") {
    const MeshReport r = check(tetrahedron({1024, -512, 256}));
    CHECK(r.volume.value() == doctest::Approx(1.0 / 6).epsilon(1e-12));
    CHECK(r.centroid.value().x == doctest::Approx(1024.25).epsilon(1e-12));
}

TEST_CASE("an inside-out mesh is oriented and has a negative volume") {
    Mesh mesh = tetrahedron();
    for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    const MeshReport r = check(mesh);
    CHECK(r.oriented);
    CHECK(r.volume.value() == doctest::Approx(-1.0 / 6));
}

TEST_CASE("an open mesh has no volume, centroid or genus") {
    Mesh mesh = tetrahedron();
    mesh.triangles.pop_back();
    const MeshReport r = check(mesh);
    CHECK(r.boundary_edges == 3);
    CHECK_FALSE(r.closed);
    CHECK(r.manifold);
    CHECK(r.euler_characteristic == 1);
    CHECK_FALSE(r.genus);
    CHECK_FALSE(r.volume);
    CHECK_FALSE(r.centroid);
    CHECK(r.area == doctest::Approx(1.5));
}

TEST_CASE("a flipped triangle makes three misoriented edges") {
    Mesh mesh = tetrahedron();
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    const MeshReport r = check(mesh);
    CHECK(r.misoriented_edges == 3);
    CHECK_FALSE(r.oriented);
    CHECK(r.closed);
    CHECK(r.manifold);
}

TEST_CASE("a fin on an edge is non-manifold at the edge and its ends") {
    Mesh mesh = tetrahedron();
    mesh.vertices.push_back({-1, -1, -1});
    mesh.triangles.push_back({0, 1, 4});
    const MeshReport r = check(mesh);
    CHECK(r.nonmanifold_edges == 1);
    CHECK(r.nonmanifold_vertices == 2);
    CHECK(r.boundary_edges == 2);
    CHECK_FALSE(r.manifold);
}

TEST_CASE("two bodies that touch in a vertex") {
    Mesh mesh = together(tetrahedron(), tetrahedron({1, 0, 0}));  // vertex 1 and vertex 4 coincide
    const MeshReport r = check(mesh);
    CHECK(r.vertices == 8);
    CHECK(r.nonmanifold_vertices == 1);
    CHECK(r.nonmanifold_edges == 0);
    CHECK(r.components == 2);
    CHECK(r.euler_characteristic == 3);
    CHECK(r.genus == 0.0);
    CHECK(r.volume.value() == doctest::Approx(1.0 / 3));
}

TEST_CASE("a double triangle is closed; equal triangles three times are not manifold") {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
    MeshReport r = check(mesh);
    CHECK(r.closed);
    CHECK(r.manifold);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.volume.value() == 0);
    CHECK_FALSE(r.centroid);
    mesh.triangles.push_back({0, 1, 2});
    r = check(mesh);
    CHECK(r.nonmanifold_edges == 3);
    CHECK(r.nonmanifold_vertices == 3);
    CHECK(r.misoriented_edges == 3);
}

TEST_CASE("genus is summed over the components") {
    const Mesh torus = test::grid_torus(7, 5);
    MeshReport r = check(torus);
    CHECK(r.euler_characteristic == 0);
    CHECK(r.genus == 1.0);
    CHECK(r.components == 1);
    Mesh far = test::grid_torus(5, 5);
    for (Vec3& v : far.vertices) v = v + Vec3{1000, 0, 0};
    r = check(together(together(torus, far), tetrahedron({-50, 0, 0})));
    CHECK(r.components == 3);
    CHECK(r.genus == 2.0);
    CHECK(r.euler_characteristic == 2);
}

TEST_CASE("closed is judged on the coordinates as written") {
    // Three separate triangles whose corners agree in binary32 only.
    Mesh mesh = tetrahedron({1, 1, 1});
    Mesh split;
    for (const Triangle& t : mesh.triangles) {
        const auto base = static_cast<std::uint32_t>(split.vertices.size());
        for (std::uint32_t v : t) split.vertices.push_back(mesh.vertices[v] + Vec3{1e-10 * base, 0, 0});
        split.triangles.push_back({base, base + 1, base + 2});
    }
    CHECK(check(split).closed);
    CHECK_FALSE(check(split, {.as_float32 = false}).closed);
    // The other way round: a needle that collapses is dropped and its neighbours close the gap.
    Mesh needle = tetrahedron({1, 1, 1});
    needle.vertices.push_back(needle.vertices[3] + Vec3{0, 0, 1e-10});
    needle.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}};
    const MeshReport r = check(needle);
    CHECK(r.closed);
    CHECK(r.manifold);
    CHECK(r.triangles == 6);
    CHECK(r.euler_characteristic == 2);
}

TEST_CASE("an empty mesh and unused vertices") {
    MeshReport r = check(Mesh{});
    CHECK_FALSE(r.closed);
    CHECK(r.manifold);
    CHECK(r.oriented);
    CHECK(r.euler_characteristic == 0);
    CHECK_FALSE(r.bounds);
    Mesh mesh = tetrahedron();
    mesh.vertices.push_back({5, 5, 5});
    r = check(mesh);
    CHECK(r.vertices == 5);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.bounds.value().max.x == 1);
}
