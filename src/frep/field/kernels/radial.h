// Kernel of interpolation by radial functions: a linear polynomial and a sum of w r^3 over centres of space
// and time, the smoothest function through given values where the weights are solved for (Duchon 1977; Turk
// and O'Brien 1999). The weights have both signs and cancel, so that ranges of single terms say nothing:
// intervals use Taylor's formula for the whole sum. Tested by tests/unit/shapes/radial_test.cpp and
// intervals_test.cpp.
#pragma once

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace radial_detail {

constexpr std::size_t axes = 4, item = 5;

template <class T>
T cubic_sum(const T* lead, const Data<T>& data) {
    T sum = data[4];
    for (std::size_t k = 0; k < axes; ++k) sum += data[k] * lead[k];
    for (std::size_t i = item; i + item <= data.size(); i += item) {
        const T r2 = sum_of_squares(lead[0] - data[i], lead[1] - data[i + 1], lead[2] - data[i + 2]) +
                     math::square(lead[3] - data[i + 3]);
        sum += data[i + 4] * (r2 * math::sqrt(r2));
    }
    return sum;
}

/// The box of the leading operands as a middle and half the widths, and its circumscribed radius.
struct Ball {
    double middle[axes], half[axes], radius;

    explicit Ball(const Interval* lead) {
        constexpr double outward = 1.0 + 0x1p-50;
        double square = 0.0;
        for (std::size_t k = 0; k < axes; ++k) {
            middle[k] = centre_of(lead[k]);
            half[k] = math::max(lead[k].hi - middle[k], middle[k] - lead[k].lo) * outward;
            square += half[k] * half[k];
        }
        radius = math::sqrt(square) * outward;
    }
};

/// What one pass over the centres gives about the sum over a ball about c: value, gradient and second
/// derivatives at c, the bounds of the single terms, and the sizes that bound remainder and rounding.
struct Expansion {
    double value = 0, slope[axes] = {}, bend[axes][axes] = {};  ///< bend: the upper triangle
    double low = 0, high = 0;                                   ///< sums of the terms' own bounds
    double weight = 0;                                          ///< sum of |w|
    double size = 0;  ///< sum of the greatest magnitudes of the terms
    std::size_t terms = 0;

    void add(const double* d, double w, double radius) {
        const double r = math::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
        const double far = r + radius, near = r > radius ? r - radius : 0.0;
        const double most = w * (far * far * far), least = w * (near * near * near);
        low += math::min(most, least);
        high += math::max(most, least);
        weight += math::abs(w);
        size += math::abs(most);
        value += w * (r * r * r);
        const double steep = 3.0 * w * r, turn = r > 0.0 ? 3.0 * w / r : 0.0;
        for (std::size_t k = 0; k < axes; ++k) {
            slope[k] += steep * d[k];
            bend[k][k] += steep;
            for (std::size_t l = k; l < axes; ++l) bend[k][l] += turn * d[k] * d[l];
        }
        ++terms;
    }
};

/// The smaller of two enclosures of the sum over the box: that of the terms one by one, and Taylor's formula
/// of second order. The third derivative of r^3 along a line, 9u - 3u^3 with the cosine u of its angle with
/// the radius, lies in -6..6, so that the remainder at the distance s is at most s^3 for each unit of |w|.
inline Interval cubic_range(const Interval* lead, const Data<Interval>& data) {
    constexpr double ordinary = 0x1p100;  // up to it nothing overflows
    if (!data.is_constant() || any_empty(lead[0], lead[1], lead[2], lead[3]) ||
        !within(ordinary, lead[0], lead[1], lead[2], lead[3]))
        return cubic_sum(lead, data);
    const Ball ball(lead);
    Expansion sum;
    for (std::size_t i = item; i + item <= data.size(); i += item) {
        double d[axes];
        for (std::size_t k = 0; k < axes; ++k) d[k] = ball.middle[k] - data.number(i + k);
        sum.add(d, data.number(i + 4), ball.radius);
    }
    double linear = data.number(4), spread = 0;  // of the polynomial
    sum.size += math::abs(linear);
    for (std::size_t k = 0; k < axes; ++k) {
        const double slope = data.number(k);
        linear += slope * ball.middle[k];
        spread += math::abs(slope) * ball.half[k];
        sum.size += math::abs(slope) * (math::abs(ball.middle[k]) + ball.half[k]);
    }
    const double loss = (static_cast<double>(sum.terms) + 64.0) * 0x1p-50 * sum.size + 0x1p-960;
    if (!(loss < math::infinity)) return cubic_sum(lead, data);
    // Taylor: linear terms to both sides; squares to the side of their sign
    double low = -ball.radius * ball.radius * ball.radius * sum.weight, high = -low;
    for (std::size_t k = 0; k < axes; ++k) {
        const double tilt = math::abs(sum.slope[k] + data.number(k)) * ball.half[k];
        const double own = 0.5 * sum.bend[k][k] * (ball.half[k] * ball.half[k]);
        low += math::min(own, 0.0) - tilt;
        high += math::max(own, 0.0) + tilt;
        for (std::size_t l = k + 1; l < axes; ++l) {
            const double mixed = math::abs(sum.bend[k][l]) * (ball.half[k] * ball.half[l]);
            low -= mixed;
            high += mixed;
        }
    }
    const double value = sum.value + linear;
    return padded(math::max(value + low, linear - spread + sum.low), loss,
                  math::min(value + high, linear + spread + sum.high), loss,
                  any_flagged(lead[0], lead[1], lead[2], lead[3]));
}

}  // namespace radial_detail

/// slopes . (x, y, z, t) + constant + sum of w |(x, y, z, t) - centre|^3.
template <class T>
T radial_cubic(const T* lead, Data<T> data) {
    if (data.size() < radial_detail::item) return math::constant<T>(math::quiet_nan);
    if constexpr (is_interval<T>) {
        return radial_detail::cubic_range(lead, data);
    } else {
        return defined_with(radial_detail::cubic_sum(lead, data), lead[0], lead[1], lead[2], lead[3]);
    }
}

}  // namespace frep::kernels
