// Clauses as the passes of the pruner read them, and the numbers that the passes share. Included by
// tile_ranges.h and tile_walk.h. Tested by tests/unit/eval/prune_test.cpp.
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

}  // namespace
}  // namespace frep::tile
