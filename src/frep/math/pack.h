// Pack<E, N>: N items of 32 or 64 bits as machine vectors, one or two halves of them. Written in halves
// because g++ takes vectors wider than the machine's apart item by item for comparisons; this way each step
// is one instruction a register, and such values pass through calls alike whatever the instruction set.
// Checked by tests/unit/math/lanes_test.cpp.
#pragma once

#include <cstdint>

#include "frep/math/isa.h"

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

FREP_MATH_OPEN

/// Bytes of one register of the instruction set that this file is compiled for.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

/// The vector type of one register with N items E.
template <class E, int N>
struct RegisterOf;
#define FREP_REGISTER(E, N)                                         \
    template <>                                                     \
    struct RegisterOf<E, N> {                                       \
        typedef E type __attribute__((vector_size(sizeof(E) * N))); \
    };
#define FREP_REGISTERS(E, N)    \
    FREP_REGISTER(E, N)         \
    FREP_REGISTER(E, (2 * (N))) \
    FREP_REGISTER(E, (4 * (N)))
FREP_REGISTERS(double, 2)
FREP_REGISTERS(std::int64_t, 2)
FREP_REGISTERS(std::uint64_t, 2)
FREP_REGISTERS(float, 4)
FREP_REGISTERS(std::int32_t, 4)
FREP_REGISTERS(std::uint32_t, 4)
#undef FREP_REGISTERS
#undef FREP_REGISTER

/// Two halves, until one register holds them.
template <class E, int N, bool Whole = (N * static_cast<int>(sizeof(E)) <= register_bytes)>
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

/// The square root of every item, correctly rounded.
template <class V>
inline __attribute__((always_inline)) V square_roots(V v) {
    constexpr int bytes = sizeof(V);
    constexpr bool wide = sizeof(v[0]) == 8;
#if defined(__AVX512F__)
    if constexpr (bytes == 64) {
        if constexpr (wide) {
            return reinterpret_cast<V>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(v)));
        } else {
            return reinterpret_cast<V>(_mm512_maskz_sqrt_ps(0xffff, reinterpret_cast<__m512>(v)));
        }
    }
#endif
#if defined(__AVX2__)
    if constexpr (bytes == 32) {
        if constexpr (wide) {
            return reinterpret_cast<V>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(v)));
        } else {
            return reinterpret_cast<V>(_mm256_sqrt_ps(reinterpret_cast<__m256>(v)));
        }
    }
#endif
#if defined(__SSE2__)
    if constexpr (bytes == 16) {
        if constexpr (wide) {
            return reinterpret_cast<V>(_mm_sqrt_pd(reinterpret_cast<__m128d>(v)));
        } else {
            return reinterpret_cast<V>(_mm_sqrt_ps(reinterpret_cast<__m128>(v)));
        }
    }
#else
    for (int i = 0; i < bytes / static_cast<int>(sizeof(v[0])); ++i)
        v[i] = wide ? __builtin_sqrt(v[i]) : __builtin_sqrtf(v[i]);
    return v;
#endif
}

/// True if some item, each all ones or all zeros, is set.
template <class V>
inline __attribute__((always_inline)) bool any_set(V v) {
    constexpr int bytes = sizeof(V);
#if defined(__AVX512F__)
    if constexpr (bytes == 64) return _mm512_movepi32_mask(reinterpret_cast<__m512i>(v)) != 0;
#endif
#if defined(__AVX2__)
    if constexpr (bytes == 32) return _mm256_movemask_epi8(reinterpret_cast<__m256i>(v)) != 0;
#endif
#if defined(__SSE2__)
    if constexpr (bytes == 16) return _mm_movemask_epi8(reinterpret_cast<__m128i>(v)) != 0;
#else
    for (int i = 0; i < bytes / static_cast<int>(sizeof(v[0])); ++i)
        if (v[i] != 0) return true;
    return false;
#endif
}
/// The same for a pack.
template <class E, int N, bool Whole>
inline bool any_set(const Pack<E, N, Whole>& p) {
    if constexpr (Whole) {
        return any_set(p.v);
    } else {
        return any_set(p.low) || any_set(p.high);
    }
}

FREP_MATH_CLOSE
