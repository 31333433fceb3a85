// Areas of the plane by the monotone formula (private to shapes; see polygon.h). Tested by
// tests/unit/shapes/outline_formula_test.cpp.
#pragma once

#include "frep/base/result.h"
#include "frep/geom/area.h"
#include "frep/shapes/library.h"

namespace frep::shapes {

/// The union of the parts. Of a part, each contour at which the filling begins or ends is a polygon by the
/// monotone formula, less those of the next such contours inside it. 0 exactly on the contours, and where
/// parts touch. Errors: invalid_argument for a contour that crosses itself or another one of its part;
/// over_limit beyond 4096 vertices.
Result<Expression> area_formula(const SetSystem& system, const Area& area, Expression x, Expression y);

}  // namespace frep::shapes
