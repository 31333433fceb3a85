// Kernels of the distance-like family: SARDF intersection and fillets (Fayolle, Pasko, Schmitt and Mirenkov
// 2006), distance to an ellipsoid (Eberly 2013, with a secular equation), Fourier sawtooth. Iterations are
// bounded; their derivatives are analytic. Intervals use that the operations are monotone. Tested by
// tests/unit/shapes/distance_test.cpp.
#pragma once

#include "frep/field/kernels/ellipsoid.h"
#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace distance_detail {

/// min(x, y) with a circular fillet of radius r where |x - y| <= r.
template <class T>
T fillet(T x, T y, T r) {
    const T apart = x - y;
    const T rounded = 0.5 * ((x + y - 2.0 * r) + math::sqrt(2.0 * math::square(r) - math::square(apart)));
    const T value = math::select(math::less_equal(math::abs(apart), r), rounded, math::min(x, y));
    return math::select(math::is_nan(r), r, value);
}

/// 0 that moves with `a`: the derivatives of `a` at the value 0.
template <class T>
T moving_zero(T a) {
    if constexpr (is_dual<T>) {
        return T(zero<decltype(a.value)>(), a.d);
    } else {
        return zero<T>();
    }
}

/// The m whose level circle passes (x, y) with its near arc. In units of R the level set of value m^2 is a
/// circle of centre (2m, 2m) and radius 2m - m^2, and the gap to it falls with m and is concave: Newton from
/// above; it stops where it stops falling, which is the same for a lane alone and in company.
template <class T>
T level_root(T x, T y) {
    const T nought = zero<T>();
    const T guess = 0.5 * ((x + y) + math::sqrt(2.0 * x * y));
    T m = math::min(math::sqrt(math::min(x, y)), guess);
    for (int step = 0; step < 60; ++step) {
        const T u = 2.0 * m - x, v = 2.0 * m - y, distance = math::hypot(u, v);
        const T slope = 2.0 - 2.0 * m - 2.0 * (u + v) / distance;
        const T next = m - (m * (2.0 - m) - distance) / slope;
        const auto falls = math::both(math::less(next, m), math::less(nought, next));
        if (!math::any(falls)) break;
        m = math::select(falls, next, m);
    }
    return m;
}
/// dm/dx = G_x / -G_m, from one Newton step with the derivative of G held.
template <class T>
math::Dual<T> level_root(math::Dual<T> x, math::Dual<T> y) {
    const T m = level_root(x.value, y.value);
    const T u = 2.0 * m - x.value, v = 2.0 * m - y.value, distance = math::hypot(u, v);
    const T fall = 2.0 * (u + v) / distance + 2.0 * m - 2.0;
    return math::chain(m, u / distance / fall, x, v / distance / fall, y);
}

/// Inside corner, both operands positive.
template <class T>
T sardf_inner(T x, T y, T r) {
    const T four_r = 4.0 * r, two_r = 2.0 * r;
    const T px = math::square(x) / four_r, py = math::square(y) / four_r;
    const T scaled_x = x / r, scaled_y = y / r;
    const T m = level_root(scaled_x, scaled_y);
    T corner = r * math::square(m);
    corner = math::select(math::less(y, px), y, math::select(math::less(x, py), x, corner));
    const auto close = math::both(math::less_equal(x, two_r), math::less_equal(y, two_r));
    const auto outside_circle =
        math::less_equal(math::square(r), math::square(x - two_r) + math::square(y - two_r));
    const auto zone = math::either(math::either(math::less_equal(x, r), math::less_equal(y, r)),
                                   math::both(close, outside_circle));
    return math::select(zone, corner, fillet(x, y, r));
}

/// Outside corner, both operands negative: a sector rounded by circles about the corner.
template <class T>
T sardf_outer(T x, T y, T alpha) {
    const T t = math::tan(alpha), q = x / y;
    const T b = -2.0 * t * (x + y), c = math::square(x) + math::square(y);
    const T p = 1.0 - math::square(t) - 2.0 * t;
    const T sector = -2.0 * c / (b + math::sqrt(math::square(b) + 4.0 * p * c));
    const T upper = 1.0 / (t + 0.0);  // +inf for both zeros
    return math::select(math::less_equal(upper, q), x, math::select(math::less_equal(q, t), y, sector));
}

template <class T>
T sardf(T x, T y, T r, T alpha) {
    const T nought = zero<T>(), tiny = math::constant<T>(1e-7);
    const auto zero_x = math::less(math::abs(x), tiny), zero_y = math::less(math::abs(y), tiny);
    const auto above_x = math::less(nought, x), above_y = math::less(nought, y);
    const T inner = sardf_inner(x, y, r), outer = sardf_outer(x, y, alpha);
    T value = math::select(above_x, math::select(above_y, inner, y), math::select(above_y, x, outer));
    const T at_x = math::select(above_y, moving_zero(x), y);
    const T at_y = math::select(above_x, moving_zero(y), x);
    value = math::select(zero_x, at_x, math::select(zero_y, at_y, value));
    value = math::select(math::both(zero_x, zero_y), moving_zero(x + y), value);
    return defined_with(value, x, y, r, alpha);
}

