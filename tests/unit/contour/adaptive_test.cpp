// Tests of contour/adaptive.h: known solids, hostile data, cap, walls, merging, determinism.
#include "frep/contour/adaptive.h"

#include <doctest/doctest.h>

#include "frep/contour/mesh_error.h"
#include "frep/geom/bvh.h"
#include "unit/contour/adaptive_checks.h"
#include "unit/contour/csg_trees.h"
#include "unit/eval/blobs.h"

using namespace frep;
using namespace frep::test;

namespace {

/// Uncorrelated values at the lattice points of `cells` cells on [-1, 1]^3, constant around them.
FunctionField noise_field(std::uint64_t seed, int cells, double share_inside = 0.5, double share_nan = 0) {
    return FunctionField([=](double x, double y, double z) {
        const auto index = [=](double v) {
            return static_cast<std::uint64_t>(std::floor((v + 1) * 0.5 * cells + 0.5) + 100);
        };
        const std::uint64_t i = (index(z) * 1000 + index(y)) * 1000 + index(x);
        if (noise(seed + 77, i) < 2 * share_nan - 1) return undefined;
        return noise(seed, i) + 2 * share_inside - 1;
    });
}

}  // namespace

TEST_CASE("a sphere: closed, near to the surface, with normals") {
    const FunctionField sphere = generic_field(sphere_function(1));
    for (const int cells : {5, 16, 40}) {
        CAPTURE(cells);
        const ContourResult r = adaptive(sphere, {.bounds = Box3::cube(1.3), .cells = cells});
        const MeshReport report = sound_and_closed(r.mesh);
        CHECK(report.euler_characteristic == 2);
        CHECK(report.components == 1);
        const double h = 2.6 / cells;
        for (std::size_t v = 0; v < r.mesh.vertices.size(); ++v) {
            const Vec3 p = r.mesh.vertices[v];
            CHECK(std::abs(length(p) - 1) < 0.4 * h * h);
            CHECK(dot(p, r.mesh.normals[v]) / length(p) > 1 - h * h);
        }
        CHECK(report.volume.value() == doctest::Approx(4.18879).epsilon(h * h));
    }
}

TEST_CASE("contour_solid takes the method of the options, the adaptive one by default") {
    const FunctionField sphere = generic_field(sphere_function(1));
    ContourOptions options{.bounds = Box3::cube(1.3), .cells = 16};
    const auto first = contour_solid(sphere, options, {});
    REQUIRE(static_cast<bool>(first));
    CHECK(first->mesh.triangles == adaptive(sphere, options).mesh.triangles);
    options.method = ContourMethod::cells;
    const auto second = contour_solid(sphere, options, {});
    const auto cells = contour_cells(sphere, options, {});
    REQUIRE(static_cast<bool>(second));
    CHECK(second->mesh.triangles == cells->mesh.triangles);
    CHECK(second->mesh.triangles != first->mesh.triangles);
    options.tolerance = 0.1;
    const auto wrong = contour_solid(sphere, options, {});
    REQUIRE_FALSE(static_cast<bool>(wrong));
    CHECK(wrong.error().kind == ErrorKind::invalid_argument);
}

TEST_CASE("noise gives a closed manifold without self-intersections under the cap") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        const FunctionField field = noise_field(seed, 10);
        const ContourResult r = adaptive(field, {.bounds = Box3::cube(1), .cells = 10, .cap = true});
        sound_and_closed(r.mesh);
        CHECK(r.mesh.triangles.size() > 2000);
        const MeshReport open = sound(adaptive(field, {.bounds = Box3::cube(1), .cells = 10}).mesh);
        CHECK(open.boundary_edges > 0);
        CHECK(r.touches == std::array<bool, 6>{true, true, true, true, true, true});
    }
    for (const double share : {0.05, 0.2, 0.8, 0.95}) {
        CAPTURE(share);
        sound_and_closed(
            adaptive(noise_field(5, 12, share), {.bounds = Box3::cube(1), .cells = 12, .cap = true}).mesh);
        sound_and_closed(
            adaptive(noise_field(5, 12, share, 0.3), {.bounds = Box3::cube(1), .cells = 12, .cap = true})
                .mesh);
    }
}

