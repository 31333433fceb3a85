// Implicit surfaces as sums over key points: blobs, metaballs, soft objects, and a solid pulled through
// points. Key points come as arrays of equal length; unequal lengths or an `x` without 3 items give
// error_value with a warning. One call is one node of the graph, however many points. Units: those of the
// model. Sources: Blinn 1982; Nishimura and others 1985; Wyvill and others 1986; Savchenko and others 1995.
// Tested by tests/unit/shapes/skeletons_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Blinn's blobs: sum of b exp(-a r^2), minus T.
Expression blobby(Build& build, Array x, Array x0, Array y0, Array z0, Array a, Array b,
                  Expression threshold);

/// Metaballs of height b and radius d, piecewise quadratic, minus T.
Expression metaball(Build& build, Array x, Array x0, Array y0, Array z0, Array b, Array d,
                    Expression threshold);

/// Soft objects of radius d: a polynomial of degree 6 in r that ends at d, minus T.
Expression soft(Build& build, Array x, Array x0, Array y0, Array z0, Array d, Expression threshold);

/// The object of value `object` pulled through key points where its value is object0: each point takes away
/// object0/(1 + r^2/sigma^2); points with sigma <= 1e-6 have no effect.
Expression fitted_blob(Build& build, Array x, Expression object, Array x0, Array y0, Array z0, Array object0,
                       Array sigma);

}  // namespace frep::shapes
