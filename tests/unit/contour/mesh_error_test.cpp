// Tests of contour/mesh_error.h: the sagitta of spheres, missed features, caps, sharp edges, determinism.
#include "frep/contour/mesh_error.h"

#include <doctest/doctest.h>

#include <cmath>

#include "frep/contour/contour.h"
#include "unit/contour/test_fields.h"

using namespace frep;
using test::FunctionField;
using test::generic_field;
using test::sphere_function;

namespace {

struct Measured {
    ContourResult contour;
    MeshError error;
};

Measured measured(const SampledField& field, const ContourOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    Result<ContourResult> contour = contour_cells(field, options, job);
    REQUIRE(static_cast<bool>(contour));
    const Result<MeshError> error =
        measure_mesh_error(field, contour->mesh, {.grid = contour->grid, .samples = 50000}, job);
    REQUIRE(static_cast<bool>(error));
    return {std::move(*contour), *error};
}

/// The depth of the deepest of many points of triangles with vertices on the unit sphere.
double deepest_point(const Mesh& mesh) {
    constexpr int steps = 12;
    double deepest = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        for (int u = 0; u <= steps; ++u) {
            for (int v = 0; u + v <= steps; ++v) {
                const Vec3 p =
                    a * (u / double{steps}) + b * (v / double{steps}) + c * ((steps - u - v) / double{steps});
                deepest = std::max(deepest, 1 - length(p));
            }
        }
    }
    return deepest;
}

}  // namespace

TEST_CASE("a sphere: the error is the sagitta of the deepest triangle, found from both sides") {
    const FunctionField sphere = generic_field(sphere_function(1));
    for (const int cells : {8, 16, 40}) {
        CAPTURE(cells);
        const Measured m = measured(sphere, {.bounds = Box3::cube(1.3), .cells = cells});
        const double sagitta = deepest_point(m.contour.mesh);
        const double cell = 2.6 / cells;
        REQUIRE(m.error.mesh_to_surface.has_value());
        REQUIRE(m.error.surface_to_mesh.has_value());
        // The samples are fewer than those of deepest_point(); a centroid or an edge's middle comes near it.
        CHECK(*m.error.mesh_to_surface <= sagitta * 1.01);
        CHECK(*m.error.mesh_to_surface >= 0.9 * sagitta);
        CHECK(*m.error.surface_to_mesh <= sagitta * 1.01);
        CHECK(*m.error.surface_to_mesh >= 0.9 * sagitta);
        CHECK(*m.error.largest() < 0.5 * cell * cell);
        CHECK(std::abs(length(m.error.mesh_place) - 1) ==
              doctest::Approx(*m.error.mesh_to_surface).epsilon(2e-3));
        CHECK(std::abs(length(m.error.surface_place) - 1) < 1e-4);
        CHECK(m.error.unresolved == 0);
        CHECK(m.error.samples_on_mesh > 1000);
        CHECK(m.error.samples_on_surface > m.contour.mesh.vertices.size());
    }
}

TEST_CASE("a sphere that the mesh has missed shows from the surface's side only") {
    // Smaller than a cell and between the samples of the grid of 10 cells, whose samples are multiples of
    // 0.26.
    const auto two = [](auto x, auto y, auto z) {
        using math::max;
        return max(sphere_function(0.8)(x, y, z), sphere_function(0.1, 1.17, 0.13, 0.13)(x, y, z));
    };
    const Measured m = measured(generic_field(two), {.bounds = Box3::cube(1.3), .cells = 10});
    CHECK(m.contour.mesh.triangles.size() > 100);
    CHECK(*m.error.mesh_to_surface < 0.05);
    CHECK(*m.error.surface_to_mesh > 0.3);
    CHECK(*m.error.surface_to_mesh < 0.52);
    CHECK(*m.error.largest() == *m.error.surface_to_mesh);
    CHECK(m.error.place().x > 1);
}

TEST_CASE("a mesh moved off its surface by a known way") {
    const FunctionField sphere = generic_field(sphere_function(1));
    Result<ContourResult> contour = contour_cells(sphere, {.bounds = Box3::cube(1.3), .cells = 40}, Job{});
    REQUIRE(static_cast<bool>(contour));
    for (Vec3& v : contour->mesh.vertices) v = v * 1.05;
    const Result<MeshError> error =
        measure_mesh_error(sphere, contour->mesh, {.grid = contour->grid, .samples = 20000}, Job{});
    REQUIRE(static_cast<bool>(error));
    CHECK(*error->mesh_to_surface == doctest::Approx(0.05).epsilon(2e-3));
    CHECK(*error->surface_to_mesh == doctest::Approx(0.05).epsilon(5e-2));
}

TEST_CASE("sharp edges, walls where F ends, and caps") {
    // A cube between the samples: the mesh cuts its edges by at most half a cell's diagonal.
    const auto cube = [](auto x, auto y, auto z) {
        using math::abs;
        using math::min;
        return min(min(0.53 - abs(x), 0.53 - abs(y)), 0.53 - abs(z));
    };
    const double cell = 2.0 / 20;
    const Measured edges = measured(generic_field(cube), {.bounds = Box3::cube(1), .cells = 20});
    CHECK(*edges.error.largest() > 0.05 * cell);
    CHECK(*edges.error.largest() < 0.9 * cell);
    // Half a ball that ends where its function does: the wall is surface, and its rim is cut.
    const auto wall = [](auto x, auto y, auto z) {
        return sphere_function(0.8)(x, y, z) + 0.0 * math::sqrt(0.33 - x);
    };
    const Measured half = measured(generic_field(wall), {.bounds = Box3::cube(1), .cells = 20});
    CHECK(*half.error.largest() < 0.9 * cell);
    CHECK(half.error.unresolved == 0);
    // The cap is no part of F = 0: it does not count.
    const Measured capped =
        measured(generic_field(sphere_function(0.9)), {.bounds = Box3::cube(0.6), .cells = 30, .cap = true});
    CHECK(*capped.error.largest() < 0.04 * 0.04);
}

TEST_CASE("nothing to measure, joined figures, threads, cancellation") {
    const FunctionField nothing = generic_field([](auto x, auto, auto) { return x * 0.0 - 1.0; });
    const Measured none = measured(nothing, {.bounds = Box3::cube(1), .cells = 5});
    CHECK_FALSE(none.error.largest().has_value());
    const FunctionField sphere = generic_field(sphere_function(0.7, 0.01, 0.02));
    const ContourOptions options{.bounds = Box3::cube(1), .cells = 30};
    const Measured one = measured(sphere, options);
    for (const int threads : {2, 8}) {
        const Measured many = measured(sphere, options, threads);
        CHECK(many.error.mesh_to_surface == one.error.mesh_to_surface);
        CHECK(many.error.surface_to_mesh == one.error.surface_to_mesh);
        CHECK(many.error.place() == one.error.place());
    }
    MeshError sum = none.error;
    sum.add(one.error);
    CHECK(sum.largest() == one.error.largest());
    MeshError far;
    far.mesh_to_surface = 5.0;
    far.mesh_place = {1, 2, 3};
    far.unresolved = 2;
    sum.add(far);
    CHECK(sum.largest() == 5.0);
    CHECK(sum.place() == Vec3{1, 2, 3});
    CHECK(sum.unresolved == 2);
    Job cancelled;
    cancelled.cancel();
    CHECK_FALSE(static_cast<bool>(
        measure_mesh_error(sphere, one.contour.mesh, {.grid = one.contour.grid}, cancelled)));
}
