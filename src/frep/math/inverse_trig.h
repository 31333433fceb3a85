// Kernels of atan2, atan, asin, acos: all are the angle of a point in the plane.
// Method: the smaller coordinate over the larger, above tan(pi/8) reduced by the addition theorem, the
// quotient in double length, a polynomial, and the octant's base angle in double length. Checked by
// tests/unit/math/kernels_test.cpp.
#pragma once

#include "frep/math/coefficients.h"
#include "frep/math/double_double.h"

FREP_MATH_OPEN
namespace kernel {

/// The angle in [0, pi] of (x, y) with y >= 0; sizes between 2^-500 and 2^500 unless y/|x| < 2^-60 (or the
/// other way round). `plain` is y/|x| (or |x|/y) in the original scale, used below 2^-60.
template <LaneType T>
inline T angle_of(Pair<T> x, Pair<T> y, T plain) {
    namespace c = coefficients;
    const auto left = less(x.hi, T(0.0));
    const Pair<T> ax = {select(left, -x.hi, x.hi), select(left, -x.lo, x.lo)};
    const auto steep = less(ax.hi, y.hi);
    const Pair<T> big = {select(steep, y.hi, ax.hi), select(steep, y.lo, ax.lo)};
    const Pair<T> small = {select(steep, ax.hi, y.hi), select(steep, ax.lo, y.lo)};
    // atan(s/b) = pi/4 + atan((s-b)/(b+s)).
    const auto turned = less(big.hi * c::tan_eighth_pi, small.hi);
    Pair<T> n = exact_sum(small.hi, -big.hi), d = exact_sum(big.hi, small.hi);
    n = {select(turned, n.hi, small.hi), select(turned, n.lo + (small.lo - big.lo), small.lo)};
    d = {select(turned, d.hi, big.hi), select(turned, d.lo + (small.lo + big.lo), big.lo)};
    Pair<T> q = quotient(n, d);
    const auto flat = less(plain, T(0x1p-60));
    q = {select(flat, plain, q.hi), select(flat, T(0.0), q.lo)};
    const T z = q.hi * q.hi;
    const T tail = q.lo + q.hi * z * polynomial(z, c::atan_tail);
    // Angle = base + direction * (q + tail): 0, pi/4, pi/2 above the axis, mirrored on the left.
    const T high = select(turned, T(c::quarter_pi_hi), select(steep, T(c::half_pi_hi), T(0.0)));
    const T low = select(turned, T(c::quarter_pi_lo), select(steep, T(c::half_pi_lo), T(0.0)));
    const T left_high =
        select(turned, T(c::three_quarter_pi_hi), select(steep, T(c::half_pi_hi), T(c::pi_hi)));
    const T left_low =
        select(turned, T(c::three_quarter_pi_lo), select(steep, T(c::half_pi_lo), T(c::pi_lo)));
    const auto backward = either(both(steep, !left), both(!steep, left));
    const T direction = select(backward, T(-1.0), T(1.0));
    const Pair<T> sum = exact_sum(select(left, left_high, high), direction * q.hi);
    return sum.hi + (sum.lo + (select(left, left_low, low) + direction * tail));
}
template <LaneType T>
inline T atan2(T y, T x) {
    T ay = abs(y), ax = abs(x);
    // Infinities become 1 against 0; the origin becomes (1, 0).
    const auto y_endless = equal(ay, T(infinity)), x_endless = equal(ax, T(infinity));
    const auto endless = either(y_endless, x_endless);
    ay = select(endless, select(y_endless, T(1.0), T(0.0)), ay);
    ax = select(endless, select(x_endless, T(1.0), T(0.0)), ax);
    ax = select(both(equal(ax, T(0.0)), equal(ay, T(0.0))), T(1.0), ax);
    const T big = select(less(ax, ay), ay, ax), small = select(less(ax, ay), ax, ay);
    const T plain = small / big;
    const T s =
        select(less(T(0x1p500), big), T(0x1p-600), select(less(big, T(0x1p-500)), T(0x1p600), T(1.0)));
    ax = select(less(x, T(0.0)), -ax, ax);
    const T r = angle_of<T>({ax * s, T(0.0)}, {ay * s, T(0.0)}, plain);
    const auto below = less(y, T(0.0));
    const T kept = select(both(equal(y, T(0.0)), !less(x, T(0.0))), y, r);
    return select(is_nan(x), x, select(is_nan(y), y, select(below, -r, kept)));
}
template <LaneType T>
inline T atan(T x) {
    const T a = abs(x);
    const auto steep = less(T(1.0), a);
    const T cut = select(less(T(0x1p100), a), T(0x1p100), a);
    const T r = angle_of<T>({T(1.0), T(0.0)}, {cut, T(0.0)}, select(steep, 1.0 / a, a));
    return select(is_nan(x), x, copy_sign(r, x));
}
/// sqrt(1 - x*x) in double length, NaN outside [-1, 1].
template <LaneType T>
inline Pair<T> co_sine(T x) {
    const Pair<T> p = exact_product(x, x);
    const Pair<T> s = fast_sum(T(1.0), -p.hi);
    const Pair<T> d = fast_sum(s.hi, s.lo - p.lo);
    const T root = sqrt(d.hi);
    const Pair<T> back = exact_product(root, root);
    const T rest = ((d.hi - back.hi) - back.lo + d.lo) / (2.0 * root);
    return {root, select(equal(root, T(0.0)), T(0.0), rest)};
}
template <LaneType T>
inline T asin(T x) {
    const T a = abs(x);
    const Pair<T> c = co_sine(x);
    const T r = angle_of<T>(c, {a, T(0.0)}, select(less(a, c.hi), a, T(1.0)));
    const T end = select(equal(a, T(1.0)), T(coefficients::half_pi_hi), r);
    return select(less_equal(a, T(1.0)), copy_sign(end, x), T(quiet_nan));
}
template <LaneType T>
inline T acos(T x) {
    const Pair<T> c = co_sine(x);
    const T r = angle_of<T>({x, T(0.0)}, c, T(1.0));
    return select(less_equal(abs(x), T(1.0)), r, T(quiet_nan));
}

}  // namespace kernel
FREP_MATH_CLOSE
