// Kernels of the blending set operations: displacement over the whole space (Pasko and Savchenko 1994,
// a0/(1 + (f1/a1)^2 + (f2/a2)^2)), within control extents, and within a bounding solid (Pasko, Pasko, Ikeda
// and Kunii 2002, 2005: a0 (1-u)^3/(1+u)). Where a blend is not active the value is the plain set operation
// bit for bit. An extent of 0 means no displacement. All operands are read: where one of them is NaN the
// value is, active or not. Tested by tests/unit/shapes/blends_test.cpp.
#pragma once

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace blend_detail {

/// (1-u)^3/(1+u) for t = 1 - u in 0..1, without cancellation; increasing.
template <class T>
T bell(T t) {
    return t * math::square(t) / (2.0 - t);
}

/// True where one of the extents is 0, or the displacement is.
template <class T>
auto no_displacement(T a0, T a1, T a2) {
    const T nought = zero<T>();
    return math::either(math::equal(a0, nought),
                        math::either(math::equal(a1, nought), math::equal(a2, nought)));
}

/// z^2/(x^2 + y^2 + z^2), scaled by the largest magnitude, which over- and underflow survive; 1 where all
/// three are 0.
template <class T>
T share_of(T x, T y, T z) {
    const T nought = zero<T>();
    const T largest = without_derivative(math::max(math::max(math::abs(x), math::abs(y)), math::abs(z)));
    const auto endless = math::equal(largest, math::constant<T>(math::infinity));
    const auto scaled = [&](T a) {
        const T sized = math::select(math::equal(math::abs(a), largest), one<T>(), nought);
        return math::square(math::select(endless, sized, a / largest));
    };
    const T square_z = scaled(z);
    const T share = square_z / (scaled(x) + scaled(y) + square_z);
    return math::select(math::equal(largest, nought), one<T>(), share);
}

/// The magnitude of f/a: a range of non-negative numbers, [0, inf] where a may be 0.
inline Interval ratio(Interval f, Interval a) {
    if (f.is_empty() || a.is_empty()) return {0.0, math::infinity};
    if (a.contains(0.0)) return {0.0, math::infinity};
    const Interval q = math::abs(f / a);
    return q.is_empty() ? Interval(0.0, math::infinity) : Interval(q.lo, q.hi);
}
inline bool surely_zero(Interval a) { return a.lo == 0.0 && a.hi == 0.0 && !a.maybe_undefined; }
inline bool surely_plain(Interval a0, Interval a1, Interval a2) {
    return surely_zero(a0) || surely_zero(a1) || surely_zero(a2);
}

/// base + a0 bell; 0 counts as a value of the bell where an extent may be 0.
inline Interval displaced(Interval base, Interval a0, Interval bell,
                          std::initializer_list<Interval> extents) {
    for (const Interval& a : extents)
        if (a.contains(0.0)) bell.lo = 0.0;
    return base + a0 * bell;
}
inline bool endless(Interval a) { return !(magnitude(a) < math::infinity); }

/// `whole`, or better: where f1, f2 <= 0 and a0 >= 0 the blending unions increase in f1, f2 (and f3), so that
/// `low` and `high`, the ranges at the end points, bound them (pruning.md, section 3).
template <class Low, class High>
Interval by_corners(Interval whole, Interval f1, Interval f2, Interval a0, Low low, High high) {
    if (!(f1.hi <= 0.0 && f2.hi <= 0.0 && a0.lo >= 0.0) || whole.is_empty()) return whole;
    if (is_point(f1) && is_point(f2)) return whole;
    const Interval below = low(), above = high();
    if (any_empty(below, above)) return whole;
    // the terms of the sum, which may cancel, are at most as large as the operands and the result
    const double slack_low = 0x1p-50 * (magnitude(below) - f1.lo - f2.lo);
    const double slack_high = 0x1p-50 * (magnitude(above) - f1.hi - f2.hi);
    return cut(whole, math::next_down(below.lo - slack_low), math::next_up(above.hi + slack_high));
}

}  // namespace blend_detail

inline Interval blend_uni(Interval f1, Interval f2, Interval a0, Interval a1, Interval a2) {
    using namespace blend_detail;
    if (any_empty(f1, f2, a0, a1, a2)) return Interval::empty();
    const auto natural = [&](Interval g1, Interval g2) {
        const Interval base = math::r_or(g1, g2);
        if (surely_plain(a0, a1, a2)) return base;
        const Interval u = math::square(ratio(g1, a1)) + math::square(ratio(g2, a2));
        return displaced(base, a0, Interval(1.0) / (Interval(1.0) + u), {a1, a2});
    };
    // inf/inf; with finite operands nothing is undefined
    const bool clash = endless(a0) || (endless(f1) && endless(a1)) || (endless(f2) && endless(a2));
    const Interval range = by_corners(
        natural(f1, f2), f1, f2, a0, [&] { return natural(f1.lo, f2.lo); },
        [&] { return natural(f1.hi, f2.hi); });
    return range.flagged(clash || any_flagged(f1, f2, a0, a1, a2));
}

