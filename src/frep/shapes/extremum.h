// Largest and smallest values over variables, and what FRep makes of them: projections, Minkowski sums and
// offsets by a radius (Pasko, Savchenko 1997; Pasko, Okunev, Savchenko 2003). All are searches with proved
// tolerances (field/search.h). Tested by tests/unit/shapes/extremum_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// A variable from `low` to `high`, which largest() goes through.
Expression variable(Build& build, Expression low, Expression high);

/// The largest value of f over the variable t, of variable(): within tolerance * max(1, |value|).
Expression largest(Build& build, Expression f, Expression t, Expression tolerance);
/// The smallest.
Expression smallest(Build& build, Expression f, Expression t, Expression tolerance);

/// The shadow of f, a function of the items of x, along item number k (from 1), searched from low to high.
Expression projection(Build& build, Array x, Expression f, Expression k, Expression low, Expression high,
                      Expression tolerance);

/// All sums of a point of f1 and a point of f2, both functions of the items of x (1 to 3): the points of f1
/// are searched in the box low..high.
Expression minkowski_sum(Build& build, Array x, Expression f1, Expression f2, Array low, Array high,
                         Expression tolerance);

/// f, a function of the items of x (2 or 3), grown by the radius r, or shrunk where r < 0. r is one number.
Expression radius_offset(Build& build, Array x, Expression f, Expression r, Expression tolerance);

}  // namespace frep::shapes
