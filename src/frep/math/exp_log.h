// Kernels of exp, log, log10, and their double-length forms that pow and the hyperbolic functions use.
// Method: exp by x = k ln2 + r (Cody and Waite, "Software Manual for the Elementary Functions", 1980) and a
// polynomial in r; log by x = 2^k m and ln m = 2 artanh((m-1)/(m+1)) in double length.
// Checked by tests/unit/math/kernels_test.cpp.
#pragma once

#include "frep/math/coefficients.h"
#include "frep/math/double_double.h"

FREP_MATH_OPEN
namespace kernel {

/// 1.5 * 2^52: adding it rounds to the nearest integer and leaves that in the low bits.
inline constexpr double to_integer = 0x1.8p52;

/// e^x = 2^k (1 + r + tail), |r| <= 0.35; k stands as a two's complement integer.
template <class T>
struct ExpParts {
    T r, tail;
    word_t<T> k;
};

/// Reduces x.hi + x.lo with |x.hi| < 2000. Error of r + tail about 2^-57 relative.
template <LaneType T>
inline ExpParts<T> exp_parts(T x, T low) {
    namespace c = coefficients;
    const T shifted = x * c::log2_e + to_integer;
    const T k = shifted - to_integer;
    const T near = x - k * c::ln2_1, back = k * c::ln2_2;
    const T first = near - back;
    const Pair<T> sum = fast_sum(first, ((near - first) - back) + low);
    const T r = sum.hi, rest = sum.lo;
    return {r, rest + (r * r * polynomial(r, c::exp_tail) + r * rest),
            bits_of(shifted) - to_bits(to_integer)};
}
/// y * 2^k for |k| <= 1100 and y near 1, rounded once.
template <LaneType T>
inline T scale(T y, word_t<T> k) {
    const word_t<T> half = (k + std::uint64_t{2048}) >> 1;
    const T first = float_of<T>((half - std::uint64_t{1}) << 52);
    const T second = float_of<T>((k - half + std::uint64_t{2047}) << 52);
    return y * first * second;
}
/// 1 + r + tail, rounded.
template <LaneType T>
inline T one_plus(const ExpParts<T>& e) {
    const Pair<T> s = fast_sum(T(1.0), e.r);
    return s.hi + (s.lo + e.tail);
}
/// exp of a double-length number, |x.hi| < 1000 or NaN.
template <LaneType T>
inline T exp_of_pair(Pair<T> x) {
    const T high = select(less(x.hi, T(-746.0)), T(-746.0), select(less(T(710.0), x.hi), T(710.0), x.hi));
    const T low = select(equal(high, x.hi), x.lo, T(0.0));
    const ExpParts<T> e = exp_parts(high, low);
    return scale(one_plus(e), e.k);
}
template <LaneType T>
inline T exp(T x) {
    const T high = select(less(x, T(-746.0)), T(-746.0), select(less(T(710.0), x), T(710.0), x));
    const ExpParts<T> e = exp_parts(high, T(0.0));
    return scale(one_plus(e), e.k);
}

/// artanh(s) * 2 for the quotient s = f/(2+f), f in [-0.2929, 0.4143], to about 2^-67 relative.
template <LaneType T>
inline Pair<T> log_near_one(T f, Pair<T>& correction) {
    namespace c = coefficients;
    const Pair<T> s = quotient<T>({f, T(0.0)}, fast_sum(T(2.0), f));
    Pair<T> u = exact_product(s.hi, s.hi);
    u.lo = u.lo + 2.0 * s.hi * s.lo;
    const Pair<T> sum = fast_sum(T(c::third_hi), u.hi * polynomial(u.hi, c::artanh_tail));
    const T low = sum.lo + c::third_lo;
    Pair<T> v = exact_product(u.hi, sum.hi);
    v.lo = v.lo + (u.hi * low + u.lo * sum.hi);
    const Pair<T> w = exact_product(s.hi, v.hi);
    correction = {2.0 * w.hi, 2.0 * (w.lo + (s.hi * v.lo + s.lo * v.hi))};
    return {2.0 * s.hi, 2.0 * s.lo};
}
/// ln x for finite x > 0 in double length, to about 2^-66 relative.
template <LaneType T>
inline Pair<T> log_pair(T x) {
    namespace c = coefficients;
    const auto tiny = less(x, T(0x1p-1022));
    const T normal = select(tiny, x * 0x1p54, x);
    const word_t<T> b = bits_of(normal);
    // Exponent of normal/sqrt(1/2), with 1024 added to stay positive.
    const word_t<T> k = (b - to_bits(0x1.6a09e667f3bcdp-1) + (std::uint64_t{1024} << 52)) >> 52;
    const T m = float_of<T>(b - ((k - std::uint64_t{1024}) << 52));
    const T exponent = float_of<T>(k | to_bits(0x1p52)) - (0x1p52 + 1024.0) - select(tiny, T(54.0), T(0.0));
    Pair<T> extra;
    const Pair<T> main = log_near_one(m - 1.0, extra);
    const Pair<T> a = exact_sum(exponent * c::ln2_1, main.hi);
    const Pair<T> s = exact_sum(a.hi, extra.hi);
    return fast_sum(s.hi, a.lo + s.lo + (exponent * c::ln2_2 + (main.lo + extra.lo)));
}
/// The value of a logarithm outside the finite positive numbers: NaN for x <= 0 and NaN, +inf for +inf.
template <LaneType T>
inline T log_ends(T x, T inside) {
    const T r = select(equal(x, T(infinity)), x, inside);
    return select(less(T(0.0), x), r, T(quiet_nan));
}
template <LaneType T>
inline T log(T x) {
    return log_ends(x, log_pair(x).hi);
}
template <LaneType T>
inline T log10(T x) {
    namespace c = coefficients;
    const Pair<T> l = log_pair(x);
    const Pair<T> p = exact_product(l.hi, T(c::log10_e_hi));
    return log_ends(x, p.hi + (p.lo + (l.hi * c::log10_e_lo + l.lo * c::log10_e_hi)));
}

}  // namespace kernel
FREP_MATH_CLOSE
