// How steep a function is where its surface is, from samples. Used by `frep convert` and `frep morph`.
// Tested by tests/cli/convert.txt and tests/cli/morph.txt.
#pragma once

#include <optional>

#include "frep/frep.h"

namespace frep::cli {

/// Lengths of the gradient at samples so near to the surface that it may cross their cell.
struct SurfaceSlope {
    double largest = 0, median = 0;
};

/// From 32 samples along each side of the box that has a length; if none is near the surface, from all of
/// them. Nothing where the slope is 0 everywhere, or not defined.
std::optional<SurfaceSlope> surface_slope(SampledField& field, const Box3& box);

}  // namespace frep::cli
