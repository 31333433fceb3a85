// Blending set operations: the global displacement of 1994 and the bounded blends of 2002 (by a bounding
// solid, or by control points). f1, f2, f3 are values of defining functions; a0 is the displacement in units
// of f (a0 > 0 adds material), a1, a2 the extents along surface 1 and 2, a3 the weight of the bounding solid;
// only |a1|, |a2|, |a3| count, an extent of 0 means no displacement, and any a_i may be a field. Sources:
// Pasko and Savchenko 1994; Pasko, Pasko, Ikeda and Kunii 2002 and 2005. Tested by
// tests/unit/shapes/blends_test.cpp; kernels: field/kernels/blend.h.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// R-union or R-intersection (`op`) plus a0/(1 + (f1/a1)^2 + (f2/a2)^2).
template <Op op>
Expression blend(Build& build, Expression f1, Expression f2, Expression a0, Expression a1, Expression a2);

/// R-intersection of f1 and -f2 with the displacement of `op`, blend_int or point_int; f2 enters evenly.
template <Op op>
Expression blend_subtraction(Build& build, Expression f1, Expression f2, Expression a0, Expression a1,
                             Expression a2);

/// Blend that acts only where the bounding solid f3 > 0; elsewhere the plain operation bit for bit.
template <Op op>
Expression bounded_blend(Build& build, Expression f1, Expression f2, Expression f3, Expression a0,
                         Expression a1, Expression a2, Expression a3);

/// The same for f1 without f2.
Expression bounded_subtraction(Build& build, Expression f1, Expression f2, Expression f3, Expression a0,
                               Expression a1, Expression a2, Expression a3);

}  // namespace frep::shapes
