// check: the topology and the measures of a mesh, for the report of `frep mesh` (docs/formats.md) and for
// `--require`. The mesh is judged on the coordinates as written: rounded to binary32, equal positions merged,
// triangles that collapse by that dropped (docs/numerics.md, rule 9).
// Tested by tests/unit/geom/mesh_check_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "frep/geom/mesh.h"
#include "frep/math/vec.h"

namespace frep {

struct CheckOptions {
    bool as_float32 = true;  ///< judge the coordinates rounded to binary32; false: as they are in memory
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
    std::optional<double> volume;  ///< enclosed volume, negative when inside out; nothing when not closed
    std::optional<Vec3> centroid;  ///< of the enclosed volume; nothing when not closed or the volume is 0
    std::optional<Box3> bounds;    ///< of the vertices in use; nothing for an empty mesh
    bool closed = false;           ///< there are triangles and no boundary edges
    bool manifold = false;         ///< no non-manifold edge or vertex
    bool oriented = false;         ///< no misoriented edge
};

/// Topology and measures of `mesh`, which must be valid. Sums run in a fixed order: the same bits everywhere.
/// Memory: about 80 bytes a triangle. An empty mesh is manifold and oriented but not closed.
MeshReport check(const Mesh& mesh, const CheckOptions& options = {});

}  // namespace frep