/// Operands up to this size overflow nowhere.
inline constexpr double ordinary = 0x1p300;

/// What the value loses by rounding, relative to itself and the radius: the root of the sector between
/// negative operands is of 0 at tan(alpha) = 1. Infinite where rounding may make it undefined.
inline double sardf_loss(bool outer, double alpha) {
    const double t = math::tan(alpha), apart = outer && t < 1.0 ? 1.0 - t : 1.0;
    return apart < 1e-6 ? math::infinity : 0x1p-46 / math::min(apart, 1.0);
}

/// Range where both operands may be negative, from the values at the corners, for one angle, or several in
/// 0..0.78. For 0 <= tan(alpha) < 1 the sector rounds the minimum, at most to the distance from the corner;
/// for others the value is one of x and y, and not even continuous.
inline Interval with_sector(Interval corners, Interval x, Interval y, Interval alpha) {
    const double x_lo = x.lo, y_lo = y.lo, x_hi = math::min(x.hi, 0.0), y_hi = math::min(y.hi, 0.0);
    if (!is_point(alpha)) {
        const double least = -math::hypot(x_lo, y_lo), most = math::min(x_hi, y_hi);
        return {math::min(corners.lo, least), math::max(corners.hi, most)};
    }
    const double t = math::tan(alpha.lo);
    if (t >= 0.0 && t < 1.0) return corners;
    return {math::min(corners.lo, math::min(x_lo, y_lo)), math::max(corners.hi, math::max(x_hi, y_hi))};
}

}  // namespace distance_detail

template <class T>
T sardf_int(T x, T y, T r, T alpha) {
    return distance_detail::sardf(x, y, r, alpha);
}

/// Grows with both operands, between negative ones if 0 <= tan(alpha) < 1, and falls with the radius (one
/// below 0 rounds nothing, as 0 does).
inline Interval sardf_int(Interval x, Interval y, Interval r, Interval alpha) {
    using namespace distance_detail;
    if (any_empty(x, y, r, alpha)) return Interval::empty();
    const bool outer = x.lo < 0.0 && y.lo < 0.0;
    if (r.hi > ordinary || !within(ordinary, alpha)) return unknown();
    if (outer && !within(ordinary, x, y)) return unknown();
    if (outer && !is_point(alpha) && !(alpha.lo >= 0.0 && alpha.hi < 0.78)) return unknown();
    const double low = sardf(x.lo, y.lo, r.hi, alpha.lo), high = sardf(x.hi, y.hi, r.lo, alpha.lo);
    const double loss = sardf_loss(outer, alpha.hi);
    if (low != low || high != high || !(loss < 1.0)) return unknown();
    const Interval range = outer ? with_sector({low, high}, x, y, alpha) : Interval(low, high);
    const double radius = r.hi > 0.0 ? r.hi : 0.0;
    const auto pad = [&](double v) { return v == 0.0 ? 0.0 : loss * (math::abs(v) + radius); };
    return padded(range.lo, pad(range.lo), range.hi, pad(range.hi), any_flagged(x, y, r, alpha));
}

template <class T>
T sardf_blend(T x, T y, T r) {
    return distance_detail::fillet(x, y, r);
}
/// Grows with both operands and falls with the radius; one below 0 is no fillet, as 0 is.
inline Interval sardf_blend(Interval x, Interval y, Interval r) {
    using namespace distance_detail;
    if (any_empty(x, y, r)) return Interval::empty();
    if (r.hi > ordinary) return unknown();
    double low = fillet(x.lo, y.lo, r.hi), high = fillet(x.hi, y.hi, r.lo);
    if (low != low || high != high) return unknown();
    constexpr double half = 0.5 * math::max_finite;  // beyond it x + y overflows
    if (x.hi > half && y.hi > half) high = math::infinity;
    if (x.lo < -half && y.lo < -half) low = -math::infinity;
    const double radius = r.hi > 0.0 ? r.hi : 0.0;
    return padded(low, 0x1p-48 * (math::abs(low) + radius), high, 0x1p-48 * (math::abs(high) + radius),
                  any_flagged(x, y, r));
}

/// Terms beyond this number make the sawtooth undefined.
inline constexpr int most_sawtooth_terms = 10'000;

/// (1/2 - sum over i = 1..n-1 of sin(2 pi i f t)/i) 2/(a pi); 0 for n <= 1.
template <class T>
T sawtooth(T t, T n, T a, T f) {
    T sum = zero<T>();
    const T turns = f * t, last = n - 0.5;
    for (int i = 1; i <= most_sawtooth_terms; ++i) {
        const auto counts = math::less(math::constant<T>(i), last);
        if (!can_hold(counts)) break;
        const T term = math::sin(2.0 * math::pi * i * turns) / static_cast<double>(i);
        sum += math::select(counts, term, zero<T>());
    }
    const T value = (0.5 - sum) * 2.0 / (a * math::pi);
    const auto too_many = math::less(math::constant<T>(most_sawtooth_terms + 1.0), n);
    const T checked = math::select(math::less_equal(n, one<T>()), zero<T>(), value);
    return math::select(math::either(too_many, any_nan(t, n, a, f)), math::constant<T>(math::quiet_nan),
                        checked);
}

}  // namespace frep::kernels
