// hypot and the R-functions of the system R0 (Rvachev) in binary32, in a form whose sign is right for every
// pair of floats. Method: rule 6 of numerics.md with one square root and one quotient; the operands are
// scaled by a power of two first, so that no square overflows or vanishes. Checked by
// tests/unit/math/single_rfunctions_test.cpp.
#pragma once

#include "frep/math/rounding.h"

FREP_MATH_OPEN

/// The largest magnitude that an R-function of binary32 returns.
inline constexpr double single_r_limit = 1e18;

namespace single {

/// Powers of two that bring a magnitude to where it can be squared, and back.
template <SingleType T>
struct Scaling {
    T down, up;
    explicit Scaling(T size) {
        const auto large = less(T(0x1p60), size), small = less(size, T(0x1p-60));
        down = select(large, T(0x1p-70), select(small, T(0x1p100), T(1.0)));
        up = select(large, T(0x1p70), select(small, T(0x1p-100), T(1.0)));
    }
};
/// x limited to the finite numbers; any number for NaN.
template <SingleType T>
inline T limited(T x, double limit) {
    const T high = select(less(x, T(limit)), x, T(limit));
    return select(less(T(-limit), high), high, T(-limit));
}

}  // namespace single

/// sqrt(a*a + b*b) without overflow or underflow on the way. Error <= 2 ulp.
template <SingleType T>
inline T hypot(T a, T b) {
    const T x = abs(a), y = abs(b);
    const T size = select(less(x, y), y, x);
    const single::Scaling<T> scaling(size);
    const T u = x * scaling.down, v = y * scaling.down;
    const T r = select(equal(size, T(infinity)), size, sqrt(u * u + v * v) * scaling.up);
    return select(either(is_nan(a), is_nan(b)), T(quiet_nan), r);
}

/// R-conjunction f1 + f2 - sqrt(f1^2 + f2^2): sign(r_and(a,b)) = sign(min(a,b)). NaN if either is NaN;
/// saturated at +-single_r_limit. Error <= 4 ulp.
template <SingleType T>
inline T r_and(T a, T b) {
    constexpr double limit = Format<float>::max_finite;
    const auto swap = less(b, a);
    const T lo = single::limited(select(swap, b, a), limit), hi = single::limited(select(swap, a, b), limit);
    const T x = abs(lo), y = abs(hi);
    const single::Scaling<T> scaling(select(less(x, y), y, x));
    const T u = lo * scaling.down, v = hi * scaling.down;
    const T h = sqrt(u * u + v * v);
    // lo 2 hi/(hi + lo + h): no cancellation where hi > -lo
    const T inner = lo * ((v + v) / ((u + v) + h));
    const T outer = (lo + hi) - h * scaling.up;
    const T r = single::limited(select(less(-lo, hi), inner, outer), single_r_limit);
    return select(either(is_nan(a), is_nan(b)), T(quiet_nan), r);
}
/// R-disjunction f1 + f2 + sqrt(f1^2 + f2^2): sign(r_or(a,b)) = sign(max(a,b)). By De Morgan. Error <= 4 ulp.
template <SingleType T>
inline T r_or(T a, T b) {
    return -r_and(-a, -b);
}

FREP_MATH_CLOSE
