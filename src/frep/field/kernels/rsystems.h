// Kernels of the systems of R-functions beside R0 (Rvachev 1982; Pasko, Adzhiev, Sourin and Savchenko 1995;
// Shapiro 2007): R_alpha, (a + b -+ sqrt(a^2 + b^2 - 2 alpha a b))/(1 + alpha); R_0^m, the R0 function times
// (a^2 + b^2)^(m/2); R_p, a + b -+ (|a|^p + |b|^p)^(1/p). The sign of a conjunction is that of the smaller
// operand, of a disjunction that of the larger one, for every pair of doubles; results are saturated as those
// of R0. A disjunction is the negated conjunction of the complements. Tested by
// tests/unit/shapes/rsystems_test.cpp.
#pragma once

#include "frep/field/kernels/basic.h"
#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace rsystem_detail {

/// `value`, cut to the limit of R-functions; where it lost the sign of `like` (underflow, cancellation) the
/// least number of that sign.
template <class T>
T saturated(T value, T like) {
    const T nought = zero<T>(), limit = math::constant<T>(math::r_limit);
    const T least = math::constant<T>(0x1p-1074);
    T r = math::select(math::less(limit, value), limit, value);
    r = math::select(math::less(r, -limit), -limit, r);
    r = math::select(math::both(math::less(nought, like), math::less_equal(r, nought)), least, r);
    return math::select(math::both(math::less(like, nought), math::less_equal(nought, r)), -least, r);
}

/// Both operands cut to +-2 r_limit, so that infinities need no rule of their own.
template <class T>
T bounded(T a) {
    const T limit = math::constant<T>(2.0 * math::r_limit);
    return math::select(math::less(limit, a), limit, math::select(math::less(a, -limit), -limit, a));
}

/// The operand of smaller value, and the other one.
template <class T>
void in_order(T a, T b, T& low, T& high) {
    const auto swap = math::less(b, a);
    low = math::select(swap, b, a);
    high = math::select(swap, a, b);
}

/// The chain rule for f(a, b, c): value f, local partials fa, fb, fc.
template <class T>
math::Dual<T> chain(T f, T fa, const math::Dual<T>& a, T fb, const math::Dual<T>& b, T fc,
                    const math::Dual<T>& c) {
    math::Dual<T> r = math::chain(f, fa, a, fb, b);
    fc = math::finite(fc);
    for (std::size_t i = 0; i < 3; ++i) r.d[i] = math::saturated(r.d[i] + math::saturated(fc * c.d[i]));
    return r;
}

/// [f(lows), f(highs)] of a function that increases in each operand and has an error of a few ulp.
template <class F>
Interval increasing(F f, Interval a, Interval b, double at_low, double at_high, bool undefined) {
    const double low = f(a.lo, b.lo, at_low), high = f(a.hi, b.hi, at_high);
    if (low != low || high != high) return {-math::r_limit, math::r_limit, true};
    return cut(stepped(low, high, 32, undefined), -math::r_limit, math::r_limit);
}

}  // namespace rsystem_detail

