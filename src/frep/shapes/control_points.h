// Bounded blends by control points on the surfaces (Pasko, Pasko and Kunii 2005; thesis 2.1.2): p1 is the
// point of surface 1 where the blend shall begin, p2 that of surface 2, and the extents are
// a1 = |f1(p2)|, a2 = |f2(p1)|, computed once. The blend touches surface 1 along f2 = -+a2 and surface 2
// along f1 = -+a1. Fillets and chamfers with a radius are blends with the right extents and displacement.
// Tested by tests/unit/shapes/control_points_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// `op` is point_uni or point_int. f1 and f2 must be functions of the items of x (3 each, like p1 and p2,
/// which do not depend on the point). A point beside its surface is moved there by Newton's method, at most
/// half the distance of the two points; one that does not come there, or that lies on the other surface too
/// (the edge), is an error, as are functions that depend on the point in another way. Local arrangement: of
/// a union (intersection for point_int), by R0 or max (min), only the operand that has its surface at the
/// control point goes into the blend, and the others are joined with the blend afterwards.
template <Op op>
Expression control_blend(Build& build, Array x, Expression f1, Expression f2, Expression a0, Array p1,
                         Array p2);

/// Displacements over the radius r, for two perpendicular faces with unit gradients and the extents r: the
/// section of the blend passes the middle of the circle of radius r (the rest within 1.36 % of r), or the
/// middle of the chamfer with legs r.
inline constexpr double fillet_share = 0.35355339059327379;  ///< 1/(2 sqrt 2)
inline constexpr double chamfer_share = 3.5147186257614301;  ///< 6 (2 - sqrt 2)

}  // namespace frep::shapes
