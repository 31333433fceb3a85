// Area: a region of the plane bounded by polygons, as plain data: what outlines and texts of files become.
#pragma once

#include <vector>

#include "frep/math/vec.h"

namespace frep {

/// Which points closed contours enclose, by their winding number there.
enum class FillRule {
    nonzero,   ///< where it is not 0
    even_odd,  ///< where it is odd
};

/// Closed contours (the last vertex is joined to the first) that are filled together.
struct FilledPart {
    std::vector<std::vector<Vec2>> contours;
    FillRule rule = FillRule::nonzero;
};

/// The union of its parts; y points up.
struct Area {
    std::vector<FilledPart> parts;
};

}  // namespace frep