/// a + b > 0: 2 a b/(a + b + s) with s = sqrt((a - alpha b)^2 + (1 - alpha^2) b^2), where nothing cancels;
/// else (a + b - s)/(1 + alpha), where a + b and -s have one sign. Undefined outside -1 < alpha <= 1.
template <class T>
T r_alpha_and(T a, T b, T alpha) {
    using namespace rsystem_detail;
    T low, high;
    in_order(bounded(a), bounded(b), low, high);
    const T rest = (1.0 - alpha) * (1.0 + alpha);
    const auto root = [&](T q) { return math::sqrt(math::square(q - alpha) + rest); };
    const T q = low / high, p = high / low;
    const T inner = low * (2.0 / ((1.0 + q) + root(q)));
    // -|low| as low: this branch is for low < 0, or both 0
    const T outer =
        math::select(math::less(low, zero<T>()), low * ((1.0 + p) + root(p)) / (1.0 + alpha), low + high);
    const T value = math::select(math::less(-low, high), inner, outer);
    const auto good = math::both(math::less(-one<T>(), alpha), math::less_equal(alpha, one<T>()));
    const T result = math::select(good, saturated(value, low), math::constant<T>(math::quiet_nan));
    return defined_with(result, a, b);
}
/// Both operands 0: partials 1 and 1, as for R0.
template <class T>
math::Dual<T> r_alpha_and(const math::Dual<T>& a, const math::Dual<T>& b, const math::Dual<T>& alpha) {
    // F = (a + b - s)/(1 + alpha), s^2 = a^2 + b^2 - 2 alpha a b: F_a = (1 - (a - alpha b)/s)/(1 + alpha),
    // and F_alpha = (a b/s - F)/(1 + alpha). Of the unit vector ((a - alpha b)/s, sqrt(1 - alpha^2) b/s) =
    // (u, v) comes 1 - u without cancellation.
    const T beta = math::sqrt((1.0 - alpha.value) * (1.0 + alpha.value));
    const auto slope = [&](T x, T y) {
        T u, v, length;
        math::dual_detail::unit_pair(x - alpha.value * y, beta * y, u, v, length);
        return math::dual_detail::one_minus(u, v) / (1.0 + alpha.value);
    };
    T u, v, s;
    math::dual_detail::unit_pair(a.value - alpha.value * b.value, beta * b.value, u, v, s);
    const T value = r_alpha_and(a.value, b.value, alpha.value);
    const auto corner = math::equal(s, T(0.0));
    const T fa = math::select(corner, T(1.0), slope(a.value, b.value));
    const T fb = math::select(corner, T(1.0), slope(b.value, a.value));
    const T turn = math::select(corner, T(0.0), (a.value * (b.value / s) - value) / (1.0 + alpha.value));
    return rsystem_detail::chain(value, fa, a, fb, b, turn, alpha);
}
inline Interval r_alpha_and(Interval a, Interval b, Interval alpha) {
    if (any_empty(a, b, alpha)) return Interval::empty();
    if (!(alpha.hi > -1.0) || alpha.lo > 1.0) return Interval::empty();
    const bool undefined = any_flagged(a, b, alpha) || !(alpha.lo > -1.0) || alpha.hi > 1.0;
    const double least = alpha.lo > -1.0 ? alpha.lo : math::next_up(-1.0);
    const double most = alpha.hi < 1.0 ? alpha.hi : 1.0;
    return rsystem_detail::increasing([](double x, double y, double k) { return r_alpha_and(x, y, k); }, a, b,
                                      least, most, undefined);
}
template <class T>
T r_alpha_or(T a, T b, T alpha) {
    return -r_alpha_and(-a, -b, alpha);
}

/// The largest exponent that counts: beyond it powers are 0, 1 or endless, and the norm is the larger
/// operand.
inline constexpr double exponent_limit = 1e6;

/// r_and(a, b) hypot(a, b)^m, 0 where both are 0. Undefined for m < 0.
template <class T>
T r0m_and(T a, T b, T m) {
    const T base = math::r_and(a, b), size = math::hypot(a, b);
    // finite, so that 0 times it is 0
    const T power = math::min(math::pow(size, math::min(m, math::constant<T>(exponent_limit))),
                              math::constant<T>(0x1p1000));
    // 0^0 has no value; numbers near to 0 count as 0 there (numerics.md, rule 8)
    const auto plain = math::either(math::equal(m, zero<T>()), math::is_nan(power));
    const T value = math::select(plain, base, rsystem_detail::saturated(base * power, base));
    const T result = math::select(math::less(m, zero<T>()), math::constant<T>(math::quiet_nan), value);
    return defined_with(result, a, b, m);
}
/// The sign is that of the base, whatever is lost on the way.
inline Interval r0m_and(Interval a, Interval b, Interval m) {
    if (any_empty(a, b, m) || m.hi < 0.0) return Interval::empty();
    const double limit = math::r_limit, least = 0x1p-1074, most = 0x1p1000;
    const Interval base = math::r_and(a, b);
    const Interval power = math::pow(
        math::hypot(a, b), Interval(m.lo > 0.0 ? (m.lo < exponent_limit ? m.lo : exponent_limit) : 0.0,
                                    m.hi < exponent_limit ? m.hi : exponent_limit));
    const Interval size =
        power.is_empty() ? Interval(0.0, most)
                         : Interval(power.lo < most ? power.lo : most, power.hi < most ? power.hi : most);
    const Interval product = base * size;
    double low = product.lo, high = product.hi;
    if (!(m.lo > 0.0) || power.maybe_undefined) {  // the base itself
        low = base.lo < low ? base.lo : low;
        high = base.hi > high ? base.hi : high;
    }
    const Interval wide = stepped(low, high, 8);
    const auto within = [limit](double v) { return v < -limit ? -limit : v < limit ? v : limit; };
    low = within(wide.lo);
    high = within(wide.hi);
    if (base.lo > 0.0) low = low > least ? low : least;
    if (base.lo < 0.0) low = low < -least ? low : -least;
    if (base.hi > 0.0) high = high > least ? high : least;
    if (base.hi < 0.0) high = high < -least ? high : -least;
    return {low < high ? low : high, high, any_flagged(a, b, m) || m.lo < 0.0};
}
template <class T>
T r0m_or(T a, T b, T m) {
    return -r0m_and(-a, -b, m);
}

