// orient2d, orient3d: on which side of a line or a plane a point lies, exactly.
// Method: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates"
// (1997). A floating-point determinant decides when it is larger than its error bound; otherwise the
// determinant is computed exactly as an expansion, a sum of doubles that do not overlap.
// Exact unless products of three coordinates overflow or underflow: always for binary32 coordinates, and for
// others with sizes (if not zero) between 1e-80 and 1e90.
// Tested by tests/unit/geom/predicates_test.cpp.
#pragma once

#include "frep/math/vec.h"

namespace frep {

/// The sign (-1, 0, 1) of the determinant of a - d, b - d, c - d: 1 when d lies below the plane through
/// a, b, c, that is, when a, b, c run clockwise seen from d; 0 when the four lie in one plane.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The sign of the determinant of a - c, b - c: 1 when a, b, c run counter-clockwise, 0 when they lie on one
/// line.
int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace frep
