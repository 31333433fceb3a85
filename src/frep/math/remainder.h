// Kernel of remainder_trunc (C's fmod), exact. Method: with a quotient below 2^26 its product with either
// half of the divisor is exact, and so are the differences; every other case takes one shared scalar path,
// long division of the integer significands. Checked by tests/unit/math/remainder_test.cpp.
#pragma once

#include "frep/math/double_double.h"

FREP_MATH_OPEN
namespace kernel {

/// The remainder for every pair of doubles, by long division, eleven bits a step.
inline double remainder_by_division(double a, double b) {
    const double x = abs(a), y = abs(b);
    if (!(x < infinity) || !(y > 0.0)) return quiet_nan;
    if (x < y) return a;
    const auto exponent = [](double v) {
        const int e = static_cast<int>(to_bits(v) >> 52);
        return e == 0 ? 1 : e;
    };
    const auto significand = [](double v) {
        const std::uint64_t w = to_bits(v);
        return (w & 0xfffffffffffffu) | ((w >> 52) == 0 ? 0u : 0x10000000000000u);
    };
    const std::uint64_t divisor = significand(y);
    std::uint64_t rest = significand(x) % divisor;
    for (int left = exponent(x) - exponent(y); left > 0 && rest != 0;) {
        const int step = left < 11 ? left : 11;
        rest = (rest << step) % divisor;
        left -= step;
    }
    // rest * 2^(exponent(y) - 1075), exact: rest < divisor.
    if (rest == 0) return with_sign_of(0.0, a);
    const int shift = __builtin_clzll(rest) - 11;
    const int e = exponent(y) - shift;
    const std::uint64_t bits =
        e > 0 ? (rest << shift) - 0x10000000000000u + (static_cast<std::uint64_t>(e) << 52)
              : rest << (exponent(y) - 1);
    return with_sign_of(from_bits(bits), a);
}
template <LaneType T>
inline T remainder_trunc(T a, T b) {
    const T x = abs(a), y = abs(b);
    const T q = trunc(x / y);
    const T high = upper_half(y), low = y - high;
    const Pair<T> s = exact_sum(x, -(q * high));
    const T r = (s.hi - q * low) + s.lo;
    const T result = copy_sign(select(less(r, T(0.0)), r + y, r), a);
    const auto fast = both(both(less(q, T(0x1p26)), less(T(0x1p-900), y)),
                           both(less(x, T(0x1p1000)), less(y, T(0x1p1000))));
    return patch(!fast, result, a, b, remainder_by_division);
}

}  // namespace kernel
FREP_MATH_CLOSE
