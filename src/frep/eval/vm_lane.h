// Lane by lane access to the element types of the vm, for arrays whose index differs from lane to lane.
// Tested by tests/unit/eval/region_test.cpp.
#pragma once

#include <cstddef>
#include <limits>

#include "frep/math/number.h"

namespace frep {

/// The numbers that conditions and indices are judged by.
inline double lane_values(double value) { return value; }
inline math::Lanes lane_values(math::Lanes value) { return value; }
template <class T>
T lane_values(const math::Dual<T>& value) {
    return value.value;
}

/// Sets one lane of `to` to that of `from`.
inline void copy_lane(math::Lanes& to, math::Lanes from, int lane) { to.set(lane, from[lane]); }
inline void copy_lane(math::Dual<math::Lanes>& to, const math::Dual<math::Lanes>& from, int lane) {
    copy_lane(to.value, from.value, lane);
    for (std::size_t i = 0; i < 3; ++i) copy_lane(to.d[i], from.d[i], lane);
}

inline constexpr std::size_t no_item = std::numeric_limits<std::size_t>::max();

/// The item, counted from 0, that a 1-based index means after rounding; no_item when undefined or out of
/// range.
inline std::size_t item_number(double index, std::size_t size) {
    const double rounded = math::round_half_up(index);
    if (!(rounded >= 1.0 && rounded <= static_cast<double>(size))) return no_item;
    return static_cast<std::size_t>(rounded) - 1;
}

}  // namespace frep
