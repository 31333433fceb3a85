// The union of several fields in one, each part in a color of its own: several states of a model in one
// picture, the coordinate or parameter between them mapped to color (multimedia coordinates: Fausett, Pasko
// and Adzhiev 2000). Tested by tests/unit/field/colored_union_test.cpp.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "frep/field/field.h"

namespace frep {

struct ColoredPart {
    Field field;
    std::vector<std::pair<int, double>> frozen;  ///< coordinates (first = 0) that have these values
    std::array<double, 3> color;                 ///< R, G, B in 0..1, sRGB
};

/// F = max of the parts' functions; three attributes, the color of the part that has the largest value
/// (of equals the first). Present parameter values become numbers. At least one part, all of as many
/// coordinates. Undefined where one of the parts is.
Field colored_union(std::span<const ColoredPart> parts);

}  // namespace frep
