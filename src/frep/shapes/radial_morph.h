// Metamorphosis by variational interpolation in space-time (Turk and O'Brien 1999): one smooth function takes
// the value 0 on the boundary of shape 1 at time t1 and of shape 2 at time t2, and positive values a step
// inside of them; its sections are the frames. A baseline beside space-time blending (metamorphosis.h): the
// shapes need be given by points only, but are met at those points alone, and the frames between cannot be
// steered. Tested by tests/unit/shapes/radial_morph_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// The interpolating function of x and t. The boundaries of g1 and g2, as functions of the items of x, are
/// looked for in `box`: {xmin, ymin, xmax, ymax} for shapes of the plane or {xmin, ymin, zmin, xmax, ymax,
/// zmax}, on points about `spacing` apart; the inner points lie `inset` inside, less where the shape is thin,
/// and have their distance as value. t1, t2, box, spacing and inset must be known. Time counts as a length:
/// the nearer t1 and t2 are, the more each shape feels of the other.
Expression radial_morph(Build& build, Array x, Expression t, Expression g1, Expression g2, Expression t1,
                        Expression t2, Array box, Expression spacing, Expression inset);

}  // namespace frep::shapes
