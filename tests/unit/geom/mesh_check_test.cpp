// Tests of geom/mesh_check.h on meshes whose counts are known by hand, each kind of fault once, and measures
// of solids with known formulas.
#include "frep/geom/mesh_check.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "unit/geom/shapes.h"

using namespace frep;
using test::tetrahedron;
using test::together;

namespace {

/// What a mesh without fault has none of; a test names the faults that it expects.
struct Faults {
    std::size_t boundary_edges = 0, nonmanifold_edges = 0, nonmanifold_vertices = 0, misoriented_edges = 0;
};

/// The report, after comparing its faults and the flags that follow from them.
MeshReport checked(const Mesh& mesh, const Faults& faults = {}) {
    const MeshReport r = check(mesh);
    CHECK(r.boundary_edges == faults.boundary_edges);
    CHECK(r.nonmanifold_edges == faults.nonmanifold_edges);
    CHECK(r.nonmanifold_vertices == faults.nonmanifold_vertices);
    CHECK(r.misoriented_edges == faults.misoriented_edges);
    CHECK(r.closed == (!mesh.triangles.empty() && faults.boundary_edges == 0));
    CHECK(r.manifold == (faults.nonmanifold_edges == 0 && faults.nonmanifold_vertices == 0));
    CHECK(r.oriented == (faults.misoriented_edges == 0));
    CHECK(r.vertices == mesh.vertices.size());
    CHECK(r.triangles == mesh.triangles.size());
    CHECK(r.component_list.size() == r.components);
    CHECK(r.genus.has_value() == r.closed);
    CHECK(r.volume.has_value() == r.closed);
    CHECK_FALSE(r.self_intersections);  // not asked for
    return r;
}

void check_near(const Vec3& a, const Vec3& b, double tolerance) {
    CHECK(a.x == doctest::Approx(b.x).epsilon(tolerance));
    CHECK(a.y == doctest::Approx(b.y).epsilon(tolerance));
    CHECK(a.z == doctest::Approx(b.z).epsilon(tolerance));
}

}  // namespace

TEST_CASE("a tetrahedron") {
    const MeshReport r = checked(tetrahedron());
    CHECK(r.components == 1);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.genus == 0.0);
    CHECK(r.area == doctest::Approx(1.5 + 0.8660254037844386).epsilon(1e-14));
    CHECK(r.volume.value() == doctest::Approx(1.0 / 6).epsilon(1e-14));
    check_near(r.centroid.value(), {0.25, 0.25, 0.25}, 1e-14);
    CHECK(r.bounds.value() == Box3{{0, 0, 0}, {1, 1, 1}});
    // About the origin: integral of x^2 = 1/60, of xy = 1/120; the centroid takes V/16 off each.
    const Inertia inertia = r.inertia.value();
    for (const double moment : {inertia.xx, inertia.yy, inertia.zz})
        CHECK(moment == doctest::Approx(2 * (1.0 / 60 - 1.0 / 96)).epsilon(1e-12));
    for (const double product : {inertia.xy, inertia.xz, inertia.yz})
        CHECK(product == doctest::Approx(-(1.0 / 120 - 1.0 / 96)).epsilon(1e-12));
}

TEST_CASE("measures do not depend on the place of the mesh") {
    const MeshReport r = checked(tetrahedron({1024, -512, 256}));
    CHECK(r.volume.value() == doctest::Approx(1.0 / 6).epsilon(1e-12));
    check_near(r.centroid.value(), {1024.25, -511.75, 256.25}, 1e-12);
    CHECK(r.inertia->yy == doctest::Approx(2 * (1.0 / 60 - 1.0 / 96)).epsilon(1e-10));
}

