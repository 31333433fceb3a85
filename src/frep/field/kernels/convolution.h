// Kernels of convolution surfaces with the Cauchy kernel 1/(1 + S^2 r^2)^2 (McCormack and Sherstyuk 1998):
// closed forms for points, segments, triangles (by Green's theorem over the edges) and arcs of any angle.
// The geometry of elements that are constants is prepared in double. Elements of length or area 0 count 0.
// Intervals use that each element's integral lies between its size times the kernel at the largest and at the
// smallest distance. Tested by tests/unit/shapes/convolution_test.cpp.
#pragma once

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace convolution_detail {

template <class S>
struct Triple {
    S x, y, z;
    friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};
template <class S>
S dot(Triple<S> a, Triple<S> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
Triple<S> cross(Triple<S> a, Triple<S> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class S>
S length_of(Triple<S> a) {
    return math::sqrt(sum_of_squares(a.x, a.y, a.z));
}
/// a/length; 0 where the length is 0.
template <class S>
Triple<S> unit(Triple<S> a, S length) {
    const auto nought = math::equal(length, zero<S>());
    const S scale = math::select(nought, zero<S>(), 1.0 / length);
    return {a.x * scale, a.y * scale, a.z * scale};
}
template <class T, class S>
Triple<T> lift3(Triple<S> a) {
    return {lift<T>(a.x), lift<T>(a.y), lift<T>(a.z)};
}
template <class S, class T>
S item(const Data<T>& data, std::size_t i) {
    if constexpr (std::is_same_v<S, T>) {
        return data[i];
    } else {
        return data.number(i);
    }
}
template <class S, class T>
Triple<S> triple(const Data<T>& data, std::size_t i) {
    return {item<S>(data, i), item<S>(data, i + 1), item<S>(data, i + 2)};
}

/// 1/(1 + S^2 r^2)^2 of the squared distance.
template <class T>
T cauchy(T s2, T r2) {
    return 1.0 / math::square(1.0 + s2 * r2);
}

// Segments.

template <class S>
struct Segment {
    Triple<S> begin, along;  ///< `along` of length 1
    S length;
};
template <class S, class T>
Segment<S> segment_of(const Data<T>& data, std::size_t i) {
    const Triple<S> begin = triple<S>(data, i), span = triple<S>(data, i + 3) - begin;
    const S length = length_of(span);
    return {begin, unit(span, length), length};
}
template <class T, class S>
Segment<T> lift_segment(const Segment<S>& a) {
    return {lift3<T>(a.begin), lift3<T>(a.along), lift<T>(a.length)};
}

/// The integral along a line of the given length for a point at coordinate x along it and squared distance
/// rho2 from it.
template <class T>
T line_integral(T x, T rho2, T length, T s) {
    const T s2 = math::square(s), rest = length - x;
    const T p2 = 1.0 + s2 * rho2, p = math::sqrt(p2);
    const T ends = x / (p2 + s2 * math::square(x)) + rest / (p2 + s2 * math::square(rest));
    const T angles = math::atan(s * x / p) + math::atan(s * rest / p);
    const T value = (ends + angles / (s * p)) / (2.0 * p2);
    return math::select(math::equal(s, zero<T>()), length, value);
}

/// What the closed form may lose by rounding: it is a sum of terms below 1/(S p) and below the lengths, with
/// p^2 = 1 + S^2 rho^2.
inline double segment_loss(Interval x, Interval rho2, Interval length, Interval s) {
    const double slope = least_magnitude(s), p2 = 1.0 + slope * slope * rho2.lo;
    const double angles = 4.2 / (slope * math::sqrt(p2)), lengths = 4.0 * (magnitude(x) + length.hi);
    return 0x1p-48 * math::min(angles, lengths) / p2;
}

/// The integral decreases with the distance from the line, and from the segment's middle plane.
inline Interval segment_range(Interval x, Interval rho2, Interval length, Interval s) {
    constexpr double ordinary = 0x1p60;  // up to it nothing overflows
    if (!within(ordinary, x, rho2, length, s) || !(least_magnitude(s) > 1.0 / ordinary))
        return line_integral(x, rho2, length, s);
    const Interval half = length * Interval(0.5), off = math::abs(x - half);
    const Interval low = line_integral(half + Interval(off.hi), Interval(rho2.hi), length, s);
    const Interval high = line_integral(half + Interval(off.lo), Interval(rho2.lo), length, s);
    const double loss = segment_loss(x, rho2, length, s);
    return padded(low.lo, loss, high.hi, loss, any_flagged(x, rho2, length, s));
}

template <class T>
T segment_term(const T* lead, const Segment<T>& a, T s) {
    const Triple<T> d = Triple<T>{lead[0], lead[1], lead[2]} - a.begin;
    const Triple<T> beside = cross(d, a.along);
    const T x = dot(d, a.along), rho2 = sum_of_squares(beside.x, beside.y, beside.z);
    if constexpr (is_interval<T>) {
        return segment_range(x, rho2, a.length, s);
    } else {
        return line_integral(x, rho2, a.length, s);
    }
}

template <class T>
Segment<T> segment_at(const Data<T>& data, std::size_t i) {
    if (data.is_constant()) return lift_segment<T>(segment_of<double>(data, i));
    return segment_of<T>(data, i);
}

// Triangles.

template <class S>
struct Triangle {
    Triple<S> corner[3], edge[3], inward[3], normal;  ///< unit vectors; `inward` in the plane, across an edge
    S length[3], area;
};
template <class S, class T>
Triangle<S> triangle_of(const Data<T>& data, std::size_t i) {
    Triangle<S> t;
    for (std::size_t k = 0; k < 3; ++k) t.corner[k] = triple<S>(data, i + 3 * k);
    const Triple<S> n = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
    const S twice = length_of(n);
    t.area = twice * 0.5;
    t.normal = unit(n, twice);
    for (std::size_t k = 0; k < 3; ++k) {
        const Triple<S> span = t.corner[(k + 1) % 3] - t.corner[k];
        t.length[k] = length_of(span);
        t.edge[k] = unit(span, t.length[k]);
        t.inward[k] = cross(t.normal, t.edge[k]);
    }
    return t;
}
template <class T, class S>
Triangle<T> lift_triangle(const Triangle<S>& a) {
    Triangle<T> t;
    for (std::size_t k = 0; k < 3; ++k) {
        t.corner[k] = lift3<T>(a.corner[k]);
        t.edge[k] = lift3<T>(a.edge[k]);
        t.inward[k] = lift3<T>(a.inward[k]);
        t.length[k] = lift<T>(a.length[k]);
    }
    t.normal = lift3<T>(a.normal);
    t.area = lift<T>(a.area);
    return t;
}

/// 1/(2 K S) sum over the edges of (h/B)(atan(S t1/B) - atan(S t0/B)), K = 1 + S^2 z^2, B^2 = K + S^2 h^2,
/// z the height over the plane, h the distance inward of an edge, t0, t1 the ends along it.
template <class T>
T triangle_integral(const T* lead, const Triangle<T>& a, T s) {
    const Triple<T> p = {lead[0], lead[1], lead[2]};
    const T s2 = math::square(s);
    const T k = 1.0 + s2 * math::square(dot(p - a.corner[0], a.normal));
    T sum = zero<T>();
    for (std::size_t i = 0; i < 3; ++i) {
        const Triple<T> d = p - a.corner[i];
        const T h = dot(d, a.inward[i]), t = dot(d, a.edge[i]);
        const T b = math::sqrt(k + s2 * math::square(h)), scale = s / b;
        sum += h / b * (math::atan((a.length[i] - t) * scale) + math::atan(t * scale));
    }
    return math::select(math::equal(s, zero<T>()), a.area, sum / (2.0 * (k * s)));
}

/// Range of one coordinate of a triangle's corners.
inline Interval corner_span(const Triangle<Interval>& a, int axis) {
    const auto coordinate = [&](std::size_t k) {
        return axis == 0 ? a.corner[k].x : axis == 1 ? a.corner[k].y : a.corner[k].z;
    };
    return math::hull(math::hull(coordinate(0), coordinate(1)), coordinate(2));
}

/// Bounds of the squared distance between a box of points and a triangle.
inline Interval square_distance_range(const Interval* lead, const Triangle<Interval>& a) {
    double low = 0.0, high = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        low = math::next_down(low + math::square(lead[axis] - corner_span(a, axis)).lo);
    for (const Triple<Interval>& c : a.corner) {
        const double r2 = sum_of_squares(lead[0] - c.x, lead[1] - c.y, lead[2] - c.z).hi;
        high = r2 > high ? r2 : high;
    }
    return {low > 0.0 ? low : 0.0, high};
}

/// What the closed form may lose by rounding, that of the unit vectors of a thin triangle included: it is a
/// sum of terms below 1/S^2, and the heights over the plane have errors relative to the distance.
inline double triangle_loss(const Triangle<Interval>& a, Interval s, double square_distance) {
    double longest = 0.0;
    for (const Interval& length : a.length) longest = math::max(longest, length.hi);
    const double slope = least_magnitude(s), far = magnitude(s) * math::sqrt(square_distance);
    return 2e-14 / (slope * slope) * (1.0 + longest * longest / a.area.lo) * (1.0 + far);
}

/// The closed form cut to area times the kernel, and by the mean value form with the slope
/// -4 S^2 area (p - q)/(1 + S^2 r^2)^3, q in the triangle.
inline Interval triangle_range(const Interval* lead, const Triangle<Interval>& a, Interval s) {
    const Interval whole = triangle_integral(lead, a, s);
    constexpr double ordinary = 0x1p60;
    const Interval square_distance = square_distance_range(lead, a);
    const double lost = triangle_loss(a, s, square_distance.hi);
    if (!within(ordinary, lead[0], lead[1], lead[2], s) || !(lost < ordinary)) return whole;
    const Interval s2 = math::square(s), kernel = Interval(1.0) + s2 * square_distance;
    const Interval range = a.area / math::square(kernel);
    const Interval value = cut(whole, range.lo - lost, range.hi + lost);
    double centre[3];
    Interval middle[3];
    for (int i = 0; i < 3; ++i) middle[i] = centre[i] = centre_of(lead[i]);
    const Interval steep = Interval(-4.0) * s2 * a.area / (kernel * math::square(kernel));
    const Interval there = widened(triangle_integral(middle, a, s), 2.0 * lost);
    return by_mean_value(value, there, lead, centre,
                         [&](int i) { return steep * (lead[i] - corner_span(a, i)); });
}

template <class T>
T triangle_term(const T* lead, const Triangle<T>& a, T s) {
    if constexpr (is_interval<T>) {
        return triangle_range(lead, a, s);
    } else {
        return triangle_integral(lead, a, s);
    }
}

template <class T>
Triangle<T> triangle_at(const Data<T>& data, std::size_t i) {
    if (data.is_constant()) return lift_triangle<T>(triangle_of<double>(data, i));
    return triangle_of<T>(data, i);
}

// Arcs.

/// An angle that rounding may have put beyond pi, where the tangent of its half changes the sign.
template <class T>
T within_half_turn(T angle) {
    if constexpr (is_dual<T>) {
        return T(within_half_turn(angle.value), angle.d);
    } else {
        const T limit = math::constant<T>(math::pi);
        return math::min(math::max(angle, -limit), limit);
    }
}

/// Integral of dt/(k - m cos t)^2 from 0 to t, k > m >= 0, as a function of t + any turn.
template <class T>
T arc_primitive(T t, T k, T m, T w2) {
    constexpr double inverse_turn = 0.15915494309189533577;
    const T n = math::floor(t * inverse_turn + 0.5);
    const T rest = within_half_turn(t - n * (2.0 * math::pi));
    const T w = math::sqrt(w2);
    const T angle = math::atan(w / (k - m) * math::tan(0.5 * rest)) + n * math::pi;
    return m * math::sin(t) / (w2 * (k - m * math::cos(t))) + 2.0 * k / (w2 * w) * angle;
}

/// Smallest and largest 1 + S^2 distance^2 to the full circle.
template <class T>
struct ArcReach {
    T near, far;
    ArcReach(T rho, T z, T r, T s)
        : near(1.0 + math::square(s) * (math::square(r - rho) + math::square(z))),
          far(1.0 + math::square(s) * (math::square(r + rho) + math::square(z))) {}
};

/// Arc of radius r about the origin of the local plane, from the x axis by theta.
template <class T>
T arc_integral(T x, T y, T z, T r, T theta, T s) {
    const T rho = math::hypot(x, y), phi = math::atan2(y, x), s2 = math::square(s);
    const ArcReach<T> reach(rho, z, r, s);
    const T k = 1.0 + s2 * (math::square(r) + math::square(rho) + math::square(z)), m = 2.0 * s2 * r * rho;
    const T w2 = reach.near * reach.far;
    return arc_primitive(theta - phi, k, m, w2) - arc_primitive(-phi, k, m, w2);
}

/// What the closed form may lose by rounding: its terms are below k/w^3 times an angle, with relative errors
/// of k/(k - m) places. Infinite where rounding may reach the pole k = m.
inline double arc_loss(Interval near, Interval far, Interval k, Interval theta) {
    const double least = near.lo < far.lo ? near.lo : far.lo, w2 = near.lo * far.lo;
    const double places = k.hi / least;
    if (!(places < 0x1p40 && w2 >= 1.0)) return math::infinity;
    return 0x1p-46 * (magnitude(theta) + 8.0) * (1.0 + places) * (k.hi / (w2 * math::sqrt(w2)));
}

/// The closed form cut to theta times the kernel, and by the mean value form with the slope
/// -4 S^2 theta (p - q)/(1 + S^2 distance^2)^3, q on the arc. The closed form over a box about the axis or
/// the arc divides by ranges that hold 0; for operands of ordinary size its value is defined all the same.
inline Interval arc_range(const Interval* p, Interval r, Interval theta, Interval s) {
    const Interval whole = arc_integral(p[0], p[1], p[2], r, theta, s);
    constexpr double ordinary = 0x1p60;
    if (!within(ordinary, p[0], p[1], p[2], r, s) || !within(0x1p20, theta)) return whole;
    const ArcReach<Interval> reach(math::hypot(p[0], p[1]), p[2], r, s);
    const Interval s2 = math::square(s), sweep = math::hull(Interval(0.0), theta);
    const Interval k = Interval(1.0) + s2 * (math::square(r) + sum_of_squares(p[0], p[1], p[2]));
    const double lost = arc_loss(reach.near, reach.far, k, theta);
    if (!(lost < math::infinity)) return whole;
    const Interval from_arc[3] = {p[0] - r * math::cos(sweep), p[1] - r * math::sin(sweep), p[2]};
    // a negative radius has its nearest point where a positive one has its farthest
    const Interval reached = math::hull(reach.near, reach.far);
    const Interval kernel = cut(Interval(1.0) + s2 * sum_of_squares(from_arc[0], from_arc[1], from_arc[2]),
                                reached.lo, reached.hi);
    const Interval range = theta / math::square(kernel);
    const bool undefined = any_flagged(p[0], p[1], p[2], r, theta, s);
    double centre[3];
    Interval middle[3];
    for (int i = 0; i < 3; ++i) middle[i] = centre[i] = centre_of(p[i]);
    Interval value = {-math::infinity, math::infinity};
    if (!whole.is_empty()) value = {whole.lo, whole.hi};
    value = cut(value, range.lo - lost, range.hi + lost);
    const Interval at_centre = arc_integral(middle[0], middle[1], middle[2], r, theta, s);
    const Interval steep = Interval(-4.0) * s2 * theta / (kernel * math::square(kernel));
    const Interval there = widened(Interval(at_centre.lo, at_centre.hi), 2.0 * lost);
    return by_mean_value(value, there, p, centre, [&](int i) { return steep * from_arc[i]; })
        .flagged(undefined);
}

/// The angle about the axis has no derivative on the axis: derivatives there are taken a millionth of the
/// radius beside it, where they differ by about as much.
template <class T>
math::Dual<T> arc_integral(math::Dual<T> x, math::Dual<T> y, math::Dual<T> z, math::Dual<T> r,
                           math::Dual<T> theta, math::Dual<T> s) {
    const T value = arc_integral(x.value, y.value, z.value, r.value, theta.value, s.value);
    const T beside = 1e-6 * math::abs(r.value);
    const auto on_axis = math::less(math::hypot(x.value, y.value), beside);
    x.value = math::select(on_axis, beside, x.value);
    math::Dual<T> result = arc_integral<math::Dual<T>>(x, y, z, r, theta, s);
    result.value = value;
    return result;
}

}  // namespace convolution_detail

template <class T>
T conv_point(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 4 <= data.size(); i += 4)
        sum += convolution_detail::cauchy(
            math::square(data[i + 3]),
            sum_of_squares(lead[0] - data[i], lead[1] - data[i + 1], lead[2] - data[i + 2]));
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

template <class T>
T conv_line(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 7 <= data.size(); i += 7)
        sum += convolution_detail::segment_term(lead, convolution_detail::segment_at(data, i), data[i + 6]);
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

template <class T>
T conv_line_clamped(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 6 <= data.size(); i += 6)
        sum = math::min(
            sum + convolution_detail::segment_term(lead, convolution_detail::segment_at(data, i), lead[3]),
            one<T>());
    return defined_with(sum, lead[0], lead[1], lead[2], lead[3]);
}

template <class T>
T conv_triangle(const T* lead, Data<T> data) {
    T sum = zero<T>();
    for (std::size_t i = 0; i + 11 <= data.size(); i += 11)
        sum += data[i + 10] *
               convolution_detail::triangle_term(lead, convolution_detail::triangle_at(data, i), data[i + 9]);
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

template <class T>
T conv_arc(const T* lead, Data<T> data) {
    using namespace convolution_detail;
    T sum = zero<T>();
    for (std::size_t i = 0; i + 13 <= data.size(); i += 13) {
        const Triple<T> d = Triple<T>{lead[0], lead[1], lead[2]} - triple<T>(data, i);
        const Triple<T> u = triple<T>(data, i + 3), v = triple<T>(data, i + 6);
        const T p[3] = {dot(d, u), dot(d, v), dot(d, cross(u, v))};
        if constexpr (is_interval<T>) {
            sum += data[i + 12] * arc_range(p, data[i + 9], data[i + 10], data[i + 11]);
        } else {
            const T integral = arc_integral(p[0], p[1], p[2], data[i + 9], data[i + 10], data[i + 11]);
            sum += data[i + 12] * integral;
        }
    }
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

}  // namespace frep::kernels
