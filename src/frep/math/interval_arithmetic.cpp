// Interval arithmetic, comparison, selection, and the exact functions. Method: numerics.md, rules 4 and 5;
// see interval.h. Checked by tests/unit/math/interval_test.cpp and itf1788_test.cpp.
#include "frep/math/interval.h"

FREP_MATH_OPEN
namespace {

bool undefined_too(const Interval& a, const Interval& b) { return a.maybe_undefined || b.maybe_undefined; }
bool either_empty(const Interval& a, const Interval& b) { return a.is_empty() || b.is_empty(); }
bool has_zero(const Interval& a) { return a.contains(0.0); }
bool has_infinity(const Interval& a) { return a.lo == -infinity || a.hi == infinity; }
bool is_point(const Interval& a, double x) { return a.lo == x && a.hi == x; }
bool is_infinite(const Interval& a) { return a.lo == a.hi && has_infinity(a); }

/// One place down (up), except where a computed sum is exact: zero, or from an infinite operand.
double sum_down(double a, double b) {
    const double s = a + b;
    if (s != s) return -infinity;
    return s == 0.0 || abs(a) == infinity || abs(b) == infinity ? s : next_down(s);
}
double sum_up(double a, double b) { return -sum_down(-a, -b); }

/// The hull of up to four candidates, NaN left out, stepped outward; zero from a zero factor stays.
struct Corners {
    double lo = infinity, hi = -infinity;
    void add(double value, bool exact) {
        if (value != value) return;
        const double below = exact ? value : next_down(value), above = exact ? value : next_up(value);
        lo = below < lo ? below : lo;
        hi = above > hi ? above : hi;
    }
};
void add_product(Corners& c, double a, double b) {
    const double p = a * b;
    const bool exact = a == 0.0 || b == 0.0 || abs(a) == infinity || abs(b) == infinity;
    c.add(exact && p != p ? 0.0 : p, exact);
}
void add_quotient(Corners& c, double a, double b) {
    c.add(a / b, a == 0.0 || abs(a) == infinity || abs(b) == infinity);
}
template <class F>
Interval map_ends(const Interval& a, F f) {
    return a.is_empty() ? a : Interval(f(a.lo), f(a.hi), a.maybe_undefined);
}

}  // namespace

Interval hull(Interval a, Interval b) {
    if (a.is_empty()) return b.flagged(true);
    if (b.is_empty()) return a.flagged(true);
    return {a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi, undefined_too(a, b)};
}
Interval select(IntervalMask m, Interval a, Interval b) {
    if (m.can_be_true && m.can_be_false) return hull(a, b);
    return m.can_be_true ? a : (m.can_be_false ? b : Interval::empty());
}
IntervalMask less(Interval a, Interval b) {
    if (either_empty(a, b)) return {false, true};
    return {a.lo < b.hi, !(a.hi < b.lo) || undefined_too(a, b)};
}
IntervalMask less_equal(Interval a, Interval b) {
    if (either_empty(a, b)) return {false, true};
    return {a.lo <= b.hi, !(a.hi <= b.lo) || undefined_too(a, b)};
}
IntervalMask equal(Interval a, Interval b) {
    if (either_empty(a, b)) return {false, true};
    const bool one_value = a.lo == a.hi && is_point(b, a.lo);
    return {a.lo <= b.hi && b.lo <= a.hi, !one_value || undefined_too(a, b)};
}
IntervalMask is_nan(Interval a) { return {a.maybe_undefined || a.is_empty(), !a.is_empty()}; }

