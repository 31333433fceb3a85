// Point membership classification (Tilove 1980): is a point in, on or out of a shape. The value of a function
// is no distance, so "on" is decided to first order: |F| <= tolerance * |grad F|, the distance to the tangent
// plane of the level set. Tested by tests/unit/measure/membership_test.cpp.
#pragma once

#include <span>
#include <string_view>

namespace frep {

enum class Membership { in, on, out };

/// Of a point with this value and gradient; `tolerance` >= 0 in model units. An undefined value is out. F = 0
/// is on, whatever the gradient.
Membership membership(double value, std::span<const double> gradient, double tolerance);

/// "in", "on", "out".
std::string_view to_string(Membership membership);

}  // namespace frep
