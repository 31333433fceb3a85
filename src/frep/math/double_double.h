// Sums and products with their rounding errors, and polynomials: the tools of the kernels.
// Method: T. J. Dekker, "A floating-point technique for extending the available precision" (1971), and
// D. E. Knuth's branch-free sum; the split cuts the low 27 bits, so a product of two low parts may lose one
// bit (relative 2^-103). Checked by tests/unit/math/kernels_test.cpp.
#pragma once

#include <cstddef>

#include "frep/math/rounding.h"

FREP_MATH_OPEN

/// The unevaluated sum hi + lo.
template <class T>
struct Pair {
    T hi, lo;
};

/// a + b and its exact error, for |a| >= |b| or a = 0.
template <class T>
inline Pair<T> fast_sum(T a, T b) {
    const T s = a + b;
    return {s, b - (s - a)};
}
/// a + b and its exact error.
template <class T>
inline Pair<T> exact_sum(T a, T b) {
    const T s = a + b;
    const T t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}
/// The upper 26 bits of each lane's significand.
template <class T>
inline T upper_half(T x) {
    return float_of<T>(bits_of(x) & std::uint64_t{0xfffffffff8000000});
}
/// a * b and its error to about 2^-103 of the product.
template <class T>
inline Pair<T> exact_product(T a, T b) {
    const T p = a * b;
    const T ah = upper_half(a), al = a - ah;
    const T bh = upper_half(b), bl = b - bh;
    return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}
/// (n.hi + n.lo) / (d.hi + d.lo) to about 2^-100.
template <class T>
inline Pair<T> quotient(Pair<T> n, Pair<T> d) {
    const T q = n.hi / d.hi;
    const Pair<T> p = exact_product(q, d.hi);
    const T rest = ((n.hi - p.hi) - p.lo) + n.lo - q * d.lo;
    return {q, rest / d.hi};
}

/// c[0] + c[1] z + ... by two interleaved Horner chains in z*z (odd and even powers).
template <class T, std::size_t N>
inline T polynomial(T z, const double (&c)[N]) {
    const T w = z * z;
    T a = T(c[N - 1]), b = T(c[N - 2]);
    int i = static_cast<int>(N) - 3;
    for (; i >= 1; i -= 2) {
        a = a * w + c[i];
        b = b * w + c[i - 1];
    }
    if (i == 0) {
        a = a * w + c[0];
        return a + b * z;
    }
    return b + a * z;
}

FREP_MATH_CLOSE
