// Implementation of cell_sums.h.
#include "frep/measure/cell_sums.h"

#include <algorithm>

#include "frep/measure/pairs.h"

namespace frep::measuring {

namespace {

using math::Interval;

/// The number of the pair of axes i, j.
std::size_t pair_of(std::size_t i, std::size_t j) {
    if (i > j) std::swap(i, j);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (pairs[k][0] == i && pairs[k][1] == j) return k;
    return 0;
}

Interval around(double value) { return {value - clip_error, value + clip_error}; }
/// An upper bound of a quantity that is >= 0, as a range.
Interval up_to(double value) { return {0.0, value}; }
Interval within(double value) { return {-value, value}; }

/// The part of a that lies in b, which surely holds the value too.
Interval cut(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

}  // namespace

CellPart cell_part(const Cell& cell, const CellBounds& bounds, int dimension) {
    CellPart part{cell, {}, 1};
    if (!bounds.has_planes) return part;
    const std::size_t points = dimension == 2 ? 9 : 27;
    part.sure = positive_part_of_lattice(dimension, {bounds.lower.data(), points});
    std::array<double, 27> below{};
    for (std::size_t p = 0; p < points; ++p) below[p] = -bounds.upper[p];
    const double outside = positive_share_of_lattice(dimension, {below.data(), points});
    part.rest = std::clamp(1 - outside - part.sure.share + 4 * clip_error, 0.0, 1.0);
    return part;
}

Interval cell_size(const Cell& cell, const std::vector<std::size_t>& axes) {
    Interval size = 1;
    for (const std::size_t axis : axes) size *= Interval(cell.high[axis]) - Interval(cell.low[axis]);
    return size;
}

void MomentSums::add(const CellPart& part, const std::vector<std::size_t>& axes) {
    const Interval whole = cell_size(part.cell, axes);
    const Interval share = cut(around(part.sure.share) + up_to(part.rest), {0.0, 1.0});
    size += whole * share;
    // coordinates of the cell: x = middle + half u, u in -1..1
    std::array<Interval, 3> middle, half, u;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const Interval low = part.cell.low[axes[k]], high = part.cell.high[axes[k]];
        middle[k] = (low + high) * Interval(0.5) - Interval(origin[axes[k]]);
        half[k] = (high - low) * Interval(0.5);
        u[k] = around(part.sure.first[k]) + within(part.rest);
        first[axes[k]] += whole * (middle[k] * share + half[k] * u[k]);
    }
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto [i, j] = pairs[p];
        if (i >= axes.size() || j >= axes.size()) continue;
        const Interval uu = around(part.sure.second[p]) + (i == j ? up_to(part.rest) : within(part.rest));
        second[pair_of(axes[i], axes[j])] +=
            whole * (middle[i] * middle[j] * share + middle[i] * half[j] * u[j] + middle[j] * half[i] * u[i] +
                     half[i] * half[j] * uu);
    }
}

void MomentSums::add_whole(const Cell& cell, const std::vector<std::size_t>& axes) {
    CellPart part{cell, {}, 0};
    part.sure.share = 1;
    for (std::size_t k = 0; k < axes.size(); ++k) part.sure.second[k] = 1.0 / 3;
    add(part, axes);
}

void MomentSums::add(const MomentSums& other) {
    size += other.size;
    for (std::size_t k = 0; k < 3; ++k) first[k] += other.first[k];
    for (std::size_t k = 0; k < 6; ++k) second[k] += other.second[k];
}

MomentSums MomentSums::about(const std::array<double, 3>& point) const {
    MomentSums out{point, size, {}, {}};
    std::array<Interval, 3> d;
    for (std::size_t k = 0; k < 3; ++k) {
        d[k] = Interval(origin[k]) - Interval(point[k]);
        out.first[k] = first[k] + d[k] * size;
    }
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto [i, j] = pairs[p];
        out.second[p] = second[p] + d[i] * first[j] + d[j] * first[i] + d[i] * d[j] * size;
    }
    return out;
}

CentralMoments central_moments(const MomentSums& sums, const Cell& box,
                               const std::vector<std::size_t>& axes) {
    CentralMoments out;
    std::array<Interval, 3> shift;  // from the origin of the sums to the centroid
    for (const std::size_t axis : axes) {
        const Interval side{box.low[axis], box.high[axis]};
        shift[axis] = side - Interval(sums.origin[axis]);
        if (sums.size.lo > 0) shift[axis] = cut(sums.first[axis] / sums.size, shift[axis]);
        out.centroid[axis] = cut(Interval(sums.origin[axis]) + shift[axis], side);
    }
    // second moments about the centroid: Huygens and Steiner
    std::array<Interval, 6> central;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto [i, j] = pairs[p];
        const Interval product = i == j ? math::square(shift[i]) : shift[i] * shift[j];
        central[p] = sums.second[p] - sums.size * product;
        if (i == j) central[p].lo = std::max(central[p].lo, 0.0);
    }
    out.inertia = {central[1] + central[2],
                   central[0] + central[2],
                   central[0] + central[1],
                   -central[3],
                   -central[4],
                   -central[5]};
    return out;
}

}  // namespace frep::measuring