TEST_CASE("measures of a box and of a skew box") {
    const MeshReport r = checked(test::box({-1, 2, 5}, {3, 5, 7}));  // sides 4, 3, 2
    CHECK(r.area == 52);
    CHECK(r.volume == 24.0);
    check_near(r.centroid.value(), {1, 3.5, 6}, 1e-14);
    CHECK(r.inertia->xx == doctest::Approx(24.0 * (9 + 4) / 12).epsilon(1e-13));
    CHECK(r.inertia->yy == doctest::Approx(24.0 * (16 + 4) / 12).epsilon(1e-13));
    CHECK(r.inertia->zz == doctest::Approx(24.0 * (16 + 9) / 12).epsilon(1e-13));
    CHECK(r.inertia->xy == doctest::Approx(0));
    // The unit cube sheared by x += y / 2, y += z / 4, around its middle: integral of xy over the body
    // is (integral of y^2) / 2 with y = y' + z'/4, and y'^2 and z'^2 give 1/12 each.
    Mesh skew = test::box({0, 0, 0}, {1, 1, 1});
    for (Vec3& v : skew.vertices) {
        v.y += v.z / 4;
        v.x += v.y / 2;
    }
    const MeshReport s = checked(skew);
    CHECK(s.volume.value() == doctest::Approx(1));
    const double yy = (1 + 1.0 / 16) / 12, xx = 1.0 / 12 + yy / 4, zz = 1.0 / 12;
    CHECK(s.inertia->xx == doctest::Approx(yy + zz).epsilon(1e-12));
    CHECK(s.inertia->zz == doctest::Approx(xx + yy).epsilon(1e-12));
    CHECK(s.inertia->xy == doctest::Approx(-yy / 2).epsilon(1e-12));
    CHECK(s.inertia->yz == doctest::Approx(-zz / 4).epsilon(1e-12));
    CHECK(s.inertia->xz == doctest::Approx(-zz / 8).epsilon(1e-12));
}

TEST_CASE("measures of a sphere converge to its formulas") {
    const double pi = 3.141592653589793;
    double last_error = 1;
    for (int levels = 2; levels <= 5; ++levels) {
        const MeshReport r = checked(test::sphere({1, 2, 3}, 2, levels));
        CHECK(r.euler_characteristic == 2);
        const double error = 1 - r.volume.value() / (32 * pi / 3);
        CHECK(error > 0);
        CHECK(error < last_error / 3.5);  // of second order
        last_error = error;
        CHECK(r.inertia->xx == doctest::Approx(0.4 * 32 * pi / 3 * 4).epsilon(3 * error));
        CHECK(r.area == doctest::Approx(16 * pi).epsilon(2 * error));
        check_near(r.centroid.value(), {1, 2, 3}, 1e-6);
    }
}

TEST_CASE("an inside-out mesh is oriented and has a negative volume") {
    const MeshReport r = checked(test::turned_inside_out(tetrahedron()));
    CHECK(r.volume.value() == doctest::Approx(-1.0 / 6));
    CHECK(r.centroid->x == doctest::Approx(0.25));
    CHECK(r.inertia->xx == doctest::Approx(-2 * (1.0 / 60 - 1.0 / 96)));
}

TEST_CASE("an open mesh has no volume, centroid, inertia or genus") {
    Mesh mesh = tetrahedron();
    mesh.triangles.pop_back();
    const MeshReport r = checked(mesh, {.boundary_edges = 3});
    CHECK(r.euler_characteristic == 1);
    CHECK_FALSE(r.centroid);
    CHECK_FALSE(r.inertia);
    CHECK_FALSE(r.component_list.at(0).closed);
    CHECK_FALSE(r.component_list.at(0).volume);
    CHECK_FALSE(r.component_list.at(0).genus);
    CHECK(r.area == doctest::Approx(1.5));
}

TEST_CASE("a flipped triangle makes three misoriented edges") {
    Mesh mesh = tetrahedron();
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    checked(mesh, {.misoriented_edges = 3});
}

TEST_CASE("a fin on an edge is non-manifold at the edge and its ends") {
    Mesh mesh = tetrahedron();
    mesh.vertices.push_back({-1, -1, -1});
    mesh.triangles.push_back({0, 1, 4});
    checked(mesh,
            {.boundary_edges = 2, .nonmanifold_edges = 1, .nonmanifold_vertices = 2, .misoriented_edges = 1});
}

