// Implementation of jet_rules.h. Flags of derivatives are dropped: where a value may be undefined nobody asks
// for its derivatives.
#include "frep/measure/jet_rules.h"

#include <algorithm>

#include "frep/field/kernels/basic.h"
#include "frep/math/number.h"

namespace frep::measuring {

namespace {

using math::Interval;

Interval plain(const Interval& a) { return a.is_empty() ? Interval::entire() : Interval(a.lo, a.hi); }
Interval times(const Interval& a, const Interval& b) { return plain(a * b); }
Interval plus(const Interval& a, const Interval& b) { return plain(a + b); }
Interval over(const Interval& a, const Interval& b) { return plain(a / b); }
Interval squared(const Interval& a) { return plain(math::square(a)); }
Interval either(const Interval& a, const Interval& b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
bool is_one(const Interval& a) { return a.lo == 1 && a.hi == 1; }

class Rules {
  public:
    Rules(const Interval& value, bool with_second) : value_(value), with_second_(with_second) {}

    Jet same(Jet a) const {
        a.value = value_;
        return a;
    }
    Jet unknown(int moves) const { return unknown_jet(value_, static_cast<std::uint8_t>(moves)); }

    /// k a + l b, where k and l do not change.
    Jet sum(const Jet& a, const Interval& k, const Jet& b, const Interval& l) const {
        Jet out = start(a.moves | b.moves);
        each_first(out, [&](std::size_t i) { return plus(scaled(k, a.first[i]), scaled(l, b.first[i])); });
        each_second(out, [&](std::size_t p, std::size_t, std::size_t) {
            return plus(scaled(k, a.second[p]), scaled(l, b.second[p]));
        });
        return out;
    }

    /// h(a) with the first and second derivative of h.
    Jet chain(const Jet& a, const Interval& first, const Interval& second) const {
        Jet out = start(a.moves);
        each_first(out, [&](std::size_t i) { return times(first, a.first[i]); });
        each_second(out, [&](std::size_t p, std::size_t i, std::size_t j) {
            return plus(times(first, a.second[p]), times(second, product_of(a, i, j)));
        });
        return out;
    }

    Jet product(const Jet& a, const Jet& b) const {
        Jet out = start(a.moves | b.moves);
        const Interval u = plain(a.value), v = plain(b.value);
        each_first(out, [&](std::size_t i) { return plus(times(v, a.first[i]), times(u, b.first[i])); });
        each_second(out, [&](std::size_t p, std::size_t i, std::size_t j) {
            const Interval own = plus(times(v, a.second[p]), times(u, b.second[p]));
            return plus(own, plus(times(a.first[i], b.first[j]), times(a.first[j], b.first[i])));
        });
        return out;
    }

    Jet quotient(const Jet& a, const Jet& b) const {
        if (b.value.contains(0.0)) return unknown(a.moves | b.moves);
        const Interval inverse = over(Interval(1.0), plain(b.value));
        if (b.moves == 0) return chain(a, inverse, Interval(0.0));
        // q' = (a' - q b') / b, q'' = (a'' - q b'' - q' b' - b' q') / b
        Jet out = start(a.moves | b.moves);
        const Interval q = plain(value_);
        each_first(out,
                   [&](std::size_t i) { return times(inverse, plain(a.first[i] - times(q, b.first[i]))); });
        each_second(out, [&](std::size_t p, std::size_t i, std::size_t j) {
            const Interval mixed = plus(times(out.first[i], b.first[j]), times(out.first[j], b.first[i]));
            return times(inverse, plain(a.second[p] - times(q, b.second[p]) - mixed));
        });
        return out;
    }

    /// One of two functions, which one depends on the point: they agree where it changes.
    Jet one_of(const Jet& a, const Jet& b) const {
        Jet out = start(a.moves | b.moves);
        each_first(out, [&](std::size_t i) { return either(a.first[i], b.first[i]); });
        each_second(out, [](std::size_t, std::size_t, std::size_t) { return Interval::entire(); });
        return out;
    }

    Jet smaller(const Jet& a, const Jet& b) const {
        if (a.value.hi < b.value.lo) return same(a);
        if (b.value.hi < a.value.lo) return same(b);
        return one_of(a, b);
    }
    Jet larger(const Jet& a, const Jet& b) const {
        if (a.value.lo > b.value.hi) return same(a);
        if (b.value.lo > a.value.hi) return same(b);
        return one_of(a, b);
    }
    Jet negative(const Jet& a) const {
        Jet out = a;
        out.value = value_;
        for (Interval& d : out.first) d = -d;
        for (Interval& d : out.second) d = -d;
        return out;
    }
    Jet absolute(const Jet& a) const {
        if (a.value.lo >= 0) return same(a);
        if (a.value.hi <= 0) return negative(a);
        return one_of(a, negative(a));
    }

    /// k a + k b + sign * sqrt(a^2 + b^2), whose root is a cone over (a, b): k = 0 for the length alone, 1
    /// for R-functions. The second derivative of a cone is w w' / h^3 with w = b grad a - a grad b.
    Jet cone(const Jet& a, const Jet& b, double k, double sign) const {
        const Interval u = plain(a.value), v = plain(b.value), h = plain(math::hypot(u, v));
        Jet out = start(a.moves | b.moves);
        if (!(h.lo > 0)) {
            each_first(out, [&](std::size_t i) {
                if (k != 0) {
                    const Interval weight(0.0, 2.0);
                    return plus(times(weight, a.first[i]), times(weight, b.first[i]));
                }
                const double most = plain(math::hypot(a.first[i], b.first[i])).hi;
                return Interval(-most, most);
            });
            each_second(out, [](std::size_t, std::size_t, std::size_t) { return Interval::entire(); });
            return out;
        }
        const auto weight = [&](const Interval& x, const Interval& y) {
            return plus(Interval(k), times(Interval(sign), cosine(x, y)));
        };
        const Interval p = weight(u, v), q = weight(v, u);
        each_first(out, [&](std::size_t i) { return plus(times(p, a.first[i]), times(q, b.first[i])); });
        if (!with_second_) return out;
        std::array<Interval, 3> w;
        for (std::size_t i = 0; i < 3; ++i) w[i] = plain(times(v, a.first[i]) - times(u, b.first[i]));
        const Interval factor = over(Interval(sign), times(h, squared(h)));
        each_second(out, [&](std::size_t n, std::size_t i, std::size_t j) {
            const Interval own = plus(times(p, a.second[n]), times(q, b.second[n]));
            return plus(own, times(factor, i == j ? squared(w[i]) : times(w[i], w[j])));
        });
        return out;
    }

    /// The angle of the vector (b, a).
    Jet angle(const Jet& a, const Jet& b) const {
        const int moves = a.moves | b.moves;
        const Interval u = plain(a.value), v = plain(b.value);
        const Interval r = plus(squared(u), squared(v));
        if (!(r.lo > 0) || (u.contains(0.0) && v.lo < 0)) return unknown(moves);
        // f_u = v/r, f_v = -u/r; f_uu = -2uv/r^2 = -f_vv, f_uv = (u^2 - v^2)/r^2
        const Interval fu = over(v, r), fv = over(-u, r), rr = squared(r);
        const Interval fuu = over(times(Interval(-2.0), times(u, v)), rr);
        const Interval fuv = over(plain(squared(u) - squared(v)), rr);
        Jet out = start(moves);
        each_first(out, [&](std::size_t i) { return plus(times(fu, a.first[i]), times(fv, b.first[i])); });
        each_second(out, [&](std::size_t n, std::size_t i, std::size_t j) {
            const Interval own = plus(times(fu, a.second[n]), times(fv, b.second[n]));
            const Interval squares = times(fuu, plain(product_of(a, i, j) - product_of(b, i, j)));
            const Interval mixed =
                times(fuv, plus(times(a.first[i], b.first[j]), times(a.first[j], b.first[i])));
            return plus(own, plus(squares, mixed));
        });
        return out;
    }

    /// b^e for a constant exponent.
    Jet power(const Jet& b, double e) const {
        const Interval base = plain(b.value);
        const bool whole = e == math::trunc(e) && e >= 2 && e <= 64;
        if (!whole && !(base.lo > 0)) return unknown(b.moves);
        const auto to = [&](double exponent) {
            return whole ? plain(math::powi(base, static_cast<int>(exponent)))
                         : plain(math::pow(base, Interval(exponent)));
        };
        return chain(b, times(Interval(e), to(e - 1)),
                     times(times(Interval(e), Interval(e) - Interval(1.0)), to(e - 2)));
    }

    Jet choice(const Jet& condition, const Jet& a, const Jet& b) const {
        const auto taken = kernels::is_true(plain(condition.value));
        if (condition.value.is_empty()) return unknown(a.moves | b.moves | condition.moves);
        if (taken.surely_true()) return same(a);
        if (taken.surely_false()) return same(b);
        return unknown(a.moves | b.moves | condition.moves);
    }

    Jet start(int moves) const { return {value_, {}, {}, static_cast<std::uint8_t>(moves)}; }

  private:
    /// x / sqrt(x^2 + y^2), which increases in x and is nearer to 0 for larger |y|.
    static Interval cosine(const Interval& x, const Interval& y) {
        const Interval side = plain(math::abs(y));
        const auto at = [](double p, double q) {
            return p == 0 ? Interval(0.0) : over(Interval(p), plain(math::hypot(Interval(p), Interval(q))));
        };
        const double low = at(x.lo, x.lo > 0 ? side.hi : side.lo).lo;
        const double high = at(x.hi, x.hi > 0 ? side.lo : side.hi).hi;
        return {std::max(low, -1.0), std::min(high, 1.0)};
    }
    static Interval scaled(const Interval& k, const Interval& a) { return is_one(k) ? a : times(k, a); }
    static Interval product_of(const Jet& a, std::size_t i, std::size_t j) {
        return i == j ? squared(a.first[i]) : times(a.first[i], a.first[j]);
    }
    template <class Function>
    void each_first(Jet& out, Function f) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (out.moves >> i & 1u) out.first[i] = f(i);
    }
    template <class Function>
    void each_second(Jet& out, Function f) const {
        if (!with_second_) return;
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const auto [i, j] = pairs[p];
            if ((out.moves >> i & 1u) && (out.moves >> j & 1u)) out.second[p] = f(p, i, j);
        }
    }

