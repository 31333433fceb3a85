// Pack<E, N>: N items of 64 bits as machine vectors, one or two halves of them. Written in halves because g++
// takes vectors wider than the machine's apart item by item for comparisons; this way each step is one
// instruction a register, and such values pass through calls alike whatever the instruction set. Checked by
// tests/unit/math/lanes_test.cpp.
#pragma once

#include <cstdint>

#include "frep/math/isa.h"

FREP_MATH_OPEN

/// Items in one register of the instruction set that this file is compiled for.
#if defined(__AVX512F__)
inline constexpr int register_items = 8;
#elif defined(__AVX2__)
inline constexpr int register_items = 4;
#else
inline constexpr int register_items = 2;
#endif

/// The vector types of one register.
template <int N>
struct Register;
template <>
struct Register<2> {
    typedef double Reals __attribute__((vector_size(16)));
    typedef std::int64_t Integers __attribute__((vector_size(16)));
    typedef std::uint64_t Words __attribute__((vector_size(16)));
};
template <>
struct Register<4> {
    typedef double Reals __attribute__((vector_size(32)));
    typedef std::int64_t Integers __attribute__((vector_size(32)));
    typedef std::uint64_t Words __attribute__((vector_size(32)));
};
template <>
struct Register<8> {
    typedef double Reals __attribute__((vector_size(64)));
    typedef std::int64_t Integers __attribute__((vector_size(64)));
    typedef std::uint64_t Words __attribute__((vector_size(64)));
};
/// The register type for items E.
template <class E, int N>
struct RegisterOf;
template <int N>
struct RegisterOf<double, N> {
    using type = typename Register<N>::Reals;
};
template <int N>
struct RegisterOf<std::int64_t, N> {
    using type = typename Register<N>::Integers;
};
template <int N>
struct RegisterOf<std::uint64_t, N> {
    using type = typename Register<N>::Words;
};

/// Two halves, until one register holds them.
template <class E, int N, bool Whole = (N <= register_items)>
struct Pack {
    using Half = Pack<E, N / 2>;
    static constexpr bool whole = false;
    Half low, high;

    static Pack all(E x) { return {Half::all(x), Half::all(x)}; }
    E get(int i) const { return i < N / 2 ? low.get(i) : high.get(i - N / 2); }
    void set(int i, E x) {
        if (i < N / 2) {
            low.set(i, x);
        } else {
            high.set(i - N / 2, x);
        }
    }
};
template <class E, int N>
struct Pack<E, N, true> {
    using Vector = typename RegisterOf<E, N>::type;
    static constexpr bool whole = true;
    Vector v;

    static Pack all(E x) { return {x - Vector{}}; }
    E get(int i) const { return v[i]; }
    void set(int i, E x) { v[i] = x; }
};

/// f on the registers of packs of one width; f returns a register (of any item type, the bits count).
template <class R, class F, class... A>
inline __attribute__((always_inline)) R each(F f, const A&... a) {
    if constexpr (R::whole) {
        return R{reinterpret_cast<typename R::Vector>(f(a.v...))};
    } else {
        return R{each<typename R::Half>(f, a.low...), each<typename R::Half>(f, a.high...)};
    }
}

FREP_MATH_CLOSE
