// Kernels of sinh, cosh, tanh. Method: e^x - 1 in double length from the parts of exp; above 22 half of e^x.
// Checked by tests/unit/math/kernels_test.cpp.
#pragma once

#include "frep/math/exp_log.h"

FREP_MATH_OPEN
namespace kernel {

/// 2^k for 0 <= k <= 1000.
template <LaneType T>
inline T power_of_two(word_t<T> k) {
    return float_of<T>((k + std::uint64_t{1023}) << 52);
}
/// e^x - 1 = 2^k - 1 + 2^k (r + tail) for 0 <= x <= 44, normalised.
template <LaneType T>
inline Pair<T> exp_minus_one(T x) {
    const ExpParts<T> e = exp_parts(x, T(0.0));
    const T p = power_of_two<T>(e.k);
    const Pair<T> s = exact_sum(p - 1.0, p * e.r);
    return fast_sum(s.hi, s.lo + p * e.tail);
}
/// e^x / 2 for x > 22.
template <LaneType T>
inline T half_exp(T x) {
    const ExpParts<T> e = exp_parts(select(less(T(712.0), x), T(712.0), x), T(0.0));
    return scale(one_plus(e), e.k - std::uint64_t{1});
}
/// 1 + u in double length.
template <LaneType T>
inline Pair<T> add_one(Pair<T> u) {
    const Pair<T> s = exact_sum(T(1.0), u.hi);
    return {s.hi, s.lo + u.lo};
}
template <LaneType T>
inline T sinh(T x) {
    const T a = abs(x);
    const auto large = less(T(22.0), a);
    const Pair<T> u = exp_minus_one(select(large, T(22.0), a));
    const Pair<T> q = quotient(u, add_one(u));
    const Pair<T> s = exact_sum(u.hi, q.hi);
    const T near = 0.5 * (s.hi + (s.lo + (u.lo + q.lo)));
    return copy_sign(select(large, half_exp(a), near), x);
}
template <LaneType T>
inline T cosh(T x) {
    const T a = abs(x);
    const auto large = less(T(22.0), a);
    const Pair<T> e = add_one(exp_minus_one(select(large, T(22.0), a)));
    const Pair<T> q = quotient<T>({T(1.0), T(0.0)}, e);
    const Pair<T> s = exact_sum(e.hi, q.hi);
    const T near = 0.5 * (s.hi + (s.lo + (e.lo + q.lo)));
    return select(large, half_exp(a), near);
}
template <LaneType T>
inline T tanh(T x) {
    const T a = abs(x);
    const Pair<T> u = exp_minus_one(2.0 * select(less(T(22.0), a), T(22.0), a));
    const Pair<T> s = exact_sum(u.hi, T(2.0));
    const Pair<T> q = quotient<T>(u, {s.hi, s.lo + u.lo});
    return copy_sign(q.hi + q.lo, x);
}

}  // namespace kernel
FREP_MATH_CLOSE
