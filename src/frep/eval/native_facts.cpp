// What is known of the values of native_steps.h: ranges by the rounded operation at the end points (rounding
// is monotone, so the bounds hold for the computed values), possible NaNs, and which zeros may occur.
// Tested by tests/unit/eval/native_steps_test.cpp.
#include <algorithm>
#include <bit>

#include "frep/eval/native_steps.h"
#include "frep/math/rounding.h"

namespace frep::native {
namespace {

constexpr double infinity = math::infinity;

template <class Real>
double operate(StepOp op, Real a, Real b) {
    switch (op) {
        case StepOp::add:
            return a + b;
        case StepOp::subtract:
            return a - b;
        case StepOp::multiply:
            return a * b;
        case StepOp::divide:
            return a / b;
        case StepOp::square_root:
            if constexpr (sizeof(Real) == 4) {
                return __builtin_sqrtf(a);
            } else {
                return __builtin_sqrt(a);
            }
        default:
            return math::quiet_nan;
    }
}

/// The range that some corner values span; a corner that is NaN leaves it open.
void span_corners(Facts& facts, std::initializer_list<double> corners) {
    facts.lo = infinity;
    facts.hi = -infinity;
    for (const double c : corners) {
        if (c != c) {
            facts.lo = -infinity;
            facts.hi = infinity;
            return;
        }
        facts.lo = std::min(facts.lo, c);
        facts.hi = std::max(facts.hi, c);
    }
}

/// Zeros of a result whose range is known, when its sign is the product of the signs.
void signs_of_product(Facts& facts, const Facts& a, const Facts& b, bool same) {
    const bool reaches = facts.lo <= 0 && facts.hi >= 0;
    const bool unlike =
        !same && ((a.may_be_plus() && b.may_be_minus()) || (a.may_be_minus() && b.may_be_plus()));
    const bool alike = same || (a.may_be_plus() && b.may_be_plus()) || (a.may_be_minus() && b.may_be_minus());
    facts.plus_zero = reaches && alike;
    facts.minus_zero = reaches && unlike;
}

Facts of_sum(bool single, const Facts& a, const Facts& b) {
    Facts r;
    r.nan =
        a.nan || b.nan || (a.hi == infinity && b.lo == -infinity) || (a.lo == -infinity && b.hi == infinity);
    const double lo = rounded_operation(single, StepOp::add, a.lo, b.lo);
    const double hi = rounded_operation(single, StepOp::add, a.hi, b.hi);
    r.lo = lo == lo ? lo : -infinity;
    r.hi = hi == hi ? hi : infinity;
    const bool reaches = r.lo <= 0 && r.hi >= 0;
    r.minus_zero = a.minus_zero && b.minus_zero;
    r.plus_zero = reaches;
    return r;
}

Facts negated(const Facts& a) { return {-a.hi, -a.lo, a.nan, a.minus_zero, a.plus_zero}; }

Facts of_product(bool single, const Facts& a, const Facts& b, bool same) {
    Facts r;
    const bool a_endless = !a.finite(), b_endless = !b.finite();
    r.nan = a.nan || b.nan || (!same && ((a.may_be_zero() && b_endless) || (b.may_be_zero() && a_endless)));
    const auto at = [&](double x, double y) { return rounded_operation(single, StepOp::multiply, x, y); };
    if (same) {
        const double low = at(a.lo, a.lo), high = at(a.hi, a.hi);
        span_corners(r, {low, high});
        if (a.lo <= 0 && a.hi >= 0) r.lo = 0;
    } else {
        span_corners(r, {at(a.lo, b.lo), at(a.lo, b.hi), at(a.hi, b.lo), at(a.hi, b.hi)});
    }
    signs_of_product(r, a, b, same);
    return r;
}

Facts of_quotient(bool single, const Facts& a, const Facts& b) {
    Facts r;
    r.nan = a.nan || b.nan || (a.may_be_zero() && b.may_be_zero()) || (!a.finite() && !b.finite());
    if (b.lo > 0 || b.hi < 0) {
        const auto at = [&](double x, double y) { return rounded_operation(single, StepOp::divide, x, y); };
        span_corners(r, {at(a.lo, b.lo), at(a.lo, b.hi), at(a.hi, b.lo), at(a.hi, b.hi)});
    }
    signs_of_product(r, a, b, false);
    return r;
}

Facts of_root(bool single, const Facts& a) {
    Facts r;
    r.nan = a.nan || a.lo < 0;
    r.lo = a.lo > 0 ? rounded_operation(single, StepOp::square_root, a.lo, 0) : 0;
    r.hi = a.hi > 0 ? rounded_operation(single, StepOp::square_root, a.hi, 0) : 0;
    r.plus_zero = a.plus_zero;
    r.minus_zero = a.minus_zero;
    return r;
}

Facts of_rounding(const Facts& a, Rounding how) {
    const auto at = [how](double x) {
        return how == Rounding::down ? math::floor(x) : how == Rounding::up ? math::ceil(x) : math::trunc(x);
    };
    Facts r{at(a.lo), at(a.hi), a.nan, true, true};
    const bool reaches = r.lo <= 0 && r.hi >= 0;
    r.plus_zero = reaches && a.may_be_plus();
    r.minus_zero = reaches && a.may_be_minus();
    return r;
}

/// a with some bits of its significand cleared: towards 0.
Facts cut_short(const Facts& a) {
    Facts r = a;
    r.lo = std::min(a.lo, 0.0);
    r.hi = std::max(a.hi, 0.0);
    r.plus_zero = a.may_be_plus();
    r.minus_zero = a.may_be_minus();
    return r;
}

Facts of_bits(const StepList& list, StepOp op, ValueId a, ValueId b) {
    if (list.is_constant(a)) std::swap(a, b);
    const Facts fa = list.facts(a), fb = list.facts(b);
    const std::uint64_t sign = list.sign_bit(), rest = list.word_mask() ^ sign;
    if (list.is_constant(b)) {
        const std::uint64_t c = list.bits_of(b);
        if (op == StepOp::bit_and && c == rest) {
            Facts r;
            r.nan = fa.nan;
            r.lo = fa.lo > 0 ? fa.lo : fa.hi < 0 ? -fa.hi : 0;
            r.hi = std::max(-fa.lo, fa.hi);
            r.plus_zero = fa.may_be_zero();
            r.minus_zero = false;
            return r;
        }
        if (op == StepOp::bit_and && c == sign) return {0, 0, false, true, true};
        if (op == StepOp::bit_xor && c == sign) return negated(fa);
        const std::uint64_t exponent = list.single() ? 0x7f800000u : 0x7ff0000000000000u;
        if (op == StepOp::bit_and && (c & (sign | exponent)) == (sign | exponent) && !fa.nan)
            return cut_short(fa);
        return {};
    }
    // A number whose sign is given or changed by another's.
    const auto only_sign = [](const Facts& f) { return f.lo == 0 && f.hi == 0 && !f.nan; };
    if (only_sign(fa) && !only_sign(fb)) return of_bits(list, op, b, a);
    if (only_sign(fb) && (op == StepOp::bit_or || op == StepOp::bit_xor)) {
        const double size = std::max(-fa.lo, fa.hi);
        return {-size, size, fa.nan, fa.may_be_zero(), fa.may_be_zero()};
    }
    return {};
}

/// A word of which one bit of the operand came to the place of the sign, and nothing else.
bool leaves_sign_only(const StepList& list, ValueId a, std::uint8_t places) {
    const Step& step = list.steps()[a];
    if (step.op != StepOp::bit_and) return false;
    for (int k = 0; k < 2; ++k)
        if (list.is_constant(step.in[k]) &&
            ((list.bits_of(step.in[k]) << places) & list.word_mask() & ~list.sign_bit()) == 0)
            return true;
    return false;
}

}  // namespace

std::uint64_t bits_of_number(bool single, double number) {
    return single ? std::bit_cast<std::uint32_t>(static_cast<float>(number)) : math::to_bits(number);
}

double number_of_bits(bool single, std::uint64_t bits) {
    return single ? std::bit_cast<float>(static_cast<std::uint32_t>(bits)) : math::from_bits(bits);
}

double rounded_operation(bool single, StepOp op, double a, double b) {
    return single ? operate<float>(op, static_cast<float>(a), static_cast<float>(b))
                  : operate<double>(op, a, b);
}

Facts facts_of_number(double number) {
    if (number != number) return {infinity, -infinity, true, false, false};
    const bool zero = number == 0, minus = (math::to_bits(number) >> 63) != 0;
    return {number, number, false, zero && !minus, zero && minus};
}

Facts hull_of(const Facts& a, const Facts& b) {
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi), a.nan || b.nan, a.plus_zero || b.plus_zero,
            a.minus_zero || b.minus_zero};
}