template <class T>
T blend_uni(T f1, T f2, T a0, T a1, T a2) {
    const T base = math::r_or(f1, f2);
    const T value = base + a0 / (1.0 + (math::square(f1 / a1) + math::square(f2 / a2)));
    return defined_with(math::select(blend_detail::no_displacement(a0, a1, a2), base, value), a0, a1, a2);
}

/// A blending intersection is the negated blending union of the complements.
template <class T>
T blend_int(T f1, T f2, T a0, T a1, T a2) {
    return -blend_uni(-f1, -f2, -a0, a1, a2);
}

inline Interval point_uni(Interval f1, Interval f2, Interval a0, Interval a1, Interval a2) {
    using namespace blend_detail;
    if (any_empty(f1, f2, a0, a1, a2)) return Interval::empty();
    const auto natural = [&](Interval g1, Interval g2) {
        const Interval base = math::r_or(g1, g2);
        const Interval u = math::square(ratio(g1, a1)) + math::square(ratio(g2, a2));
        if (surely_plain(a0, a1, a2) || u.lo >= 1.0) return base;
        const Interval rest = Interval(1.0) - u;
        const Interval t = {rest.lo > 0.0 ? rest.lo : 0.0, rest.hi < 1.0 ? rest.hi : 1.0};
        return displaced(base, a0, bell(t), {a1, a2});
    };
    const bool clash = endless(a0) || (endless(f1) && endless(a1)) || (endless(f2) && endless(a2));
    const Interval range = by_corners(
        natural(f1, f2), f1, f2, a0, [&] { return natural(f1.lo, f2.lo); },
        [&] { return natural(f1.hi, f2.hi); });
    return range.flagged(clash || any_flagged(f1, f2, a0, a1, a2));
}

/// The plain union where u = (f1/a1)^2 + (f2/a2)^2 >= 1.
template <class T>
T point_uni(T f1, T f2, T a0, T a1, T a2) {
    const T base = math::r_or(f1, f2);
    const T u = math::square(f1 / a1) + math::square(f2 / a2);
    const T value = base + a0 * blend_detail::bell(1.0 - u);
    const auto plain = math::either(math::less_equal(one<T>(), u), blend_detail::no_displacement(a0, a1, a2));
    return defined_with(math::select(plain, base, value), a0, a1, a2);
}

template <class T>
T point_int(T f1, T f2, T a0, T a1, T a2) {
    return -point_uni(-f1, -f2, -a0, a1, a2);
}

inline Interval bounded_uni(Interval f1, Interval f2, Interval f3, Interval a0, Interval a1, Interval a2,
                            Interval a3) {
    using namespace blend_detail;
    if (any_empty(f1, f2, f3, a0, a1, a2, a3)) return Interval::empty();
    const auto natural = [&](Interval g1, Interval g2, Interval g3) {
        const Interval base = math::r_or(g1, g2);
        if (!(g3.hi > 0.0) || surely_plain(a0, a1, a2) || surely_zero(a3)) return base;
        const Interval x = ratio(g1, a1), y = ratio(g2, a2);
        const Interval z = ratio({g3.lo > 0.0 ? g3.lo : 0.0, g3.hi}, a3);
        Interval t = stepped(share_of(x.hi, y.hi, z.lo), share_of(x.lo, y.lo, z.hi), 16);
        if (!(g3.lo > 0.0) || !(t.lo > 0.0)) t.lo = 0.0;
        if (!(t.hi < 1.0)) t.hi = 1.0;
        return displaced(base, a0, bell(t), {a1, a2, a3});
    };
    const bool clash = endless(a0) || (endless(f1) && endless(a1)) || (endless(f2) && endless(a2)) ||
                       (endless(f3) && endless(a3));
    const Interval range = by_corners(
        natural(f1, f2, f3), f1, f2, a0, [&] { return natural(f1.lo, f2.lo, f3.lo); },
        [&] { return natural(f1.hi, f2.hi, f3.hi); });
    return range.flagged(clash || any_flagged(f1, f2, f3, a0, a1, a2, a3));
}

/// The plain union where f3 <= 0; f3 is tested first.
template <class T>
T bounded_uni(T f1, T f2, T f3, T a0, T a1, T a2, T a3) {
    const T base = math::r_or(f1, f2), nought = zero<T>();
    const T t = blend_detail::share_of(f1 / a1, f2 / a2, f3 / a3);
    const T value = base + a0 * blend_detail::bell(t);
    const auto plain =
        math::either(math::less_equal(f3, nought),
                     math::either(math::equal(a3, nought), blend_detail::no_displacement(a0, a1, a2)));
    return defined_with(math::select(plain, base, value), f3, a0, a1, a2, a3);
}

template <class T>
T bounded_int(T f1, T f2, T f3, T a0, T a1, T a2, T a3) {
    return -bounded_uni(-f1, -f2, f3, -a0, a1, a2, a3);
}

}  // namespace frep::kernels
