// find_self_intersections: how often a mesh runs through itself. A self-intersection is a pair of triangles
// that share no vertex and have a common point, or share a vertex or an edge and have a common point outside
// of what they share. Precisely: the two closed triangles, as sets of points, meet outside of their common
// vertex, their common edge, or, with three common vertices, their three edges. Vertices are common when
// their written positions are equal. So a touch counts, and so does an edge folded flat onto its neighbor;
// two triangles side by side in one plane do not count. Triangles without area are segments and take part.
// Boxes are compared in a tree (bvh.h), triangles by exact predicates (predicates.h): no tolerance, and no
// degenerate case goes astray. Tested by tests/unit/geom/self_intersection_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/geom/mesh.h"
#include "frep/math/vec.h"

namespace frep {

struct SelfIntersectionOptions {
    bool as_float32 = true;       ///< judge the coordinates rounded to binary32, as the binary formats write
    std::size_t max_listed = 10;  ///< pairs to name; all are counted
};

/// Two triangles that intersect.
struct IntersectingPair {
    std::uint32_t first = 0, second = 0;  ///< indices into Mesh::triangles of the mesh asked about
    Vec3 place;                           ///< a common point outside of what they share, model units, rounded
    friend bool operator==(const IntersectingPair&, const IntersectingPair&) = default;
};

struct SelfIntersections {
    std::size_t count = 0;                 ///< pairs of triangles
    std::vector<IntersectingPair> listed;  ///< the first of them by (first, second), first < second
};

/// The self-intersections of `mesh`, which must be valid, after merging equal positions and dropping the
/// triangles that collapse by that. Exact for binary32 coordinates, and for others with sizes between 1e-80
/// and 1e90. Triangles with a coordinate that is not finite take no part. Time near n log n while
/// few boxes overlap, and linear in the number of overlapping boxes; memory about 130 bytes a triangle.
/// Errors: cancelled.
Result<SelfIntersections> find_self_intersections(const Mesh& mesh,
                                                  const SelfIntersectionOptions& options = {},
                                                  const Job& job = {});

}  // namespace frep
