// check: the topology and the measures of a mesh, for the report of `frep mesh` (docs/formats.md) and for
// `--require`. The mesh is judged on the coordinates as written: rounded to binary32, equal positions merged,
// triangles that collapse by that dropped (docs/numerics.md, rule 9).
// Tested by tests/unit/geom/mesh_check_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frep/base/job.h"
#include "frep/geom/mesh.h"
#include "frep/geom/self_intersection.h"
#include "frep/math/vec.h"

namespace frep {

struct CheckOptions {
    bool as_float32 = true;           ///< judge the coordinates rounded to binary32; false: as in memory
    bool self_intersections = false;  ///< look for them too: several times the work of all the rest
};

/// The inertia tensor [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] of a solid of density 1 about its centroid:
/// xx = integral of y^2 + z^2, xy = - integral of x y, and so on. Model units to the 5th. Negative, as the
/// volume is, when the mesh is inside out.
struct Inertia {
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

/// One set of triangles connected through edges.
struct ComponentReport {
    std::size_t triangles = 0;  ///< of the merged mesh
    bool closed = false;        ///< no boundary edge
    double area = 0;
    std::optional<double> volume;  ///< negative for the wall of a cavity; nothing when not closed
    Box3 bounds;
    std::int64_t euler_characteristic = 0;  ///< V - E + T of this component alone
    std::optional<double> genus;            ///< 1 - chi/2; nothing when not closed
};

/// What check() finds. Lengths in model units.
struct MeshReport {
    std::size_t vertices = 0;               ///< as in the mesh, before merging
    std::size_t triangles = 0;              ///< as in the mesh, before merging
    std::size_t components = 0;             ///< sets of triangles connected through edges
    std::size_t boundary_edges = 0;         ///< edges of exactly one triangle
    std::size_t nonmanifold_edges = 0;      ///< edges of three or more triangles
    std::size_t nonmanifold_vertices = 0;   ///< vertices whose triangles are not one fan (open or closed)
    std::size_t misoriented_edges = 0;      ///< inner edges not run through equally often in both directions
    std::int64_t euler_characteristic = 0;  ///< V - E + T of the merged mesh, unused vertices not counted
    /// Sum over the components of 1 - chi/2 (handles of an oriented surface); nothing when not closed.
    std::optional<double> genus;
    double area = 0;
    std::optional<double> volume;    ///< enclosed volume, negative when inside out; nothing when not closed
    std::optional<Vec3> centroid;    ///< of the enclosed volume; nothing when not closed or the volume is 0
    std::optional<Inertia> inertia;  ///< nothing when there is no centroid
    std::optional<Box3> bounds;      ///< of the vertices in use; nothing for an empty mesh
    bool closed = false;             ///< there are triangles and no boundary edges
    bool manifold = false;           ///< no non-manifold edge or vertex
    bool oriented = false;           ///< no misoriented edge
    std::vector<ComponentReport> component_list;  ///< by falling area, then by the first triangle
    /// Nothing when they were not asked for or the job was cancelled.
    std::optional<SelfIntersections> self_intersections;
};

/// Topology and measures of `mesh`, which must be valid. Sums run in a fixed order: the same bits everywhere.
/// Memory: about 80 bytes a triangle, 130 with self-intersections. An empty mesh is manifold and oriented but
/// not closed. Only the search for self-intersections uses threads and looks at cancellation.
MeshReport check(const Mesh& mesh, const CheckOptions& options = {}, const Job& job = {});

}  // namespace frep
