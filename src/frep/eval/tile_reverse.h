// The pass from the root down: which clauses each box needs, for their sign or their value, and what stands
// for a clause there. Included by tile_impl.h alone, once for each instruction set. Method: two masks of
// boxes a row, all users of a row before the row; the rules are those of
// docs/decisions/0012-pruning-by-demand.md. An operand that may be undefined is never dropped, since
// undefined passes through every operation. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_smooth.h"

namespace frep::tile {
namespace {

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
    if (rounded && d.margin > 0) {
        d = d.as_value();
        r.value |= static_cast<std::uint16_t>(d.live);
    }
    if (rounded) r.notes |= r_function_note;
    if (rounded) d.gain *= 2;  // their partial derivatives are within [0, 2]
    unsigned without_0 = 0, without_1 = 0;
    if (!rounded) {
        without_0 = united ? w.ordered(0, 1) : w.ordered(1, 0);
        without_1 = united ? w.ordered(1, 0) : w.ordered(0, 1);
    }
    if (const unsigned sign = d.sign(); sign != 0) {
        const float m = d.margin;
        without_0 |= sign & (united ? Walk::below(w.range(0), -m) : Walk::above(w.range(0), m));
        without_1 |= sign & (united ? Walk::below(w.range(1), -m) : Walk::above(w.range(1), m));
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

/// R-functions with a parameter, operand 2, that is a constant within `least` (excluded) and `most`: as R0
/// where only the sign counts. They have no form by minimum and maximum here, and no bound of their slopes.
template <bool united>
void parametric_operation(const Walk& w, Demand d, float least, float most_of, Record& r) {
    const bool good =
        w.is_constant(2) && w.undefined(2) == 0 && w.range(2).lo[0] > least && w.range(2).hi[0] <= most_of;
    const unsigned sign = good && !(d.margin > 0) ? d.sign() : 0;
    const unsigned without_0 = united ? w.negative(0) : w.positive(0);
    const unsigned without_1 = united ? w.negative(1) : w.positive(1);
    choose(w, {d.live, d.live & ~sign, 0}, sign & without_0, sign & without_1, r);
    w.ask_value(2, d.live & ~(unsigned{r.first} | unsigned{r.second}));
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

/// The gain of the operands of f * g or f/g where one is a constant.
float scaled_gain(const Walk& w, float gain, bool over) {
    const float c = constant_size(w, 1), b = over ? 0 : constant_size(w, 0);
    return c > 0 ? widened(over ? gain / c : gain * c) : b > 0 ? widened(gain * b) : endless;
}

/// f * g or f/g: the sign of f is enough where that of g is known (and inf/inf cannot come up); a margin goes
/// through constants.
void product_demand(const Walk& w, Demand d, bool over) {
    if (d.sign() != 0 && d.margin > 0) {
        const float c = constant_size(w, 1), b = over ? 0 : constant_size(w, 0);
        const float gain = scaled_gain(w, d.gain, over);
        if (c > 0) w.ask(0, {d.live, d.value, widened(over ? d.margin * c : d.margin / c), gain});
        if (b > 0) w.ask(1, {d.live, d.value, widened(d.margin / b), gain});
        if (c > 0 || b > 0) return;
        d = d.as_value();
    }
    const unsigned sign = d.sign();
    const float gain = scaled_gain(w, d.gain, over);
    if (sign == 0) {
        w.ask_value(0, d.live, gain);
        w.ask_value(1, d.live, gain);
        return;
    }
    const unsigned known_0 = over ? 0 : w.positive(0) | w.negative(0);
    unsigned known_1 = w.positive(1) | w.negative(1);
    if (over) known_1 &= Walk::above(w.range(1), -endless) & Walk::below(w.range(1), endless);
    w.ask(0, {d.live, d.value | (sign & ~known_1), 0, gain});
    w.ask(1, {d.live, d.value | (sign & ~known_0), 0, gain});
}

/// a + b within a margin needs a within that and the size of b more. Where only the sign counts, a term that
/// is 0 goes. Terms that the tolerance allows go, whatever is wanted.
void sum_demand(const Walk& w, Demand d, bool minus, Record& r) {
    const unsigned sign = d.sign();
    if (sign != 0 && smooth_demand(w, d, minus, r)) return;
    unsigned less_0 = 0, less_1 = 0;  // boxes without the one or the other
    if (w.job.tolerance > 0 && d.gain < endless && d.gain > small) {
        less_1 = d.live & w.within(1, w.job.tolerance / d.gain);
        if (!minus) less_0 = d.live & w.within(0, w.job.tolerance / d.gain) & ~less_1;
    }
    if (sign == 0) {
        r.first = static_cast<std::uint16_t>(less_1);
        r.second = static_cast<std::uint16_t>(less_0);
        w.ask_value(0, d.live & ~less_0, d.gain);
        w.ask_value(1, d.live & ~less_1, d.gain);
        return;
    }
    const unsigned first = sign & w.zero(1), second = minus ? 0 : sign & w.zero(0) & ~first;
    less_0 &= ~first;
    less_1 &= ~second;
    r.first = static_cast<std::uint16_t>(first | less_1);
    r.second = static_cast<std::uint16_t>(second | less_0);
    if (first != 0) w.ask(0, {first, 0, d.margin, d.gain});
    if (second != 0) w.ask(1, {second, 0, d.margin, d.gain});
    const unsigned rest = d.live & ~first & ~second;
    const float far_0 = farthest(w.range(0)), far_1 = farthest(w.range(1));
    const float margin_0 = widened(d.margin + far_1), margin_1 = widened(d.margin + far_0);
    const unsigned rest_0 = rest & ~less_0, rest_1 = rest & ~less_1;
    w.ask(0, {rest_0, margin_0 < far_0 ? d.value & rest_0 : rest_0, margin_0, d.gain});
    w.ask(1, {rest_1, margin_1 < far_1 ? d.value & rest_1 : rest_1, margin_1, d.gain});
}

/// |a| is a or -a where the sign of a is known. It is as large as a.
void absolute_demand(const Walk& w, Demand d, Record& r) {
    r.first = static_cast<std::uint16_t>(d.live & w.positive(0));
    r.base = static_cast<std::uint16_t>(d.live & w.negative(0));
    r.notes |= optional_choice;
    w.ask(0, d);
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
        case Op::r_alpha_and:
            parametric_operation<false>(w, d, -1.0f, 1.0f, r);
            return;
        case Op::r_alpha_or:
            parametric_operation<true>(w, d, -1.0f, 1.0f, r);
            return;
        case Op::rp_and:
            parametric_operation<false>(w, d, 1.0f, endless, r);
            return;
        case Op::rp_or:
            parametric_operation<true>(w, d, 1.0f, endless, r);
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

/// What 16 roundings of the result and of the operands of a clause may come to at the root.
float rounding_of(const Walk& w, float gain) {
    float size = farthest(w.job.rows[w.clause.out()]);
    for (int k = 0; k < static_cast<int>(w.clause.count()); ++k) size += farthest(w.range(k));
    return widened(size * gain * 0x1p-49f) + w.job.tolerance * 0x1p-20f;
}

std::size_t reverse(const Job& job) {
    Record* next = job.records;
    const auto* at = static_cast<const unsigned char*>(job.clauses) + job.clause_count * clause_bytes;
    for (std::uint32_t i = job.clause_count; i-- > 0;) {
        at -= clause_bytes;
        const Walk w{job, {at}};
        Wanted& row = job.wanted[w.clause.out()];
        if ((row.live | row.inner) == 0) continue;
        Wanted wanted = row;
        row = Wanted{};
        // two uses of one part of a smooth set operation, or a use besides it
        const unsigned all_of_it = wanted.stage == mixed_stages ? wanted.inner : wanted.inner & wanted.live;
        wanted.live |= static_cast<std::uint16_t>(all_of_it);
        wanted.value |= static_cast<std::uint16_t>(all_of_it);
        wanted.inner &= static_cast<std::uint16_t>(~all_of_it);
        Record& r = *next;
        ++next;
        r = Record{i, wanted.live, wanted.value, 0, 0, 0, 0};
        if (job.tolerance > 0 && wanted.gain < endless) *job.rounding += rounding_of(w, wanted.gain);
        if (wanted.live != 0) demand_of(w, {wanted.live, wanted.value, wanted.margin, wanted.gain}, r);
        if (wanted.inner != 0) inner_demand(w, wanted, r);
    }
    return static_cast<std::size_t>(next - job.records);
}

typedef std::uint16_t Masks __attribute__((vector_size(32), may_alias));
typedef std::uint32_t Counts __attribute__((vector_size(64), may_alias));

/// Adds counts that are kept as negative numbers, and clears them.
inline void collect(Masks& counts, Counts& sum) {
    for (int k = 0; k < 16; ++k) sum[k] += static_cast<std::uint16_t>(-counts[k]);
    counts = Masks{};
}

void agree(const Record* records, std::size_t count, unsigned lanes, bool set_operations,
           std::uint16_t* same_as, std::uint32_t* left) {
    Masks together = Masks{} + static_cast<std::uint16_t>(lanes), bit{}, counts{};
    Counts sum{};
    for (int k = 0; k < 16; ++k) bit[k] = static_cast<std::uint16_t>(1u << k);
    const auto refine = [&](std::uint16_t m) {
        const Masks mask = Masks{} + m;
        // all ones in the lanes outside the mask, which agree where its bits are 0
        together &= mask ^ (Masks)((mask & bit) == 0);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const Record& r = records[i];
        unsigned gone = r.first | r.second | r.base;
        if (set_operations && (r.notes & r_function_note) != 0) gone |= ~unsigned{r.value};
        const Masks needed = Masks{} + static_cast<std::uint16_t>(r.live & ~gone);
        counts += (Masks)((needed & bit) != 0);
        if (i % 0x8000 == 0x7fff) collect(counts, sum);
        if ((r.notes & optional_choice) != 0) continue;
        if ((r.first & lanes) != 0 && (r.first & lanes) != lanes) refine(r.first);
        if ((r.second & lanes) != 0 && (r.second & lanes) != lanes) refine(r.second);
        if ((r.base & lanes) != 0 && (r.base & lanes) != lanes) refine(r.base);
    }
    collect(counts, sum);
    __builtin_memcpy(same_as, &together, sizeof together);
    __builtin_memcpy(left, &sum, sizeof sum);
}

}  // namespace
}  // namespace frep::tile
