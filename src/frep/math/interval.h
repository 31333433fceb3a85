// Intervals that enclose every value that the double kernels compute for the doubles of the box, and the
// exact real values too, with a flag for "may be undefined". Method: compute to nearest, step outward by the
// stated bound of the operation (numerics.md, rule 4). Checked by tests/unit/math/interval_test.cpp (samples,
// MPFR) and itf1788_test.cpp (IEEE 1788 vectors).
#pragma once

#include "frep/math/functions.h"

FREP_MATH_OPEN

/// The closed range of the defined values of a number, infinities included, and whether it may be undefined.
struct Interval {
    double lo = 0.0;
    double hi = 0.0;
    bool maybe_undefined = false;

    constexpr Interval() = default;
    /// One value; NaN gives empty().
    constexpr Interval(double point) : lo(point), hi(point) {
        if (point != point) *this = empty();
    }
    constexpr Interval(double low, double high, bool undefined = false)
        : lo(low), hi(high), maybe_undefined(undefined) {}

    /// No defined value: surely undefined.
    static constexpr Interval empty() { return {infinity, -infinity, true}; }
    /// Any value, defined.
    static constexpr Interval entire() { return {-infinity, infinity}; }
    constexpr bool is_empty() const { return !(lo <= hi); }
    /// True if the closed range holds x.
    constexpr bool contains(double x) const { return lo <= x && x <= hi; }
    /// hi - lo (inf when unbounded); negative or NaN when empty.
    constexpr double width() const { return hi - lo; }
    /// True if every value is defined and > 0, >= 0, < 0.
    constexpr bool surely_positive() const { return !maybe_undefined && lo > 0.0; }
    constexpr bool surely_not_negative() const { return !maybe_undefined && lo >= 0.0; }
    constexpr bool surely_negative() const { return !maybe_undefined && hi < 0.0; }
    /// The same range with the flag set if `undefined`.
    constexpr Interval flagged(bool undefined) const { return {lo, hi, maybe_undefined || undefined}; }
};

/// What a comparison can come out as, over a box. A comparison with an undefined value is false, as for
/// double.
struct IntervalMask {
    bool can_be_true = false;
    bool can_be_false = false;
    constexpr bool surely_true() const { return can_be_true && !can_be_false; }
    constexpr bool surely_false() const { return !can_be_true; }
};
template <>
struct MaskOf<Interval> {
    using type = IntervalMask;
};
constexpr IntervalMask operator&(IntervalMask a, IntervalMask b) {
    return {a.can_be_true && b.can_be_true, a.can_be_false || b.can_be_false};
}
constexpr IntervalMask operator|(IntervalMask a, IntervalMask b) {
    return {a.can_be_true || b.can_be_true, a.can_be_false && b.can_be_false};
}
constexpr IntervalMask operator!(IntervalMask a) { return {a.can_be_false, a.can_be_true}; }

/// The smallest interval that holds both; an empty operand leaves the other, which then may be undefined.
Interval hull(Interval a, Interval b);
/// The mask's choice; undecided gives the hull.
Interval select(IntervalMask m, Interval a, Interval b);
IntervalMask less(Interval a, Interval b);
IntervalMask less_equal(Interval a, Interval b);
IntervalMask equal(Interval a, Interval b);
/// True where undefined.
IntervalMask is_nan(Interval a);

/// Arithmetic, stepped outward by 1 ulp unless a result is exact beyond doubt (a zero sum, a zero factor).
/// inf-inf, 0*inf, 0/0 and inf/inf set maybe_undefined; a divisor that contains 0 gives the whole line.
Interval operator+(Interval a, Interval b);
Interval operator-(Interval a, Interval b);
Interval operator*(Interval a, Interval b);
Interval operator/(Interval a, Interval b);
inline Interval operator-(Interval a) { return a.is_empty() ? a : Interval(-a.hi, -a.lo, a.maybe_undefined); }
inline Interval& operator+=(Interval& a, Interval b) { return a = a + b; }
inline Interval& operator-=(Interval& a, Interval b) { return a = a - b; }
inline Interval& operator*=(Interval& a, Interval b) { return a = a * b; }
inline Interval& operator/=(Interval& a, Interval b) { return a = a / b; }

/// Exact: no step.
Interval abs(Interval a);
Interval sign(Interval a);
Interval floor(Interval a);
Interval ceil(Interval a);
Interval trunc(Interval a);
Interval round_half_up(Interval a);
Interval min(Interval a, Interval b);
Interval max(Interval a, Interval b);
/// Exact where b is one value and the quotient does not change; never outside [-|b|, |b|] and the sign of a.
Interval remainder_trunc(Interval a, Interval b);

/// Stepped by 1 ulp, never below 0.
Interval square(Interval a);
Interval sqrt(Interval a);
/// Stepped by the kernel's bound + 1 ulp; exp, cosh and hypot never step below 0.
Interval exp(Interval a);
Interval log(Interval a);
Interval log10(Interval a);
Interval sin(Interval a);
Interval cos(Interval a);
/// The whole line across a pole.
Interval tan(Interval a);
Interval asin(Interval a);
Interval acos(Interval a);
Interval atan(Interval a);
Interval sinh(Interval a);
Interval cosh(Interval a);
Interval tanh(Interval a);
Interval hypot(Interval a, Interval b);
/// [-pi, pi] where the box crosses the cut (y < 0 and y >= 0 with x < 0).
Interval atan2(Interval y, Interval x);
/// By parity and end points; each product of the chain is stepped.
Interval powi(Interval x, int n);
/// Encloses both the snapped exponent (see pow in functions.h) and the exact one.
Interval pow(Interval b, Interval e);
/// The R-functions at the corners, stepped outward; a bound never leaves the sign of min (max) of its corner.
/// The step is 9 ulp: the formula of rule 6 is within 4 ulp of the exact value (measured: 2.94) but not
/// monotone, so that a value inside may pass the computed corner by twice that (rule 4 plans 4 ulp, which is
/// too few).
Interval r_and(Interval a, Interval b);
Interval r_or(Interval a, Interval b);

FREP_MATH_CLOSE
