// Signed distance to an ellipsoid, positive inside, exact to rounding. Method: the nearest point
// (r_i y_i/(s + r_i)) of the surface by its secular equation (Eberly, Distance from a point to an ellipse, an
// ellipsoid, or a hyperellipsoid, 2013), in the variable s + 1, so that points near the planes of symmetry
// lose nothing; Newton on 1/|q| - 1 with a bracket, at most 200 steps. The derivative is the surface normal.
// Tested by tests/unit/shapes/distance_test.cpp.
#pragma once

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace ellipsoid_detail {

/// A point of the closed first octant relative to the ellipsoid, and what is nearest to it.
struct Nearest {
    double distance;   ///< positive inside
    double point[3];   ///< on the surface
    double normal[3];  ///< outward, of length 1
};

struct Secular {
    double offset[3];  ///< r_i - 1 >= 0
    double top[3];     ///< r_i z_i

    /// |q|^2 and sum q_i^2/(sigma + offset_i) for q_i = top_i/(sigma + offset_i).
    void at(double sigma, double& square, double& slope) const {
        square = slope = 0.0;
        for (int i = 0; i < 3; ++i) {
            if (top[i] == 0.0) continue;
            const double below = sigma + offset[i], q = top[i] / below;
            square += q * q;
            slope += q * q / below;
        }
    }
};

/// The sigma > 0 with |q| = 1, which exists between low and high.
inline double secular_root(const Secular& f, double low, double high) {
    double sigma = low;
    for (int step = 0; step < 200; ++step) {
        double square, slope;
        f.at(sigma, square, slope);
        if (square == 1.0) break;
        (square > 1.0 ? low : high) = sigma;
        const double length = math::sqrt(square);
        double next = sigma + (length - 1.0) * square / slope;
        if (next == sigma && sigma < 0x1p-60) break;  // 200 halvings would not come back to such a small one
        if (!(next > low && next < high)) next = low + 0.5 * (high - low);
        if (!(next > low && next < high) || next == sigma) break;
        const double moved = next > sigma ? next - sigma : sigma - next;
        sigma = next;
        if (moved <= 0x1p-54 * sigma) break;
    }
    return sigma;
}

/// y >= 0 and e > 0 in any order of axes.
inline Nearest nearest_in_octant(const double* y, const double* e) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (e[i] < e[least]) least = i;
    const double unit = e[least];
    Secular f;
    double low = 0.0, sum = 0.0, at_pole = 0.0;
    bool pole = true;
    for (int i = 0; i < 3; ++i) {
        const double ratio = e[i] / unit;
        f.offset[i] = (e[i] - unit) / unit * (ratio + 1.0);
        const double top = ratio * ratio * (y[i] / e[i]);
        f.top[i] = top > 0x1p-900 ? top : 0.0;  // denormals have too few places for the quotients below
        const double reach = f.top[i] - f.offset[i];
        if (reach > low) low = reach;
        sum += f.top[i] * f.top[i];
        if (f.top[i] == 0.0) continue;
        if (f.offset[i] == 0.0)
            pole = false;
        else
            at_pole += (f.top[i] / f.offset[i]) * (f.top[i] / f.offset[i]);
    }
    pole = pole && at_pole < 1.0;  // on a plane of symmetry, near the centre: the nearest point is above it
    const double sigma = pole ? 0.0 : secular_root(f, low, math::sqrt(sum));
    const double s = sigma - 1.0;
    Nearest out;
    double off = 0.0, length = 0.0;
    for (int i = 0; i < 3; ++i) {
        double gap;
        if (pole && i == least) {
            out.point[i] = unit * math::sqrt(1.0 - at_pole);
            gap = out.point[i];
        } else if (f.top[i] == 0.0) {
            out.point[i] = gap = 0.0;
        } else {
            const double below = sigma + f.offset[i];
            out.point[i] = e[i] * (f.top[i] / below);
            gap = s * (y[i] / below);
        }
        off += gap * gap;
        out.normal[i] = out.point[i] / e[i] / e[i];
        length += out.normal[i] * out.normal[i];
    }
    const double distance = math::sqrt(off);
    out.distance = s < 0.0 ? distance : -distance;
    const double scale = length > 0.0 ? 1.0 / math::sqrt(length) : 0.0;
    for (double& n : out.normal) n *= scale;
    return out;
}