TEST_CASE("merging keeps noise sound, and its topology") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        for (const double share : {0.02, 0.1, 0.5, 0.9, 0.98}) {
            CAPTURE(seed);
            CAPTURE(share);
            const FunctionField field = noise_field(seed, 14, share);
            for (const bool cap : {false, true}) {
                const ContourOptions fine{.bounds = Box3::cube(1), .cells = 14, .cap = cap};
                ContourOptions merging = fine;
                merging.tolerance = 10;
                const MeshReport a = sound(adaptive(field, fine).mesh);
                const MeshReport b = sound(adaptive(field, merging).mesh);
                CHECK(a.components == b.components);
                CHECK(a.euler_characteristic == b.euler_characteristic);
                if (cap) CHECK(b.boundary_edges == 0);
            }
        }
    }
}

TEST_CASE("the edges and corners of a box are kept") {
    const FunctionField box([](double x, double y, double z) {
        // Turned about two axes.
        const double u = 0.8 * x + 0.6 * y, v = -0.6 * x + 0.8 * y;
        const double p = 0.96 * u + 0.28 * z, q = -0.28 * u + 0.96 * z;
        return 0.7 - std::max(std::abs(p), std::max(std::abs(v), std::abs(q)));
    });
    for (const int cells : {12, 33}) {
        CAPTURE(cells);
        const ContourResult r = adaptive(box, {.bounds = Box3::cube(1.4), .cells = cells});
        const MeshReport report = sound_and_closed(r.mesh);
        CHECK(report.euler_characteristic == 2);
        CHECK(report.volume.value() == doctest::Approx(1.4 * 1.4 * 1.4).epsilon(cells == 12 ? 5e-3 : 1e-3));
    }
}

TEST_CASE("flat sides and straight edges merge") {
    const FunctionField box([](double x, double y, double z) {
        const double u = 0.8 * x + 0.6 * y, v = -0.6 * x + 0.8 * y;
        return 0.6 - std::max(std::abs(u), std::max(std::abs(v), std::abs(z)));
    });
    const ContourOptions fine{.bounds = Box3::cube(1.1), .cells = 64};
    ContourOptions merging = fine;
    merging.tolerance = 1e-3;
    const MeshReport a = sound_and_closed(adaptive(box, fine).mesh);
    const MeshReport b = sound_and_closed(adaptive(box, merging).mesh);
    CHECK(b.triangles * 8 < a.triangles);
    CHECK(b.euler_characteristic == 2);
    CHECK(b.volume.value() == doctest::Approx(1.728).epsilon(2e-3));
}

TEST_CASE("the merged mesh stays within the tolerance") {
    const auto solid = [](auto x, auto y, auto z) {
        using math::max;
        return max(sphere_function(0.7)(x, y, z), torus_function(0.7, 0.25)(x, y, z));
    };
    const FunctionField field = generic_field(solid);
    for (const double tolerance : {1e-3, 4e-3, 1e-2}) {
        CAPTURE(tolerance);
        const ContourResult r =
            adaptive(field, {.bounds = Box3::cube(1), .cells = 64, .tolerance = tolerance});
        sound_and_closed(r.mesh);
        MeshErrorOptions options;
        options.grid = r.grid;
        options.samples = 20000;
        Job job;
        job.threads = 1;
        const auto error = measure_mesh_error(field, r.mesh, options, job);
        REQUIRE(static_cast<bool>(error));
        CHECK(error->largest().value() < 1.5 * tolerance);
    }
}

TEST_CASE("the same bytes for every number of threads, with and without pruning") {
    for (const std::uint64_t seed : {3u, 7u, 12u}) {
        CAPTURE(seed);
        const auto field = sampled(random_solid(seed, seed == 7));
        for (const double tolerance : {0.0, 4e-3}) {
            ContourOptions options{.bounds = Box3::cube(csg_bounds), .cells = 50, .tolerance = tolerance};
            const ContourResult one = adaptive(*field, options);
            CHECK(one.mesh.triangles.size() > 500);
            for (const int threads : {2, 3, 8}) CHECK(same_bytes(one, adaptive(*field, options, threads)));
            options.prune = false;
            const ContourResult full = adaptive(*field, options, 2);
            CHECK(full.mesh.triangles == one.mesh.triangles);
            REQUIRE(full.mesh.vertices.size() == one.mesh.vertices.size());
            for (std::size_t v = 0; v < full.mesh.vertices.size(); ++v)
                REQUIRE(length(full.mesh.vertices[v] - one.mesh.vertices[v]) <= 1e-9 * 2 * csg_bounds);
            CHECK(full.sampled_blocks > one.sampled_blocks);
        }
    }
}