    const Interval& value_;
    bool with_second_;
};

}  // namespace

Jet unknown_jet(const Interval& value, std::uint8_t moves) {
    Jet out{value, {}, {}, moves};
    for (std::size_t i = 0; i < 3; ++i)
        if (moves >> i & 1u) out.first[i] = Interval::entire();
    for (std::size_t p = 0; p < pairs.size(); ++p)
        if ((moves >> pairs[p][0] & 1u) && (moves >> pairs[p][1] & 1u)) out.second[p] = Interval::entire();
    return out;
}

std::optional<Jet> jet_of(Op op, const Interval& value, std::span<const Jet* const> a, bool with_second) {
    const Rules rules(value, with_second);
    const Interval one(1.0), two(2.0);
    const Interval x = plain(a[0]->value), f = plain(value);
    switch (op) {
        case Op::add:
            return rules.sum(*a[0], one, *a[1], one);
        case Op::sub:
            return rules.sum(*a[0], one, *a[1], -one);
        case Op::neg:
            return rules.negative(*a[0]);
        case Op::mul:
            return rules.product(*a[0], *a[1]);
        case Op::div:
            return rules.quotient(*a[0], *a[1]);
        case Op::square:
            return rules.chain(*a[0], times(two, x), two);
        case Op::sqrt: {
            if (!(x.lo > 0)) return rules.unknown(a[0]->moves);
            const Interval first = over(Interval(0.5), f);
            return rules.chain(*a[0], first, over(times(Interval(-0.5), first), x));
        }
        case Op::abs:
            return rules.absolute(*a[0]);
        case Op::min:
            return rules.smaller(*a[0], *a[1]);
        case Op::max:
            return rules.larger(*a[0], *a[1]);
        case Op::hypot:
            return rules.cone(*a[0], *a[1], 0, 1);
        case Op::r_and:
            return rules.cone(*a[0], *a[1], 1, -1);
        case Op::r_or:
            return rules.cone(*a[0], *a[1], 1, 1);
        case Op::exp:
            return rules.chain(*a[0], f, f);
        case Op::log:
        case Op::log10: {
            if (!(x.lo > 0)) return rules.unknown(a[0]->moves);
            const Interval scale = op == Op::log ? one : over(one, math::log(Interval(10.0)));
            const Interval first = over(one, x);
            return rules.chain(*a[0], times(scale, first), times(scale, -squared(first)));
        }
        case Op::sin:
            return rules.chain(*a[0], math::cos(x), -f);
        case Op::cos:
            return rules.chain(*a[0], -math::sin(x), -f);
        case Op::tan: {
            const Interval first = plus(one, squared(f));
            return rules.chain(*a[0], first, times(times(two, f), first));
        }
        case Op::asin:
        case Op::acos: {
            const Interval rest = plain(one - squared(x));
            if (!(rest.lo > 0)) return rules.unknown(a[0]->moves);
            const Interval first = over(op == Op::asin ? one : -one, plain(math::sqrt(rest)));
            return rules.chain(*a[0], first, over(times(x, first), rest));
        }
        case Op::atan: {
            const Interval first = over(one, plus(one, squared(x)));
            return rules.chain(*a[0], first, times(times(-two, x), squared(first)));
        }
        case Op::atan2:
            return rules.angle(*a[0], *a[1]);
        case Op::sinh:
            return rules.chain(*a[0], math::cosh(x), f);
        case Op::cosh:
            return rules.chain(*a[0], math::sinh(x), f);
        case Op::tanh: {
            const Interval first = plain(one - squared(f));
            return rules.chain(*a[0], first, times(times(-two, f), first));
        }
        case Op::pow:
            if (a[1]->moves != 0 || a[1]->value.lo != a[1]->value.hi)
                return rules.unknown(a[0]->moves | a[1]->moves);
            return rules.power(*a[0], a[1]->value.lo);
        case Op::remainder: {
            const Interval turns = math::trunc(over(x, plain(a[1]->value)));
            if (turns.lo != turns.hi) return rules.unknown(a[0]->moves | a[1]->moves);
            return rules.sum(*a[0], one, *a[1], -turns);
        }
        case Op::select:
            return rules.choice(*a[0], *a[1], *a[2]);
        default:
            return std::nullopt;
    }
}

}  // namespace frep::measuring
