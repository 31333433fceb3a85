// Kernels of free-form volumes: trivariate Bernstein and clamped cubic B-spline sums (Miura, Pasko and
// Savchenko 1996) and trilinear voxel grids. The sizes of a net are the first three data items. Intervals:
// Bernstein coefficients of the box by blossoming; cell by cell for splines and voxels. Tested by
// tests/unit/shapes/freeform_test.cpp.
#pragma once

#include "frep/field/kernels/freeform_interval.h"
#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace freeform_detail {

/// The Bernstein polynomials of degree count - 1 at u.
template <class T>
void bernstein(T u, std::size_t count, T* basis) {
    const T rest = 1.0 - u;
    basis[0] = one<T>();
    for (std::size_t degree = 1; degree < count; ++degree) {
        basis[degree] = u * basis[degree - 1];
        for (std::size_t i = degree - 1; i > 0; --i) basis[i] = rest * basis[i] + u * basis[i - 1];
        basis[0] = rest * basis[0];
    }
}

/// The four cubic B-splines that are not 0 in the span from knot k (clamped knots 0..spans), at u.
template <class T>
void cubic_basis(T u, T k, T spans, T* basis) {
    const auto knot = [&](double j) { return math::min(math::max(k + j, zero<T>()), spans); };
    basis[0] = one<T>();
    for (int degree = 1; degree <= 3; ++degree) {
        T carried = zero<T>();
        for (int i = 0; i < degree; ++i) {
            const T right = knot(i + 1) - u, left = u - knot(i + 1 - degree);
            const T share = basis[i] / (right + left);
            basis[i] = carried + right * share;
            carried = left * share;
        }
        basis[degree] = carried;
    }
}

/// All `count` cubic B-splines at u, which is clamped to the knots.
template <class T>
void bspline(T u, std::size_t count, T* basis) {
    const double last = static_cast<double>(count) - 4.0;
    const T spans = math::constant<T>(last + 1.0);
    const T at = math::min(math::max(u, zero<T>()), spans);
    const T k = math::min(math::floor(at), math::constant<T>(last));
    T local[4];
    cubic_basis(at, k, spans, local);
    for (std::size_t i = 0; i < count; ++i) {
        basis[i] = zero<T>();
        for (std::size_t j = 0; j < 4 && j <= i; ++j)
            basis[i] = math::select(math::equal(k, math::constant<T>(static_cast<double>(i - j))), local[j],
                                    basis[i]);
    }
}

/// a b, 0 where a is 0 whatever b is.
template <class T>
T weighted(T a, T b) {
    return math::select(math::equal(a, zero<T>()), zero<T>(), a * b);
}
template <class T>
bool all_zero(T a) {
    return math::all(math::equal(a, zero<T>()));
}

/// sum of value[(i m + j) n + k] bases[0][i] bases[1][j] bases[2][k].
template <class T>
T tensor_sum(const Data<T>& data, const Net& net, const T (*basis)[most_controls]) {
    T sum = zero<T>();
    for (std::size_t i = 0; i < net.size[0]; ++i) {
        if (all_zero(basis[0][i])) continue;
        T plane = zero<T>();
        for (std::size_t j = 0; j < net.size[1]; ++j) {
            if (all_zero(basis[1][j])) continue;
            T line = zero<T>();
            for (std::size_t k = 0; k < net.size[2]; ++k)
                if (!all_zero(basis[2][k]))
                    line += weighted(basis[2][k], data[3 + (i * net.size[1] + j) * net.size[2] + k]);
            plane += weighted(basis[1][j], line);
        }
        sum += weighted(basis[0][i], plane);
    }
    return sum;
}

}  // namespace freeform_detail

template <class T>
T bezier_volume(const T* lead, Data<T> data) {
    using namespace freeform_detail;
    const Net net(data);
    if (!net.valid(1)) return math::constant<T>(math::quiet_nan);
    if constexpr (is_interval<T>) {
        return bezier_range(lead, data, net);
    } else {
        T basis[3][most_controls];
        for (int axis = 0; axis < 3; ++axis) bernstein(lead[axis], net.size[axis], basis[axis]);
        return defined_with(tensor_sum(data, net, basis), lead[0], lead[1], lead[2]);
    }
}

