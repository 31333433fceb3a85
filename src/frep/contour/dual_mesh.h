// The mesh of dual contouring, from the crossings and the vertices of the leaves. It is closed, manifold and
// free of self-intersections by construction:
// The crossings on the boundary of a leaf are joined by arcs in its faces to closed lines, one a sheet. The
// triangles from the sheet's vertex to its line do not meet each other, since the leaf is convex and the
// vertex inside; all of them together are a closed manifold without self-intersections, and every edge has
// two triangles because leaves share faces and arcs. Two changes keep that and make the mesh the dual one:
// An arc is turned: its crossings are no longer joined, the vertices at its two sides are, if the straight
// line between them passes through the inside of the face that the leaves share, and no other arc lies there.
// (The line r - r' in the face becomes r - f - r', with f on the line between the vertices.)
// A crossing all of whose arcs are turned is taken out and its polygon cut into one or two triangles, if
// these lie in the envelope of the edge: the tetrahedra of the edge and each two neighbouring vertices.
// Envelopes of different edges do not meet (Ju and Udeshi 2006, "Intersection-free contouring on an octree
// grid"). What may not be done is left undone: there the mesh has more triangles. So no polygon ever gets an
// edge that another one has, also at ambiguous faces, whose arcs are never turned. Tested by
// tests/unit/contour/adaptive_test.cpp, adaptive_topology_test.cpp and adaptive_random_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/contour/dual_block.h"
#include "frep/contour/dual_vertices.h"
#include "frep/geom/mesh.h"

namespace frep::contouring {

struct DualMesh {
    Mesh mesh;
    std::vector<std::vector<double>> attributes;  ///< one column an attribute, a number a vertex
};

/// Computes the vertices of all blocks (dual_vertices.h) and joins them. `blocks` stand in the order of their
/// codes and are used up. The vertices of leaves come first, then those on edges, both in the order of the
/// blocks. Errors: over_limit for more than 2^32 - 2 vertices, cancelled, invalid_argument when the intervals
/// and the values of the field contradict each other.
Result<DualMesh> join_blocks(const Grid& grid, const DualOptions& options, std::vector<StoredBlock> blocks,
                             const Job& job);

}  // namespace frep::contouring
