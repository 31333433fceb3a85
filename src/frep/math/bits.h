// The bit patterns of binary64: casts, neighbours, constants. No libm, no std code that leaves a function
// behind. Method: IEEE 754 order of bit patterns. Checked by tests/unit/math/lanes_test.cpp.
#pragma once

#include <cstdint>

#include "frep/math/isa.h"

FREP_MATH_OPEN

/// +infinity.
inline constexpr double infinity = __builtin_huge_val();
/// The quiet NaN that stands for "undefined".
inline constexpr double quiet_nan = __builtin_nan("");
/// The largest finite double.
inline constexpr double max_finite = 0x1.fffffffffffffp+1023;
/// The smallest positive double (denormal).
inline constexpr double min_denormal = 0x1p-1074;
/// pi, pi/2 and ln 2 rounded to nearest; pi itself lies in (pi, next_up(pi)).
inline constexpr double pi = 0x1.921fb54442d18p+1;
inline constexpr double half_pi = 0x1.921fb54442d18p+0;
inline constexpr double ln2 = 0x1.62e42fefa39efp-1;

/// The 64 bits of a double.
constexpr std::uint64_t to_bits(double x) { return __builtin_bit_cast(std::uint64_t, x); }
/// The double with these 64 bits.
constexpr double from_bits(std::uint64_t b) { return __builtin_bit_cast(double, b); }
/// The double with the magnitude of `x` and the sign of `s`.
constexpr double with_sign_of(double x, double s) {
    return from_bits((to_bits(x) & 0x7fffffffffffffffu) | (to_bits(s) & 0x8000000000000000u));
}

/// The double `n` >= 0 places above `x` in the order of the doubles (-0 and +0 are one place), stopping at
/// +infinity. NaN stays NaN. Exact.
constexpr double step_up(double x, int n) {
    if (x != x || n <= 0) return x;
    const std::int64_t bits = static_cast<std::int64_t>(to_bits(x));
    const std::int64_t place = bits < 0 ? INT64_MIN - bits : bits;
    const std::int64_t top = static_cast<std::int64_t>(to_bits(infinity));
    const std::int64_t moved = place > top - n ? top : place + n;
    return from_bits(static_cast<std::uint64_t>(moved < 0 ? INT64_MIN - moved : moved));
}
/// The double `n` >= 0 places below `x`, stopping at -infinity. NaN stays NaN. Exact.
constexpr double step_down(double x, int n) { return -step_up(-x, n); }
/// The least double above `x` (nextafter towards +infinity). Exact.
constexpr double next_up(double x) { return step_up(x, 1); }
/// The greatest double below `x` (nextafter towards -infinity). Exact.
constexpr double next_down(double x) { return step_down(x, 1); }

FREP_MATH_CLOSE