/// Beyond the knots the value of the nearest knot goes on.
template <class T>
T bspline_volume(const T* lead, Data<T> data) {
    using namespace freeform_detail;
    const Net net(data);
    if (!net.valid(4)) return math::constant<T>(math::quiet_nan);
    if constexpr (is_interval<T>) {
        return bspline_range(lead, data, net);
    } else {
        T basis[3][most_controls];
        for (int axis = 0; axis < 3; ++axis) bspline(lead[axis], net.size[axis], basis[axis]);
        return defined_with(tensor_sum(data, net, basis), lead[0], lead[1], lead[2]);
    }
}

namespace freeform_detail {

/// Trilinear value at numbers of type double or Dual<double>, from constant data; 0 outside the grid.
template <class S, class T>
S voxel_value(const Data<T>& data, const VoxelGrid& grid, S x, S y, S z) {
    const S at[3] = {x, y, z};
    std::size_t cell[3];
    S low[3], high[3];
    for (const S& a : at)
        if (number_of(a) != number_of(a)) return math::constant<S>(math::quiet_nan);
    for (std::size_t i = 0; i < 3; ++i) {
        const double a = number_of(at[i]), last = static_cast<double>(grid.size[i] - 1);
        if (!(a >= 0.0 && a <= last)) return zero<S>();
        const double corner = math::min(math::floor(a), last - 1.0);
        cell[i] = static_cast<std::size_t>(corner);
        high[i] = at[i] - corner;
        low[i] = 1.0 - high[i];
    }
    const auto value = [&](std::size_t i, std::size_t j, std::size_t k) {
        return data.number(grid.index(cell[0] + i, cell[1] + j, cell[2] + k));
    };
    const auto line = [&](std::size_t j, std::size_t k) {
        return low[0] * value(0, j, k) + high[0] * value(1, j, k);
    };
    const auto plane = [&](std::size_t k) { return low[1] * line(0, k) + high[1] * line(1, k); };
    return low[2] * plane(0) + high[2] * plane(1);
}

/// For data that are no constants: a hat function for every sample.
template <class T>
T voxel_sum(const T* lead, const Data<T>& data, const VoxelGrid& grid) {
    T sum = zero<T>();
    const auto hat = [](T a, std::size_t i) {
        return math::max(1.0 - math::abs(a - static_cast<double>(i)), zero<T>());
    };
    for (std::size_t k = 0; k < grid.size[2]; ++k)
        for (std::size_t j = 0; j < grid.size[1]; ++j)
            for (std::size_t i = 0; i < grid.size[0]; ++i)
                sum += hat(lead[0], i) * hat(lead[1], j) * hat(lead[2], k) * data[grid.index(i, j, k)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T last = math::constant<T>(static_cast<double>(grid.size[axis] - 1));
        const auto outside = math::either(math::less(lead[axis], zero<T>()), math::less(last, lead[axis]));
        sum = math::select(outside, zero<T>(), sum);
    }
    return defined_with(sum, lead[0], lead[1], lead[2]);
}

template <class T>
struct VoxelCall {
    static T value(const T* lead, const Data<T>& data, const VoxelGrid& grid) {
        return lane_by_lane([&](double x, double y, double z) { return voxel_value(data, grid, x, y, z); },
                            lead[0], lead[1], lead[2]);
    }
};
template <class T>
struct VoxelCall<math::Dual<T>> {
    using Number = math::Dual<T>;
    static Number value(const Number* lead, const Data<Number>& data, const VoxelGrid& grid) {
        return dual_by_lane(
            [&](const math::Dual<double>* v) { return voxel_value(data, grid, v[0], v[1], v[2]); },
            std::array<Number, 3>{lead[0], lead[1], lead[2]});
    }
};

}  // namespace freeform_detail

template <class T>
T voxels(const T* lead, Data<T> data) {
    using namespace freeform_detail;
    const VoxelGrid grid(data);
    if (!grid.valid(data.size())) return math::constant<T>(math::quiet_nan);
    if (!data.is_constant()) return voxel_sum(lead, data, grid);
    if constexpr (is_interval<T>) {
        return voxel_range(lead, data, grid);
    } else {
        return VoxelCall<T>::value(lead, data, grid);
    }
}

}  // namespace frep::kernels
