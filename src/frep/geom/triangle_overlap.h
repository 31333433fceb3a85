// common_point: do two triangles meet outside of the corners that they share? Exact, for every position:
// crossing, touching, in one plane, without area. A triangle without area is the segment that it covers.
// Two triangles meet if an edge of one meets the other. With one common corner v they meet elsewhere if the
// edge opposite to v of one meets the other: the ray from v through a second common point leaves one of the
// triangles first, through that edge. With a common edge they meet elsewhere if they lie in one plane and on
// the same side of the edge. All is decided by signs of orient3d and orient2d (predicates.h).
// Tested by tests/unit/geom/triangle_overlap_test.cpp.
#pragma once

#include <array>
#include <optional>

#include "frep/math/vec.h"

namespace frep {

/// The corners of a triangle, all different.
using Corners = std::array<Vec3, 3>;

/// A common point of the closed triangles `a` and `b` outside of what they share; nothing when there is none.
/// The first `shared` corners (0..3) of both are the same, in the same order, and the other corners are
/// different. They share nothing, that corner, the edge between two, or with three the three edges. Whether
/// there is a point is exact; its coordinates are rounded.
std::optional<Vec3> common_point(const Corners& a, const Corners& b, int shared);

}  // namespace frep
