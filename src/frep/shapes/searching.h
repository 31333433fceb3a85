// What builders of searches share. Private to extremum.cpp and sweeps.cpp.
#pragma once

#include <span>

#include "frep/field/search.h"
#include "frep/shapes/library.h"

namespace frep::shapes {

/// A fresh variable over [0, 1].
inline Expression unit_variable(Build& build) { return {build.graph, make_search_variable(build.graph)}; }

/// The largest value of f over variables of unit_variable(), with a warning and the error value where the
/// search is refused.
Expression search(Build& build, Expression f, std::span<const Expression> variables, Expression tolerance,
                  bool in_ball = false);

/// f as a function of the items of x, at p (at_point.h), or a warning.
std::optional<Expression> moved(Build& build, Expression f, Array x, Array p);

}  // namespace frep::shapes
