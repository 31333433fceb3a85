// Exact functions of double and lanes of both formats: abs, sign, square, sqrt, min, max, floor and its
// relatives, and the remainder of a truncated division. All are exact or, sqrt and square, correctly rounded.
// Method: rounding by adding and taking away 2^52 (2^23). Checked by tests/unit/math/lanes_test.cpp.
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
/// True for the lane types of binary32 (SinglesN).
template <class T>
inline constexpr bool is_single_type = false;
template <int N>
inline constexpr bool is_single_type<SinglesN<N>> = true;

/// double or LanesN: the types that kernels are instantiated for.
template <class T>
concept LaneType = is_lane_type<T>;
/// SinglesN: the types that the kernels of binary32 are instantiated for (single/).
template <class T>
concept SingleType = is_single_type<T>;
/// Either: for what is written alike in both formats.
template <class T>
concept AnyLaneType = LaneType<T> || SingleType<T>;

/// |x|, exact; the sign bit of a NaN is cleared too.
template <AnyLaneType T>
inline T abs(T x) {
    return float_of<T>(bits_of(x) & format_of<T>::magnitude);
}
/// The magnitude of x with the sign bit of s.
template <AnyLaneType T>
inline T copy_sign(T x, T s) {
    return float_of<T>((bits_of(x) & format_of<T>::magnitude) | (bits_of(s) & format_of<T>::sign));
}
/// x*x, correctly rounded.
template <AnyLaneType T>
inline T square(T x) {
    return x * x;
}
/// The square root, correctly rounded; undefined (NaN) below 0.
inline double sqrt(double x) { return __builtin_sqrt(x); }
template <class E, int N>
inline LanesOf<E, N> sqrt(LanesOf<E, N> x) {
    using Items = typename LanesOf<E, N>::Items;
    return LanesOf<E, N>(each<Items>([](auto v) { return square_roots(v); }, x.items));
}
/// -1, 0 or 1; NaN for NaN.
template <AnyLaneType T>
inline T sign(T x) {
    const T s = select(less(T(0.0), x), T(1.0), select(less(x, T(0.0)), T(-1.0), T(0.0)));
    return select(is_nan(x), x, s);
}
/// The smaller one; NaN if either is NaN; -0 counts as less than +0. The two picks agree except for zeros of
/// two signs and for NaN; or-ing their bits gives -0 there, and a NaN.
template <AnyLaneType T>
inline T min(T a, T b) {
    return float_of<T>(bits_of(select(less(a, b), a, b)) | bits_of(select(less(b, a), b, a)));
}
/// The larger one; NaN if either is NaN; +0 counts as more than -0. As min, but the sign bit is and-ed.
template <AnyLaneType T>
inline T max(T a, T b) {
    const auto first = bits_of(select(less(b, a), a, b)), second = bits_of(select(less(a, b), b, a));
    return float_of<T>((first | second) ^ ((first ^ second) & format_of<T>::sign));
}

/// The integer part (rounded towards 0), with the sign of x. Exact.
template <AnyLaneType T>
inline T trunc(T x) {
    constexpr double whole = format_of<T>::whole;
    const T a = abs(x);
    const T near = (a + whole) - whole;
    const T down = near - select(less(a, near), T(1.0), T(0.0));
    return select(less(a, T(whole)), copy_sign(down, x), x);
}
/// The greatest integer <= x. Exact.
template <AnyLaneType T>
inline T floor(T x) {
    const T t = trunc(x);
    return select(less(x, t), t - 1.0, t);
}
/// The least integer >= x. Exact.
template <AnyLaneType T>
inline T ceil(T x) {
    const T t = trunc(x);
    return select(less(t, x), t + 1.0, t);
}
/// The nearest integer, halves upward: with c = ceil(x), c-1 if c-x > 1/2, else c. Exact.
template <AnyLaneType T>
inline T round_half_up(T x) {
    const T c = ceil(x);
    return select(less(T(0.5), c - x), c - 1.0, c);
}

FREP_MATH_CLOSE
