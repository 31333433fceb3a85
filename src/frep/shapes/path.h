// A path in space for sweeps of contours: polygons and chains of cubic Bezier curves, cut into pieces between
// planes, with a frame that is carried along. The frame is rotation-minimizing: from knot to knot by double
// reflection (W. Wang, B. Juttler, D. Zheng, Y. Liu, ACM Transactions on Graphics 27(1), 2008), over a corner
// by reflection in the plane of the mitre. Plain numbers, no graph. Tested by
// tests/unit/shapes/contour_sweep_test.cpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "frep/math/vec.h"

namespace frep::shapes {

/// Where two pieces meet, or the path ends. Sections of both pieces lie in the same plane there.
struct PathKnot {
    Vec3 point;
    Vec3 normal;  ///< of the plane, of length 1, forwards: half-way between both directions
};

/// What lies between two knots.
struct PathPiece {
    std::array<Vec3, 4> curve;  ///< p(s) = c0 + s (c1 + s (c2 + s c3)), s in [0, 1]
    std::size_t first_knot = 0, last_knot = 0;
    std::array<double, 2> slant{1, 1};        ///< 1 / (direction . normal) at both ends
    std::array<std::array<Vec3, 3>, 2> axes;  ///< side, up(c0, c1, c2): c0 + s (c1 + s c2), of length 1
    double bend = 0;               ///< s = r + bend r (1 - r), where r is the share of the piece's length
    double start = 0, length = 0;  ///< along the path
    bool straight = false;         ///< p(s) = c0 + s c1, and the axes do not change
};

struct Path {
    std::vector<PathKnot> knots;
    std::vector<PathPiece> pieces;
    double length = 0;
    bool closed = false;
    std::string problem;  ///< why there is none; empty: all is well
};

/// Through `points` in order; closed when the last one is the first one. The frame's first axis begins as
/// what of `side` is perpendicular to the path. Over a closed path the frame is turned evenly so that it
/// meets itself.
Path polygon_path(const std::vector<Vec3>& points, Vec3 side);

/// Of cubic Bezier curves, each beginning where the one before ends: 4, 7, 10, ... control points. Pieces are
/// halved until they turn by less than 0.1 and s is right to 0.01, at most 7 times.
Path bezier_path(const std::vector<Vec3>& points, Vec3 side);

}  // namespace frep::shapes
