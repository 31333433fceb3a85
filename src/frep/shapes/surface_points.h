// Points of the boundary of a shape that is given as a function: where the edges of a lattice cross it,
// thinned out to an even spacing. For operations that are set up by points. Tested by
// tests/unit/shapes/radial_morph_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "frep/math/vec.h"
#include "frep/shapes/library.h"

namespace frep::shapes {

/// Where to look for the boundary.
struct SurfaceSearch {
    int dimension = 3;  ///< 2: the plane z = 0, and only x and y of the box count
    Box3 box;
    double spacing = 0;  ///< wanted distance of neighbours, in model units
};

/// A point of the boundary and the unit vector into the shape there.
struct SurfacePoint {
    Vec3 place, inward;
};
struct SurfacePoints {
    std::vector<SurfacePoint> points;
    std::string problem;  ///< empty when all is well
};

/// Points of the boundary of f >= 0, f as a function of the items of x (at_point.h), for the present
/// parameters: every crossing lies within `spacing` of a point, and no two points are nearer than that
/// (Gonzalez 1985). Features thinner than half the spacing may be missed. Problems: a lattice that is too
/// fine, an f that is no function of x alone, no boundary within the box.
SurfacePoints surface_points(Build& build, Expression f, Array x, const SurfaceSearch& search);

}  // namespace frep::shapes
