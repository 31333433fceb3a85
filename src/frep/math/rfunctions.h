// R-functions of the system R0 (Rvachev), in a form whose sign is right for every pair of doubles.
// Method: rule 6 of numerics.md. Checked by tests/unit/math/rfunctions_test.cpp.
#pragma once

#include "frep/math/functions.h"

FREP_MATH_OPEN

/// The largest magnitude that an R-function returns: deep folds can then neither overflow nor turn to NaN.
inline constexpr double r_limit = 1e150;

/// sqrt(x*x + y*y) for hi >= lo >= 0, scaled by a power of two: the formula behind hypot. Error <= 2 ulp.
template <LaneType T>
inline T hypot_ordered(T hi, T lo) {
    const auto large = less(T(0x1p500), hi), small = less(hi, T(0x1p-500));
    const T down = select(large, T(0x1p-600), select(small, T(0x1p600), T(1.0)));
    const T up = select(large, T(0x1p600), select(small, T(0x1p-600), T(1.0)));
    const T a = hi * down, b = lo * down;
    return sqrt(a * a + b * b) * up;
}

/// R-conjunction f1 + f2 - sqrt(f1^2 + f2^2), the intersection of solids: sign(r_and(a,b)) = sign(min(a,b)).
/// NaN if either is NaN; saturated at +-r_limit. Error <= 4 ulp.
template <LaneType T>
inline T r_and(T a, T b) {
    const auto swap = less(b, a);
    const T lo = select(swap, b, a), hi = select(swap, a, b);
    const T q = lo / hi;
    const T inner = lo * (2.0 / (1.0 + q + sqrt(1.0 + q * q)));
    const auto turned = less(abs(lo), abs(hi));
    const T big = select(turned, abs(hi), abs(lo)), little = select(turned, abs(lo), abs(hi));
    const T outer = lo + hi - hypot_ordered(big, little);
    T r = select(less(-lo, hi), inner, outer);
    r = select(equal(lo, T(infinity)), T(r_limit), r);
    r = select(equal(lo, T(-infinity)), T(-r_limit), r);
    r = select(less(T(r_limit), r), T(r_limit), select(less(r, T(-r_limit)), T(-r_limit), r));
    return select(is_nan(a), a, select(is_nan(b), b, r));
}
/// R-disjunction f1 + f2 + sqrt(f1^2 + f2^2), the union of solids: sign(r_or(a,b)) = sign(max(a,b)). By
/// De Morgan -r_and(-a,-b). Error <= 4 ulp.
template <LaneType T>
inline T r_or(T a, T b) {
    return -r_and(-a, -b);
}

FREP_MATH_CLOSE