Interval operator+(Interval a, Interval b) {
    if (either_empty(a, b)) return Interval::empty();
    const bool clash = (a.lo == -infinity && b.hi == infinity) || (a.hi == infinity && b.lo == -infinity);
    if (clash && is_infinite(a) && is_infinite(b)) return Interval::empty();
    return {sum_down(a.lo, b.lo), sum_up(a.hi, b.hi), undefined_too(a, b) || clash};
}
Interval operator-(Interval a, Interval b) { return a + -b; }
Interval operator*(Interval a, Interval b) {
    if (either_empty(a, b)) return Interval::empty();
    const bool clash = (has_zero(a) && has_infinity(b)) || (has_zero(b) && has_infinity(a));
    if (clash && ((is_point(a, 0.0) && is_infinite(b)) || (is_point(b, 0.0) && is_infinite(a)))) {
        return Interval::empty();
    }
    Corners c;
    add_product(c, a.lo, b.lo);
    add_product(c, a.lo, b.hi);
    add_product(c, a.hi, b.lo);
    add_product(c, a.hi, b.hi);
    // Products of numbers of one sign, and underflowed ones, do not cross 0.
    const bool positive = (a.lo >= 0.0 && b.lo >= 0.0) || (a.hi <= 0.0 && b.hi <= 0.0);
    const bool negative = (a.lo >= 0.0 && b.hi <= 0.0) || (a.hi <= 0.0 && b.lo >= 0.0);
    if (positive && c.lo < 0.0) c.lo = 0.0;
    if (negative && c.hi > 0.0) c.hi = 0.0;
    return {c.lo, c.hi, undefined_too(a, b) || clash};
}
Interval operator/(Interval a, Interval b) {
    if (either_empty(a, b)) return Interval::empty();
    const bool clash = (has_zero(a) && has_zero(b)) || (has_infinity(a) && has_infinity(b));
    if (is_point(a, 0.0) && is_point(b, 0.0)) return Interval::empty();
    if (has_zero(b)) return {-infinity, infinity, undefined_too(a, b) || clash};
    if (is_infinite(a) && is_infinite(b)) return Interval::empty();
    Corners c;
    if (is_infinite(b)) c.add(0.0, true);  // a finite one over it; both ends of a may be infinite
    add_quotient(c, a.lo, b.lo);
    add_quotient(c, a.lo, b.hi);
    add_quotient(c, a.hi, b.lo);
    add_quotient(c, a.hi, b.hi);
    const bool positive = (a.lo >= 0.0 && b.lo >= 0.0) || (a.hi <= 0.0 && b.hi <= 0.0);
    const bool negative = (a.lo >= 0.0 && b.hi <= 0.0) || (a.hi <= 0.0 && b.lo >= 0.0);
    if (positive && c.lo < 0.0) c.lo = 0.0;
    if (negative && c.hi > 0.0) c.hi = 0.0;
    return {c.lo, c.hi, undefined_too(a, b) || clash};
}

Interval abs(Interval a) {
    if (a.is_empty() || a.lo >= 0.0) return a;
    if (a.hi <= 0.0) return -a;
    return {0.0, -a.lo > a.hi ? -a.lo : a.hi, a.maybe_undefined};
}
Interval sign(Interval a) {
    return map_ends(a, [](double x) { return sign(x); });
}
Interval floor(Interval a) {
    return map_ends(a, [](double x) { return floor(x); });
}
Interval ceil(Interval a) {
    return map_ends(a, [](double x) { return ceil(x); });
}
Interval trunc(Interval a) {
    return map_ends(a, [](double x) { return trunc(x); });
}
Interval round_half_up(Interval a) {
    return map_ends(a, [](double x) { return round_half_up(x); });
}
Interval min(Interval a, Interval b) {
    if (either_empty(a, b)) return Interval::empty();
    return {min(a.lo, b.lo), min(a.hi, b.hi), undefined_too(a, b)};
}
Interval max(Interval a, Interval b) {
    if (either_empty(a, b)) return Interval::empty();
    return {max(a.lo, b.lo), max(a.hi, b.hi), undefined_too(a, b)};
}

namespace {
/// remainder_trunc for 0 <= a, 0 < d, all finite.
Interval remainder_of_positive(double low, double high, Interval d) {
    const double below = next_down(d.hi);
    const double top = high < below ? high : below;
    if (high < d.lo) return {low, high};  // the quotient is 0
    if (d.lo == d.hi) {
        const double r = remainder_trunc(low, d.lo), s = remainder_trunc(high, d.lo);
        if (next_up(high - low) < d.lo && r <= s) return {r, s};
        return {0.0, top};
    }
    const double q = floor(next_down(low / d.hi)), p = floor(next_up(high / d.lo));
    if (q != p || q < 0.0 || q >= 0x1p53) return {0.0, top};
    const Interval r = Interval(low, high) - Interval(q) * d;
    return {r.lo > 0.0 ? r.lo : 0.0, r.hi < top ? r.hi : top};
}
}  // namespace

Interval remainder_trunc(Interval a, Interval b) {
    if (either_empty(a, b)) return Interval::empty();
    const Interval d = abs(b);
    if (d.hi == 0.0 || is_infinite(a)) return Interval::empty();
    const bool undefined = undefined_too(a, b) || d.lo == 0.0 || has_infinity(a);
    Interval positive = Interval::empty(), negative = Interval::empty();
    const bool plain = !has_infinity(a) && d.lo > 0.0 && d.hi < infinity;
    const auto bounded = [&](double low, double high) {
        if (plain) return remainder_of_positive(low, high, d);
        const double most = high < d.hi ? high : d.hi;
        return Interval(high < d.lo ? low : 0.0, most < max_finite ? most : max_finite);
    };
    if (a.hi >= 0.0) positive = bounded(a.lo > 0.0 ? a.lo : 0.0, a.hi);
    if (a.lo < 0.0) negative = -bounded(a.hi < 0.0 ? -a.hi : 0.0, -a.lo);
    Interval r = positive.is_empty() ? negative : (negative.is_empty() ? positive : hull(positive, negative));
    r.maybe_undefined = undefined;
    return r;
}

FREP_MATH_CLOSE
