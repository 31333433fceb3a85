// Ranges of powers with a whole exponent and of blending set operations over 16 boxes, for the forward pass
// of the pruner (tile_forward.h). A blend is base + a0 w with a weight w in 0..1 that falls with |f1/a1| and
// |f2/a2| (field/kernels/blend.h); where f1, f2 <= 0 and a0 >= 0 a blending union increases in its operands,
// so that its values at the ends bound it (docs/decisions/0012-pruning-by-demand.md). Tested by
// tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_ranges.h"

namespace frep::tile {
namespace {

constexpr int most_of_exponent = 16;

inline V power_of(V x, int n) {
    V result = all(1.0f), square = x;
    for (; n > 0; n /= 2) {
        if (n % 2 != 0) result = result * square;
        square = square * square;
    }
    return result;
}

/// a to a constant exponent 1 .. 16; false for another one. A base below 1e-6 counts as 0 (docs/numerics.md,
/// 8).
bool power(const Job& job, Reader clause, Row& r) {
    if (clause.in(1) >= job.constants || job.flags[clause.in(1)] != 0) return false;
    const Row &a = job.rows[clause.in(0)], &exponent = job.rows[clause.in(1)];
    const float e = exponent.lo[0];
    if (!(e == exponent.hi[0] && e >= 1 && e <= most_of_exponent)) return false;
    const int n = static_cast<int>(e);
    if (static_cast<float>(n) != e) return false;
    const float by = static_cast<float>(n) * place;
    const V zero = all(0.0f), tiny = all(least_number);
    const auto below = [&](V x) {
        const V p = most(zero, lower(power_of(x, n), by) - tiny);
        return pick(less(x, all(surely_true_from)), zero, p);
    };
    const auto above = [&](V x) { return pick(same(x, zero), zero, upper(power_of(x, n), by) + tiny); };
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        const V low = most(zero, -al), high = most(zero, ah);
        if (n % 2 == 0)
            put(r, c, below(most(zero, most(al, -ah))), above(most(low, high)));
        else
            put(r, c, pick(less(al, zero), -above(low), below(most(zero, al))),
                pick(less(zero, ah), above(high), -below(most(zero, -ah))));
    }
    return true;
}

enum class Bound { nowhere, solid, points };  ///< what a blend is confined to

/// 1/|a| of an extent that is a constant of ordinary size, else 0.
inline float reciprocal(const Job& job, std::uint32_t row) {
    if (row >= job.constants || job.flags[row] != 0) return 0;
    const float a = job.rows[row].lo[0], size = a < 0 ? -a : a;
    return size > 1e-12f && size < 1e12f ? 1 / size : 0;
}

/// The weight of a blend for the squares of f1/a1, f2/a2 and f3/a3, to about 16 places; 0 where `z` is.
template <Bound bound>
inline V weight(V x, V y, V z) {
    const V zero = all(0.0f), one = all(1.0f);
    if (bound == Bound::nowhere) return one / (one + x + y);
    V t = bound == Bound::solid ? z / (x + y + z) : one - (x + y);
    t = bound == Bound::solid ? pick(less(zero, z), t, zero) : most(t, zero);
    return t * t * t / (all(2.0f) - t);
}

/// What a bound of a weight is worth: NaN, from over- or underflow, says nothing.
template <Bound bound>
inline V least_weight(V w) {
    // 1 - u loses places by cancellation
    const V p = bound == Bound::points ? w - all(48 * place) : w - w * (48 * place);
    return pick(less(all(0.0f), p), p, all(0.0f));
}
template <Bound bound>
inline V most_weight(V w) {
    const V p = bound == Bound::points ? w + all(48 * place) : w + w * (48 * place);
    return pick(less(p, all(1.0f)), p, all(1.0f));
}

struct Extents {
    float a0, r1, r2, r3;  ///< the displacement, reciprocals of the others
};

/// A blending union of g1, g2 within g3, at one corner of a box: its value and the size of its terms.
template <Bound bound>
inline V corner(const Extents& e, V g1, V g2, V g3, V& size) {
    const V x = g1 * all(e.r1), y = g2 * all(e.r2), z = most(g3, all(0.0f)) * all(e.r3);
    const V base = -conjunction(-g1, -g2);
    V w = weight<bound>(x * x, y * y, z * z);
    w = pick(less_equal(w, all(1.0f)), w, all(1.0f));
    const V raised = all(e.a0) * w;
    size = magnitude(base) + magnitude(raised) + magnitude(g1) + magnitude(g2);
    return base + raised;
}

/// Blending union (`united`) or intersection, its operands and extents found. Returns the boxes that it did
/// not bound well. An intersection is the negated union of the negated operands.
template <Bound bound, bool united>
unsigned blend_range(const Row& f1, const Row& f2, const Row& f3, const Extents& e, Row& r) {
    const V zero = all(0.0f);
    const auto low_of = [](const Row& f, int c) { return united ? load(f.lo + c) : -load(f.hi + c); };
    const auto high_of = [](const Row& f, int c) { return united ? load(f.hi + c) : -load(f.lo + c); };
    const auto squared = [](V x, float by) { return (x * all(by)) * (x * all(by)); };
    unsigned bad = 0;
    for (int c = 0; c < 16; c += width) {
        const V l1 = low_of(f1, c), h1 = high_of(f1, c), l2 = low_of(f2, c), h2 = high_of(f2, c);
        const V l3 = load(f3.lo + c), h3 = load(f3.hi + c);
        const V near1 = squared(most(zero, most(l1, -h1)), e.r1), far1 = squared(most(-l1, h1), e.r1);
        const V near2 = squared(most(zero, most(l2, -h2)), e.r2), far2 = squared(most(-l2, h2), e.r2);
        V w_low = least_weight<bound>(weight<bound>(far1, far2, squared(most(zero, l3), e.r3)));
        V w_high = most_weight<bound>(weight<bound>(near1, near2, squared(most(zero, h3), e.r3)));
        if (bound == Bound::solid) w_high = pick(less(zero, h3), w_high, zero);
        const V p = -conjunction(-l1, -l2), q = -conjunction(-h1, -h2);
        const V d_low = all(e.a0) * (e.a0 < 0 ? w_high : w_low),
                d_high = all(e.a0) * (e.a0 < 0 ? w_low : w_high);
        constexpr float by = 24 * place;
        V lo = lower(p, by) + lower(d_low, by), hi = upper(q, by) + upper(d_high, by);
        lo = lower(lo, place) - all(least_number), hi = upper(hi, place) + all(least_number);
        if (e.a0 >= 0) {
            const M monotone = less_equal(h1, zero) & less_equal(h2, zero);
            V size = zero;
            const V below = corner<bound>(e, l1, l2, l3, size) - size * all(64 * place);
            lo = pick(monotone & less(lo, below), below, lo);
            const V above = corner<bound>(e, h1, h2, h3, size) + size * all(64 * place);
            hi = pick(monotone & less(above, hi), above, hi);
        }
        put(r, c, united ? lo : -hi, united ? hi : -lo);
        bad |= bits(~(ordinary(l1, l2) & ordinary(h1, h2))) << c;
    }
    return bad;
}

/// Blends with constant extents; false for all else. `f`: flags.
bool blended(const Job& job, Reader clause, Row& r, std::uint32_t& f, unsigned& bad) {
    const bool in_solid = clause.op() == Op::bounded_uni || clause.op() == Op::bounded_int;
    const bool by_points = clause.op() == Op::point_uni || clause.op() == Op::point_int;
    const bool everywhere = clause.op() == Op::blend_uni || clause.op() == Op::blend_int;
    if (!in_solid && !by_points && !everywhere) return false;
    const std::uint32_t* in = job.operands + clause.in(0);
    const std::uint32_t* a = in + (in_solid ? 3 : 2);
    if (a[0] >= job.constants || job.flags[a[0]] != 0) return false;
    const bool united =
        clause.op() == Op::bounded_uni || clause.op() == Op::point_uni || clause.op() == Op::blend_uni;
    const float a0 = job.rows[a[0]].lo[0];
    if (!(a0 > -1e15f && a0 < 1e15f)) return false;
    const Extents e{united ? a0 : -a0, reciprocal(job, a[1]), reciprocal(job, a[2]),
                    in_solid ? reciprocal(job, a[3]) : 1.0f};
    if (e.r1 == 0 || e.r2 == 0 || e.r3 == 0) return false;
    const Row &f1 = job.rows[in[0]], &f2 = job.rows[in[1]], &f3 = job.rows[in_solid ? in[2] : in[0]];
    f = job.flags[in[0]] | job.flags[in[1]] | (in_solid ? job.flags[in[2]] : 0u);
    if (in_solid)
        bad = united ? blend_range<Bound::solid, true>(f1, f2, f3, e, r)
                     : blend_range<Bound::solid, false>(f1, f2, f3, e, r);
    else if (by_points)
        bad = united ? blend_range<Bound::points, true>(f1, f2, f3, e, r)
                     : blend_range<Bound::points, false>(f1, f2, f3, e, r);
    else
        bad = united ? blend_range<Bound::nowhere, true>(f1, f2, f3, e, r)
                     : blend_range<Bound::nowhere, false>(f1, f2, f3, e, r);
    return true;
}

}  // namespace
}  // namespace frep::tile
