// What every mesh of contour_adaptive must be, for its tests.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "frep/contour/adaptive.h"
#include "frep/geom/mesh_check.h"
#include "unit/contour/test_fields.h"

namespace frep::test {

inline ContourResult adaptive(const SampledField& field, const ContourOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    Result<ContourResult> result = contour_adaptive(field, options, job);
    REQUIRE(static_cast<bool>(result));
    REQUIRE(is_valid(result->mesh));
    REQUIRE(result->mesh.normals.size() == result->mesh.vertices.size());
    for (const Vec3& p : result->mesh.vertices) REQUIRE(p.x - p.x + (p.y - p.y) + (p.z - p.z) == 0);
    for (const Vec3& n : result->mesh.normals) REQUIRE(std::abs(length(n) - 1) < 1e-12);
    return std::move(*result);
}

/// Checks that the mesh is manifold, oriented and free of self-intersections, on coordinates in binary32 and
/// as they are, and uses all its vertices.
inline MeshReport sound(const Mesh& mesh) {
    Job job;
    job.threads = 1;
    const MeshReport report = check(mesh, {.self_intersections = true}, job);
    CHECK(report.nonmanifold_edges == 0);
    CHECK(report.nonmanifold_vertices == 0);
    CHECK(report.misoriented_edges == 0);
    REQUIRE(report.self_intersections);
    CHECK(report.self_intersections->count == 0);
    CHECK(check(mesh, {.as_float32 = false}).manifold);
    std::vector<bool> is_used(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) is_used[v] = true;
    }
    CHECK(std::find(is_used.begin(), is_used.end(), false) == is_used.end());
    return report;
}

inline MeshReport sound_and_closed(const Mesh& mesh) {
    const MeshReport report = sound(mesh);
    CHECK(report.boundary_edges == 0);
    return report;
}

inline bool same_bytes(const ContourResult& a, const ContourResult& b) {
    const auto same = [](const auto& u, const auto& v) {
        return u.size() == v.size() &&
               (u.empty() || std::memcmp(u.data(), v.data(), u.size() * sizeof u[0]) == 0);
    };
    return same(a.mesh.vertices, b.mesh.vertices) && same(a.mesh.normals, b.mesh.normals) &&
           same(a.mesh.triangles, b.mesh.triangles) && a.undefined_points == b.undefined_points &&
           a.first_undefined == b.first_undefined && a.touches == b.touches;
}

}  // namespace frep::test
