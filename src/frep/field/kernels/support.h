// What several kernels share: lifting doubles, values without derivatives, lane-wise scalar calls, and rules
// for intervals of monotone functions. Tested through the kernels (tests/unit/shapes).
#pragma once

#include <array>
#include <tuple>
#include <type_traits>

#include "frep/field/kernels/data.h"
#include "frep/math/number.h"

namespace frep::kernels {

using math::Interval;

template <class T>
inline constexpr bool is_interval = std::is_same_v<T, Interval>;
template <class T>
inline constexpr bool is_dual = false;
template <class T>
inline constexpr bool is_dual<math::Dual<T>> = true;

/// A double as a T, a T as itself.
template <class T, class S>
T lift(S value) {
    if constexpr (std::is_same_v<S, T>) {
        return value;
    } else {
        return math::constant<T>(value);
    }
}

// Arithmetic of duals with plain numbers (other number types convert from double by themselves).
template <class T>
math::Dual<T> operator+(double a, const math::Dual<T>& b) {
    return {a + b.value, b.d};
}
template <class T>
math::Dual<T> operator+(const math::Dual<T>& a, double b) {
    return {a.value + b, a.d};
}
template <class T>
math::Dual<T> operator-(double a, const math::Dual<T>& b) {
    return {a - b.value, {-b.d[0], -b.d[1], -b.d[2]}};
}
template <class T>
math::Dual<T> operator-(const math::Dual<T>& a, double b) {
    return {a.value - b, a.d};
}
template <class T>
math::Dual<T> operator*(double a, const math::Dual<T>& b) {
    return math::chain(a * b.value, T(a), b);
}
template <class T>
math::Dual<T> operator*(const math::Dual<T>& a, double b) {
    return math::chain(a.value * b, T(b), a);
}
template <class T>
math::Dual<T> operator/(double a, const math::Dual<T>& b) {
    return math::Dual<T>(a) / b;
}
template <class T>
math::Dual<T> operator/(const math::Dual<T>& a, double b) {
    return a / math::Dual<T>(b);
}

/// The value without its derivatives.
template <class T>
T without_derivative(T a) {
    if constexpr (is_dual<T>) {
        return T(a.value, {});
    } else {
        return a;
    }
}

/// The number that every lane, derivative and bound of a constant agrees on.
inline double number_of(double a) { return a; }
inline double number_of(Interval a) { return a.lo; }
template <int N>
double number_of(math::LanesN<N> a) {
    return a[0];
}
template <class T>
double number_of(const math::Dual<T>& a) {
    return number_of(a.value);
}

template <class T>
T zero() {
    return math::constant<T>(0.0);
}
template <class T>
T one() {
    return math::constant<T>(1.0);
}

/// True if the mask can hold somewhere.
template <class M>
bool can_hold(M mask) {
    if constexpr (std::is_same_v<M, math::IntervalMask>) {
        return mask.can_be_true;
    } else {
        return math::any(mask);
    }
}

/// True where one of the operands is NaN.
template <class T>
auto any_nan(T a) {
    return math::is_nan(a);
}
template <class T, class... Rest>
auto any_nan(T a, Rest... rest) {
    return math::either(math::is_nan(a), any_nan(rest...));
}
/// `value`, undefined where one of the operands is: an operation reads all its plain and leading operands,
/// whether they count at this point or not (numerics.md, rule 5).
template <class T, class... Operands>
T defined_with(T value, Operands... operands) {
    return math::select(any_nan(operands...), math::constant<T>(math::quiet_nan), value);
}

/// x^2 + y^2 + z^2.
template <class T>
T sum_of_squares(T x, T y, T z) {
    return math::square(x) + math::square(y) + math::square(z);
}

/// f on the numbers of each lane: f takes and returns double (T = double, LanesN).
template <class F, class... T>
auto lane_by_lane(F f, T... arguments) {
    using First = std::tuple_element_t<0, std::tuple<T...>>;
    if constexpr (std::is_same_v<First, double>) {
        return f(arguments...);
    } else {
        First result;
        for (int i = 0; i < First::size; ++i) result.set(i, f(arguments[i]...));
        return result;
    }
}

/// f on the duals of each lane: f takes a pointer to Dual<double> and returns one.
template <class F, class T, std::size_t n>
math::Dual<T> dual_by_lane(F f, const std::array<math::Dual<T>, n>& arguments) {
    if constexpr (std::is_same_v<T, double>) {
        return f(arguments.data());
    } else {
        math::Dual<T> result;
        for (int i = 0; i < T::size; ++i) {
            std::array<math::Dual<double>, n> lane;
            for (std::size_t k = 0; k < n; ++k) {
                lane[k].value = arguments[k].value[i];
                for (std::size_t j = 0; j < 3; ++j) lane[k].d[j] = arguments[k].d[j][i];
            }
            const math::Dual<double> r = f(lane.data());
            result.value.set(i, r.value);
            for (std::size_t j = 0; j < 3; ++j) result.d[j].set(i, r.d[j]);
        }
        return result;
    }
}

// Intervals.

/// [lo, hi] stepped outward by `ulps`, with a flag.
inline Interval stepped(double lo, double hi, int ulps, bool undefined = false) {
    return {math::step_down(lo, ulps), math::step_up(hi, ulps), undefined};
}
/// Bounds moved outward by a pad >= 0 each; a bound or pad that is no number gives no bound.
inline Interval padded(double lo, double pad_lo, double hi, double pad_hi, bool undefined) {
    const double low = pad_lo == 0.0 ? lo : math::next_down(lo - pad_lo);
    const double high = pad_hi == 0.0 ? hi : math::next_up(hi + pad_hi);
    return {low == low ? low : -math::infinity, high == high ? high : math::infinity, undefined};
}
/// `a` widened by `pad` >= 0 to both sides.
inline Interval widened(Interval a, double pad) {
    return a.is_empty() ? a : padded(a.lo, pad, a.hi, pad, a.maybe_undefined);
}
/// Any value, or none.
inline Interval unknown() { return {-math::infinity, math::infinity, true}; }
/// `a` cut to [lo, hi]; the flag is that of `a`. Bounds that miss `a` (rounding) leave it.
inline Interval cut(Interval a, double lo, double hi) {
    if (a.is_empty()) return a;
    const double low = lo > a.lo ? lo : a.lo, high = hi < a.hi ? hi : a.hi;
    return low <= high ? Interval(low, high, a.maybe_undefined) : a;
}
/// The larger magnitude of the bounds.
inline double magnitude(Interval a) {
    const double low = a.lo < 0 ? -a.lo : a.lo, high = a.hi < 0 ? -a.hi : a.hi;
    return low > high ? low : high;
}
inline bool is_point(Interval a) { return a.lo == a.hi; }
/// The smaller magnitude; 0 where the signs differ.
inline double least_magnitude(Interval a) { return a.lo > 0.0 ? a.lo : a.hi < 0.0 ? -a.hi : 0.0; }
template <class... I>
bool any_empty(I... a) {
    return (a.is_empty() || ...);
}
template <class... I>
bool any_flagged(I... a) {
    return (a.maybe_undefined || ...);
}
/// True if no operand exceeds the limit (an empty one does).
template <class... I>
bool within(double limit, I... a) {
    return ((magnitude(a) <= limit) && ...);
}

/// Cuts `whole` by the mean value form: the range at the centre plus slopes times deviations.
template <class Slope>
Interval by_mean_value(Interval whole, Interval at_centre, const Interval* p, const double* centre,
                       Slope slope) {
    if (whole.is_empty() || at_centre.is_empty()) return whole;
    Interval sum = at_centre;
    for (int i = 0; i < 3; ++i) sum += slope(i) * (p[i] - Interval(centre[i]));
    return sum.is_empty() || sum.maybe_undefined ? whole : cut(whole, sum.lo, sum.hi);
}
inline double centre_of(Interval a) { return 0.5 * a.lo + 0.5 * a.hi; }

/// Range of a decreasing function over q: its ranges at the two ends.
template <class F>
Interval decreasing(F f, Interval q) {
    if (q.is_empty() || is_point(q)) return f(q);
    const Interval low = f(Interval(q.hi)), high = f(Interval(q.lo));
    if (any_empty(low, high)) return unknown();
    return {low.lo, high.hi, any_flagged(q, low, high)};
}

}  // namespace frep::kernels
