// Kernels of sin, cos, tan. Method: reduction to [-pi/4, pi/4] in double length, up to 2^20 by pi/2 in four
// parts (Cody and Waite), above by one shared scalar path (trig_reduce.h); polynomials for both functions.
// Checked by tests/unit/math/kernels_test.cpp.
#pragma once

#include "frep/math/coefficients.h"
#include "frep/math/trig_reduce.h"

FREP_MATH_OPEN
namespace kernel {

/// Arguments up to here take the fast reduction.
inline constexpr double largest_fast_angle = 0x1p20;

/// x = quadrant * pi/2 + rest; only the low two bits of quadrant count.
template <class T>
struct Angle {
    Pair<T> rest;
    word_t<T> quadrant;
};
/// For |x| <= 2^20. Absolute error of the rest below 2^-130.
template <LaneType T>
inline Angle<T> reduce_angle(T x) {
    namespace c = coefficients;
    const T shifted = x * c::two_over_pi + 0x1.8p52;
    const T k = shifted - 0x1.8p52;
    const Pair<T> a = exact_sum(x - k * c::half_pi_1, -(k * c::half_pi_2));
    const Pair<T> b = exact_sum(a.hi, -(k * c::half_pi_3));
    return {fast_sum(b.hi, a.lo + b.lo - k * c::half_pi_4), bits_of(shifted)};
}
/// sin(r.hi + r.lo) for |r| <= pi/4 as r.hi plus a small rest.
template <LaneType T>
inline Pair<T> sin_parts(Pair<T> r) {
    const T z = r.hi * r.hi;
    return {r.hi, r.lo * (1.0 - 0.5 * z) + r.hi * z * polynomial(z, coefficients::sin_tail)};
}
/// cos(r.hi + r.lo) for |r| <= pi/4 as a value and its small rest.
template <LaneType T>
inline Pair<T> cos_parts(Pair<T> r) {
    const Pair<T> z = exact_product(r.hi, r.hi);
    const Pair<T> s = fast_sum(T(1.0), -0.5 * z.hi);
    const T tail = z.hi * z.hi * polynomial(z.hi, coefficients::cos_tail);
    return {s.hi, s.lo + (tail - (r.hi * r.lo + 0.5 * z.lo))};
}
/// The sine of the angle plus `turn` quadrants.
template <LaneType T>
inline T sin_of_angle(const Angle<T>& a, std::uint64_t turn) {
    const word_t<T> q = a.quadrant + turn;
    const Pair<T> s = sin_parts(a.rest), c = cos_parts(a.rest);
    const T r = select(mask_of_low_bit(q), c.hi + c.lo, s.hi + s.lo);
    return float_of<T>(bits_of(r) ^ ((q & std::uint64_t{2}) << 62));
}
/// The tangent, as a quotient in double length.
template <LaneType T>
inline T tan_of_angle(const Angle<T>& a) {
    const Pair<T> ps = sin_parts(a.rest), pc = cos_parts(a.rest);
    const Pair<T> s = fast_sum(ps.hi, ps.lo), c = fast_sum(pc.hi, pc.lo);
    const auto odd = mask_of_low_bit(a.quadrant);
    const Pair<T> n = {select(odd, -c.hi, s.hi), select(odd, -c.lo, s.lo)};
    const Pair<T> d = {select(odd, s.hi, c.hi), select(odd, s.lo, c.lo)};
    const Pair<T> q = quotient(n, d);
    return q.hi + q.lo;
}
/// The shared scalar path for |x| > 2^20.
inline Angle<double> huge_angle(double x) {
    const ReducedAngle a = reduce_huge_angle(x);
    return {a.rest, static_cast<std::uint64_t>(a.quadrant)};
}
inline double sin_huge(double x) { return abs(x) < infinity ? sin_of_angle(huge_angle(x), 0) : quiet_nan; }
inline double cos_huge(double x) { return abs(x) < infinity ? sin_of_angle(huge_angle(x), 1) : quiet_nan; }
inline double tan_huge(double x) { return abs(x) < infinity ? tan_of_angle(huge_angle(x)) : quiet_nan; }

template <LaneType T>
inline auto is_huge_angle(T x) {
    return less(T(largest_fast_angle), abs(x));
}
/// Below 2^-28 the sine and the tangent are x to half an ulp; this keeps -0 and the denormals.
template <LaneType T>
inline T sin(T x) {
    const T r = select(less(abs(x), T(0x1p-28)), x, sin_of_angle(reduce_angle(x), 0));
    return patch(is_huge_angle(x), r, x, sin_huge);
}
template <LaneType T>
inline T cos(T x) {
    return patch(is_huge_angle(x), sin_of_angle(reduce_angle(x), 1), x, cos_huge);
}
template <LaneType T>
inline T tan(T x) {
    const T r = select(less(abs(x), T(0x1p-28)), x, tan_of_angle(reduce_angle(x)));
    return patch(is_huge_angle(x), r, x, tan_huge);
}

}  // namespace kernel
FREP_MATH_CLOSE
