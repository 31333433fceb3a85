// Connected parts of a set of samples of a lattice. Tested by tests/unit/measure/connected_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace frep::measuring {

/// The parts of `samples` (distinct, indices below 2^16), the largest first, of parts of one size the one
/// with the first sample. Samples belong together when their blocks of 2 x 2 x 2 are one or touch: surely up
/// to a step of 2 along each axis, surely not beyond 3.
std::vector<std::vector<std::array<std::uint16_t, 3>>> connected_parts(
    const std::vector<std::array<std::uint16_t, 3>>& samples);

}  // namespace frep::measuring