TEST_CASE("sums without their small terms give the mesh of the whole field") {
    const auto field = sampled(frep_test::blobs(4, 80));
    ContourOptions options{.bounds = Box3::cube(1), .cells = 70};
    const ContourResult one = adaptive(*field, options);
    CHECK(one.mesh.triangles.size() > 5000);
    CHECK(same_bytes(one, adaptive(*field, options, 3)));
    options.prune = false;
    const ContourResult full = adaptive(*field, options, 2);
    CHECK(full.mesh.triangles == one.mesh.triangles);
    REQUIRE(full.mesh.vertices.size() == one.mesh.vertices.size());
    for (std::size_t v = 0; v < full.mesh.vertices.size(); ++v)
        REQUIRE(length(full.mesh.vertices[v] - one.mesh.vertices[v]) <= 1e-9 * 2);
}

namespace {

/// A drilled, turned plate: y = a turn of x about z; and points of its sharp edges.
struct Part {
    double cosine = 0.8, sine = 0.6;
    double operator()(double x, double y, double z) const {
        const double u = cosine * x + sine * y, v = cosine * y - sine * x;
        const double plate = std::min(0.7 - std::abs(u), std::min(0.5 - std::abs(v), 0.2 - std::abs(z)));
        return std::min(plate, std::hypot(u - 0.1, v) - 0.3);
    }
    Vec3 at(double u, double v, double z) const { return {cosine * u - sine * v, sine * u + cosine * v, z}; }

    std::vector<Vec3> edge_points(int count) const {
        std::vector<Vec3> points;
        for (int i = 0; i < count; ++i) {
            const double s = -1 + 2 * (i + 0.5) / count, angle = 3.14159265358979 * s;
            for (const double a : {-1.0, 1.0}) {
                for (const double b : {-1.0, 1.0}) {
                    points.push_back(at(0.7 * s, 0.5 * a, 0.2 * b));
                    points.push_back(at(0.7 * a, 0.5 * s, 0.2 * b));
                    points.push_back(at(0.7 * a, 0.5 * b, 0.2 * s));
                }
                points.push_back(at(0.1 + 0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.2 * a));
            }
        }
        return points;
    }
};

}  // namespace

TEST_CASE("points of sharp edges lie on the mesh") {
    const Part part;
    const FunctionField field(part);
    for (const int cells : {64, 128}) {
        CAPTURE(cells);
        const ContourResult r = adaptive(field, {.bounds = Box3::cube(1), .cells = cells});
        const MeshReport report = sound_and_closed(r.mesh);
        CHECK(report.genus == 1.0);
        const TriangleBvh tree(r.mesh);
        std::vector<double> distances;
        for (const Vec3& p : part.edge_points(500)) distances.push_back(tree.nearest(p)->distance);
        std::sort(distances.begin(), distances.end());
        const double p99 = distances[distances.size() * 99 / 100];
        CAPTURE(distances.back());
        // 2e-4 at cells of 2 / 256; chords of the bore's rim fall with the square.
        const double coarse = 256.0 / cells;
        CHECK(p99 <= 2e-4 * coarse);
        CHECK(distances.back() <= 0.1 * 2.0 / cells);
    }
}

TEST_CASE("what cannot be meshed is refused") {
    const FunctionField sphere = generic_field(sphere_function(1));
    Job job;
    job.threads = 1;
    const auto error_of = [&](const ContourOptions& options) {
        const auto result = contour_adaptive(sphere, options, job);
        REQUIRE(!result);
        return result.error().kind;
    };
    CHECK(error_of({.bounds = Box3::cube(-1)}) == ErrorKind::invalid_argument);
    CHECK(error_of({.bounds = Box3::cube(2), .cells = 0}) == ErrorKind::invalid_argument);
    CHECK(error_of({.bounds = Box3::cube(2), .tolerance = -1}) == ErrorKind::invalid_argument);
    CHECK(error_of({.bounds = Box3::cube(2), .tolerance = undefined}) == ErrorKind::invalid_argument);
    CHECK(error_of({.bounds = Box3::cube(2), .cells = 200, .memory_limit = 1 << 20}) ==
          ErrorKind::over_limit);
    job.cancel();
    CHECK(error_of({.bounds = Box3::cube(2)}) == ErrorKind::cancelled);
}
