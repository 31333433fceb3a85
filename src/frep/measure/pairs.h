// The pairs of axes in the order of all second moments and second derivatives of this module: 00 11 22 01 02
// 12. Tested through tests/unit/measure/clip_test.cpp.
#pragma once

#include <array>
#include <cstddef>

namespace frep::measuring {

inline constexpr std::array<std::array<std::size_t, 2>, 6> pairs{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

}  // namespace frep::measuring
