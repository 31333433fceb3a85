// Arrays of copies of a solid: its function, as a function of the items of `x`, is taken at the places that
// the copies come from, and the copies are united by the file's system of set operations. Every copy is there
// in full: nothing is folded, so that pieces may overlap and reach anywhere. The number of copies must be
// known; away from a copy the engines leave it out. Tested by tests/unit/shapes/patterns_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// `count` copies of f about `axis` through the origin, equally spaced over a turn; the first one is f. The
/// array x must have the two items across the axis.
template <int axis>
Expression polar_array(Build& build, Array x, Expression f, Expression count);

/// `count` copies of f at 0, d, 2 d and so on; the offset d has at most as many items as x.
Expression linear_array(Build& build, Array x, Expression f, Array offset, Expression count);

}  // namespace frep::shapes
