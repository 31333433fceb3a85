// Implementation of prune_general.h.
#include "frep/eval/prune_general.h"

#include <limits>

#include "frep/field/meaning.h"

namespace frep {
namespace {

constexpr float largest = std::numeric_limits<float>::max();
constexpr float least_number = std::numeric_limits<float>::denorm_min();
/// R-functions of binary32 engines may be saturated from here on.
constexpr float saturation = 0.999e18f;
/// What binary32 may differ by, relative: 2 ulp of the function, 1 of the rounding of its bounds here.
constexpr float rounding_of_binary32 = 0x1p-21f;

/// Operations that compare with the tolerance 1e-6, which binary32 rounds.
bool has_tolerance(Op op) {
    return op == Op::equal || op == Op::truth || op == Op::select || op == Op::logical_not ||
           op == Op::logical_and || op == Op::logical_or;
}

/// x moved down, without leaving its sign.
float below(float x, float by) {
    if (x == 0) return x;
    const float r = x - (x < 0 ? -x : x) * by - least_number;
    return x > 0 && r < 0 ? 0.0f : r;
}

math::Interval operand(const tile::Row& row, std::uint32_t flags, int k, bool widened) {
    if (flags >> (16 + k) & 1u) return math::Interval::empty();
    float lo = row.lo[k], hi = row.hi[k];
    if (widened) {
        lo = below(lo, rounding_of_binary32);
        hi = -below(-hi, rounding_of_binary32);
    }
    return {lo, hi, (flags >> k & 1u) != 0};
}

}  // namespace

float rounded_down(double x) {
    float r = x > static_cast<double>(largest) ? largest : static_cast<float>(x);
    if (static_cast<double>(r) > x) {
        std::int32_t bits = __builtin_bit_cast(std::int32_t, r);
        if (r == 0)
            bits = __builtin_bit_cast(std::int32_t, -least_number);
        else
            bits += r > 0 ? -1 : 1;
        r = __builtin_bit_cast(float, bits);
    }
    return r;
}
float rounded_up(double x) { return -rounded_down(-x); }

void general_range(const ClauseTape& tape, std::uint32_t number, unsigned lanes, tile::Row* rows,
                   std::uint32_t* flags, GeneralRange& workspace) {
    const Clause& clause = tape.clauses[number];
    const std::span<const RowNumber> in = tape.operands_of(clause);
    const bool widened = has_tolerance(clause.op);
    const bool saturates = clause.op == Op::r_and || clause.op == Op::r_or;
    tile::Row& out = rows[clause.out];
    std::uint32_t undefined = flags[clause.out];
    workspace.operands.resize(in.size());
    for (int k = 0; k < 16; ++k) {
        if (!(lanes >> k & 1u)) continue;
        for (std::size_t i = 0; i < in.size(); ++i)
            workspace.operands[i] = operand(rows[in[i]], flags[in[i]], k, widened);
        const auto range = meaning<math::Interval>(clause.op, workspace.operands, tape.block_of(clause));
        undefined &= ~(0x10001u << k);
        if (range.is_empty()) {
            undefined |= 0x10001u << k;
            out.lo[k] = -std::numeric_limits<float>::infinity();
            out.hi[k] = std::numeric_limits<float>::infinity();
            continue;
        }
        if (range.maybe_undefined) undefined |= 1u << k;
        float lo = below(rounded_down(range.lo), rounding_of_binary32);
        float hi = -below(-rounded_up(range.hi), rounding_of_binary32);
        if (saturates && lo > saturation) lo = saturation;
        if (saturates && hi < -saturation) hi = -saturation;
        out.lo[k] = lo;
        out.hi[k] = hi;
    }
    flags[clause.out] = undefined;
}

}  // namespace frep
