// Kernels of pow and powi. Method: rule 8 of numerics.md; repeated squaring for integers, e^(y ln|x|) with
// the logarithm and the product in double length for the rest. Checked by tests/unit/math/power_test.cpp.
#pragma once

#include "frep/math/exp_log.h"

FREP_MATH_OPEN
namespace kernel {

/// Integer exponents up to this size take the chain of products.
inline constexpr double longest_chain = 1024.0;
/// Bases below this size count as 0, and exponents this little above an integer as that integer.
inline constexpr double power_snap = 1e-6;

template <LaneType T>
inline T powi(T x, int n) {
    unsigned rest = n < 0 ? 0u - static_cast<unsigned>(n) : static_cast<unsigned>(n);
    if (rest == 0) return select(is_nan(x), x, T(1.0));
    T factor = x;
    for (; (rest & 1u) == 0; rest >>= 1) factor = factor * factor;
    T r = factor;
    for (rest >>= 1; rest != 0; rest >>= 1) {
        factor = factor * factor;
        if ((rest & 1u) != 0) r = r * factor;
    }
    return n < 0 ? 1.0 / r : r;
}
/// The exponent that counts: floor(e) if e is less than 1e-6 above it.
template <LaneType T>
inline T snapped_exponent(T e) {
    const T whole = floor(e);
    return select(less(e - whole, T(power_snap)), whole, e);
}
/// |b|^e by exponential and logarithm, for |b| >= 1e-6.
template <LaneType T>
inline T power_of_size(T size, T e) {
    const Pair<T> l = log_pair(size);
    const T log_high = select(equal(size, T(infinity)), size, l.hi);
    const T p = e * log_high;
    const Pair<T> q = exact_product(e, l.hi);
    const T low = select(less(abs(p), T(1000.0)), q.lo + e * l.lo, T(0.0));
    return exp_of_pair<T>({p, low});
}
/// The value where |b| counts as 0.
template <LaneType T>
inline T power_of_zero(T n) {
    const T r = select(less(T(0.0), n), T(0.0), select(less(n, T(0.0)), T(infinity), T(quiet_nan)));
    return select(is_nan(n), n, r);
}
/// pow for every exponent that does not take the chain.
template <LaneType T>
inline T pow_general(T b, T e) {
    const T n = snapped_exponent(e);
    const T half = 0.5 * n;
    const auto whole = equal(floor(n), n);
    const auto odd = both(whole, !equal(floor(half), half));
    const T r = power_of_size(abs(b), n);
    const T negative = select(odd, -r, select(whole, r, T(quiet_nan)));
    const T sized = select(less(b, T(0.0)), negative, r);
    const T value = select(less(abs(b), T(power_snap)), power_of_zero(n), sized);
    return select(is_nan(b), b, select(equal(n, T(0.0)), select(is_nan(value), value, T(1.0)), value));
}
/// True where pow goes through powi.
template <LaneType T>
inline mask_t<T> takes_chain(T e) {
    const T n = snapped_exponent(e);
    return both(equal(floor(n), n), less_equal(abs(n), T(longest_chain)));
}
/// The chain, with the rule for small bases. Scalar: the path shared by all widths.
inline double pow_chain(double b, double e) {
    const double n = snapped_exponent(e);
    if (abs(b) < power_snap) return power_of_zero(n);
    return powi(b, static_cast<int>(n));
}
inline double pow(double b, double e) { return takes_chain(e) ? pow_chain(b, e) : pow_general(b, e); }
template <int N>
inline LanesN<N> pow(LanesN<N> b, LanesN<N> e) {
    using T = LanesN<N>;
    if (all(equal(e, T(2.0)))) return select(less(abs(b), T(power_snap)), T(0.0), b * b);  // the chain of 2
    const auto chain = takes_chain(e);
    if (all(chain)) {
        const T n = snapped_exponent(e);
        if (all(equal(n, T(n[0])))) {
            const T r = powi(b, static_cast<int>(n[0]));
            return select(less(abs(b), T(power_snap)), power_of_zero(n), r);
        }
    }
    return patch(chain, pow_general(b, e), b, e, pow_chain);
}

}  // namespace kernel
FREP_MATH_CLOSE
