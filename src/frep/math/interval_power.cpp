// Intervals of powi and pow. Method: chains whose products are stepped outward, by parity and sign of the
// base; fractional exponents by the corners of the box, since e ln b is bilinear in e and ln b. Checked by
// tests/unit/math/interval_test.cpp and itf1788_test.cpp.
#include <initializer_list>

#include "frep/math/interval.h"
#include "frep/math/power.h"

FREP_MATH_OPEN
namespace {

double least(double a, double b) { return a < b ? a : b; }
double most(double a, double b) { return a > b ? a : b; }

/// b^n for b >= 0, n >= 1 by the chain of powi with every product stepped: a bound of the exact power and of
/// the computed one, below or above.
double chain_bound(double b, unsigned n, bool up) {
    const auto step = [up](double x, double y) {
        const double p = x * y;
        if (x == 0.0 || y == 0.0 || (x == 1.0 && y == 1.0)) return p;
        if (p == infinity && (x == infinity || y == infinity)) return p;
        return up ? next_up(p) : most(0.0, next_down(p));
    };
    double factor = b;
    for (; (n & 1u) == 0; n >>= 1) factor = step(factor, factor);
    double r = factor;
    for (n >>= 1; n != 0; n >>= 1) {
        factor = step(factor, factor);
        if ((n & 1u) != 0) r = step(r, factor);
    }
    return r;
}
/// Powers of the bases [lo, hi], 0 <= lo; with n < 0 a base 0 gives +inf.
Interval power_of_positive(double lo, double hi, int n) {
    const unsigned size = n < 0 ? 0u - static_cast<unsigned>(n) : static_cast<unsigned>(n);
    const double low = chain_bound(lo, size, false), high = chain_bound(hi, size, true);
    if (n > 0) return {low, high};
    const double end = low > 0.0 ? next_up(1.0 / low) : infinity;
    return {hi == 0.0 ? infinity : most(0.0, next_down(1.0 / high)), end};
}
/// The hull of two parts of one result: an empty part leaves no mark.
Interval join(const Interval& a, const Interval& b) {
    if (a.is_empty()) return b;
    return b.is_empty() ? a : hull(a, b);
}

}  // namespace

Interval powi(Interval x, int n) {
    if (x.is_empty()) return x;
    if (n == 0) return {1.0, 1.0, x.maybe_undefined};
    const bool odd = n % 2 != 0;
    Interval r;
    if (!odd) {
        const Interval m = abs(x);
        r = power_of_positive(m.lo, m.hi, n);
    } else if (n < 0 && x.contains(0.0)) {
        r = Interval::entire();
    } else if (x.lo >= 0.0) {
        r = power_of_positive(x.lo, x.hi, n);
    } else if (x.hi <= 0.0) {
        r = -power_of_positive(-x.hi, -x.lo, n);
    } else {
        r = {-power_of_positive(0.0, -x.lo, n).hi, power_of_positive(0.0, x.hi, n).hi};
    }
    return r.flagged(x.maybe_undefined);
}

namespace {

/// Powers of the bases [lo, hi], 1e-6 <= lo, for exponents [n, m]: corners, widened for what a chain may add.
Interval general_power(double lo, double hi, double n, double m) {
    double low = infinity, high = 0.0;
    for (const double b : {lo, hi}) {
        for (const double e : {n, m}) {
            double v = kernel::power_of_size(b, e);
            if (v != v) v = 1.0;  // 1^inf, undefined and marked so; the values beside it start from 1
            low = least(low, v);
            high = most(high, v);
        }
    }
    int steps = ulp_bound::pow + 1;
    const double first = most(ceil(n), -kernel::longest_chain), last = least(floor(m), kernel::longest_chain);
    if (first <= last) {  // integers that take the chain lie in [n, m]
        const double longest = most(abs(first), abs(last));
        steps += 2 * ulp_bound::powi(static_cast<int>(longest));
        if (low < 0x1p-960) low = 0.0;
        if (high > 0x1p960) high = infinity;
    }
    return {most(0.0, step_down(low, steps)), high == infinity ? high : step_up(high, steps)};
}
/// The part of a power with negative bases -[lo, hi], 1e-6 <= lo.
Interval negative_power(double lo, double hi, double n, double m, bool& undefined) {
    if (n != m) {
        undefined = true;
        if (ceil(n) > m) return Interval::empty();
        const Interval r = general_power(lo, hi, n, m);
        return {-r.hi, r.hi};
    }
    if (floor(n) != n) {
        undefined = true;
        return Interval::empty();
    }
    const Interval r = general_power(lo, hi, n, n);
    const double half = 0.5 * n;
    return floor(half) == half ? r : -r;
}

}  // namespace

Interval pow(Interval b, Interval e) {
    if (e.lo == 2.0 && e.hi == 2.0 && !e.maybe_undefined) {  // by far the most frequent: no chain needed
        Interval r = square(b);
        if (b.lo < kernel::power_snap && b.hi > -kernel::power_snap) r.lo = 0.0;
        return r;
    }
    if (b.is_empty() || e.is_empty()) return Interval::empty();
    const double n = kernel::snapped_exponent(e.lo), snapped = kernel::snapped_exponent(e.hi);
    const double m = n == snapped ? n : e.hi;
    bool undefined = b.maybe_undefined || e.maybe_undefined;
    const bool one_chain = n == m && kernel::takes_chain(n);
    const double tiny = kernel::power_snap;
    Interval r = Interval::empty();
    if (b.hi >= tiny) {
        const double lo = most(b.lo, tiny);
        const Interval part =
            !one_chain ? general_power(lo, b.hi, n, m) : powi(Interval(lo, b.hi), static_cast<int>(n));
        r = join(r, part);
        undefined = undefined || (lo <= 1.0 && b.hi >= 1.0 && (n == -infinity || m == infinity));
    }
    if (b.lo <= -tiny) {
        const double hi = least(b.hi, -tiny);
        const Interval part = one_chain ? powi(Interval(b.lo, hi), static_cast<int>(n))
                                        : negative_power(-hi, -b.lo, n, m, undefined);
        r = join(r, part);
        undefined = undefined || (b.lo <= -1.0 && hi >= -1.0 && (n == -infinity || m == infinity));
    }
    if (b.lo < tiny && b.hi > -tiny) {  // bases that count as 0
        if (snapped > 0.0) r = join(r, Interval(0.0));
        if (n < 0.0) r = join(r, Interval(infinity));
        undefined = undefined || (n <= 0.0 && m >= 0.0);
    }
    return r.is_empty() ? r : Interval(r.lo, r.hi, undefined);
}

FREP_MATH_CLOSE
