// Forward derivatives in three directions over double or lanes: Dual<T>. Gradients are total (numerics.md,
// rule 7): local partials are finite (NaN becomes 0, magnitudes are clamped to DBL_MAX) and sums saturate, so
// that d holds no NaN. Method: the chain rule. Checked by tests/unit/math/dual_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "frep/math/rfunctions.h"

FREP_MATH_OPEN

/// A value and its derivatives along three directions (usually x, y, z).
template <class T>
struct Dual {
    T value = T(0.0);
    std::array<T, 3> d = {T(0.0), T(0.0), T(0.0)};

    Dual() = default;
    /// A constant.
    Dual(double c) : value(c) {}
    explicit Dual(T v) requires(!std::is_same_v<T, double>) : value(v) {}
    Dual(T v, std::array<T, 3> partials) : value(v), d(partials) {}
    /// The variable with value v that moves along `direction` (0, 1 or 2).
    static Dual variable(T v, int direction) {
        Dual r;
        r.value = v;
        r.d[static_cast<std::size_t>(direction)] = T(1.0);
        return r;
    }
};
template <class T>
struct MaskOf<Dual<T>> {
    using type = mask_t<T>;
};

/// x clamped to the largest finite numbers, and 0 for NaN: a finite number whatever comes in.
template <AnyLaneType T>
inline T finite(T x) {
    const T most(format_of<T>::max_finite);
    const T low = select(less(x, -most), -most, x);
    const T both = select(less(most, low), most, low);
    return select(is_nan(x), T(0.0), both);
}
/// The chain rule for f(a): value f, local partial fa.
template <class T>
inline Dual<T> chain(T f, T fa, const Dual<T>& a) {
    fa = finite(fa);
    return {f, {finite(fa * a.d[0]), finite(fa * a.d[1]), finite(fa * a.d[2])}};
}
/// The chain rule for f(a, b): value f, local partials fa and fb.
template <class T>
inline Dual<T> chain(T f, T fa, const Dual<T>& a, T fb, const Dual<T>& b) {
    fa = finite(fa);
    fb = finite(fb);
    Dual<T> r;
    r.value = f;
    for (std::size_t i = 0; i < 3; ++i) {
        r.d[i] = finite(finite(fa * a.d[i]) + finite(fb * b.d[i]));
    }
    return r;
}

template <class T>
inline mask_t<T> less(const Dual<T>& a, const Dual<T>& b) {
    return less(a.value, b.value);
}
template <class T>
inline mask_t<T> less_equal(const Dual<T>& a, const Dual<T>& b) {
    return less_equal(a.value, b.value);
}
template <class T>
inline mask_t<T> equal(const Dual<T>& a, const Dual<T>& b) {
    return equal(a.value, b.value);
}
template <class T>
inline mask_t<T> is_nan(const Dual<T>& a) {
    return is_nan(a.value);
}
namespace dual_detail {
template <class T, class M>
inline Dual<T> pick(M m, const Dual<T>& a, const Dual<T>& b) {
    return {select(m, a.value, b.value),
            {select(m, a.d[0], b.d[0]), select(m, a.d[1], b.d[1]), select(m, a.d[2], b.d[2])}};
}
}  // namespace dual_detail
/// Value and derivatives by the mask.
inline Dual<double> select(bool m, const Dual<double>& a, const Dual<double>& b) {
    return dual_detail::pick(m, a, b);
}
template <class E, int N>
inline Dual<LanesOf<E, N>> select(LaneMaskOf<E, N> m, const Dual<LanesOf<E, N>>& a,
                                  const Dual<LanesOf<E, N>>& b) {
    return dual_detail::pick(m, a, b);
}

template <class T>
inline Dual<T> operator+(const Dual<T>& a, const Dual<T>& b) {
    return chain(a.value + b.value, T(1.0), a, T(1.0), b);
}
template <class T>
inline Dual<T> operator-(const Dual<T>& a, const Dual<T>& b) {
    return chain(a.value - b.value, T(1.0), a, T(-1.0), b);
}
template <class T>
inline Dual<T> operator-(const Dual<T>& a) {
    return {-a.value, {-a.d[0], -a.d[1], -a.d[2]}};
}
template <class T>
inline Dual<T> operator*(const Dual<T>& a, const Dual<T>& b) {
    return chain(a.value * b.value, b.value, a, a.value, b);
}
template <class T>
inline Dual<T> operator/(const Dual<T>& a, const Dual<T>& b) {
    const T q = a.value / b.value;
    return chain(q, 1.0 / b.value, a, -(q / b.value), b);
}
template <class T>
inline Dual<T>& operator+=(Dual<T>& a, const Dual<T>& b) {
    return a = a + b;
}
template <class T>
inline Dual<T>& operator-=(Dual<T>& a, const Dual<T>& b) {
    return a = a - b;
}
template <class T>
inline Dual<T>& operator*=(Dual<T>& a, const Dual<T>& b) {
    return a = a * b;
}
template <class T>
inline Dual<T>& operator/=(Dual<T>& a, const Dual<T>& b) {
    return a = a / b;
}

template <class T>
inline Dual<T> square(const Dual<T>& a) {
    return chain(square(a.value), 2.0 * a.value, a);
}
/// Derivative 0 at 0.
template <class T>
inline Dual<T> sqrt(const Dual<T>& a) {
    const T r = sqrt(a.value);
    return chain(r, select(equal(r, T(0.0)), T(0.0), 0.5 / r), a);
}
/// Derivative 0 at 0.
template <class T>
inline Dual<T> abs(const Dual<T>& a) {
    return chain(abs(a.value), sign(a.value), a);
}
/// Steps: derivative 0 everywhere.
template <class T>
inline Dual<T> sign(const Dual<T>& a) {
    return Dual<T>(sign(a.value), {T(0.0), T(0.0), T(0.0)});
}
template <class T>
inline Dual<T> floor(const Dual<T>& a) {
    return Dual<T>(floor(a.value), {T(0.0), T(0.0), T(0.0)});
}
template <class T>
inline Dual<T> ceil(const Dual<T>& a) {
    return Dual<T>(ceil(a.value), {T(0.0), T(0.0), T(0.0)});
}
template <class T>
inline Dual<T> trunc(const Dual<T>& a) {
    return Dual<T>(trunc(a.value), {T(0.0), T(0.0), T(0.0)});
}
template <class T>
inline Dual<T> round_half_up(const Dual<T>& a) {
    return Dual<T>(round_half_up(a.value), {T(0.0), T(0.0), T(0.0)});
}
/// d/da = 1, d/db = -trunc(a/b).
template <class T>
inline Dual<T> remainder_trunc(const Dual<T>& a, const Dual<T>& b) {
    return chain(remainder_trunc(a.value, b.value), T(1.0), a, -trunc(a.value / b.value), b);
}
/// The derivative of the smaller (larger) one; 1/2 of each at a tie.
template <class T>
inline Dual<T> min(const Dual<T>& a, const Dual<T>& b) {
    const T fa = select(less(a.value, b.value), T(1.0), select(equal(a.value, b.value), T(0.5), T(0.0)));
    return chain(min(a.value, b.value), fa, a, 1.0 - fa, b);
}
template <class T>
inline Dual<T> max(const Dual<T>& a, const Dual<T>& b) {
    const T fa = select(less(b.value, a.value), T(1.0), select(equal(a.value, b.value), T(0.5), T(0.0)));
    return chain(max(a.value, b.value), fa, a, 1.0 - fa, b);
}

FREP_MATH_CLOSE

#include "frep/math/dual_functions.h"
