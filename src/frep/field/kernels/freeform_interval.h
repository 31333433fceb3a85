// Ranges of free-form volumes over boxes: Bernstein coefficients by blossoming (their hull bounds the sum),
// B-spline spans and voxel cells one by one when the box meets few of them, else the extremes of the control
// values that count. Used by freeform.h; tested by tests/unit/shapes/freeform_test.cpp.
#pragma once

#include <vector>

#include "frep/field/kernels/support.h"

namespace frep::kernels::freeform_detail {

/// Sums of numbers up to this size do not overflow.
inline constexpr double ordinary = 1e290;
/// Control values an axis at most: 21 of a model and 3 layers around them.
inline constexpr std::size_t most_controls = 27;

/// Sizes of a control net, from the first three data items.
struct Net {
    std::size_t size[3];
    std::size_t count;  ///< values that there are

    template <class T>
    explicit Net(const Data<T>& data) : size{}, count(data.size() < 3 ? 0 : data.size() - 3) {
        for (std::size_t i = 0; i < 3 && count > 0; ++i) {
            const double n = number_of(data[i]);
            size[i] = n >= 1.0 && n <= 1e6 ? static_cast<std::size_t>(n) : 0;
        }
    }
    bool valid(std::size_t least) const {
        for (const std::size_t n : size)
            if (n < least || n > most_controls) return false;
        return size[0] * size[1] * size[2] == count;
    }
};

/// Sizes of a voxel grid.
struct VoxelGrid {
    std::size_t size[3];

    template <class T>
    explicit VoxelGrid(const Data<T>& data) {
        const Net net(data);
        for (std::size_t i = 0; i < 3; ++i) size[i] = net.size[i];
    }
    bool valid(std::size_t items) const {
        return size[0] > 1 && size[1] > 1 && size[2] > 1 && size[0] * size[1] * size[2] + 3 == items;
    }
    std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
        return 3 + (k * size[1] + j) * size[0] + i;
    }
};

/// Replaces `count` values, `stride` apart, by the Bernstein coefficients over u: coefficient j is the
/// blossom at count-1-j times u.lo and j times u.hi.
inline void blossom(Interval* value, std::size_t count, std::size_t stride, Interval u) {
    Interval source[most_controls], work[most_controls];
    for (std::size_t i = 0; i < count; ++i) source[i] = value[i * stride];
    const Interval low(u.lo), high(u.hi), one(1.0);
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = 0; i < count; ++i) work[i] = source[i];
        for (std::size_t level = 1; level < count; ++level) {
            const Interval t = level <= j ? high : low;
            for (std::size_t i = 0; i + level < count; ++i) work[i] = (one - t) * work[i] + t * work[i + 1];
        }
        value[j * stride] = work[0];
    }
}

/// (|u| + |1-u|)^degree, the sum of the magnitudes of the Bernstein polynomials.
inline double bernstein_weight(Interval u, std::size_t count) {
    double weight = 1.0;
    for (std::size_t i = 1; i < count; ++i) weight *= magnitude(u) + magnitude(Interval(1.0) - u);
    return weight;
}

inline Interval bezier_range(const Interval* lead, const Data<Interval>& data, const Net& net) {
    std::vector<Interval> values(net.count);
    double largest = 0.0, weight = 1.0;
    bool undefined = false;
    for (std::size_t i = 0; i < net.count; ++i) {
        values[i] = data[3 + i];
        undefined = undefined || values[i].maybe_undefined || values[i].is_empty();
        largest = math::max(largest, magnitude(values[i]));
    }
    std::size_t degrees = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (lead[axis].is_empty()) return Interval::empty();
        undefined = undefined || lead[axis].maybe_undefined;
        weight *= bernstein_weight(lead[axis], net.size[axis]);
        degrees += net.size[axis];
    }
    const double lost = 0x1p-51 * static_cast<double>(2 * degrees + 8) * largest * weight;
    if (!(largest * weight <= ordinary)) return unknown();  // sums may overflow
    const std::size_t plane = net.size[1] * net.size[2];
    for (std::size_t i = 0; i < plane; ++i) blossom(&values[i], net.size[0], plane, lead[0]);
    for (std::size_t i = 0; i < net.size[0]; ++i)
        for (std::size_t k = 0; k < net.size[2]; ++k)
            blossom(&values[i * plane + k], net.size[1], net.size[2], lead[1]);
    for (std::size_t i = 0; i < net.size[0] * net.size[1]; ++i)
        blossom(&values[i * net.size[2]], net.size[2], 1, lead[2]);
    Interval range = values[0];
    for (const Interval& value : values) range = math::hull(range, value);
    return widened(Interval(range.lo, range.hi, undefined || range.maybe_undefined), lost);
}

