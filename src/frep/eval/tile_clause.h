// What the parts of the pruner's forward pass have in common: how a clause is read, how bounds step outward,
// and the R-conjunction in binary32. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_kernels.h"
#include "frep/eval/tile_vector.h"
#include "frep/field/op.h"

namespace frep::tile {
namespace {

constexpr float place = 0x1p-23f;            ///< at least one place of any number, relative to it
constexpr float least_number = 0x1p-149f;    ///< the smallest positive number
constexpr float largest = 0x1.fffffep+127f;  ///< the largest finite number
constexpr float endless = __builtin_huge_valf();
constexpr float small = 0x1p-100f;  ///< products beyond are far from underflow
/// Operands of square sums that neither over- nor underflow.
constexpr float ordinary_low = 1e-15f, ordinary_high = 1e15f;
/// A number is true from here on, whether 1e-6 is rounded to binary32 or not; and false below there.
constexpr float surely_true_from = 1.0000003e-6f, surely_false_below = 0.9999997e-6f;

/// A clause, read field by field from its bytes.
struct Reader {
    const unsigned char* at;

    std::uint32_t word(int k) const {
        std::uint32_t w;
        __builtin_memcpy(&w, at + 4 * k, 4);
        return w;
    }
    Op op() const { return static_cast<Op>(at[0]); }
    bool listed() const { return at[1] != 0; }
    std::uint32_t count() const { return word(1); }
    std::uint32_t out() const { return word(2); }
    std::uint32_t in(int k) const { return word(3 + k); }
};
constexpr std::size_t clause_bytes = 24;

inline V lower(V x, float by) { return least(x, all(largest)) - magnitude(least(x, all(largest))) * by; }
inline V upper(V x, float by) { return most(x, all(-largest)) + magnitude(most(x, all(-largest))) * by; }
inline void put(Row& r, int c, V lo, V hi) {
    store(r.lo + c, lo);
    store(r.hi + c, hi);
}

/// r_and(a, b) = lo * 2 hi/(lo + hi + s) where hi > -lo, else lo + hi - s, with s = hypot(lo, hi).
inline V conjunction(V a, V b) {
    const V lo = least(a, b), hi = most(a, b);
    const V s = root(lo * lo + hi * hi);
    return pick(less(-lo, hi), lo * ((hi + hi) / (lo + hi + s)), lo + hi - s);
}
/// True for pairs whose larger magnitude is ordinary.
inline M ordinary(V a, V b) {
    const V far = most(magnitude(a), magnitude(b));
    return less(all(ordinary_low), far) & less(far, all(ordinary_high));
}
}  // namespace
}  // namespace frep::tile
