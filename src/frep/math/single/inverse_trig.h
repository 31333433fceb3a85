// Kernels of atan2 and atan in binary32: the angle of a point in the plane. Method: the smaller coordinate
// over the larger, above tan(pi/8) reduced by the addition theorem, a polynomial, the base angle of the
// octant in two floats. Checked by tests/unit/math/single_functions_test.cpp.
#pragma once

#include "frep/math/double_double.h"
#include "frep/math/functions.h"
#include "frep/math/single/coefficients.h"

FREP_MATH_OPEN
namespace single {

/// The angle in [0, pi] of (x, y), or of (-x, y) where `left` holds; x, y >= 0, not both 0 or infinite.
template <SingleType T>
inline T angle_of(T x, T y, mask_t<T> left) {
    namespace c = coefficients;
    const auto steep = less(x, y);
    const T large = select(steep, y, x), little = select(steep, x, y);
    const T down = select(less(T(0x1p125), large), T(0.25), T(1.0));  // the sum shall not overflow
    const T big = large * down, small = little * down;
    // atan(s/b) = pi/4 + atan((s-b)/(b+s))
    const auto turned = less(big * c::tan_eighth_pi, small);
    const T q = select(turned, small - big, small) / select(turned, big + small, big);
    const T z = q * q;
    const T tail = q * (z * polynomial(z, c::atan_tail));
    // angle = base + direction * (q + tail): 0, pi/4, pi/2 above the axis, mirrored on the left
    const T high = select(turned, T(c::quarter_pi_hi), select(steep, T(c::half_pi_hi), T(0.0)));
    const T low = select(turned, T(c::quarter_pi_lo), select(steep, T(c::half_pi_lo), T(0.0)));
    const T left_high =
        select(turned, T(c::three_quarter_pi_hi), select(steep, T(c::half_pi_hi), T(c::pi_hi)));
    const T left_low =
        select(turned, T(c::three_quarter_pi_lo), select(steep, T(c::half_pi_lo), T(c::pi_lo)));
    const auto backward = either(both(steep, !left), both(!steep, left));
    const Pair<T> sum = exact_sum(select(left, left_high, high), select(backward, -q, q));
    return sum.hi + (sum.lo + (select(left, left_low, low) + select(backward, -tail, tail)));
}

}  // namespace single

/// The angle of the point (x = b, y = a) in (-pi, pi]. Zeros have no sign here: (y = +-0, x < 0) is pi, and
/// (+-0, +-0) is the zero y. Error <= 3 ulp (found: 1.96).
template <SingleType T>
inline T atan2(T y, T x) {
    const T size_y = abs(y), size_x = abs(x);
    // infinities become 1 against 0; the origin becomes (1, 0)
    const auto y_endless = equal(size_y, T(infinity)), x_endless = equal(size_x, T(infinity));
    const auto endless = either(y_endless, x_endless);
    const T v = select(endless, select(y_endless, T(1.0), T(0.0)), size_y);
    const T u = select(endless, select(x_endless, T(1.0), T(0.0)), size_x);
    const auto origin = both(equal(u, T(0.0)), equal(v, T(0.0)));
    const auto left = less(x, T(0.0));
    const T r = single::angle_of(select(origin, T(1.0), u), v, left);
    const T kept = select(both(equal(y, T(0.0)), !left), y, r);
    const T value = select(less(y, T(0.0)), -r, kept);
    return select(either(is_nan(x), is_nan(y)), T(quiet_nan), value);
}
/// Inverse tangent in [-pi/2, pi/2]. Error <= 2 ulp.
template <SingleType T>
inline T atan(T x) {
    const T size = abs(x);
    const auto endless = equal(size, T(infinity));
    const T y = select(endless, T(1.0), size);
    return copy_sign(single::angle_of(select(endless, T(0.0), T(1.0)), y, less(T(0.0), T(0.0))), x);
}

FREP_MATH_CLOSE