/// The cells (knot spans, voxels) 0..last that a coordinate meets.
struct CellRange {
    std::size_t first, last;
};
inline CellRange cells_of(Interval u, double last) {
    const auto cell = [&](double a) {
        return static_cast<std::size_t>(math::min(math::max(math::floor(a), 0.0), last));
    };
    return {cell(u.lo), cell(u.hi)};
}

/// The four clamped cubic B-splines of span k over an interval inside the span.
inline void cubic_ranges(Interval u, double k, double spans, Interval* basis) {
    const auto knot = [&](double j) { return Interval(math::min(math::max(k + j, 0.0), spans)); };
    basis[0] = Interval(1.0);
    for (int degree = 1; degree <= 3; ++degree) {
        Interval carried(0.0);
        for (int i = 0; i < degree; ++i) {
            const Interval to = knot(i + 1), from = knot(i + 1 - degree), share = basis[i] / (to - from);
            basis[i] = carried + cut(to - u, 0.0, math::infinity) * share;
            carried = cut(u - from, 0.0, math::infinity) * share;
        }
        basis[degree] = carried;
    }
}

/// Range over one span: centre plus weighted deviations, as the weights add to 1.
inline Interval span_range(const Data<Interval>& data, const Net& net, const Interval (*basis)[4],
                           const std::size_t* span) {
    const auto value = [&](std::size_t i, std::size_t j, std::size_t k) {
        return data[3 + ((span[0] + i) * net.size[1] + span[1] + j) * net.size[2] + span[2] + k];
    };
    Interval extremes = value(0, 0, 0);
    for (std::size_t c = 0; c < 64; ++c) extremes = math::hull(extremes, value(c >> 4, (c >> 2) & 3, c & 3));
    const Interval centre(0.5 * extremes.lo + 0.5 * extremes.hi);
    Interval sum(0.0);
    for (std::size_t c = 0; c < 64; ++c) {
        const std::size_t i = c >> 4, j = (c >> 2) & 3, k = c & 3;
        sum += basis[0][i] * basis[1][j] * basis[2][k] * (value(i, j, k) - centre);
    }
    return cut(sum + centre, extremes.lo, extremes.hi);
}

inline Interval bspline_range(const Interval* lead, const Data<Interval>& data, const Net& net) {
    CellRange cells[3];
    Interval at[3];
    bool undefined = false;
    double largest = 0.0;
    std::size_t met = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (lead[axis].is_empty()) return Interval::empty();
        undefined = undefined || lead[axis].maybe_undefined;
        const double last = static_cast<double>(net.size[axis]) - 4.0;
        at[axis] = math::min(math::max(lead[axis], Interval(0.0)), Interval(last + 1.0));
        cells[axis] = cells_of(at[axis], last);
        met *= cells[axis].last - cells[axis].first + 1;
    }
    Interval range = Interval::empty();
    const auto join = [&](Interval value) { range = range.is_empty() ? value : math::hull(range, value); };
    for (std::size_t i = 0; i < net.count; ++i) largest = math::max(largest, magnitude(data[3 + i]));
    if (!(largest <= ordinary)) return unknown();
    const double lost = 0x1p-45 * largest;
    if (met > 8) {  // the convex hull of the control values that count
        for (std::size_t i = cells[0].first; i <= cells[0].last + 3; ++i)
            for (std::size_t j = cells[1].first; j <= cells[1].last + 3; ++j)
                for (std::size_t k = cells[2].first; k <= cells[2].last + 3; ++k)
                    join(data[3 + (i * net.size[1] + j) * net.size[2] + k]);
        return widened(range.flagged(undefined), lost);
    }
    std::size_t span[3];
    for (span[0] = cells[0].first; span[0] <= cells[0].last; ++span[0])
        for (span[1] = cells[1].first; span[1] <= cells[1].last; ++span[1])
            for (span[2] = cells[2].first; span[2] <= cells[2].last; ++span[2]) {
                Interval basis[3][4];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double k = static_cast<double>(span[axis]);
                    cubic_ranges(cut(at[axis], k, k + 1.0), k, static_cast<double>(net.size[axis]) - 3.0,
                                 basis[axis]);
                }
                join(span_range(data, net, basis, span));
            }
    return widened(range.flagged(undefined), lost);
}