/// The norm (|a|^p + |b|^p)^(1/p) is the larger magnitude times (1 + q^p)^(1/p), q in 0..1. Undefined for
/// p <= 1, where it is no norm with a tangent. Error <= 16 ulp of the larger operand where they have one
/// sign.
template <class T>
T rp_and(T a, T b, T exponent) {
    using namespace rsystem_detail;
    const T p = math::min(exponent, math::constant<T>(exponent_limit));
    T low, high;
    in_order(bounded(a), bounded(b), low, high);
    const T size_low = math::abs(low), size_high = math::abs(high);
    const auto turned = math::less(size_high, size_low);
    const T big = math::select(turned, size_low, size_high),
            little = math::select(turned, size_high, size_low);
    const auto none = math::equal(big, zero<T>());
    const T q = math::select(none, zero<T>(), little / big);
    const T power = math::select(math::equal(q, zero<T>()), zero<T>(), math::exp(p * math::log(q)));
    const T excess = math::exp(math::log(1.0 + power) / p) - 1.0;  // of the norm over `big`
    const T inner = low - big * excess;
    const T outer = (low + high) - big * (1.0 + excess);
    const T value = math::select(math::less(-low, high), inner, outer);
    const auto good = math::less(one<T>(), p);
    const T result = math::select(good, saturated(math::select(none, low, value), low),
                                  math::constant<T>(math::quiet_nan));
    return defined_with(result, a, b);
}
/// Partials 1 - sign(a) (|a|/N)^(p - 1) with the norm N; both 1 at the origin; that of p by the formula
/// N (sum of w ln w)/p^2 - ..., w = (|a|/N)^p.
template <class T>
math::Dual<T> rp_and(const math::Dual<T>& a, const math::Dual<T>& b, const math::Dual<T>& p) {
    const T value = rp_and(a.value, b.value, p.value);
    const T x = math::abs(a.value), y = math::abs(b.value);
    const T big = math::select(math::less(x, y), y, x);
    const auto none = math::equal(big, T(0.0));
    const auto power = [&](T q, T e) {
        return math::select(math::equal(q, T(0.0)), T(0.0), math::exp(e * math::log(q)));
    };
    const T qx = math::select(none, T(0.0), x / big), qy = math::select(none, T(0.0), y / big);
    const T sum = power(qx, p.value) + power(qy, p.value);  // 1..2
    const T norm = math::exp(math::log(math::select(none, T(1.0), sum)) / p.value);
    const auto slope = [&](T v, T q) {
        const T w = power(q / norm, p.value - 1.0);
        return math::select(none, T(1.0), 1.0 - math::copy_sign(w, v));
    };
    // d/dp of big sum^(1/p) = N (sum' / (p sum) - ln(sum)/p^2), sum' = sum of q^p ln q
    const auto entropy = [&](T q) {
        return math::select(math::equal(q, T(0.0)), T(0.0), power(q, p.value) * math::log(q));
    };
    const T change =
        big * norm * ((entropy(qx) + entropy(qy)) / (p.value * sum) - math::log(sum) / math::square(p.value));
    return rsystem_detail::chain(value, slope(a.value, qx), a, slope(b.value, qy), b,
                                 math::select(none, T(0.0), -change), p);
}
/// The norm falls with p.
inline Interval rp_and(Interval a, Interval b, Interval p) {
    if (any_empty(a, b, p) || !(p.hi > 1.0)) return Interval::empty();
    const bool undefined = any_flagged(a, b, p) || !(p.lo > 1.0);
    const double least = p.lo > 1.0 ? p.lo : math::next_up(1.0);
    const Interval range = rsystem_detail::increasing(
        [](double x, double y, double k) { return rp_and(x, y, k); }, a, b, least, p.hi, undefined);
    // rounding is relative to the operands, not to the result
    const double slack = 0x1p-48 * (magnitude(a) + magnitude(b));
    const Interval wide{math::next_down(range.lo - slack), math::next_up(range.hi + slack), undefined};
    const double low = a.lo > 0.0 && b.lo > 0.0 && !(wide.lo > 0.0) ? 0x1p-1074 : wide.lo;
    const double high = (a.hi < 0.0 || b.hi < 0.0) && !(wide.hi < 0.0) ? -0x1p-1074 : wide.hi;
    return {low, high, undefined};
}
template <class T>
T rp_or(T a, T b, T p) {
    return -rp_and(-a, -b, p);
}

}  // namespace frep::kernels
