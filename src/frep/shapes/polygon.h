// Polygons of the plane as functions, exactly 0 on the boundary and nowhere else: the monotone formula, in
// which each edge's half-plane occurs once (Pasko, Savchenko and Savchenko 1996; thesis 1.3), and the signed
// distance. Tested by tests/unit/shapes/polygon_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "frep/math/vec.h"
#include "frep/shapes/library.h"

namespace frep::shapes {

/// The vertices of a simple polygon in counter-clockwise order, without repetitions; or what is wrong.
struct Outline {
    std::vector<Vec2> vertices;
    std::string problem;  ///< empty when all is well
};

/// From pairs of numbers. A last vertex that equals the first, and vertices that repeat the one before, are
/// dropped; a clockwise polygon is turned round. Problems: fewer than three vertices, no area, edges that
/// meet anywhere but at the vertex that they share.
Outline make_outline(std::vector<Vec2> vertices);

/// True when the boundaries of two simple polygons have a common point.
bool outlines_meet(const Outline& a, const Outline& b);

/// Over the unit half-planes of the edges (positive to the left, distances): conjunction of the chains
/// between the vertices of the convex hull, in each of them the disjunction of the chains of its own hull,
/// and so on in turn. Joined as balanced trees by `system`.
Expression monotone_polygon(const SetSystem& system, const Outline& outline, Expression x, Expression y);

/// The distance to the boundary, positive inside.
Expression polygon_distance(const Outline& outline, Expression x, Expression y);

}  // namespace frep::shapes
