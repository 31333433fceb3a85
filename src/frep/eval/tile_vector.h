// Vectors of binary32 as wide as a register of the instruction set that this file is compiled for, for
// tile_impl.h. Everything here has internal linkage (docs/numerics.md, rule 2). Tested by
// tests/unit/eval/prune_test.cpp.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace frep::tile {
namespace {

#if defined(__AVX512F__)
constexpr int width = 16;
#elif defined(__AVX2__)
constexpr int width = 8;
#else
constexpr int width = 4;
#endif

typedef float V __attribute__((vector_size(4 * width), may_alias));
typedef std::int32_t Integers __attribute__((vector_size(4 * width), may_alias));

inline V all(float x) { return x - V{}; }
inline V load(const float* from) { return *reinterpret_cast<const V*>(from); }
inline void store(float* to, V x) { *reinterpret_cast<V*>(to) = x; }
inline V magnitude(V x) { return (V)((Integers)x & 0x7fffffff); }

#if defined(__AVX512F__)

/// One truth value an item.
struct M {
    __mmask16 bits;
};
inline M operator&(M a, M b) { return {(__mmask16)(a.bits & b.bits)}; }
inline M operator|(M a, M b) { return {(__mmask16)(a.bits | b.bits)}; }
inline M operator~(M a) { return {(__mmask16)(~a.bits)}; }
inline M less(V a, V b) { return {_mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ)}; }
inline M less_equal(V a, V b) { return {_mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ)}; }
inline M same(V a, V b) { return {_mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_EQ_OQ)}; }
inline M has_bit(Integers n, int bit) {
    return {_mm512_test_epi32_mask((__m512i)n, (__m512i)(Integers{} + bit))};
}
inline unsigned bits(M m) { return m.bits; }
inline V pick(M m, V a, V b) { return (V)_mm512_mask_blend_ps(m.bits, (__m512)b, (__m512)a); }
// under a full mask, since g++ 12 warns of the undefined operand in its own header otherwise
inline V least(V a, V b) { return (V)_mm512_maskz_min_ps(0xffff, (__m512)a, (__m512)b); }
inline V most(V a, V b) { return (V)_mm512_maskz_max_ps(0xffff, (__m512)a, (__m512)b); }
inline V root(V a) { return (V)_mm512_maskz_sqrt_ps(0xffff, (__m512)a); }

#else

typedef Integers M;
inline M less(V a, V b) { return a < b; }
inline M less_equal(V a, V b) { return a <= b; }
inline M same(V a, V b) { return a == b; }
inline M has_bit(Integers n, int bit) { return (n & bit) != 0; }

#if defined(__AVX2__)
inline unsigned bits(M m) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)m)); }
inline V pick(M m, V a, V b) { return (V)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m); }
inline V least(V a, V b) { return (V)_mm256_min_ps((__m256)a, (__m256)b); }
inline V most(V a, V b) { return (V)_mm256_max_ps((__m256)a, (__m256)b); }
inline V root(V a) { return (V)_mm256_sqrt_ps((__m256)a); }
#elif defined(__SSE2__)
inline unsigned bits(M m) { return static_cast<unsigned>(_mm_movemask_ps((__m128)m)); }
inline V pick(M m, V a, V b) { return (V)((m & (Integers)a) | (~m & (Integers)b)); }
inline V least(V a, V b) { return (V)_mm_min_ps((__m128)a, (__m128)b); }
inline V most(V a, V b) { return (V)_mm_max_ps((__m128)a, (__m128)b); }
inline V root(V a) { return (V)_mm_sqrt_ps((__m128)a); }
#else
inline unsigned bits(M m) {
    unsigned r = 0;
    for (int i = 0; i < width; ++i) r |= (m[i] != 0 ? 1u : 0u) << i;
    return r;
}
inline V pick(M m, V a, V b) { return (V)((m & (Integers)a) | (~m & (Integers)b)); }
inline V least(V a, V b) { return pick(a < b, a, b); }
inline V most(V a, V b) { return pick(b < a, a, b); }
inline V root(V a) {
    for (int i = 0; i < width; ++i) a[i] = __builtin_sqrtf(a[i]);
    return a;
}
#endif

#endif

constexpr unsigned full = width == 16 ? 0xffffu : (1u << width) - 1u;
inline bool every(M m) { return bits(m) == full; }

}  // namespace
}  // namespace frep::tile
