// The writers of drawings (private to io); see drawing_format.h. The points come scaled to millimetres.
// Tested by tests/unit/io/drawing_format_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "frep/io/drawing_format.h"

namespace frep::encode {

/// The smallest rectangle around all points; from (0, 0) to (0, 0) if there is none.
struct Extent {
    Vec2 low, high;
    bool empty = true;
};
Extent extent_of(const std::vector<Polyline>& lines);

std::string write_svg(const std::vector<Polyline>& lines, const DrawingOptions& options);
std::string write_dxf(const std::vector<Polyline>& lines, const DrawingOptions& options);

}  // namespace frep::encode
