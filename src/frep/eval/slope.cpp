// Implementation of slope.h: rules of differentiation over intervals. Flags of derivatives are dropped: a
// product of 0 and an infinite kink is 0, and where a value may be undefined nobody asks for its slope.
#include "frep/eval/slope.h"

#include <algorithm>
#include <vector>

#include "frep/field/kernels/basic.h"
#include "frep/field/meaning.h"

namespace frep {

namespace {

using math::Interval;

/// One ulp outwards or two, faster than math::next_up: a share of a number that is not below 2^-1021 is no
/// less than its ulp. Sums below that are exact. What has no value, inf - inf, becomes infinite.
double up(double x) {
    const double r = x + math::abs(x) * 0x1p-52;
    return r <= math::infinity ? r : math::infinity;
}
double down(double x) {
    const double r = x - math::abs(x) * 0x1p-52;
    return r >= -math::infinity ? r : -math::infinity;
}
/// Products nearer to 0 may have lost their last digits.
constexpr double nearly_nothing = 0x1p-960;

bool is_finite(const Interval& a) {
    return math::abs(a.lo) < math::infinity && math::abs(a.hi) < math::infinity;
}
bool is_zero(const Interval& a) { return a.lo == 0 && a.hi == 0; }
Interval plain(const Interval& a) { return a.is_empty() ? Interval::entire() : Interval(a.lo, a.hi); }
Interval plus(const Interval& a, const Interval& b) { return {down(a.lo + b.lo), up(a.hi + b.hi)}; }
Interval minus(const Interval& a, const Interval& b) { return {down(a.lo - b.hi), up(a.hi - b.lo)}; }
Interval times(const Interval& a, const Interval& b) {
    if (is_zero(a) || is_zero(b)) return {0.0, 0.0};
    const double ll = a.lo * b.lo, lh = a.lo * b.hi, hl = a.hi * b.lo, hh = a.hi * b.hi;
    const double lo = std::min(std::min(ll, lh), std::min(hl, hh));
    const double hi = std::max(std::max(ll, lh), std::max(hl, hh));
    const bool finite = math::abs((ll + lh) + (hl + hh)) < math::infinity;
    if (!finite || math::abs(lo) < nearly_nothing || math::abs(hi) < nearly_nothing) return plain(a * b);
    return {down(lo), up(hi)};
}
Interval either(const Interval& a, const Interval& b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

class Rules {
  public:
    /// `curved`: second derivatives are asked for.
    Rules(std::size_t variables, bool curved) : n_(variables), curved_(curved) {}

    /// (v . grad a)^2 over unit vectors v.
    Interval outer(const Slope& a) const {
        if (n_ == 1) return plain(math::square(plain(a.d[0])));
        return {0.0, square_norm(a).hi};
    }
    /// 2 (v . grad a) (v . grad b) over unit vectors v.
    Interval outer(const Slope& a, const Slope& b) const {
        Interval dot(0.0);
        for (std::size_t i = 0; i < n_; ++i) dot = plus(dot, times(a.d[i], b.d[i]));
        if (n_ == 1) return times(Interval(2.0), dot);
        const double most = math::sqrt(plain(times(square_norm(a), square_norm(b)))).hi;
        return plus(dot, {-most, most});
    }
    Interval square_norm(const Slope& a) const {
        Interval sum(0.0);
        for (std::size_t i = 0; i < n_; ++i) sum = plus(sum, plain(math::square(plain(a.d[i]))));
        return sum;
    }

    Slope sum(const Interval& value, const Slope& a, const Slope& b) const {
        Slope out{value, {}, {}, false};
        for (std::size_t i = 0; i < n_; ++i) out.d[i] = plus(a.d[i], b.d[i]);
        if (curved_) out.curvature = plus(a.curvature, b.curvature);
        return out;
    }
    Slope difference(const Interval& value, const Slope& a, const Slope& b) const {
        Slope out{value, {}, {}, false};
        for (std::size_t i = 0; i < n_; ++i) out.d[i] = minus(a.d[i], b.d[i]);
        if (curved_) out.curvature = minus(a.curvature, b.curvature);
        return out;
    }

    /// k a + l b + m, where k and l do not change.
    Slope sum(const Interval& value, const Slope& a, const Interval& k, const Slope& b,
              const Interval& l) const {
        Slope out{value, {}, {}, false};
        for (std::size_t i = 0; i < n_; ++i) out.d[i] = plus(times(k, a.d[i]), times(l, b.d[i]));
        if (curved_) out.curvature = plus(times(k, a.curvature), times(l, b.curvature));
        return out;
    }

    /// h(a) with its first and second derivative.
    Slope chain(const Interval& value, const Slope& a, const Interval& first, const Interval& second) const {
        Slope out = scaled(value, a, first);
        if (curved_ && !is_zero(second)) out.curvature = plus(out.curvature, times(second, outer(a)));
        return out;
    }
    Slope scaled(const Interval& value, const Slope& a, const Interval& k) const {
        Slope out{value, {}, {}, false};
        for (std::size_t i = 0; i < n_; ++i) out.d[i] = times(k, a.d[i]);
        if (curved_) out.curvature = times(k, a.curvature);
        return out;
    }

    Slope product(const Interval& value, const Slope& a, const Slope& b) const {
        if (a.fixed) return scaled(value, b, plain(a.value));
        if (b.fixed) return scaled(value, a, plain(b.value));
        Slope out = sum(value, a, plain(b.value), b, plain(a.value));
        if (curved_) out.curvature = plus(out.curvature, outer(a, b));
        return out;
    }

    Slope reciprocal(const Slope& b) const {
        const Interval one_over = Interval(1.0) / plain(b.value);
        const Interval first = -math::square(one_over);
        return chain(one_over, b, plain(first), times(times(Interval(-2.0), first), one_over));
    }

    /// The two sides of a kink: both functions, of which the value is always one.
    Slope one_of(const Interval& value, const Slope& a, const Slope& b) const {
        Slope out{value, {}, either(a.curvature, b.curvature), false};
        for (std::size_t i = 0; i < n_; ++i) out.d[i] = either(a.d[i], b.d[i]);
        return out;
    }

    Slope smaller(const Interval& value, const Slope& a, const Slope& b) const {
        if (a.value.hi < b.value.lo) return with_value(a, value);
        if (b.value.hi < a.value.lo) return with_value(b, value);
        Slope out = one_of(value, a, b);
        out.curvature.lo = -math::infinity;
        return out;
    }

    Slope negative(const Slope& a) const {
        Slope out{-a.value, {}, -a.curvature, a.fixed};
        for (std::size_t i = 0; i < n_; ++i) out.d[i] = -a.d[i];
        return out;
    }

    Slope absolute(const Interval& value, const Slope& a) const {
        if (a.value.lo >= 0) return with_value(a, value);
        if (a.value.hi <= 0) return with_value(negative(a), value);
        Slope out = one_of(value, a, negative(a));
        out.curvature.hi = math::infinity;
        return out;
    }

    /// sqrt(a^2 + b^2), whose surface over (a, b) is a cone.
    Slope length(const Interval& value, const Slope& a, const Slope& b) const {
        const Interval h = plain(value);
        if (!(h.lo > 0)) {
            Slope out{value, {}, Interval::entire(), false};
            for (std::size_t i = 0; i < n_; ++i) {
                const double most = math::hypot(plain(a.d[i]), plain(b.d[i])).hi;
                out.d[i] = {-most, most};
            }
            out.curvature.lo = cone_floor(a, b);
            return out;
        }
        const Interval u = part_of(a.value, h), v = part_of(b.value, h);
        Slope out = sum(value, a, u, b, v);
        // The part of the second derivatives of a cone: never below 0, at most the squared gradients over h.
        if (curved_) out.curvature = plus(out.curvature, {0.0, plain(plus(outer(a), outer(b)) / h).hi});
        return out;
    }

    /// a + b - length (sign -1) or a + b + length (sign 1).
    Slope r_function(const Interval& value, const Slope& a, const Slope& b, double sign) const {
        const Interval h = math::hypot(plain(a.value), plain(b.value));
        const Interval s(sign);
        const Interval u = weight(part_of(a.value, h), s), v = weight(part_of(b.value, h), s);
        Slope out = sum(value, a, u, b, v);
        if (!curved_) return out;
        Interval cone(0.0, h.lo > 0 ? plain(plus(outer(a), outer(b)) / h).hi : math::infinity);
        if (a.fixed && b.fixed) cone = Interval(0.0);
        out.curvature = plus(out.curvature, times(s, cone));
        return out;
    }

    /// a + b + r - hypot(a - b, r) for finite a and b that are defined, and r > 0.
    Slope rounded_smaller(const Slope& a, const Slope& b, const Interval& r) const {
        const auto value_at = [&](double p, double q) {
            const Interval x(p), y(q);
            return minus(plus(plus(x, y), r), plain(math::hypot(minus(x, y), r)));
        };
        const auto size = [](const Interval& x) { return std::max(math::abs(x.lo), math::abs(x.hi)); };
        // It rises with a and b, but for the roundings of points inside.
        const double rounding = 0x1p-48 * (size(a.value) + size(b.value) + size(r));
        const Interval value(value_at(a.value.lo, b.value.lo).lo - rounding,
                             value_at(a.value.hi, b.value.hi).hi + rounding);
        const Interval difference = minus(a.value, b.value);
        const auto share = [&](double d) { return part_of(Interval(d), math::hypot(Interval(d), r)); };
        const Interval u(share(difference.lo).lo, share(difference.hi).hi), one(1.0);
        Slope out = sum(value, a, weight(u, -one), b, weight(u, one));
        if (!curved_) return out;
        double steep = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const double d = size(minus(a.d[i], b.d[i]));
            steep = up(steep + up(d * d));
        }
        out.curvature = plus(out.curvature, {-up(steep / r.lo), 0.0});
        return out;
    }

    static Slope with_value(Slope a, const Interval& value) {
        a.value = value;
        return a;
    }

  private:
    /// a / sqrt(a^2 + b^2), in -1 .. 1.
    static Interval part_of(const Interval& a, const Interval& h) {
        if (!(h.lo > 0)) return {-1.0, 1.0};
        const Interval q = plain(plain(a) / h);
        return {std::max(q.lo, -1.0), std::min(q.hi, 1.0)};
    }
    /// 1 + sign * part, in 0 .. 2.
    static Interval weight(const Interval& part, const Interval& sign) {
        const Interval w = plus(Interval(1.0), times(sign, part));
        return {std::max(w.lo, 0.0), std::min(w.hi, 2.0)};
    }
    /// The least curvature of sqrt(a^2 + b^2), whose own is never below 0: that of a and b, by parts up to 1.
    static double cone_floor(const Slope& a, const Slope& b) {
        const auto size = [](const Interval& k) { return std::max(math::abs(k.lo), math::abs(k.hi)); };
        return -plus(Interval(size(a.curvature)), Interval(size(b.curvature))).hi;
    }

    std::size_t n_;
    bool curved_;
};

/// b^e for a constant exponent.
Slope power(const Rules& rules, const Interval& value, const Slope& b, double e) {
    const Interval base = plain(b.value);
    if (e == 2) return rules.chain(value, b, times(Interval(2.0), base), Interval(2.0));
    const bool whole = e == math::trunc(e) && e >= 2 && e <= 16;
    if (!whole && !(base.lo > 1e-6)) return Slope::of_value(value);
    const auto to = [&](double exponent) {
        return whole ? math::powi(base, static_cast<int>(exponent))
                     : plain(math::pow(base, Interval(exponent)));
    };
    return rules.chain(value, b, times(Interval(e), to(e - 1)),
                       times(times(Interval(e), Interval(e - 1)), to(e - 2)));
}

Slope select(const Rules& rules, const Interval& value, std::span<const Slope* const> a) {
    const auto taken = kernels::is_true(Interval(a[0]->value.lo, a[0]->value.hi));
    if (!a[0]->value.is_empty() && taken.surely_true()) return Rules::with_value(*a[1], value);
    if (!a[0]->value.is_empty() && taken.surely_false()) return Rules::with_value(*a[2], value);
    // A choice that is the same in the whole box: each point of space has one of the two functions.
    return a[0]->fixed ? rules.one_of(value, *a[1], *a[2]) : Slope::of_value(value);
}

Interval meaning_of(Op op, std::span<const Slope* const> a, std::span<const double> block) {
    std::array<Interval, 8> few;
    std::vector<Interval> many(a.size() > few.size() ? a.size() : 0);
    const std::span<Interval> operands = many.empty() ? std::span(few).first(a.size()) : std::span(many);
    for (std::size_t i = 0; i < a.size(); ++i) operands[i] = a[i]->value;
    return meaning<Interval>(op, std::span<const Interval>(operands), block);
}

/// The square of a finite range. Numbers up to `snap` count as 0 too.
std::optional<Interval> square_of(const Interval& x, double snap) {
    const double a = math::abs(x.lo), b = math::abs(x.hi);
    const double most = up(std::max(a, b) * std::max(a, b));
    const double near = x.contains(0.0) ? 0.0 : std::min(a, b);
    const double least = near <= snap ? 0.0 : down(near * near);
    const bool is_sure =
        nearly_nothing < most && most < math::infinity && (least == 0 || least > nearly_nothing);
    if (!is_sure || (least == 0 && near > snap)) return std::nullopt;
    return Interval(least, most, x.maybe_undefined);
}

bool is_squared(std::span<const Slope* const> a) { return a[1]->value.lo == 2 && a[1]->value.hi == 2; }

/// The value of `op`: sums, products and squares of finite ranges here, others by their meaning.
Interval value_of(Op op, std::span<const Slope* const> a, std::span<const double> block) {
    constexpr double counts_as_zero = 2e-6;  // to pow(), and more
    std::optional<Interval> value;
    const auto flagged = [&](const Interval& v) {
        return v.flagged(a[0]->value.maybe_undefined || a[1]->value.maybe_undefined);
    };
    switch (op) {
        case Op::add:
        case Op::sub:
        case Op::mul: {
            const Interval &x = a[0]->value, &y = a[1]->value;
            if (!is_finite(x) || !is_finite(y)) break;
            return flagged(op == Op::add ? plus(x, y) : op == Op::sub ? minus(x, y) : times(x, y));
        }
        case Op::square:
            if (is_finite(a[0]->value)) value = square_of(a[0]->value, 0.0);
            break;
        case Op::pow:
            if (is_finite(a[0]->value) && is_squared(a)) value = square_of(a[0]->value, counts_as_zero);
            break;
        default:
            break;
    }
    return value ? *value : meaning_of(op, a, block);
}

}  // namespace

Slope slope_of(Op op, std::span<const Slope* const> a, std::span<const double> block, std::size_t variables,
               bool curved) {
    bool fixed = true;
    for (const Slope* argument : a) fixed = fixed && argument->fixed;
    const Interval value = value_of(op, a, block);
    if (fixed) return Slope::constant(value);
    const Rules rules(variables, curved);
    const Interval one(1.0), x = plain(a[0]->value);
    switch (op) {
        case Op::add:
            return rules.sum(value, *a[0], *a[1]);
        case Op::sub:
            return rules.difference(value, *a[0], *a[1]);
        case Op::neg:
            return rules.negative(*a[0]);
        case Op::mul:
            return rules.product(value, *a[0], *a[1]);
        case Op::div:
            if (a[1]->value.contains(0.0)) return Slope::of_value(value);
            if (a[1]->fixed) return rules.scaled(value, *a[0], plain(one / a[1]->value));
            return rules.product(value, *a[0], rules.reciprocal(*a[1]));
        case Op::square:
            return rules.chain(value, *a[0], times(Interval(2.0), x), Interval(2.0));
        case Op::sqrt: {
            if (!(x.lo > 0)) return Slope::of_value(value);
            const Interval first = Interval(0.5) / plain(value);
            return rules.chain(value, *a[0], first, plain(Interval(-0.5) * first / x));
        }
        case Op::abs:
            return rules.absolute(value, *a[0]);
        case Op::min:
            return rules.smaller(value, *a[0], *a[1]);
        case Op::max:
            return rules.negative(rules.smaller(-value, rules.negative(*a[0]), rules.negative(*a[1])));
        case Op::hypot:
            return rules.length(value, *a[0], *a[1]);
        case Op::r_and:
            return rules.r_function(value, *a[0], *a[1], -1.0);
        case Op::r_or:
            return rules.r_function(value, *a[0], *a[1], 1.0);
        case Op::exp:
            return rules.chain(value, *a[0], plain(value), plain(value));
        case Op::log: {
            if (!(x.lo > 0)) return Slope::of_value(value);
            const Interval first = one / x;
            return rules.chain(value, *a[0], first, -math::square(first));
        }
        case Op::sin:
            return rules.chain(value, *a[0], math::cos(x), -plain(value));
        case Op::cos:
            return rules.chain(value, *a[0], -math::sin(x), -plain(value));
        case Op::atan: {
            const Interval first = one / (one + math::square(x));
            return rules.chain(value, *a[0], first, Interval(-2.0) * x * math::square(first));
        }
        case Op::pow:
            if (!a[1]->fixed || a[1]->value.lo != a[1]->value.hi) return Slope::of_value(value);
            return power(rules, value, *a[0], a[1]->value.lo);
        case Op::select:
            return select(rules, value, a);
        default:
            return Slope::of_value(value);
    }
}

std::optional<RoundedMinimum> rounded_minimum(const Graph& graph, NodeId id) {
    const auto is = [&](NodeId node, Op op) { return graph.node(node).op == op; };
    if (!is(id, Op::sub)) return std::nullopt;
    const NodeId sum = graph.arguments(id)[0], length = graph.arguments(id)[1];
    if (!is(sum, Op::add) || !is(length, Op::hypot)) return std::nullopt;
    for (const std::size_t first : {0u, 1u}) {
        const NodeId difference = graph.arguments(length)[first], r = graph.arguments(length)[1 - first];
        if (!is(difference, Op::sub)) continue;
        const NodeId a = graph.arguments(difference)[0], b = graph.arguments(difference)[1];
        for (const std::size_t inner : {0u, 1u}) {
            const NodeId both = graph.arguments(sum)[inner];
            if (graph.arguments(sum)[1 - inner] != r || !is(both, Op::add)) continue;
            const NodeId p = graph.arguments(both)[0], q = graph.arguments(both)[1];
            if ((p == a && q == b) || (p == b && q == a)) return RoundedMinimum{a, b, r};
        }
    }
    return std::nullopt;
}

std::optional<Slope> rounded_minimum_slope(const Slope& a, const Slope& b, const Slope& r,
                                           std::size_t variables, bool curved) {
    const auto known = [](const Interval& x) { return is_finite(x) && !x.maybe_undefined; };
    if (!r.fixed || !known(r.value) || !(r.value.lo > 0) || !known(a.value) || !known(b.value))
        return std::nullopt;
    return Rules(variables, curved).rounded_smaller(a, b, r.value);
}

}  // namespace frep
