// Ranges of single operations over 16 boxes, in binary32. Included by tile_forward.h alone. Method: end
// points to nearest, stepped outward relatively, so that a bound never leaves its sign; rows with bounds near
// 0 or infinity take slower forms that mind underflow and 0 * inf. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_clause.h"

namespace frep::tile {
namespace {

inline V lower(V x, float by) { return least(x, all(largest)) - magnitude(least(x, all(largest))) * by; }
inline V upper(V x, float by) { return most(x, all(-largest)) + magnitude(most(x, all(-largest))) * by; }
inline void put(Row& r, int c, V lo, V hi) {
    store(r.lo + c, lo);
    store(r.hi + c, hi);
}

/// a + b, or a - b. Returns the boxes where inf - inf may come up.
template <bool minus>
unsigned sum(const Row& a, const Row& b, Row& r) {
    unsigned clash = 0;
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        const V bl = minus ? -load(b.hi + c) : load(b.lo + c), bh = minus ? -load(b.lo + c) : load(b.hi + c);
        const V lo = lower(al + bl, place), hi = upper(ah + bh, place);
        put(r, c, lo, hi);
        if (every(less(hi - lo, all(endless)))) continue;
        const V top = all(endless), bottom = all(-endless);
        clash |= bits((same(al, bottom) & same(bh, top)) | (same(ah, top) & same(bl, bottom))) << c;
    }
    return clash;
}

/// Lowest or highest of the four products of the bounds, with 0 * inf = 0.
inline V tame(V p) { return pick(same(p, p), p, all(0.0f)); }

/// a * b where a bound comes near 0 or infinity. Returns the boxes where 0 * inf may come up.
__attribute__((noinline)) unsigned careful_product(const Row& a, const Row& b, Row& r) {
    unsigned clash = 0;
    const V zero = all(0.0f), top = all(endless);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), bl = load(b.lo + c), bh = load(b.hi + c);
        const V p = tame(al * bl), q = tame(al * bh), s = tame(ah * bl), t = tame(ah * bh);
        V lo = lower(least(least(p, q), least(s, t)), place) - all(least_number);
        V hi = upper(most(most(p, q), most(s, t)), place) + all(least_number);
        const M negative = (less(al, zero) & less(zero, bh)) | (less(bl, zero) & less(zero, ah));
        const M positive = (less(zero, ah) & less(zero, bh)) | (less(al, zero) & less(bl, zero));
        lo = pick(negative, lo, most(lo, zero));
        hi = pick(positive, hi, least(hi, zero));
        put(r, c, lo, hi);
        const M a_endless = same(magnitude(al), top) | same(ah, top);
        const M b_endless = same(bl, -top) | same(bh, top);
        const M a_zero = less_equal(al, zero) & less_equal(zero, ah);
        const M b_zero = less_equal(bl, zero) & less_equal(zero, bh);
        clash |= bits((a_endless & b_zero) | (b_endless & a_zero)) << c;
    }
    return clash;
}

/// True if the bounds are far from underflow and finite.
inline bool plain_bounds(V lo, V hi) {
    const V x = magnitude(lo), y = magnitude(hi);
    return every(less_equal(all(small), least(x, y)) & less(most(x, y), all(endless)));
}

unsigned product(const Row& a, const Row& b, Row& r) {
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), bl = load(b.lo + c), bh = load(b.hi + c);
        const V p = al * bl, q = al * bh, s = ah * bl, t = ah * bh;
        const V lo = least(least(p, q), least(s, t)), hi = most(most(p, q), most(s, t));
        if (!plain_bounds(lo, hi)) return careful_product(a, b, r);
        put(r, c, lo - magnitude(lo) * place, hi + magnitude(hi) * place);
    }
    return 0;
}

/// a times (over) a constant that binary32 holds to within a place.
template <bool over>
bool scaled(const Row& a, float factor, Row& r) {
    constexpr float by = 3 * place;
    const V f = all(factor);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        const V p = over ? al / f : al * f, q = over ? ah / f : ah * f;
        const V lo = factor > 0 ? p : q, hi = factor > 0 ? q : p;
        if (!plain_bounds(lo, hi)) return false;
        put(r, c, lo - magnitude(lo) * by, hi + magnitude(hi) * by);
    }
    return true;
}

/// a / b; false where a bound comes near 0 or infinity, or b to 0.
bool quotient(const Row& a, const Row& b, Row& r) {
    const V zero = all(0.0f);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), bl = load(b.lo + c), bh = load(b.hi + c);
        if (!every(less(zero, bl) | less(bh, zero))) return false;
        const V p = al / bl, q = al / bh, s = ah / bl, t = ah / bh;
        const V lo = least(least(p, q), least(s, t)), hi = most(most(p, q), most(s, t));
        if (!plain_bounds(lo, hi)) return false;
        put(r, c, lo - magnitude(lo) * place, hi + magnitude(hi) * place);
    }
    return true;
}

void square(const Row& a, Row& r) {
    const V zero = all(0.0f);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        const V near = most(zero, most(al, -ah)), far = most(-al, ah);
        const V p = near * near, q = far * far;
        const V step = least(far, all(least_number));  // none for 0 itself
        put(r, c, most(zero, lower(p, place) - all(least_number)), upper(q, place) + step);
    }
}

/// Returns the boxes where the operand may be negative; `none`: where it surely is.
unsigned square_root(const Row& a, Row& r, unsigned& none) {
    const V zero = all(0.0f);
    unsigned negative = 0;
    none = 0;
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        const V p = root(most(al, zero)), q = root(most(ah, zero));
        put(r, c, p - p * place, q + q * place);
        negative |= bits(less(al, zero)) << c;
        none |= bits(less(ah, zero)) << c;
    }
    return negative;
}

