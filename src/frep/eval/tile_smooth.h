// Smooth set operations written in arithmetic: max(a, b) + c max(k - |a - b|, 0)^2 and its mirror image
// min(a, b) - c max(k - |a - b|, 0)^2 (the polynomial smooth minimum of Quilez 2008), for c k <= 1/2. Where
// only the sign counts, an operand that lies more than k on the other side of 0 goes, and of the others
// values matter up to k. Included by tile_reverse.h alone. Method: the clauses are recognized backwards from
// the sum; a demand within a margin is handed down their chain to a and b. Why it holds:
// docs/decisions/0012-pruning-by-demand.md. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_walk.h"

namespace frep::tile {
namespace {

/// The parts, from the sum down to the operands.
enum Stage : std::uint16_t {
    no_stage,
    scaled_square,  ///< c * q or q/c
    squared,        ///< square(t)
    clamped,        ///< max(u, 0)
    turned,         ///< k - v
    distance,       ///< |d|
    difference,     ///< a - b
    sharp,          ///< max(a, b) or min(a, b)
    mixed_stages,
};

struct Smooth {
    int sharp = 0, soft = 1;     ///< operands of the sum
    std::uint32_t a = 0, b = 0;  ///< rows
    float k = 0, factor = 0;
    bool sharp_is_operand = false;  ///< max(a, b) is a or b already
};

/// The clause of a row.
inline bool clause_of(const Walk& w, std::uint32_t row, Walk& to) {
    if (row < w.job.first_value) return false;
    const auto* clauses = static_cast<const unsigned char*>(w.job.clauses);
    to.clause = {clauses + clause_bytes * (row - w.job.first_value)};
    return true;
}

/// The one operand of `op` that is no constant; -1 where there is none, or another operation.
inline int variable_operand(const Walk& w, Op op) {
    if (w.clause.op() != op) return -1;
    return w.is_constant(0) ? 1 : w.is_constant(1) ? 0 : -1;
}

/// Follows the chain below c * q, at operand k of the sum.
bool follow_chain(const Walk& sum, int k, Smooth& s) {
    Walk w = sum;
    if (!clause_of(sum, sum.row(k), w)) return false;
    const bool over = w.clause.op() == Op::div;
    const int q = over ? (w.is_constant(1) ? 0 : -1) : variable_operand(w, Op::mul);
    if (q < 0) return false;
    const float factor = w.range(1 - q).lo[0];
    if (!(factor > 1e-20f && factor < 1e20f) || w.undefined(1 - q) != 0) return false;
    if (!clause_of(w, w.row(q), w) || w.clause.op() != Op::square) return false;
    if (!clause_of(w, w.row(0), w)) return false;
    const int u = variable_operand(w, Op::max);
    if (u < 0 || w.zero(1 - u) != 0xffffu) return false;
    if (!clause_of(w, w.row(u), w) || variable_operand(w, Op::sub) != 1 || w.undefined(0) != 0) return false;
    s.k = w.range(0).hi[0];
    const float slope = over ? s.k / factor : s.k * factor;
    if (!(s.k > 0 && s.k < endless && slope <= 0.4999f)) return false;
    if (!clause_of(w, w.row(1), w) || w.clause.op() != Op::abs) return false;
    if (!clause_of(w, w.row(0), w) || w.clause.op() != Op::sub) return false;
    s.factor = over ? 1 / factor : factor;
    s.a = w.row(0);
    s.b = w.row(1);
    return true;
}

/// True if operand k of the sum is max(a, b) (min for the mirror image), or one of them.
bool is_sharp(const Walk& sum, int k, Op op, Smooth& s) {
    const std::uint32_t row = sum.row(k);
    s.sharp_is_operand = row == s.a || row == s.b;
    if (s.sharp_is_operand) return true;
    Walk w = sum;
    if (!clause_of(sum, row, w) || w.clause.op() != op) return false;
    return (w.row(0) == s.a && w.row(1) == s.b) || (w.row(0) == s.b && w.row(1) == s.a);
}

/// Finds out whether the sum w is a smooth set operation.
bool find_smooth(const Walk& w, bool minus, Smooth& s) {
    const Op op = minus ? Op::min : Op::max;
    if (follow_chain(w, 1, s) && is_sharp(w, 0, op, s)) return true;
    if (minus) return false;
    s.sharp = 1;
    s.soft = 0;
    return follow_chain(w, 0, s) && is_sharp(w, 1, op, s);
}

/// True for square(max(u, v)), without which there is no smooth set operation.
bool is_square_of_maximum(const Walk& w) {
    Walk operand = w;
    return clause_of(w, w.row(0), operand) && operand.clause.op() == Op::max;
}

/// max(a, b) + factor max(k - |a - b|, 0)^2, or the mirror image; increases in both.
template <bool minus>
V smooth_at(V a, V b, float k, float factor) {
    const V u = most(all(k) - magnitude(a - b), all(0.0f)), soft = u * u * all(factor);
    return minus ? least(a, b) - soft : most(a, b) + soft;
}
template <bool minus>
void cut_to_corners(const Row& a, const Row& b, const Smooth& s, Row& r) {
    // more than the rounding of the terms, in binary32 too
    const V slack = all(16 * place * s.k);
    for (int c = 0; c < 16; c += width) {
        const V p = smooth_at<minus>(load(a.lo + c), load(b.lo + c), s.k, s.factor);
        const V q = smooth_at<minus>(load(a.hi + c), load(b.hi + c), s.k, s.factor);
        const V lo = p - magnitude(p) * (16 * place) - slack, hi = q + magnitude(q) * (16 * place) + slack;
        // NaN, from infinite bounds, leaves what is there
        put(r, c, most(lo, load(r.lo + c)), least(hi, load(r.hi + c)));
    }
}
/// Cuts the range of a sum that is a smooth set operation to its range at the corners.
void smooth_range(const Walk& w, bool minus, Row& r) {
    Smooth s;
    if (!find_smooth(w, minus, s)) return;
    const Row &a = w.job.rows[s.a], &b = w.job.rows[s.b];
    if (minus)
        cut_to_corners<true>(a, b, s, r);
    else
        cut_to_corners<false>(a, b, s, r);
}

inline void ask_inner(const Walk& w, int k, unsigned boxes, float margin, Stage stage) {
    Wanted& wanted = w.job.wanted[w.row(k)];
    wanted.inner |= static_cast<std::uint16_t>(boxes);
    if (boxes != 0) wanted.gain = endless;
    if (wanted.stage != no_stage && wanted.stage != stage) wanted.stage = mixed_stages;
    if (wanted.stage == no_stage) wanted.stage = stage;
    if (margin > wanted.inner_margin) wanted.inner_margin = margin;
}

/// Demands of a sum that is a smooth set operation; false where it is none.
bool smooth_demand(const Walk& w, Demand d, bool minus, Record& r) {
    Smooth s;
    if (!find_smooth(w, minus, s)) return false;
    const float margin = widened(d.margin + s.k);
    const Row &a = w.job.rows[s.a], &b = w.job.rows[s.b];
    const unsigned far_a = minus ? Walk::above(a, margin) : Walk::below(a, -margin);
    const unsigned far_b = minus ? Walk::above(b, margin) : Walk::below(b, -margin);
    const unsigned sure_a = ~w.job.flags[s.a] & 0xffffu, sure_b = ~w.job.flags[s.b] & 0xffffu;
    const unsigned alone = d.sign() & (w.zero(s.soft) | (far_a & sure_a) | (far_b & sure_b));
    const unsigned both = d.sign() & ~alone;
    (s.sharp == 0 ? r.first : r.second) = static_cast<std::uint16_t>(alone);
    w.ask(s.sharp, {alone, 0, d.margin});
    if (s.sharp_is_operand)
        w.ask(s.sharp, {both, 0, margin});
    else
        ask_inner(w, s.sharp, both, margin, sharp);
    ask_inner(w, s.soft, both, margin, scaled_square);
    w.ask_value(0, d.value);
    w.ask_value(1, d.value);
    return true;
}

/// Hands the demand of a smooth set operation down from one of its parts.
void inner_demand(const Walk& w, const Wanted& wanted, Record& r) {
    const unsigned boxes = wanted.inner;
    const float margin = wanted.inner_margin;
    r.live |= static_cast<std::uint16_t>(boxes);
    r.value |= static_cast<std::uint16_t>(boxes);
    const auto next = static_cast<Stage>(wanted.stage + 1);
    switch (wanted.stage) {
        case scaled_square:
        case turned:
            ask_inner(w, w.is_constant(0) ? 1 : 0, boxes, margin, next);
            return;
        case squared:
        case distance:
            ask_inner(w, 0, boxes, margin, next);
            return;
        case clamped: {
            const int u = w.is_constant(0) ? 1 : 0;
            const unsigned at_rest = boxes & w.ordered(u, 1 - u) & ~w.undefined(u);
            (u == 0 ? r.second : r.first) |= static_cast<std::uint16_t>(at_rest);
            ask_inner(w, u, boxes & ~at_rest, margin, next);
            return;
        }
        case sharp: {
            const bool united = w.clause.op() == Op::max;
            const unsigned without_0 = united ? w.ordered(0, 1) : w.ordered(1, 0);
            const unsigned without_1 = united ? w.ordered(1, 0) : w.ordered(0, 1);
            const unsigned first = boxes & without_1 & ~w.undefined(1);
            const unsigned second = boxes & without_0 & ~w.undefined(0) & ~first;
            r.first |= static_cast<std::uint16_t>(first);
            r.second |= static_cast<std::uint16_t>(second);
            w.ask(0, {boxes & ~second, 0, margin});
            w.ask(1, {boxes & ~first, 0, margin});
            return;
        }
        default:
            w.ask(0, {boxes, 0, margin});
            w.ask(1, {boxes, 0, margin});
    }
}

}  // namespace
}  // namespace frep::tile
