// Intervals of the elementary functions and of the R-functions. Method: end points of monotone pieces,
// stepped outward by the kernel's bound + 1 ulp (numerics.md, rule 4); extrema of sine and cosine found by
// counting quarter turns. Checked by tests/unit/math/interval_test.cpp and itf1788_test.cpp.
#include "frep/math/coefficients.h"
#include "frep/math/interval.h"
#include "frep/math/rfunctions.h"

FREP_MATH_OPEN
namespace {

double least(double a, double b) { return a < b ? a : b; }
double most(double a, double b) { return a > b ? a : b; }
double clamp(double x, double low, double high) { return most(low, least(high, x)); }

/// [f(low), f(high)] of a rising kernel, stepped and kept inside [floor, ceiling].
template <class F>
Interval rising(double low, double high, bool undefined, F f, int bound, double floor, double ceiling) {
    return {clamp(step_down(f(low), bound + 1), floor, ceiling),
            clamp(step_up(f(high), bound + 1), floor, ceiling), undefined};
}
using Kernel = double (*)(double);

/// True if some integer k = phase (mod 4), as a number of quarter turns, may lie in [low, high].
bool may_hold(double low, double high, double phase) {
    const double k = ceil((low - phase) * 0.25) * 4.0 + phase;
    return k <= high;
}
/// Sine (phase 0) or cosine (phase 1): maxima at quarter turns 1 - phase, minima at 3 - phase (mod 4).
Interval wave(Interval a, Kernel f, double phase, int bound) {
    if (a.is_empty()) return a;
    const bool endless = a.lo == -infinity || a.hi == infinity;
    if (endless && a.lo == a.hi) return Interval::empty();
    const bool undefined = a.maybe_undefined || endless;
    const bool large = !(most(abs(a.lo), abs(a.hi)) <= 0x1p20);
    if (a.lo != a.hi && (large || a.hi - a.lo >= 6.3)) return {-1.0, 1.0, undefined};
    const double u = f(a.lo), v = f(a.hi);
    double low = clamp(step_down(least(u, v), bound + 1), -1.0, 1.0);
    double high = clamp(step_up(most(u, v), bound + 1), -1.0, 1.0);
    if (a.lo != a.hi) {
        // Quarter turns of the ends, widened well beyond the rounding of two products.
        const double s = a.lo * coefficients::two_over_pi, t = a.hi * coefficients::two_over_pi;
        const double from = s - abs(s) * 0x1p-50, to = t + abs(t) * 0x1p-50;
        if (may_hold(from, to, 1.0 - phase)) high = 1.0;
        if (may_hold(from, to, 3.0 - phase)) low = -1.0;
    }
    return {low, high, undefined};
}

}  // namespace

Interval square(Interval a) {
    if (a.is_empty()) return a;
    const Interval m = abs(a);
    const double low = next_down(m.lo * m.lo);
    const double high = m.hi * m.hi;
    return {m.lo == infinity ? infinity : most(0.0, low), m.hi == 0.0 ? 0.0 : next_up(high),
            a.maybe_undefined};
}
Interval sqrt(Interval a) {
    if (a.is_empty() || a.hi < 0.0) return Interval::empty();
    const bool undefined = a.maybe_undefined || a.lo < 0.0;
    const double low = a.lo <= 0.0 ? 0.0 : most(0.0, next_down(sqrt(a.lo)));
    return {low, a.hi == 0.0 ? 0.0 : next_up(sqrt(a.hi)), undefined};
}
Interval exp(Interval a) {
    if (a.is_empty()) return a;
    return rising(a.lo, a.hi, a.maybe_undefined, Kernel(exp), ulp_bound::exp, 0.0, infinity);
}
namespace {
Interval logarithm(Interval a, Kernel f, int bound) {
    if (a.is_empty() || a.hi <= 0.0) return Interval::empty();
    const bool undefined = a.maybe_undefined || a.lo <= 0.0;
    const double high = a.hi == 1.0 ? 0.0 : step_up(f(a.hi), bound + 1);
    if (a.lo <= 0.0) return {-infinity, high, undefined};
    return {a.lo == 1.0 ? 0.0 : step_down(f(a.lo), bound + 1), high, undefined};
}
}  // namespace
Interval log(Interval a) { return logarithm(a, log, ulp_bound::log); }
Interval log10(Interval a) { return logarithm(a, log10, ulp_bound::log10); }
Interval sin(Interval a) { return wave(a, sin, 0.0, ulp_bound::sin); }
Interval cos(Interval a) { return wave(a, cos, 1.0, ulp_bound::cos); }
Interval tan(Interval a) {
    if (a.is_empty()) return a;
    const bool endless = a.lo == -infinity || a.hi == infinity;
    if (endless && a.lo == a.hi) return Interval::empty();
    const bool undefined = a.maybe_undefined || endless;
    bool pole = false;
    if (a.lo != a.hi) {
        const bool large = !(most(abs(a.lo), abs(a.hi)) <= 0x1p20);
        const double s = a.lo * coefficients::two_over_pi, t = a.hi * coefficients::two_over_pi;
        const double from = s - abs(s) * 0x1p-50, to = t + abs(t) * 0x1p-50;
        pole = large || a.hi - a.lo >= 3.2 || may_hold(from, to, 1.0) || may_hold(from, to, 3.0);
    }
    if (pole) return {-infinity, infinity, undefined};
    return rising(a.lo, a.hi, undefined, Kernel(tan), ulp_bound::tan, -infinity, infinity);
}
Interval asin(Interval a) {
    if (a.is_empty() || a.hi < -1.0 || a.lo > 1.0) return Interval::empty();
    const bool undefined = a.maybe_undefined || a.lo < -1.0 || a.hi > 1.0;
    const double limit = next_up(half_pi);
    return rising(clamp(a.lo, -1.0, 1.0), clamp(a.hi, -1.0, 1.0), undefined, Kernel(asin), ulp_bound::asin,
                  -limit, limit);
}
Interval acos(Interval a) {
    if (a.is_empty() || a.hi < -1.0 || a.lo > 1.0) return Interval::empty();
    const bool undefined = a.maybe_undefined || a.lo < -1.0 || a.hi > 1.0;
    const Interval r = rising(clamp(a.hi, -1.0, 1.0), clamp(a.lo, -1.0, 1.0), undefined, Kernel(acos),
                              ulp_bound::acos, 0.0, next_up(pi));
    return a.lo >= 1.0 ? Interval(r.lo, 0.0, undefined) : r;
}
Interval atan(Interval a) {
    if (a.is_empty()) return a;
    const double limit = next_up(half_pi);
    return rising(a.lo, a.hi, a.maybe_undefined, Kernel(atan), ulp_bound::atan, -limit, limit);
}
Interval sinh(Interval a) {
    if (a.is_empty()) return a;
    return rising(a.lo, a.hi, a.maybe_undefined, Kernel(sinh), ulp_bound::sinh, -infinity, infinity);
}
Interval cosh(Interval a) {
    if (a.is_empty()) return a;
    const Interval m = abs(a);
    return rising(m.lo, m.hi, a.maybe_undefined, Kernel(cosh), ulp_bound::cosh, 1.0, infinity);
}
Interval tanh(Interval a) {
    if (a.is_empty()) return a;
    return rising(a.lo, a.hi, a.maybe_undefined, Kernel(tanh), ulp_bound::tanh, -1.0, 1.0);
}
Interval hypot(Interval a, Interval b) {
    if (a.is_empty() || b.is_empty()) return Interval::empty();
    const Interval x = abs(a), y = abs(b);
    const double low = hypot(x.lo, y.lo), high = hypot(x.hi, y.hi);
    const bool undefined = a.maybe_undefined || b.maybe_undefined;
    return {most(0.0, step_down(low, ulp_bound::hypot + 1)),
            high == 0.0 ? 0.0 : step_up(high, ulp_bound::hypot + 1), undefined};
}

