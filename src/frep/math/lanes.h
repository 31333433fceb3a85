// LanesN<N>: N doubles that go through one computation together, as a GCC/clang vector; LaneMask<N>: N truth
// values. Every operation is the IEEE operation of each lane, so lanes and scalars agree bit for bit.
// Checked by tests/unit/math/lanes_test.cpp.
#pragma once

#include "frep/math/bits.h"

// Wide vectors are passed differently with and without AVX; isa.h keeps the two apart. Both compilers would
// say so at every call, in every file that includes this one.
#pragma GCC diagnostic ignored "-Wpsabi"

FREP_MATH_OPEN

/// The vector types of N 64-bit items, for N = 2, 4, 8.
template <int N>
struct VectorsOf;
template <>
struct VectorsOf<2> {
    typedef double Reals __attribute__((vector_size(16)));
    typedef std::int64_t Integers __attribute__((vector_size(16)));
    typedef std::uint64_t Words __attribute__((vector_size(16)));
};
template <>
struct VectorsOf<4> {
    typedef double Reals __attribute__((vector_size(32)));
    typedef std::int64_t Integers __attribute__((vector_size(32)));
    typedef std::uint64_t Words __attribute__((vector_size(32)));
};
template <>
struct VectorsOf<8> {
    typedef double Reals __attribute__((vector_size(64)));
    typedef std::int64_t Integers __attribute__((vector_size(64)));
    typedef std::uint64_t Words __attribute__((vector_size(64)));
};

/// N truth values, each all ones or all zeros.
template <int N>
struct LaneMask {
    using Integers = typename VectorsOf<N>::Integers;
    Integers v;

    /// Truth value of lane i.
    bool operator[](int i) const { return v[i] != 0; }
    /// Sets lane i.
    void set(int i, bool b) { v[i] = b ? -1 : 0; }
    friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
    friend LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }
    friend LaneMask operator!(LaneMask a) { return {~a.v}; }
};

/// N doubles. The default constructor leaves them unset; a double converts to N copies of itself.
template <int N>
struct LanesN {
    using Vector = typename VectorsOf<N>::Reals;
    using Integers = typename VectorsOf<N>::Integers;
    using Words = typename VectorsOf<N>::Words;
    static constexpr int size = N;
    Vector v;

    LanesN() = default;
    LanesN(double all) : v(all - Vector{}) {}
    explicit LanesN(Vector vector) : v(vector) {}

    /// N copies of a value.
    static LanesN broadcast(double all) { return LanesN(all); }
    /// Reads N doubles from memory (any alignment).
    static LanesN load(const double* from) {
        LanesN r;
        __builtin_memcpy(&r.v, from, sizeof(Vector));
        return r;
    }
    /// Writes N doubles to memory (any alignment).
    void store(double* to) const { __builtin_memcpy(to, &v, sizeof(Vector)); }
    /// The value of lane i.
    double operator[](int i) const { return v[i]; }
    /// Sets lane i.
    void set(int i, double x) { v[i] = x; }

    friend LanesN operator+(LanesN a, LanesN b) { return LanesN(a.v + b.v); }
    friend LanesN operator-(LanesN a, LanesN b) { return LanesN(a.v - b.v); }
    friend LanesN operator*(LanesN a, LanesN b) { return LanesN(a.v * b.v); }
    friend LanesN operator/(LanesN a, LanesN b) { return LanesN(a.v / b.v); }
    friend LanesN operator-(LanesN a) {
        return LanesN(reinterpret_cast<Vector>(reinterpret_cast<Words>(a.v) ^ 0x8000000000000000u));
    }
    LanesN& operator+=(LanesN b) { return *this = *this + b; }
    LanesN& operator-=(LanesN b) { return *this = *this - b; }
    LanesN& operator*=(LanesN b) { return *this = *this * b; }
    LanesN& operator/=(LanesN b) { return *this = *this / b; }

    friend LaneMask<N> less(LanesN a, LanesN b) { return {reinterpret_cast<Integers>(a.v < b.v)}; }
    friend LaneMask<N> less_equal(LanesN a, LanesN b) { return {reinterpret_cast<Integers>(a.v <= b.v)}; }
    friend LaneMask<N> equal(LanesN a, LanesN b) { return {reinterpret_cast<Integers>(a.v == b.v)}; }
    friend LaneMask<N> is_nan(LanesN a) { return {reinterpret_cast<Integers>(a.v != a.v)}; }
    friend LanesN select(LaneMask<N> m, LanesN a, LanesN b) {
        const Integers x = reinterpret_cast<Integers>(a.v), y = reinterpret_cast<Integers>(b.v);
        return LanesN(reinterpret_cast<Vector>((x & m.v) | (y & ~m.v)));
    }
};

/// The width that the engines use: four doubles, two SSE2 registers or one AVX register.
using Lanes = LanesN<4>;

/// True if some lane is true.
template <int N>
inline bool any(LaneMask<N> m) {
    std::int64_t r = 0;
    for (int i = 0; i < N; ++i) r |= m.v[i];
    return r != 0;
}
/// True if every lane is true.
template <int N>
inline bool all(LaneMask<N> m) {
    std::int64_t r = -1;
    for (int i = 0; i < N; ++i) r &= m.v[i];
    return r != 0;
}

FREP_MATH_CLOSE
