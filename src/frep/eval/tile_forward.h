// The forward pass of the pruner: ranges of the clauses over 16 boxes, in binary32. Included by tile_impl.h
// alone, once for each instruction set. Method: end points to nearest, stepped outward relatively, so that a
// bound never leaves its sign; rows with bounds near 0 or infinity take slower forms that mind underflow and
// 0 * inf. What has no form here goes through Job::general. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_functions.h"
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

/// b where the condition surely holds, c where it surely does not, else both. Returns the flags.
std::uint32_t selection(const Job& job, Reader clause, Row& r) {
    const Row &condition = job.rows[clause.in(0)], &b = job.rows[clause.in(1)], &d = job.rows[clause.in(2)];
    const Truth t = truth_of(condition);
    const std::uint32_t fc = job.flags[clause.in(0)], fb = job.flags[clause.in(1)],
                        fd = job.flags[clause.in(2)];
    for (int k = 0; k < 16; ++k) {
        const bool yes = t.yes >> k & 1u, no = t.no >> k & 1u;
        const float lo = b.lo[k] < d.lo[k] ? b.lo[k] : d.lo[k], hi = b.hi[k] > d.hi[k] ? b.hi[k] : d.hi[k];
        r.lo[k] = yes ? b.lo[k] : no ? d.lo[k] : lo;
        r.hi[k] = yes ? b.hi[k] : no ? d.hi[k] : hi;
    }
    const std::uint32_t yes = t.yes | t.yes << 16, no = t.no | t.no << 16, open = ~(yes | no);
    const std::uint32_t undecided = ((fb | fd) & 0xffffu) | (fb & fd & 0xffff0000u);
    return fc | (fb & yes) | (fd & no) | (undecided & open);
}

/// What a clause needs of its operands to have a form here: returns false where it has none.
bool arithmetic(const Job& job, Reader clause, Row& r, std::uint32_t& f, unsigned& bad) {
    const Row &a = job.rows[clause.in(0)], &b = job.rows[clause.in(1)];
    const auto scale_of = [&](int k) {
        // a constant of ordinary size, else 0
        if (clause.in(k) >= job.constants) return 0.0f;
        const float x = job.rows[clause.in(k)].lo[0], size = x < 0 ? -x : x;
        return size > 1e-20f && size < 1e20f && job.flags[clause.in(k)] == 0 ? x : 0.0f;
    };
    switch (clause.op()) {
        case Op::add:
            f |= sum<false>(a, b, r);
            return true;
        case Op::sub:
            f |= sum<true>(a, b, r);
            return true;
        case Op::mul:
            if (const float x = scale_of(0); x != 0 && scaled<false>(b, x, r)) return true;
            if (const float x = scale_of(1); x != 0 && scaled<false>(a, x, r)) return true;
            f |= product(a, b, r);
            return true;
        case Op::div:
            if (const float x = scale_of(1); x != 0 && scaled<true>(a, x, r)) return true;
            if (!quotient(a, b, r)) bad = 0xffffu;
            return true;
        case Op::min:
            minimum(a, b, r);
            return true;
        case Op::max:
            maximum(a, b, r);
            return true;
        case Op::hypot:
            bad = hypotenuse(a, b, r);
            return true;
        case Op::r_and:
            bad = r_function<false>(a, b, r);
            return true;
        case Op::r_or:
            bad = r_function<true>(a, b, r);
            return true;
        case Op::less:
            put_truth(comparison<false>(a, b), r);
            return true;
        case Op::less_equal:
            put_truth(comparison<true>(a, b), r);
            return true;
        case Op::logical_and: {
            const Truth s = truth_of(a), t = truth_of(b);
            put_truth({s.yes & t.yes, s.no | t.no}, r);
            return true;
        }
        case Op::logical_or: {
            const Truth s = truth_of(a), t = truth_of(b);
            put_truth({s.yes | t.yes, s.no & t.no}, r);
            return true;
        }
        default:
            return false;
    }
}

bool one_operand(Reader clause, const Row& a, Row& r, std::uint32_t& f, unsigned& bad) {
    switch (clause.op()) {
        case Op::neg:
            negation(a, r);
            return true;
        case Op::square:
            square(a, r);
            return true;
        case Op::abs:
            absolute(a, r);
            return true;
        case Op::sqrt: {
            unsigned none = 0;
            f |= square_root(a, r, none);
            f |= none << 16;
            return true;
        }
        case Op::exp:
            exponential(a, r);
            return true;
        case Op::sin:
            bad = wave<0>(a, r);
            return true;
        case Op::cos:
            bad = wave<1>(a, r);
            return true;
        case Op::floor:
            rounding<Op::floor>(a, r);
            return true;
        case Op::ceil:
            rounding<Op::ceil>(a, r);
            return true;
        case Op::trunc:
            rounding<Op::trunc>(a, r);
            return true;
        case Op::round:
            rounding_to_nearest(a, r);
            return true;
        case Op::truth:
            put_truth(truth_of(a), r);
            return true;
        case Op::logical_not: {
            const Truth t = truth_of(a);
            put_truth({t.no, t.yes}, r);
            return true;
        }
        default:
            return false;
    }
}

void forward(const Job& job) {
    const auto* at = static_cast<const unsigned char*>(job.clauses);
    for (std::uint32_t i = 0; i < job.clause_count; ++i, at += clause_bytes) {
        const Reader clause{at};
        const std::uint32_t out = clause.out();
        Row& r = job.rows[out];
        bool done = false;
        std::uint32_t f = 0;
        unsigned bad = 0;
        if (!clause.listed()) {
            if (clause.count() == 2) {
                f = job.flags[clause.in(0)] | job.flags[clause.in(1)];
                done = arithmetic(job, clause, r, f, bad);
            } else if (clause.count() == 1) {
                f = job.flags[clause.in(0)];
                done = one_operand(clause, job.rows[clause.in(0)], r, f, bad);
            } else if (clause.op() == Op::select) {
                f = selection(job, clause, r);
                done = true;
            }
        }
        job.flags[out] = f;
        if (!done) bad = 0xffffu;
        if (bad != 0) job.general(job.self, i, bad);
    }
}

}  // namespace
}  // namespace frep::tile
