// The pass from the root down: which clauses each box needs, for their sign or their value, and what stands
// for a clause there. Included by tile_impl.h alone, once for each instruction set. Method: two masks of
// boxes a row, all users of a row before the row; the rules are those of
// docs/decisions/0012-pruning-by-demand.md. An operand that may be undefined is never dropped, since
// undefined passes through every operation. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_forward.h"

namespace frep::tile {
namespace {

/// Boxes that need a clause, those that need its value, and those for which its sign is enough.
struct Demand {
    unsigned live, value;
    unsigned sign() const { return live & ~value; }
    Demand only(unsigned boxes) const { return {live & boxes, value & boxes}; }
};

struct Walk {
    const Job& job;
    Reader clause;

    const std::uint32_t* operands() const { return job.operands + clause.in(0); }
    /// Row of operand k.
    std::uint32_t row(int k) const { return clause.listed() ? operands()[k] : clause.in(k); }
    const Row& range(int k) const { return job.rows[row(k)]; }
    unsigned undefined(int k) const { return job.flags[row(k)] & 0xffffu; }
    void ask(int k, Demand d) const { job.demand[row(k)] |= d.live | d.value << 16; }
    /// All of operand k, where the clause is needed.
    void ask_value(int k, unsigned boxes) const { job.demand[row(k)] |= boxes | boxes << 16; }