/// A point so far away that the ellipsoid is a point to it.
inline Nearest nearest_to_far(const double* p) {
    const double length = math::hypot(math::hypot(p[0], p[1]), p[2]);
    Nearest out = {-length, {0, 0, 0}, {0, 0, 0}};
    if (length < math::infinity)
        for (int i = 0; i < 3; ++i) out.normal[i] = p[i] / length;
    return out;
}

inline Nearest nearest(double x, double y, double z, double a, double b, double c) {
    const double p[3] = {math::abs(x), math::abs(y), math::abs(z)};
    const double e[3] = {math::abs(a), math::abs(b), math::abs(c)};
    bool undefined = false;
    for (int i = 0; i < 3; ++i)
        undefined = undefined || p[i] != p[i] || !(e[i] > 0.0 && e[i] < math::infinity);
    if (undefined) return {math::quiet_nan, {0, 0, 0}, {0, 0, 0}};
    const double largest = math::max(math::max(p[0], p[1]), p[2]);
    const double axis = math::max(math::max(e[0], e[1]), e[2]);
    return largest > 0x1p60 * axis ? nearest_to_far(p) : nearest_in_octant(p, e);
}

}  // namespace ellipsoid_detail

/// Undefined where a semi-axis is 0.
template <class T>
T ellipsoid_distance(T x, T y, T z, T a, T b, T c) {
    return lane_by_lane([](double px, double py, double pz, double pa, double pb,
                           double pc) { return ellipsoid_detail::nearest(px, py, pz, pa, pb, pc).distance; },
                        x, y, z, a, b, c);
}

/// The value is concave and even in the point, so it falls with |x|, |y|, |z|; it grows with the semi-axes.
/// Unknown for semi-axes so different, large or small that the iteration may leave the doubles.
inline Interval ellipsoid_distance(Interval x, Interval y, Interval z, Interval a, Interval b, Interval c) {
    if (any_empty(x, y, z, a, b, c)) return Interval::empty();
    const Interval p[3] = {math::abs(x), math::abs(y), math::abs(z)};
    const Interval e[3] = {math::abs(a), math::abs(b), math::abs(c)};
    double near = 0.0, far = 0.0, size = 0.0, least = math::infinity;
    for (int i = 0; i < 3; ++i) {
        near += p[i].lo;
        far += p[i].hi;
        size += e[i].hi;
        least = math::min(least, e[i].lo);
    }
    if (!(least >= 0x1p-300 && size <= 0x1p300 && size <= 0x1p40 * least)) return unknown();
    const auto at = [](double px, double py, double pz, double pa, double pb, double pc) {
        return ellipsoid_detail::nearest(px, py, pz, pa, pb, pc).distance;
    };
    const double low = at(p[0].hi, p[1].hi, p[2].hi, e[0].lo, e[1].lo, e[2].lo);
    const double high = at(p[0].lo, p[1].lo, p[2].lo, e[0].hi, e[1].hi, e[2].hi);
    return padded(low, 0x1p-47 * (far + size), high, 0x1p-46 * (near + size), any_flagged(x, y, z, a, b, c));
}

namespace ellipsoid_detail {

/// Partials of a dual: minus the outward normal for the point, n_i q_i/e_i for the semi-axes (envelope
/// theorem).
inline math::Dual<double> dual_distance(const math::Dual<double>* v) {
    const Nearest q = nearest(v[0].value, v[1].value, v[2].value, v[3].value, v[4].value, v[5].value);
    math::Dual<double> out(q.distance, {0.0, 0.0, 0.0});
    for (int i = 0; i < 3; ++i) {
        const double by_point = v[i].value < 0.0 ? q.normal[i] : -q.normal[i];
        const double axis = v[i + 3].value, by_axis = math::finite(q.normal[i] * q.point[i] / axis);
        for (std::size_t k = 0; k < 3; ++k)
            out.d[k] = math::finite(out.d[k] + by_point * v[i].d[k] + by_axis * v[i + 3].d[k]);
    }
    return out;
}

}  // namespace ellipsoid_detail

template <class T>
math::Dual<T> ellipsoid_distance(math::Dual<T> x, math::Dual<T> y, math::Dual<T> z, math::Dual<T> a,
                                 math::Dual<T> b, math::Dual<T> c) {
    return dual_by_lane([](const math::Dual<double>* v) { return ellipsoid_detail::dual_distance(v); },
                        std::array<math::Dual<T>, 6>{x, y, z, a, b, c});
}

}  // namespace frep::kernels
