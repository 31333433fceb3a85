// Kernels of implicit surfaces by key points: blobs (Blinn 1982), metaballs (Nishimura and others 1985), soft
// objects (Wyvill and others 1986), fitted blobs (Savchenko and others 1995). Data items come point by point;
// intervals use that each term decreases with the distance. Tested by tests/unit/shapes/skeletons_test.cpp.
#pragma once

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace skeleton_detail {

template <class T>
T square_distance(const T* p, const Data<T>& data, std::size_t first) {
    return sum_of_squares(p[0] - data[first], p[1] - data[first + 1], p[2] - data[first + 2]);
}

/// Nishimura's bell of height 1 for the squared relative distance q2 = (r/d)^2.
template <class T>
T metaball_bell(T q2) {
    const T q = math::sqrt(q2);
    const T rest = 1.0 - q;
    const T outer = math::select(math::less(q, one<T>()), 1.5 * math::square(rest), zero<T>());
    const T bell = math::select(math::less_equal(q, math::constant<T>(1.0 / 3.0)), 1.0 - 3.0 * q2, outer);
    return math::select(math::is_nan(q2), q2, bell);
}
/// Wyvill's bell of height 1 for the squared relative distance.
template <class T>
T soft_bell(T q) {
    const T bell = 1.0 - q * (22.0 / 9.0 - q * (17.0 / 9.0 - q * (4.0 / 9.0)));
    return math::select(math::less(one<T>(), q), zero<T>(), bell);
}
/// The value of a decreasing bell of q >= 0, by the end points for intervals; near 1 its rounding is more
/// than its value.
template <class T, class Bell>
T bell_value(Bell bell, T q) {
    if constexpr (is_interval<T>) {
        const Interval range = decreasing(bell, cut(q, 0.0, math::infinity));
        return q.lo <= 1.0 ? widened(range, 0x1p-49) : range;
    } else {
        return bell(q);
    }
}
/// Squared distance relative to `size`, of which only values above `least` count.
template <class T>
T relative(T square, T size, double least) {
    if constexpr (is_interval<T>) {
        const Interval q = square / math::square(cut(size, least, math::infinity));
        return cut(q, 0.0, math::infinity);
    } else {
        return square / math::square(size);
    }
}

}  // namespace skeleton_detail

template <class T>
T blobby(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 5 <= data.size(); i += 5)
        sum += data[i + 4] * math::exp(-(data[i + 3] * skeleton_detail::square_distance(lead, data, i)));
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

/// Points with d <= 0 are left out: what else they hold is not read.
template <class T>
T metaball(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 5 <= data.size(); i += 5) {
        const T b = data[i + 3], d = data[i + 4];
        const T q2 = skeleton_detail::relative(skeleton_detail::square_distance(lead, data, i), d, 0.0);
        const T bell =
            skeleton_detail::bell_value([](auto q) { return skeleton_detail::metaball_bell(q); }, q2);
        sum += math::select(math::less_equal(d, zero<T>()), zero<T>(), b * bell);
    }
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

/// Points with d <= 0 are left out: what else they hold is not read.
template <class T>
T soft(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 4 <= data.size(); i += 4) {
        const T d = data[i + 3];
        const T q2 = skeleton_detail::relative(skeleton_detail::square_distance(lead, data, i), d, 0.0);
        const T bell = skeleton_detail::bell_value([](auto q) { return skeleton_detail::soft_bell(q); }, q2);
        sum += math::select(math::less_equal(d, zero<T>()), zero<T>(), bell);
    }
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

/// Points with sigma <= 1e-6 are left out: what else they hold is not read.
template <class T>
T fitted_blob(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 5 <= data.size(); i += 5) {
        const T f0 = data[i + 3], sigma = data[i + 4];
        const T q2 = skeleton_detail::relative(skeleton_detail::square_distance(lead, data, i), sigma, 1e-6);
        sum += math::select(math::less_equal(sigma, math::constant<T>(1e-6)), zero<T>(), f0 / (1.0 + q2));
    }
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

}  // namespace frep::kernels