TEST_CASE("two bodies that touch in a vertex") {
    // Vertex 1 of the first and vertex 0 of the second coincide.
    const MeshReport r =
        checked(together(tetrahedron(), tetrahedron({1, 0, 0})), {.nonmanifold_vertices = 1});
    CHECK(r.components == 2);
    CHECK(r.euler_characteristic == 3);
    CHECK(r.component_list.at(1).euler_characteristic == 2);
    CHECK(r.genus == 0.0);
    CHECK(r.volume.value() == doctest::Approx(1.0 / 3));
}

TEST_CASE("a double triangle is closed; equal triangles three times are not manifold") {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
    const MeshReport r = checked(mesh);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.volume.value() == 0);
    CHECK_FALSE(r.centroid);
    CHECK_FALSE(r.inertia);
    mesh.triangles.push_back({0, 1, 2});
    checked(mesh, {.nonmanifold_edges = 3, .nonmanifold_vertices = 3, .misoriented_edges = 3});
}

TEST_CASE("components by falling area, with genus, bounds and Euler characteristic each") {
    const Mesh torus = test::grid_torus(7, 5);
    CHECK(checked(torus).genus == 1.0);
    CHECK(checked(torus).euler_characteristic == 0);
    Mesh far = test::grid_torus(5, 5);
    for (Vec3& v : far.vertices) v = v + Vec3{1000, 0, 0};
    const MeshReport r = checked(together(together(tetrahedron({-50, 0, 0}), far), torus));
    CHECK(r.components == 3);
    CHECK(r.genus == 2.0);
    CHECK(r.euler_characteristic == 2);
    const auto& list = r.component_list;
    CHECK(list[0].triangles == 70);
    CHECK(list[0].genus == 1.0);
    CHECK(list[0].bounds == Box3{{0, 0, 0}, {6, 4, 24}});
    CHECK(list[1].triangles == 50);
    CHECK(list[1].bounds.min.x == 1000);
    CHECK(list[2].triangles == 4);
    CHECK(list[2].genus == 0.0);
    CHECK(list[2].euler_characteristic == 2);
    CHECK(list[2].volume.value() == doctest::Approx(1.0 / 6));
    CHECK(list[0].area + list[1].area + list[2].area == doctest::Approx(r.area));
}

TEST_CASE("the wall of a cavity has a negative volume") {
    const Mesh shell =
        together(test::turned_inside_out(test::box({1, 1, 1}, {2, 2, 2})), test::box({0, 0, 0}, {4, 4, 4}));
    const MeshReport r = checked(shell);
    CHECK(r.volume.value() == doctest::Approx(63).epsilon(1e-14));
    CHECK(r.component_list[0].volume.value() == doctest::Approx(64).epsilon(1e-14));
    CHECK(r.component_list[1].volume.value() == doctest::Approx(-1).epsilon(1e-14));
    CHECK(r.component_list[1].area == 6);
    CHECK(r.centroid->x == doctest::Approx((64 * 2 - 1.5) / 63));
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
    const MeshReport r = checked(needle);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.component_list.at(0).triangles == 4);
}

TEST_CASE("self-intersections are part of the report when asked for") {
    const Mesh crossing = together(test::box({0, 0, 0}, {2, 2, 2}), test::box({3, 0, 0}, {5, 2, 2}));
    const CheckOptions options{.self_intersections = true};
    CHECK(check(crossing, options).self_intersections.value().count == 0);
    const Mesh poked = together(test::box({0, 0, 0}, {2, 2, 2}), tetrahedron({1.5, 0.5, 0.5}));
    CHECK(check(poked, options).self_intersections.value().count > 0);
    Job job;
    job.cancel();
    CHECK_FALSE(check(poked, options, job).self_intersections);
}

TEST_CASE("an empty mesh and unused vertices") {
    MeshReport r = checked(Mesh{});
    CHECK(r.euler_characteristic == 0);
    CHECK_FALSE(r.bounds);
    Mesh mesh = tetrahedron();
    mesh.vertices.push_back({5, 5, 5});
    r = checked(mesh);
    CHECK(r.euler_characteristic == 2);
    CHECK(r.bounds.value().max.x == 1);
}