void negation(const Row& a, Row& r) {
    for (int c = 0; c < 16; c += width) put(r, c, -load(a.hi + c), -load(a.lo + c));
}
void absolute(const Row& a, Row& r) {
    const V zero = all(0.0f);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        put(r, c, most(zero, most(al, -ah)), most(-al, ah));
    }
}
void minimum(const Row& a, const Row& b, Row& r) {
    for (int c = 0; c < 16; c += width)
        put(r, c, least(load(a.lo + c), load(b.lo + c)), least(load(a.hi + c), load(b.hi + c)));
}
void maximum(const Row& a, const Row& b, Row& r) {
    for (int c = 0; c < 16; c += width)
        put(r, c, most(load(a.lo + c), load(b.lo + c)), most(load(a.hi + c), load(b.hi + c)));
}

/// sqrt(a^2 + b^2). Returns the boxes that it did not bound well.
unsigned hypotenuse(const Row& a, const Row& b, Row& r) {
    const V zero = all(0.0f);
    unsigned bad = 0;
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), bl = load(b.lo + c), bh = load(b.hi + c);
        const V x = most(zero, most(al, -ah)), y = most(zero, most(bl, -bh));
        const V s = most(-al, ah), t = most(-bl, bh), far = most(s, t);
        const V p = root(most(zero, x * x + y * y - all(0x1p-120f))), q = root(s * s + t * t);
        put(r, c, p - p * (6 * place), q + q * (6 * place));
        bad |= bits(~(less(all(ordinary_low), far) & less(far, all(ordinary_high)))) << c;
    }
    return bad;
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
/// r_and, or r_or(a, b) = -r_and(-a, -b), at the corners (they increase in both operands). Returns the boxes
/// that it did not bound well.
template <bool united>
unsigned r_function(const Row& a, const Row& b, Row& r) {
    unsigned bad = 0;
    constexpr float by = 16 * place;
    const V zero = all(0.0f), tiny = all(least_number);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), bl = load(b.lo + c), bh = load(b.hi + c);
        const V p = united ? -conjunction(-al, -bl) : conjunction(al, bl);
        const V q = united ? -conjunction(-ah, -bh) : conjunction(ah, bh);
        // a step of the smallest number keeps the sign, that of min (max)
        const V below = p - magnitude(p) * by, above = q + magnitude(q) * by;
        const V lo =
            pick(less(zero, below), most(zero, below - tiny), pick(less(below, zero), below - tiny, below));
        const V hi =
            pick(less(above, zero), least(zero, above + tiny), pick(less(zero, above), above + tiny, above));
        put(r, c, lo, hi);
        bad |= bits(~(ordinary(al, bl) & ordinary(ah, bh))) << c;
    }
    return bad;
}

/// x without its fraction; exact.
inline V truncated(V x) {
    const V t = __builtin_convertvector(
        __builtin_convertvector(pick(less(magnitude(x), all(0x1p23f)), x, all(0.0f)), Integers), V);
    return pick(less(magnitude(x), all(0x1p23f)), t, x);
}
inline V one_where(M m) { return pick(m, all(1.0f), all(0.0f)); }
inline V rounded_up(V x) {
    const V t = truncated(x);
    return t + one_where(less(t, x));
}
template <Op op>
inline V rounded(V x) {
    const V t = truncated(x);
    if (op == Op::trunc) return t;
    if (op == Op::floor) return t - one_where(less(x, t));
    return rounded_up(x);
}
template <Op op>
void rounding(const Row& a, Row& r) {
    for (int c = 0; c < 16; c += width) put(r, c, rounded<op>(load(a.lo + c)), rounded<op>(load(a.hi + c)));
}
/// Halves upward. The difference to the next integer is rounded: a half may stand for a little more.
void rounding_to_nearest(const Row& a, Row& r) {
    const V half = all(0.5f);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), p = rounded_up(al), q = rounded_up(ah);
        put(r, c, p - one_where(less_equal(half, p - al)), q - one_where(less(half, q - ah)));
    }
}

/// Boxes where a number is surely true, surely false.
struct Truth {
    unsigned yes = 0, no = 0;
};
Truth truth_of(const Row& a) {
    Truth t;
    const V yes = all(surely_true_from), no = all(surely_false_below);
    for (int c = 0; c < 16; c += width) {
        const V lo = load(a.lo + c), hi = load(a.hi + c);
        t.yes |= bits(less_equal(yes, lo) | less_equal(hi, -yes)) << c;
        t.no |= bits(less(-no, lo) & less(hi, no)) << c;
    }
    return t;
}
template <bool or_equal>
Truth comparison(const Row& a, const Row& b) {
    Truth t;
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), bl = load(b.lo + c), bh = load(b.hi + c);
        t.yes |= bits(or_equal ? less_equal(ah, bl) : less(ah, bl)) << c;
        t.no |= bits(or_equal ? less(bh, al) : less_equal(bh, al)) << c;
    }
    return t;
}
void put_truth(Truth t, Row& r) {
    for (int k = 0; k < 16; ++k) {
        r.lo[k] = (t.yes >> k & 1u) ? 1.0f : 0.0f;
        r.hi[k] = (t.no >> k & 1u) ? 0.0f : 1.0f;
    }
}

}  // namespace
}  // namespace frep::tile