namespace {
/// The angle of boxes with y >= 0: it grows to the left; with y to the right of the axis, against y left of
/// it.
Interval upper_angle(Interval y, Interval x) {
    double low = atan2(x.hi > 0.0 ? y.lo : y.hi, x.hi);
    const double high = atan2(x.lo >= 0.0 ? y.hi : y.lo, x.lo);
    if (y.lo == 0.0 && x.contains(0.0)) low = 0.0;  // the origin has angle 0
    const double top =
        y.hi == 0.0 && x.lo >= 0.0 ? 0.0 : least(step_up(high, ulp_bound::atan2 + 1), next_up(pi));
    return {most(0.0, step_down(low, ulp_bound::atan2 + 1)), top};
}
}  // namespace

Interval atan2(Interval y, Interval x) {
    if (y.is_empty() || x.is_empty()) return Interval::empty();
    const bool undefined = y.maybe_undefined || x.maybe_undefined;
    if (y.lo >= 0.0) return upper_angle(y, x).flagged(undefined);
    if (y.hi < 0.0) return (-upper_angle(-y, x)).flagged(undefined);
    if (x.lo < 0.0) return {-next_up(pi), next_up(pi), undefined};
    const double low = atan2(y.lo, x.lo), high = y.hi > 0.0 ? atan2(y.hi, x.lo) : 0.0;
    const double limit = next_up(half_pi);
    return {most(-limit, step_down(low, ulp_bound::atan2 + 1)),
            y.hi == 0.0 ? 0.0 : least(limit, step_up(high, ulp_bound::atan2 + 1)), undefined};
}

namespace {
/// x moved `n` places without leaving its sign.
double step_up_in_sign(double x, int n) {
    if (x == 0.0) return x;
    const double r = step_up(x, n);
    return x < 0.0 && !(r < 0.0) ? -min_denormal : r;
}
/// An R-function at its corners; monotone in both operands up to its rounding.
template <class F>
Interval r_corners(const Interval& a, const Interval& b, F f) {
    if (a.is_empty() || b.is_empty()) return Interval::empty();
    const int steps = 2 * ulp_bound::r_function + 1;
    const double low = -step_up_in_sign(-f(a.lo, b.lo), steps);
    const double high = step_up_in_sign(f(a.hi, b.hi), steps);
    return {most(low, -r_limit), least(high, r_limit), a.maybe_undefined || b.maybe_undefined};
}
}  // namespace

Interval r_and(Interval a, Interval b) {
    return r_corners(a, b, [](double x, double y) { return r_and(x, y); });
}
Interval r_or(Interval a, Interval b) {
    return r_corners(a, b, [](double x, double y) { return r_or(x, y); });
}

FREP_MATH_CLOSE
