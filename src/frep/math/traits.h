// What generic code may ask of a number type T: its mask, its constants, comparison and selection; and what a
// kernel may ask besides: the bit patterns, and a shared scalar path for rare arguments. A new lane type (for
// instance one that emits instructions) supplies these few names. Checked by tests/unit/math/lanes_test.cpp.
#pragma once

#include "frep/math/lanes.h"

FREP_MATH_OPEN

/// What comparing two T gives: bool for double; other number types specialise it.
template <class T>
struct MaskOf {
    using type = bool;
};
template <class E, int N>
struct MaskOf<LanesOf<E, N>> {
    using type = LaneMaskOf<E, N>;
};
/// bool, LaneMask<N>, IntervalMask (interval.h), or the mask of T for Dual<T> (dual.h).
template <class T>
using mask_t = typename MaskOf<T>::type;

/// The integers that hold the bits of a T: uint64_t or LaneWordsOf.
template <class T>
struct WordOf {
    using type = std::uint64_t;
};
template <class E, int N>
struct WordOf<LanesOf<E, N>> {
    using type = LaneWordsOf<E, N>;
};
template <class T>
using word_t = typename WordOf<T>::type;

/// What one lane of a T is: double, or float where a lane type says so.
template <class T>
struct ItemOf {
    using type = double;
};
template <class E, int N>
struct ItemOf<LanesOf<E, N>> {
    using type = E;
};
template <class T>
using item_t = typename ItemOf<T>::type;
/// The facts of its format.
template <class T>
using format_of = Format<item_t<T>>;

/// The number c as a T. An Interval constant that is NaN is empty; a Dual constant has derivative 0.
template <class T>
inline T constant(double c) {
    return T(c);
}

inline bool less(double a, double b) { return a < b; }
inline bool less_equal(double a, double b) { return a <= b; }
inline bool equal(double a, double b) { return a == b; }
inline bool is_nan(double a) { return a != a; }
/// Mask operations as functions, for every mask type; for bool, & and | draw a warning from clang.
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
template <class M>
inline M both(M a, M b) {
    return a & b;
}
template <class M>
inline M either(M a, M b) {
    return a | b;
}
inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }
/// a where the mask holds, else b. The other value has no effect, NaN included.
inline double select(bool m, double a, double b) { return m ? a : b; }

/// True if the lowest bit is set.
inline bool mask_of_low_bit(std::uint64_t w) { return (w & 1) != 0; }
/// The bits of each lane, and back.
inline std::uint64_t bits_of(double x) { return to_bits(x); }
template <class E, int N>
inline LaneWordsOf<E, N> bits_of(LanesOf<E, N> x) {
    return x.bits();
}
/// Makes a T of its bits; a new lane type specialises it.
template <class T>
struct FloatOf {
    static T of(word_t<T> w) { return T(w); }
};
template <>
struct FloatOf<double> {
    static double of(std::uint64_t w) { return from_bits(w); }
};
template <class T>
inline T float_of(word_t<T> w) {
    return FloatOf<T>::of(w);
}

/// Replaces the lanes of `r` where `m` holds by f(x), a scalar function shared by all widths.
template <class F>
inline double patch(bool m, double r, double x, F f) {
    return __builtin_expect(m, 0) ? f(x) : r;
}
/// The rare part of patch(), by itself so that the usual one keeps its operands in registers.
template <class E, int N, class F>
__attribute__((noinline)) LanesOf<E, N> patch_lanes(LaneMaskOf<E, N> m, LanesOf<E, N> r, LanesOf<E, N> x,
                                                    F f) {
    for (int i = 0; i < N; ++i) {
        if (m[i]) r.set(i, f(x[i]));
    }
    return r;
}
template <class E, int N, class F>
inline LanesOf<E, N> patch(LaneMaskOf<E, N> m, LanesOf<E, N> r, LanesOf<E, N> x, F f) {
    return __builtin_expect(any(m), 0) ? patch_lanes(m, r, x, f) : r;
}
/// The same for a scalar function of two arguments.
template <class F>
inline double patch(bool m, double r, double x, double y, F f) {
    return __builtin_expect(m, 0) ? f(x, y) : r;
}
template <class E, int N, class F>
__attribute__((noinline)) LanesOf<E, N> patch_lanes(LaneMaskOf<E, N> m, LanesOf<E, N> r, LanesOf<E, N> x,
                                                    LanesOf<E, N> y, F f) {
    for (int i = 0; i < N; ++i) {
        if (m[i]) r.set(i, f(x[i], y[i]));
    }
    return r;
}
template <class E, int N, class F>
inline LanesOf<E, N> patch(LaneMaskOf<E, N> m, LanesOf<E, N> r, LanesOf<E, N> x, LanesOf<E, N> y, F f) {
    return __builtin_expect(any(m), 0) ? patch_lanes(m, r, x, y, f) : r;
}

FREP_MATH_CLOSE