/// Trilinear range over one cell at offsets in 0..1.
inline Interval voxel_cell(const Data<Interval>& data, const VoxelGrid& grid, const std::size_t* cell,
                           const Interval* offset) {
    const auto mix = [](Interval a, Interval b, Interval t) {
        const Interval range = a + t * (b - a), ends = math::hull(a, b);
        return cut(range, ends.lo, ends.hi);
    };
    Interval plane[2];
    for (std::size_t k = 0; k < 2; ++k) {
        Interval line[2];
        for (std::size_t j = 0; j < 2; ++j) {
            const Interval a(data.number(grid.index(cell[0], cell[1] + j, cell[2] + k)));
            const Interval b(data.number(grid.index(cell[0] + 1, cell[1] + j, cell[2] + k)));
            line[j] = mix(a, b, offset[0]);
        }
        plane[k] = mix(line[0], line[1], offset[1]);
    }
    return mix(plane[0], plane[1], offset[2]);
}

/// Hull of ranges.
struct VoxelHull {
    double low = math::infinity, high = -math::infinity;
    void add(Interval range) {
        low = math::min(low, range.lo);
        high = math::max(high, range.hi);
    }
};

/// The values of the samples of the cells; unknown (false) when one of them is not finite.
inline bool voxel_samples(const Data<Interval>& data, const VoxelGrid& grid, const CellRange* cells,
                          VoxelHull& hull) {
    for (std::size_t k = cells[2].first; k <= cells[2].last + 1; ++k)
        for (std::size_t j = cells[1].first; j <= cells[1].last + 1; ++j)
            for (std::size_t i = cells[0].first; i <= cells[0].last + 1; ++i) {
                const double value = data.number(grid.index(i, j, k));
                if (!(math::abs(value) <= ordinary)) return false;
                hull.add(value);
            }
    return true;
}

/// Trilinear ranges of the cells, one by one.
inline void voxel_cells(const Data<Interval>& data, const VoxelGrid& grid, const CellRange* cells,
                        const Interval* at, VoxelHull& hull) {
    for (std::size_t k = cells[2].first; k <= cells[2].last; ++k)
        for (std::size_t j = cells[1].first; j <= cells[1].last; ++j)
            for (std::size_t i = cells[0].first; i <= cells[0].last; ++i) {
                const std::size_t cell[3] = {i, j, k};
                Interval offset[3];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const Interval corner(static_cast<double>(cell[axis]));
                    offset[axis] = cut(cut(at[axis], corner.lo, corner.lo + 1.0) - corner, 0.0, 1.0);
                }
                hull.add(voxel_cell(data, grid, cell, offset));
            }
}

inline Interval voxel_range(const Interval* lead, const Data<Interval>& data, const VoxelGrid& grid) {
    if (any_empty(lead[0], lead[1], lead[2])) return Interval::empty();
    const bool undefined = any_flagged(lead[0], lead[1], lead[2]);
    CellRange cells[3];
    Interval at[3];
    bool leaves = false;
    std::size_t met = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double last = static_cast<double>(grid.size[axis]) - 1.0;
        if (lead[axis].lo > last || lead[axis].hi < 0.0) return Interval(0.0).flagged(undefined);
        leaves = leaves || lead[axis].lo < 0.0 || lead[axis].hi > last;
        at[axis] = cut(lead[axis], 0.0, last);
        cells[axis] = cells_of(at[axis], last - 1.0);
        met *= cells[axis].last - cells[axis].first + 1;
    }
    VoxelHull samples, hull;
    if (!voxel_samples(data, grid, cells, samples)) return unknown();
    if (met <= 8) voxel_cells(data, grid, cells, at, hull);
    if (met > 8) hull = samples;
    if (leaves) hull.add(0.0);
    const double lost = 0x1p-48 * math::max(math::abs(samples.low), math::abs(samples.high));
    return widened(Interval(hull.low, hull.high, undefined), lost);
}

}  // namespace frep::kernels::freeform_detail
