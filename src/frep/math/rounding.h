// Exact functions of double and lanes: abs, sign, square, sqrt, min, max, floor and its relatives, and the
// remainder of a truncated division. All are exact or, sqrt and square, correctly rounded.
// Method: rounding by adding and taking away 2^52. Checked by tests/unit/math/lanes_test.cpp.
#pragma once

#include "frep/math/traits.h"

FREP_MATH_OPEN

/// True for the lane types that the kernels are written for (double and LanesN).
template <class T>
inline constexpr bool is_lane_type = false;
template <>
inline constexpr bool is_lane_type<double> = true;
template <int N>
inline constexpr bool is_lane_type<LanesN<N>> = true;

/// double or LanesN: the types that kernels are instantiated for.
template <class T>
concept LaneType = is_lane_type<T>;

/// |x|, exact; the sign bit of a NaN is cleared too.
template <LaneType T>
inline T abs(T x) {
    return float_of<T>(bits_of(x) & std::uint64_t{0x7fffffffffffffff});
}
/// The magnitude of x with the sign bit of s.
template <LaneType T>
inline T copy_sign(T x, T s) {
    return float_of<T>((bits_of(x) & std::uint64_t{0x7fffffffffffffff}) |
                       (bits_of(s) & std::uint64_t{0x8000000000000000}));
}
/// x*x, correctly rounded.
template <LaneType T>
inline T square(T x) {
    return x * x;
}
/// The square root, correctly rounded; undefined (NaN) below 0.
inline double sqrt(double x) { return __builtin_sqrt(x); }
template <int N>
inline LanesN<N> sqrt(LanesN<N> x) {
    for (int i = 0; i < N; ++i) x.set(i, __builtin_sqrt(x[i]));
    return x;
}
/// -1, 0 or 1; NaN for NaN.
template <LaneType T>
inline T sign(T x) {
    const T s = select(less(T(0.0), x), T(1.0), select(less(x, T(0.0)), T(-1.0), T(0.0)));
    return select(is_nan(x), x, s);
}
/// The smaller one; NaN if either is NaN; -0 counts as less than +0.
template <LaneType T>
inline T min(T a, T b) {
    const T zeros = float_of<T>(bits_of(a) | bits_of(b));
    const T r = select(less(a, b), a, select(equal(a, b), zeros, b));
    return select(is_nan(a), a, r);
}
/// The larger one; NaN if either is NaN; +0 counts as more than -0.
template <LaneType T>
inline T max(T a, T b) {
    const T zeros = float_of<T>(bits_of(a) & bits_of(b));
    const T r = select(less(b, a), a, select(equal(a, b), zeros, b));
    return select(is_nan(a), a, r);
}

/// The integer part (rounded towards 0), with the sign of x. Exact.
template <LaneType T>
inline T trunc(T x) {
    const T a = abs(x);
    const T near = (a + 0x1p52) - 0x1p52;
    const T down = near - select(less(a, near), T(1.0), T(0.0));
    return select(less(a, T(0x1p52)), copy_sign(down, x), x);
}
/// The greatest integer <= x. Exact.
template <LaneType T>
inline T floor(T x) {
    const T t = trunc(x);
    return select(less(x, t), t - 1.0, t);
}
/// The least integer >= x. Exact.
template <LaneType T>
inline T ceil(T x) {
    const T t = trunc(x);
    return select(less(t, x), t + 1.0, t);
}
/// The nearest integer, halves upward: with c = ceil(x), c-1 if c-x > 1/2, else c. Exact.
template <LaneType T>
inline T round_half_up(T x) {
    const T c = ceil(x);
    return select(less(T(0.5), c - x), c - 1.0, c);
}

FREP_MATH_CLOSE
