// Slices of a solid as a Common Layer Interface file (.cli), version 2.0 (Brite-EuRam project BE-2578, 1994):
// a text header, then layers of polylines in text or in binary (little endian, "long" commands). Lengths are
// in millimetres. Direction 0 is clockwise (a hole), 1 counter-clockwise (an outer outline), 2 an open line.
// Tested by tests/unit/io/slice_format_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/polyline.h"
#include "frep/geom/scene.h"

namespace frep {

struct SliceOptions {
    bool ascii = true;             ///< text geometry; else binary
    LengthUnit unit{"mm", 0.001};  ///< of the points and heights
    std::string label = {};        ///< UTF-8; the part's name in the header, reduced to ASCII
    /// Thickness of the lowest layer in model units, told by an empty layer below it; 0 writes none. (A
    /// layer's thickness is the difference of its height to the one before.)
    double first_thickness = 0;
};

/// The slices as a file's bytes. A closed polyline ends with its first point, as the format asks; its
/// direction follows from its signed area; lines of fewer than 2 points are left out. Errors:
/// invalid_argument when the heights do not increase, for numbers that are not finite or beyond binary32 in
/// millimetres, or a negative thickness; over_limit for more points in a line than 2^31 - 1.
Result<std::string> encode_slices(const std::vector<Slice>& slices, const SliceOptions& options = {});

}  // namespace frep
