// Offsets and shells of solids (Pasko and Savchenko 1994b, "Constructing functionally defined surfaces";
// thesis 1.2.3). An iso offset moves the surface to another level of the function; a normal offset reads the
// function a given length away along its gradient. The offset of constant radius, which is exact, is an
// extremum over a ball (extremum.h). Tested by tests/unit/shapes/offsets_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// f + c: larger for c > 0, by a length that depends on the gradient (a ball R^2 - r^2 gets the radius
/// sqrt(R^2 + c)).
Expression iso_offset(Build& build, Expression f, Expression c);

/// f(X + d grad f/|grad f|), f(X) where the gradient is 0: larger by the length d for d > 0, exactly so where
/// the normals that pass through the neighbourhood do not meet within d. f must be a function of the items of
/// x, made of operations that have derivatives (field/derivative.h); otherwise an error.
Expression normal_offset(Build& build, Array x, Expression f, Expression d);

/// The part of the solid where 0 <= f <= w: a wall of thickness w where f is a distance.
Expression iso_shell(Build& build, Expression f, Expression w);

/// The solid without its normal offset by -w: a wall of thickness w for any function.
Expression normal_shell(Build& build, Array x, Expression f, Expression w);

}  // namespace frep::shapes