Facts facts_of_step(const StepList& list, StepOp op, ValueId a, ValueId b, std::uint8_t immediate) {
    const Facts fa = list.facts(a), fb = b == no_value ? Facts{} : list.facts(b);
    // A value that is always NaN has no range to compute with; a bit pattern may look like one.
    const bool on_bits = op >= StepOp::bit_and && op <= StepOp::shift_right;
    if (!on_bits && (fa.lo > fa.hi || fb.lo > fb.hi)) return {};
    const bool single = list.single();
    switch (op) {
        case StepOp::add:
            return of_sum(single, fa, fb);
        case StepOp::subtract:
            return a == b ? Facts{0, 0, fa.nan || !fa.finite(), true, false}
                          : of_sum(single, fa, negated(fb));
        case StepOp::multiply:
            return of_product(single, fa, fb, a == b);
        case StepOp::divide:
            return of_quotient(single, fa, fb);
        case StepOp::square_root:
            return of_root(single, fa);
        case StepOp::lesser: {
            Facts r = hull_of(fa, fb);
            if (!fa.nan && !fb.nan) r.hi = std::min(fa.hi, fb.hi);
            return r;
        }
        case StepOp::greater: {
            Facts r = hull_of(fa, fb);
            if (!fa.nan && !fb.nan) r.lo = std::max(fa.lo, fb.lo);
            return r;
        }
        case StepOp::round:
            return of_rounding(fa, static_cast<Rounding>(immediate));
        case StepOp::bit_and:
        case StepOp::bit_or:
        case StepOp::bit_xor:
            return of_bits(list, op, a, b);
        case StepOp::shift_left:
            if (leaves_sign_only(list, a, immediate)) return {0, 0, false, true, true};
            return {};
        default:
            return {};
    }
}

}  // namespace frep::native
