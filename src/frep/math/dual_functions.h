// Derivatives of the elementary functions and of the R-functions for Dual<T>; included by dual.h.
// Method: the chain rule with total partials (numerics.md, rule 7). Checked by tests/unit/math/dual_test.cpp.
#pragma once

#include "frep/math/dual.h"

FREP_MATH_OPEN

template <class T>
inline Dual<T> exp(const Dual<T>& a) {
    const T f = exp(a.value);
    return chain(f, f, a);
}
template <class T>
inline Dual<T> log(const Dual<T>& a) {
    return chain(log(a.value), 1.0 / a.value, a);
}
template <class T>
inline Dual<T> log10(const Dual<T>& a) {
    return chain(log10(a.value), T(0x1.bcb7b1526e50ep-2) / a.value, a);
}
template <class T>
inline Dual<T> sin(const Dual<T>& a) {
    return chain(sin(a.value), cos(a.value), a);
}
template <class T>
inline Dual<T> cos(const Dual<T>& a) {
    return chain(cos(a.value), -sin(a.value), a);
}
template <class T>
inline Dual<T> tan(const Dual<T>& a) {
    const T f = tan(a.value);
    return chain(f, 1.0 + f * f, a);
}
/// Derivative DBL_MAX (asin) and -DBL_MAX (acos) at +-1.
template <class T>
inline Dual<T> asin(const Dual<T>& a) {
    return chain(asin(a.value), 1.0 / sqrt((1.0 - a.value) * (1.0 + a.value)), a);
}
template <class T>
inline Dual<T> acos(const Dual<T>& a) {
    return chain(acos(a.value), -1.0 / sqrt((1.0 - a.value) * (1.0 + a.value)), a);
}
template <class T>
inline Dual<T> atan(const Dual<T>& a) {
    return chain(atan(a.value), 1.0 / (1.0 + a.value * a.value), a);
}
template <class T>
inline Dual<T> sinh(const Dual<T>& a) {
    return chain(sinh(a.value), cosh(a.value), a);
}
template <class T>
inline Dual<T> cosh(const Dual<T>& a) {
    return chain(cosh(a.value), sinh(a.value), a);
}
template <class T>
inline Dual<T> tanh(const Dual<T>& a) {
    const T c = cosh(a.value);
    return chain(tanh(a.value), (1.0 / c) / c, a);
}

namespace dual_detail {
/// A pair scaled onto the unit circle: (a, b)/hypot(a, b); (0, 0) stays (0, 0), infinities count as equal.
template <AnyLaneType T>
inline void unit_pair(T a, T b, T& u, T& v, T& length) {
    const T m = select(less(abs(a), abs(b)), abs(b), abs(a));
    const auto endless = equal(m, T(infinity));
    const auto nought = equal(m, T(0.0));
    const T p = select(endless, select(equal(abs(a), m), copy_sign(T(1.0), a), T(0.0)), a / m);
    const T q = select(endless, select(equal(abs(b), m), copy_sign(T(1.0), b), T(0.0)), b / m);
    const T h = sqrt(p * p + q * q);
    u = select(nought, T(0.0), p / h);
    v = select(nought, T(0.0), q / h);
    length = select(nought, T(0.0), m * h);
}
/// 1 - u for a point (u, v) of the unit circle, without cancellation.
template <AnyLaneType T>
inline T one_minus(T u, T v) {
    return select(less(T(0.0), u), v * v / (1.0 + u), 1.0 - u);
}
}  // namespace dual_detail

/// Partials x/h, y/h; 0 at the origin.
template <class T>
inline Dual<T> hypot(const Dual<T>& a, const Dual<T>& b) {
    T u, v, h;
    dual_detail::unit_pair(a.value, b.value, u, v, h);
    return chain(hypot(a.value, b.value), u, a, v, b);
}
/// Partials x/h^2 for y and -y/h^2 for x; 0 at the origin.
template <class T>
inline Dual<T> atan2(const Dual<T>& y, const Dual<T>& x) {
    T u, v, h;
    dual_detail::unit_pair(y.value, x.value, u, v, h);
    return chain(atan2(y.value, x.value), select(equal(h, T(0.0)), T(0.0), v / h), y,
                 select(equal(h, T(0.0)), T(0.0), -u / h), x);
}
/// Derivative n x^(n-1).
template <class T>
inline Dual<T> powi(const Dual<T>& a, int n) {
    const T fa = n == 0 ? T(0.0) : static_cast<double>(n) * powi(a.value, n - 1);
    return chain(powi(a.value, n), fa, a);
}
/// Partials e b^(e-1) (0 where b counts as 0) and b^e ln b (0 where b <= 0).
template <class T>
inline Dual<T> pow(const Dual<T>& b, const Dual<T>& e) {
    const T f = pow(b.value, e.value);
    const T whole = floor(e.value);
    const T n = select(less(e.value - whole, T(1e-6)), whole, e.value);
    const T fb = select(less(abs(b.value), T(1e-6)), T(0.0), n * pow(b.value, n - 1.0));
    const T fe = select(less(b.value, T(1e-6)), T(0.0), f * log(b.value));
    return chain(f, fb, b, fe, e);
}
/// Partials 1 - a/h and 1 - b/h with h = hypot(a, b); both 1 at the origin. Finite for infinities too.
template <class T>
inline Dual<T> r_and(const Dual<T>& a, const Dual<T>& b) {
    T u, v, h;
    dual_detail::unit_pair(a.value, b.value, u, v, h);
    return chain(r_and(a.value, b.value), dual_detail::one_minus(u, v), a, dual_detail::one_minus(v, u), b);
}
template <class T>
inline Dual<T> r_or(const Dual<T>& a, const Dual<T>& b) {
    T u, v, h;
    dual_detail::unit_pair(a.value, b.value, u, v, h);
    return chain(r_or(a.value, b.value), dual_detail::one_minus(-u, v), a, dual_detail::one_minus(-v, u), b);
}

FREP_MATH_CLOSE