    unsigned positive(int k) const { return above(range(k), 0.0f); }
    unsigned negative(int k) const { return below(range(k), 0.0f); }
    /// Boxes where the range lies above, below x.
    static unsigned above(const Row& a, float x) {
        unsigned m = 0;
        for (int c = 0; c < 16; c += width) m |= bits(less(all(x), load(a.lo + c))) << c;
        return m;
    }
    static unsigned below(const Row& a, float x) {
        unsigned m = 0;
        for (int c = 0; c < 16; c += width) m |= bits(less(load(a.hi + c), all(x))) << c;
        return m;
    }
    /// Boxes where all of operand j lies below all of operand k.
    unsigned ordered(int j, int k) const {
        const Row &a = range(j), &b = range(k);
        unsigned m = 0;
        for (int c = 0; c < 16; c += width) m |= bits(less(load(a.hi + c), load(b.lo + c))) << c;
        return m;
    }
    /// Boxes where operand k is 0.
    unsigned zero(int k) const {
        const Row& a = range(k);
        unsigned m = 0;
        for (int c = 0; c < 16; c += width)
            m |= bits(same(load(a.lo + c), all(0.0f)) & same(load(a.hi + c), all(0.0f))) << c;
        return m & ~undefined(k);
    }
};

/// The choice of operand 0 or 1: boxes that may do without the one or the other. Both keep their context.
void choose(const Walk& w, Demand d, unsigned without_0, unsigned without_1, Record& r) {
    const unsigned first = d.live & without_1 & ~w.undefined(1);
    const unsigned second = d.live & without_0 & ~w.undefined(0) & ~first;
    r.first = static_cast<std::uint16_t>(first);
    r.second = static_cast<std::uint16_t>(second);
    w.ask(0, d.only(~second));
    w.ask(1, d.only(~first));
}

/// Set operations. R-functions choose by signs only, and only where the sign is enough.
template <bool united, bool rounded>
void set_operation(const Walk& w, Demand d, Record& r) {
    unsigned without_0 = 0, without_1 = 0;
    if (!rounded) {
        without_0 = united ? w.ordered(0, 1) : w.ordered(1, 0);
        without_1 = united ? w.ordered(1, 0) : w.ordered(0, 1);
    }
    if (const unsigned sign = d.sign(); sign != 0) {
        without_0 |= sign & (united ? w.negative(0) : w.positive(0));
        without_1 |= sign & (united ? w.negative(1) : w.positive(1));
    }
    choose(w, d, without_0, without_1, r);
}

/// A blend that is the R-function of its first two operands in the boxes `rest`, and there drops all others.
template <bool united>
void blend(const Walk& w, Demand d, unsigned rest, Record& r) {
    const int count = static_cast<int>(w.clause.count());
    for (int k = 2; k < count; ++k) rest &= ~w.undefined(k);
    rest &= d.live;
    const unsigned active = d.live & ~rest;
    r.base = static_cast<std::uint16_t>(rest);
    if (rest != 0) set_operation<united, true>(w, d.only(rest), r);
    for (int k = 0; k < count; ++k) w.ask_value(k, active);
}

unsigned can_be_positive(const Row& a) {
    unsigned m = 0;
    for (int c = 0; c < 16; c += width) m |= bits(less(all(0.0f), load(a.hi + c))) << c;
    return m;
}

/// Boxes where operand k is surely larger than `times` its extent, both without their signs.
unsigned beyond(const Walk& w, int k, int extent, float times) {
    const Row &f = w.range(k), &a = w.range(extent);
    const V zero = all(0.0f);
    unsigned m = 0;
    for (int c = 0; c < 16; c += width) {
        const V near = most(zero, most(load(f.lo + c), -load(f.hi + c)));
        const V far = most(-load(a.lo + c), load(a.hi + c)) * all(times);
        m |= bits(less(far, near)) << c;
    }
    return m;
}

/// f * g or f/g: the sign of f is enough where that of g is known (and inf/inf cannot come up).
void product_demand(const Walk& w, Demand d, bool over) {
    const unsigned sign = d.sign();
    if (sign == 0) {
        w.ask_value(0, d.live);
        w.ask_value(1, d.live);
        return;
    }
    const unsigned known_0 = over ? 0 : w.positive(0) | w.negative(0);
    unsigned known_1 = w.positive(1) | w.negative(1);
    if (over) known_1 &= Walk::above(w.range(1), -endless) & Walk::below(w.range(1), endless);
    w.ask(0, {d.live, d.value | (sign & ~known_1)});
    w.ask(1, {d.live, d.value | (sign & ~known_0)});
}

/// Where only the sign counts, a term that is 0 goes.
void sum_demand(const Walk& w, Demand d, bool minus, Record& r) {
    unsigned first = 0, second = 0;
    if (const unsigned sign = d.sign(); sign != 0) {
        first = sign & w.zero(1);
        if (!minus) second = sign & w.zero(0) & ~first;
    }
    r.first = static_cast<std::uint16_t>(first);
    r.second = static_cast<std::uint16_t>(second);
    w.ask(0, {d.live & ~second, (d.live & ~second) & ~first});
    w.ask(1, {d.live & ~first, (d.live & ~first) & ~second});
}

/// |a| is a or -a where the sign of a is known.
void absolute_demand(const Walk& w, Demand d, Record& r) {
    const unsigned plus = d.live & w.positive(0), minus = d.live & w.negative(0);
    r.first = static_cast<std::uint16_t>(plus);
    r.base = static_cast<std::uint16_t>(minus);
    r.optional = 1;
    w.ask(0, {d.live, d.value | (d.live & ~plus & ~minus)});
}

void selection_demand(const Walk& w, Demand d, Record& r) {
    const Truth t = truth_of(w.range(0));
    const unsigned known = d.live & ~w.undefined(0), yes = known & t.yes, no = known & t.no;
    r.first = static_cast<std::uint16_t>(yes);
    r.second = static_cast<std::uint16_t>(no);
    w.ask_value(0, d.live & ~yes & ~no);
    w.ask(1, d.only(~no));
    w.ask(2, d.only(~yes));
}

void demand_of(const Walk& w, Demand d, Record& r) {
    constexpr float half_root = 0.708f;  // (f1/a1)^2 + (f2/a2)^2 >= 1 where both or one of them allow it
    switch (w.clause.op()) {
        case Op::neg:
            w.ask(0, d);
            return;
        case Op::min:
            set_operation<false, false>(w, d, r);
            return;
        case Op::max:
            set_operation<true, false>(w, d, r);
            return;
        case Op::r_and:
            set_operation<false, true>(w, d, r);
            return;
        case Op::r_or:
            set_operation<true, true>(w, d, r);
            return;
        case Op::bounded_uni:
            blend<true>(w, d, ~can_be_positive(w.range(2)), r);
            return;
        case Op::bounded_int:
            blend<false>(w, d, ~can_be_positive(w.range(2)), r);
            return;
        case Op::point_uni:
        case Op::point_int: {
            const unsigned rest = beyond(w, 0, 3, 1.0001f) | beyond(w, 1, 4, 1.0001f) |
                                  (beyond(w, 0, 3, half_root) & beyond(w, 1, 4, half_root));
            if (w.clause.op() == Op::point_uni)
                blend<true>(w, d, rest, r);
            else
                blend<false>(w, d, rest, r);
            return;
        }
        case Op::mul:
            product_demand(w, d, false);
            return;
        case Op::div:
            product_demand(w, d, true);
            return;
        case Op::add:
            sum_demand(w, d, false, r);
            return;
        case Op::sub:
            sum_demand(w, d, true, r);
            return;
        case Op::abs:
            absolute_demand(w, d, r);
            return;
        case Op::select:
            selection_demand(w, d, r);
            return;
        default:
            for (int k = 0; k < static_cast<int>(w.clause.count()); ++k) w.ask_value(k, d.live);
    }
}

std::size_t reverse(const Job& job) {
    Record* next = job.records;
    const auto* at = static_cast<const unsigned char*>(job.clauses) + job.clause_count * clause_bytes;
    for (std::uint32_t i = job.clause_count; i-- > 0;) {
        at -= clause_bytes;
        const Walk w{job, {at}};
        std::uint32_t& wanted = job.demand[w.clause.out()];
        if (wanted == 0) continue;
        const Demand d{wanted & 0xffffu, wanted >> 16};
        wanted = 0;
        *next =
            Record{i, static_cast<std::uint16_t>(d.live), static_cast<std::uint16_t>(d.value), 0, 0, 0, 0};
        demand_of(w, d, *next);
        ++next;
    }
    return static_cast<std::size_t>(next - job.records);
}

/// Boxes of `lanes` whose choices agree with those of box k.
void agree(const Record* records, std::size_t count, unsigned lanes, std::uint16_t* same_as) {
    typedef std::uint16_t Masks __attribute__((vector_size(32), may_alias));
    Masks together = Masks{} + static_cast<std::uint16_t>(lanes), bit{};
    for (int k = 0; k < 16; ++k) bit[k] = static_cast<std::uint16_t>(1u << k);
    const auto refine = [&](std::uint16_t m) {
        const Masks mask = Masks{} + m;
        // all ones in the lanes outside the mask, which agree where its bits are 0
        together &= mask ^ (Masks)((mask & bit) == 0);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const Record& r = records[i];
        if (r.optional != 0) continue;
        if ((r.first & lanes) != 0 && (r.first & lanes) != lanes) refine(r.first);
        if ((r.second & lanes) != 0 && (r.second & lanes) != lanes) refine(r.second);
        if ((r.base & lanes) != 0 && (r.base & lanes) != lanes) refine(r.base);
    }
    __builtin_memcpy(same_as, &together, sizeof together);
}

}  // namespace
}  // namespace frep::tile
