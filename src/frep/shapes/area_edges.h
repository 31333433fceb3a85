// The edges of an area as an arrangement (private to shapes): vertices that nearly coincide are joined, edges
// are divided where they meet, so that two edges share at most a vertex, or are the same. Tested by
// tests/unit/shapes/area_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/area.h"

namespace frep::shapes {

struct Arrangement {
    struct Edge {
        std::uint32_t from, to;  ///< vertices
        std::uint32_t part;      ///< of the area
        std::uint32_t contour;   ///< counted over all parts
    };
    std::vector<Vec2> vertices;
    std::vector<Edge> edges;  ///< contour by contour, part by part; each contour is closed
    double weld = 0;          ///< vertices and edges this near to one another were joined
};

/// Parts and contours come in an order in which neighbours are near. Vertices within 1e-9 of the larger side
/// are joined, and edges pass through vertices that near. Errors: over_limit when edges meet too often or are
/// too many, invalid_argument when there is no edge or a coordinate is not finite or above 1e12.
Result<Arrangement> arrange(const Area& area);

}  // namespace frep::shapes
