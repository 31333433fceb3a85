// Deformations of space: bending about an arc, free-form deformation by a lattice of control points, and the
// warp that takes given points exactly to others. As in transforms.h each changes the array `point` in place
// by the inverse map and returns 1; wrong sizes give error_value with a warning. Sources: Barr 1984;
// Sederberg and Parry 1986; Savchenko and Pasko 1998. Tested by tests/unit/shapes/deformations_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Bends `axis`, from p1 to p2, into an arc of the same length that turns by `angle` in all towards the next
/// axis (x to y, y to z, z to x). The point at p0 of the axis stays where it is, with its direction; beyond
/// p1 and p2 space goes on straight. Angles beyond a full turn make it cover itself: warned of.
template <int axis>
Expression bend(Build& build, ArrayInOut point, Expression p1, Expression p2, Expression p0,
                Expression angle);

/// Moves space by the Bezier volume of the displacements of l m n control points over a box {xmin, ymin,
/// zmin, xmax, ymax, zmax}: item ((i m + j) n + k) 3 of `moves` and the next two belong to the control point
/// i along x, j along y and k along z. The displacement that is read is that at the deformed place, so the
/// map is given by its inverse, and exact for it. Outside of the box the displacement of its nearest point
/// goes on.
Expression free_form(Build& build, ArrayInOut point, Expression l, Expression m, Expression n, Array box,
                     Array moves);

/// The same with the displacements at the places before the deformation, as Sederberg and Parry define it:
/// the inverse is found by `steps` turns of X <- x - displacement(X), each of which makes the error smaller
/// by the largest difference of neighbouring displacements over the distance of their control points. Where
/// that is 1 or more, space may fold, and a warning says so.
Expression free_form_forward(Build& build, ArrayInOut point, Expression l, Expression m, Expression n,
                             Array box, Array moves, Expression steps);

/// The smoothest displacement that takes each of the points `source` to the one of `target` exactly, by a
/// sum of w r^3 for each coordinate; 3 numbers a point. Far away it is an affine map.
Expression space_map_spline(Build& build, ArrayInOut point, Array source, Array target);

}  // namespace frep::shapes
