// The exact Euclidean distance transform of a sampled function in three passes of lower envelopes of
// parabolas. Method: Felzenszwalb and Huttenlocher 2012, "Distance transforms of sampled functions".
// Tested by tests/unit/trace/distance_grid_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "frep/base/job.h"

namespace frep::tracing {

/// What an entry holds that is not a seed.
inline constexpr float no_seed = 1e20F;

/// values[p] becomes the least of |p - q|^2 + values[q] over all q of the lattice (x fastest, spacing 1);
/// no_seed everywhere stays no_seed.
void distance_transform(std::span<float> values, const std::array<std::size_t, 3>& size, const Job& job);

}  // namespace frep::tracing
