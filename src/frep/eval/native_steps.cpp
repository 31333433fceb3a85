// Implementation of native_steps.h: the hash table of steps, folding and simplification.
#include "frep/eval/native_steps.h"

#include <algorithm>
#include <bit>

#include "frep/base/result.h"
#include "frep/math/rounding.h"

namespace frep::native {
namespace {

bool commutes(StepOp op) {
    switch (op) {
        case StepOp::add:
        case StepOp::multiply:
        case StepOp::bit_and:
        case StepOp::bit_or:
        case StepOp::bit_xor:
        case StepOp::word_add:
        case StepOp::mask_and:
        case StepOp::mask_or:
            return true;
        default:
            return false;
    }
}

std::uint64_t hash_of(const Step& step) {
    std::uint64_t h = (static_cast<std::uint64_t>(step.op) << 8 | step.immediate) * 0x9E3779B97F4A7C15u;
    for (int k = 0; k < step.count; ++k) h = (h ^ step.in[k]) * 0xBF58476D1CE4E5B9u;
    h = (h ^ step.bits) * 0x94D049BB133111EBu;
    return h ^ (h >> 31);
}

Predicate opposite(Predicate p) {
    switch (p) {
        case Predicate::equal:
            return Predicate::not_equal;
        case Predicate::not_equal:
            return Predicate::equal;
        case Predicate::unordered:
            return Predicate::ordered;
        case Predicate::ordered:
            return Predicate::unordered;
        case Predicate::less:
            return Predicate::not_less;
        case Predicate::not_less:
            return Predicate::less;
        case Predicate::less_equal:
            return Predicate::not_less_equal;
        case Predicate::not_less_equal:
            return Predicate::less_equal;
        default:
            FREP_CHECK(false);  // made when instructions are written, never in a list
    }
}

enum class Known { no, yes, open };

Known known_to_hold(Predicate p, const Facts& a, const Facts& b, bool same) {
    const bool numbers = !a.nan && !b.nan;
    switch (p) {
        case Predicate::unordered:
            return numbers ? Known::no : Known::open;
        case Predicate::less:
            if (a.lo >= b.hi || same) return Known::no;
            return a.hi < b.lo && numbers ? Known::yes : Known::open;
        case Predicate::less_equal:
            if (a.lo > b.hi) return Known::no;
            return (a.hi <= b.lo || same) && numbers ? Known::yes : Known::open;
        case Predicate::equal:
            if (a.lo > b.hi || a.hi < b.lo) return Known::no;
            return (same || (a.lo == a.hi && b.lo == b.hi && a.lo == b.lo)) && numbers ? Known::yes
                                                                                       : Known::open;
        default: {
            const Known k = known_to_hold(opposite(p), a, b, same);
            return k == Known::open ? k : k == Known::yes ? Known::no : Known::yes;
        }
    }
}

}  // namespace

StepList::StepList(bool single, bool has_scale)
    : single_(single), has_scale_(has_scale), table_(256, no_value) {}

double StepList::number_of(ValueId v) const { return number_of_bits(single_, steps_[v].bits); }

bool StepList::is_number(ValueId v, double number) const {
    return is_constant(v) && steps_[v].bits == bits_of_number(single_, number);
}

ValueId StepList::append(const Step& step, const Facts& facts) {
    steps_.push_back(step);
    facts_.push_back(facts);
    return static_cast<ValueId>(steps_.size() - 1);
}

void StepList::grow_table() {
    table_.assign(table_.size() * 4, no_value);
    const std::size_t mask = table_.size() - 1;
    for (ValueId v = 0; v < steps_.size(); ++v) {
        if (steps_[v].op == StepOp::call) continue;
        std::size_t at = hash_of(steps_[v]) & mask;
        while (table_[at] != no_value) at = (at + 1) & mask;
        table_[at] = v;
    }
}

ValueId StepList::number(const Step& step, const Facts& facts) {
    if (steps_.size() * 2 >= table_.size()) grow_table();
    const std::size_t mask = table_.size() - 1;
    std::size_t at = hash_of(step) & mask;
    for (; table_[at] != no_value; at = (at + 1) & mask)
        if (steps_[table_[at]] == step) return table_[at];
    return table_[at] = append(step, facts);
}

ValueId StepList::constant_bits(std::uint64_t bits) {
    Step step;
    step.bits = bits & word_mask();
    return number(step, facts_of_number(number_of_bits(single_, step.bits)));
}

ValueId StepList::constant(double value) { return constant_bits(bits_of_number(single_, value)); }

ValueId StepList::input(std::uint32_t which, const Facts& facts) {
    Step step;
    step.op = StepOp::input;
    step.bits = which;
    return number(step, facts);
}

ValueId StepList::mask_constant(bool truth) {
    Step step;
    step.op = StepOp::mask_constant;
    step.immediate = truth;
    return number(step, {});
}

ValueId StepList::fold_constants(StepOp op, ValueId a, ValueId b, std::uint8_t immediate) {
    const std::uint64_t x = steps_[a].bits, y = b == no_value ? 0 : steps_[b].bits;
    const double p = number_of(a), q = b == no_value ? 0 : number_of(b);
    switch (op) {
        case StepOp::add:
        case StepOp::subtract:
        case StepOp::multiply:
        case StepOp::divide:
        case StepOp::square_root:
            return constant(rounded_operation(single_, op, p, q));
        case StepOp::lesser:
            return p < q ? a : b;
        case StepOp::greater:
            return q < p ? a : b;
        case StepOp::round:
            return constant(immediate == static_cast<int>(Rounding::down) ? math::floor(p)
                            : immediate == static_cast<int>(Rounding::up) ? math::ceil(p)
                                                                          : math::trunc(p));
        case StepOp::bit_and:
            return constant_bits(x & y);
        case StepOp::bit_or:
            return constant_bits(x | y);
        case StepOp::bit_xor:
            return constant_bits(x ^ y);
        case StepOp::word_add:
            return constant_bits(x + y);
        case StepOp::word_subtract:
            return constant_bits(x - y);
        case StepOp::shift_left:
            return constant_bits(x << immediate);
        case StepOp::shift_right:
            return constant_bits(x >> immediate);
        case StepOp::low_bit:
            return mask_constant((x & 1) != 0);
        default:
            return no_value;
    }
}

/// One of the operands where the result has its bits for every value that the facts allow.
ValueId StepList::simplify(StepOp op, ValueId a, ValueId b, std::uint8_t) {
    if (b == no_value) return no_value;
    const Facts &fa = facts_[a], &fb = facts_[b];
    switch (op) {
        case StepOp::add:
            if (is_number(b, -0.0) || (is_number(b, 0.0) && !fa.minus_zero)) return a;
            if (is_number(a, -0.0) || (is_number(a, 0.0) && !fb.minus_zero)) return b;
            return no_value;
        case StepOp::subtract:
            if (is_number(b, 0.0) || (is_number(b, -0.0) && !fa.minus_zero)) return a;
            return no_value;
        case StepOp::multiply:
            if (is_number(b, 1.0)) return a;
            if (is_number(a, 1.0)) return b;
            if (is_number(b, -1.0)) return make(StepOp::bit_xor, a, constant_bits(sign_bit()));
            if (is_number(a, -1.0)) return make(StepOp::bit_xor, b, constant_bits(sign_bit()));
            return has_scale_ ? find_scale(a, b) : no_value;
        case StepOp::divide: {
            if (is_number(b, 1.0)) return a;
            if (!is_constant(b)) return no_value;
            // A power of two: its reciprocal is exact.
            const double d = number_of(b), r = rounded_operation(single_, op, 1.0, d);
            const std::uint64_t fraction = single_ ? 0x7fffffu : 0xfffffffffffffu;
            const double small = single_ ? 0x1p-120 : 0x1p-1000, large = single_ ? 0x1p120 : 0x1p1000;
            const double size = d < 0 ? -d : d;
            if ((steps_[b].bits & fraction) == 0 && size > small && size < large)
                return make(StepOp::multiply, a, constant(r));
            return no_value;
        }
        case StepOp::lesser:
            if (fa.nan || fb.nan) return no_value;
            return fa.hi < fb.lo ? a : fb.hi <= fa.lo ? b : no_value;
        case StepOp::greater:
            if (fa.nan || fb.nan) return no_value;
            return fa.lo > fb.hi ? a : fb.lo >= fa.hi ? b : no_value;
        default:
            return simplify_masks(op, a, b);
    }
}

/// True if v = op(something, the constant with bits `second`), or a shift by `places`.
bool StepList::is_step(ValueId v, StepOp op, std::uint64_t second, int places) const {
    const Step& step = steps_[v];
    if (step.op != op) return false;
    if (step.count == 1) return step.immediate == places;
    return is_constant(step.in[1]) && steps_[step.in[1]].bits == second;
}

/// The formula by which the kernels of exp multiply by a power of two in two factors (scale() of exp_log.h
/// and single/exp_log.h): the first product is exact, so that one operation of the machine has the same bits.
ValueId StepList::find_scale(ValueId a, ValueId b) {
    const int fraction = single_ ? 23 : 52;
    const std::uint64_t bias = single_ ? 127 : 1023,
                        to_integer = bits_of_number(single_, single_ ? 0x1.8p23 : 0x1.8p52);
    if (steps_[a].op == StepOp::shift_left) std::swap(a, b);
    if (steps_[a].op != StepOp::multiply || !is_step(b, StepOp::shift_left, 0, fraction)) return no_value;
    const ValueId sum = steps_[b].in[0];
    if (!is_step(sum, StepOp::word_add, 2 * bias + 1)) return no_value;
    const ValueId rest = steps_[sum].in[0];
    if (steps_[rest].op != StepOp::word_subtract) return no_value;
    const ValueId k = steps_[rest].in[0], half = steps_[rest].in[1];
    if (!is_step(k, StepOp::word_subtract, to_integer) || !is_step(half, StepOp::shift_right, 0, 1))
        return no_value;
    const ValueId moved = steps_[half].in[0];
    if (!is_step(moved, StepOp::word_add, 2 * bias + 2) || steps_[moved].in[0] != k) return no_value;
    for (int i = 0; i < 2; ++i) {
        const ValueId first = steps_[a].in[i];
        if (!is_step(first, StepOp::shift_left, 0, fraction)) continue;
        const ValueId less = steps_[first].in[0];
        if (!is_step(less, StepOp::word_subtract, 1) || steps_[less].in[0] != half) continue;
        const ValueId integer = make(StepOp::subtract, steps_[k].in[0], constant_bits(to_integer));
        return make(StepOp::scale, steps_[a].in[1 - i], integer);
    }
    return no_value;
}

ValueId StepList::simplify_masks(StepOp op, ValueId a, ValueId b) {
    if (op == StepOp::bit_xor && is_constant(b) && steps_[a].op == StepOp::bit_xor)
        for (int k = 0; k < 2; ++k)
            if (is_constant(steps_[a].in[k]) && steps_[steps_[a].in[k]].bits == steps_[b].bits)
                return steps_[a].in[1 - k];
    if (op == StepOp::bit_and && is_constant(b) && steps_[a].op == StepOp::bit_and)
        for (int k = 0; k < 2; ++k)
            if (is_constant(steps_[a].in[k]) && steps_[steps_[a].in[k]].bits == steps_[b].bits) return a;
    if (op != StepOp::mask_and && op != StepOp::mask_or) return no_value;
    if (a == b) return a;
    const bool conjunction = op == StepOp::mask_and;
    if (steps_[a].op == StepOp::mask_constant) return (steps_[a].immediate != 0) == conjunction ? b : a;
    if (steps_[b].op == StepOp::mask_constant) return (steps_[b].immediate != 0) == conjunction ? a : b;
    return no_value;
}

ValueId StepList::make(StepOp op, ValueId a, ValueId b, std::uint8_t immediate) {
    if (is_constant(a) && (b == no_value || is_constant(b))) {
        const ValueId folded = fold_constants(op, a, b, immediate);
        if (folded != no_value) return folded;
    }
    // Constants last: they become operands in memory.
    if (commutes(op) && (is_constant(a) != is_constant(b) ? is_constant(a) : a > b)) std::swap(a, b);
    const ValueId simple = simplify(op, a, b, immediate);
    if (simple != no_value) return simple;
    Step step;
    step.op = op;
    step.immediate = immediate;
    step.count = b == no_value ? 1 : 2;
    step.in[0] = a;
    step.in[1] = b;
    return number(step, is_mask(op) ? Facts{} : facts_of_step(*this, op, a, b, immediate));
}

ValueId StepList::compare(Predicate predicate, ValueId a, ValueId b) {
    const Known known = known_to_hold(predicate, facts_[a], facts_[b], a == b);
    if (known != Known::open) return mask_constant(known == Known::yes);
    Step step;
    step.op = StepOp::compare;
    step.immediate = static_cast<std::uint8_t>(predicate);
    step.count = 2;
    step.in[0] = a;
    step.in[1] = b;
    return number(step, {});
}

ValueId StepList::mask_not(ValueId m) {
    const Step step = steps_[m];
    if (step.op == StepOp::mask_constant) return mask_constant(step.immediate == 0);
    if (step.op == StepOp::mask_not) return step.in[0];
    if (step.op == StepOp::compare)
        return compare(opposite(static_cast<Predicate>(step.immediate)), step.in[0], step.in[1]);
    Step inverse;
    inverse.op = StepOp::mask_not;
    inverse.count = 1;
    inverse.in[0] = m;
    return number(inverse, {});
}

ValueId StepList::choose(ValueId mask, ValueId a, ValueId b) {
    if (a == b) return a;
    if (steps_[mask].op == StepOp::mask_constant) return steps_[mask].immediate != 0 ? a : b;
    // Selections by a comparison of the same two values are what the machine's minimum and maximum compute.
    const Step& test = steps_[mask];
    if (test.op == StepOp::compare && test.immediate == static_cast<int>(Predicate::less)) {
        if (test.in[0] == a && test.in[1] == b) return make(StepOp::lesser, a, b);
        if (test.in[0] == b && test.in[1] == a) return make(StepOp::greater, a, b);
    }
    Step step;
    step.op = StepOp::choose;
    step.count = 3;
    step.in[0] = mask;
    step.in[1] = a;
    step.in[2] = b;
    return number(step, hull_of(facts_[a], facts_[b]));
}

/// The machine's operation gives its second operand where one is NaN or both are zeros.
ValueId StepList::extremum(StepOp op, ValueId a, ValueId b) {
    if (a == b) return a;
    if (a > b) std::swap(a, b);
    if (is_constant(a)) std::swap(a, b);
    const bool least = op == StepOp::lesser;
    // True where op(x, y) gives the right zero.
    const auto zeros_fit = [&](ValueId x, ValueId y) {
        const Facts &fx = facts_[x], &fy = facts_[y];
        return least ? !fx.minus_zero || !fy.plus_zero : !fx.plus_zero || !fy.minus_zero;
    };
    const bool forth = zeros_fit(a, b), back = zeros_fit(b, a);
    if (forth && !facts_[a].nan) return make(op, a, b);
    if (back && !facts_[b].nan) return make(op, b, a);
    if (forth) return choose(compare(Predicate::unordered, a, a), a, make(op, a, b));
    if (back) return choose(compare(Predicate::unordered, b, b), b, make(op, b, a));
    const ValueId one = make(op, a, b), other = make(op, b, a);
    Facts facts = facts_of_step(*this, op, a, b, 0);
    facts.nan = facts_[a].nan || facts_[b].nan;
    // Zeros of both signs: their bits joined; a NaN with any number joined by "or" stays NaN.
    const ValueId joined = make(least ? StepOp::bit_or : StepOp::bit_and, one, other);
    if (least || !facts.nan) {
        refine(joined, facts);
        return joined;
    }
    const ValueId r = choose(compare(Predicate::unordered, a, b), constant(math::quiet_nan), joined);
    refine(r, facts);
    return r;
}

ValueId StepList::minimum(ValueId a, ValueId b) { return extremum(StepOp::lesser, a, b); }
ValueId StepList::maximum(ValueId a, ValueId b) { return extremum(StepOp::greater, a, b); }

ValueId StepList::patch(ValueId mask, ValueId r, ValueId x, ValueId y, const void* function) {
    if (steps_[mask].op == StepOp::mask_constant && steps_[mask].immediate == 0) return r;
    Step step;
    step.op = StepOp::patch;
    step.count = y == no_value ? 3 : 4;
    step.in[0] = mask;
    step.in[1] = r;
    step.in[2] = x;
    step.in[3] = y;
    step.bits = reinterpret_cast<std::uintptr_t>(function);
    return number(step, {});
}

ValueId StepList::call(std::uint32_t which, std::span<const ValueId> operands) {
    Step step;
    step.op = StepOp::call;
    step.in[0] = static_cast<ValueId>(listed_.size());
    step.in[1] = static_cast<ValueId>(operands.size());
    step.bits = which;
    listed_.insert(listed_.end(), operands.begin(), operands.end());
    return append(step, {});
}

void StepList::refine(ValueId v, const Facts& facts) {
    Facts& f = facts_[v];
    f.lo = std::max(f.lo, facts.lo);
    f.hi = std::min(f.hi, facts.hi);
    f.nan = f.nan && facts.nan;
    f.plus_zero = f.plus_zero && facts.plus_zero;
    f.minus_zero = f.minus_zero && facts.minus_zero;
}

}  // namespace frep::native
