// Kernels of arithmetic, elementary functions, truth values and R-functions: thin names over module math.
// Tested by tests/unit/eval/conformance_test.cpp.
#pragma once

#include "frep/field/kernels/data.h"
#include "frep/math/number.h"

namespace frep::kernels {

using math::abs;
using math::acos;
using math::asin;
using math::atan;
using math::atan2;
using math::ceil;
using math::cos;
using math::cosh;
using math::exp;
using math::floor;
using math::hypot;
using math::log;
using math::log10;
using math::max;
using math::min;
using math::pow;
using math::r_and;
using math::r_or;
using math::sign;
using math::sin;
using math::sinh;
using math::sqrt;
using math::square;
using math::tan;
using math::tanh;
using math::trunc;

template <class T>
T add(T a, T b) {
    return a + b;
}
template <class T>
T sub(T a, T b) {
    return a - b;
}
template <class T>
T mul(T a, T b) {
    return a * b;
}
template <class T>
T div(T a, T b) {
    return a / b;
}
template <class T>
T neg(T a) {
    return -a;
}
template <class T>
T round(T a) {
    return math::round_half_up(a);
}
template <class T>
T remainder(T a, T b) {
    return math::remainder_trunc(a, b);
}

/// Two numbers closer than this are equal for `=`; a number nearer to 0 is false.
inline constexpr double truth_tolerance = 1e-6;

template <class T>
T undefined_value() {
    return math::constant<T>(math::quiet_nan);
}

/// 1 or 0 by the mask; undefined where `operands` is (operands: any expression that is NaN when one of them
/// is).
template <class T, class Mask>
T truth_value(Mask mask, T a, T b) {
    const T value = math::select(mask, math::constant<T>(1.0), math::constant<T>(0.0));
    return math::select(math::either(math::is_nan(a), math::is_nan(b)), undefined_value<T>(), value);
}

template <class T>
auto is_true(T a) {
    return math::less_equal(math::constant<T>(truth_tolerance), math::abs(a));
}

template <class T>
T truth(T a) {
    return truth_value(is_true(a), a, a);
}
template <class T>
T logical_not(T a) {
    return truth_value(!is_true(a), a, a);
}
template <class T>
T logical_and(T a, T b) {
    return truth_value(math::both(is_true(a), is_true(b)), a, b);
}
template <class T>
T logical_or(T a, T b) {
    return truth_value(math::either(is_true(a), is_true(b)), a, b);
}
template <class T>
T less(T a, T b) {
    return truth_value(math::less(a, b), a, b);
}
template <class T>
T less_equal(T a, T b) {
    return truth_value(math::less_equal(a, b), a, b);
}
template <class T>
T equal(T a, T b) {
    const auto near = math::less(math::abs(a - b), math::constant<T>(truth_tolerance));
    return truth_value(math::either(near, math::equal(a, b)), a, b);  // the second for equal infinities
}
template <class T>
T select(T condition, T a, T b) {
    return math::select(math::is_nan(condition), undefined_value<T>(),
                        math::select(is_true(condition), a, b));
}

/// Table look-up by rounded 1-based index. Generic over number types: compares with every index.
template <class T>
T pick(const T* lead, Data<T> data) {
    const T index = math::round_half_up(lead[0]);
    T value = undefined_value<T>();
    for (std::size_t i = 0; i < data.size(); ++i)
        value =
            math::select(math::equal(index, math::constant<T>(static_cast<double>(i + 1))), data[i], value);
    return value;
}

/// Undefined only where the index can leave the table.
inline math::Interval pick(const math::Interval* lead, Data<math::Interval> data) {
    const math::Interval index = math::round_half_up(lead[0]);
    math::Interval value = math::Interval::empty();
    if (index.is_empty()) return value;
    const double count = static_cast<double>(data.size());
    const bool leaves = index.maybe_undefined || index.lo < 1.0 || index.hi > count;
    const double first = index.lo < 1.0 ? 1.0 : index.lo;
    for (double i = first; i <= index.hi && i <= count; i += 1.0) {
        const math::Interval item = data[static_cast<std::size_t>(i) - 1];
        value = i == first ? item : math::hull(value, item);
    }
    return value.flagged(leaves);
}

}  // namespace frep::kernels
