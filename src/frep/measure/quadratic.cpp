// Implementation of quadratic.h. Linear interpolation on a Kuhn simplex with sides s: the corners are passed
// one axis after the other, so that the covariances of interpolation are in 0 .. s_i s_j / 4 and a function
// with second derivatives M is below its interpolation by sum M_ij times half of them.
#include "frep/measure/quadratic.h"

#include <algorithm>
#include <cmath>

namespace frep::measuring {

namespace {

using math::Interval;

/// Larger values and slopes give no bounds.
constexpr double largest = 1e150;

bool is_usable(const Interval& v) {
    return !v.is_empty() && !v.maybe_undefined && v.lo > -largest && v.hi < largest;
}
double middle_of(const Interval& v) { return v.lo + 0.5 * (v.hi - v.lo); }
double size_of(const Interval& v) { return std::max(std::abs(v.lo), std::abs(v.hi)); }
/// How far the ends of v may be from middle_of(v).
double radius_of(const Interval& v) {
    const Interval m(middle_of(v));
    return std::max((Interval(v.hi) - m).hi, (m - Interval(v.lo)).hi);
}
template <class Measure>
double largest_of(const std::array<Interval, 3>& all, Measure measure) {
    return std::max({measure(all[0]), measure(all[1]), measure(all[2])});
}
/// A pair of variables stands for two entries of the matrix, but on the diagonal.
double entries(std::size_t pair) { return pairs[pair][0] == pairs[pair][1] ? 1 : 2; }

/// The three coordinates of a cell's lattice along each axis, less those of a center.
using Ways = std::array<std::array<Interval, 3>, 3>;
Ways ways_from(const std::array<double, 3>& center, const Cell& cell, std::span<const std::size_t> axes) {
    Ways out;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const std::size_t axis = axes[k];
        const double at[] = {cell.low[axis], cell.middle(axis), cell.high[axis]};
        for (std::size_t place = 0; place < 3; ++place)
            out[k][place] = Interval(at[place]) - Interval(center[axis]);
    }
    return out;
}

/// The longer half of a cell along each axis, rounded up.
std::array<double, 3> halves(const Cell& cell, std::span<const std::size_t> axes) {
    std::array<double, 3> out{};
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const Interval middle = cell.middle(axes[k]);
        out[k] =
            std::max((Interval(cell.high[axes[k]]) - middle).hi, (middle - Interval(cell.low[axes[k]])).hi);
    }
    return out;
}

/// Sets the bounds on the lattice: value(digits) is an enclosure, `below` and `above` what is taken off and
/// added.
template <class Value>
void set_bounds(std::size_t dimension, Value value, CellBounds& out) {
    const std::size_t points = dimension == 2 ? 9 : 27;
    bool all_inside = true, all_outside = true;
    out.has_planes = true;
    for (std::size_t point = 0; point < points; ++point) {
        const Interval range = value({point % 3, point / 3 % 3, point / 9});
        out.lower[point] = range.lo;
        out.upper[point] = range.hi;
        all_inside = all_inside && range.lo >= 0;
        all_outside = all_outside && range.hi < 0;
        out.has_planes = out.has_planes && is_usable(range);
    }
    if (!out.has_planes) return;
    if (all_inside) out.sign = CellSign::inside;
    if (all_outside) out.sign = CellSign::outside;
}

using Digits = std::array<std::size_t, 3>;

}  // namespace

std::optional<Quadratic> quadratic_of(const Cell& cell, std::span<const std::size_t> axes, const Jet& whole,
                                      const Jet& middle) {
    Quadratic q;
    if (!is_usable(whole.value) || !is_usable(middle.value)) return std::nullopt;
    for (std::size_t axis = 0; axis < 3; ++axis) q.center[axis] = cell.middle(axis);
    q.value = middle.value;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        q.slope[k] = middle.first[k];
        if (!is_usable(q.slope[k])) return std::nullopt;
    }
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Interval& h = whole.second[p];
        if (!is_usable(h)) return std::nullopt;
        q.second[p] = middle_of(h);
        q.rest[p] = size_of(h - Interval(q.second[p]));
    }
    return q;
}

QuadraticGap gap_of(const Quadratic& q, const Cell& cell, std::span<const std::size_t> axes) {
    const Ways ways = ways_from(q.center, cell, axes);
    const std::array<double, 3> half = halves(cell, axes);
    QuadraticGap gap;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto [i, j] = pairs[p];
        if (i >= axes.size() || j >= axes.size()) continue;
        const auto most = [&](std::size_t k) { return std::max(size_of(ways[k][0]), size_of(ways[k][2])); };
        gap.rest += 0.5 * entries(p) * q.rest[p] * most(i) * most(j);
        gap.bend += entries(p) * std::abs(q.second[p]) * half[i] * half[j] / 8;
    }
    return gap;
}

double mean_value_gap(const Cell& cell, std::span<const std::size_t> axes, const Jet& whole) {
    double gap = 0;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (!is_usable(whole.first[k])) return math::infinity;
        gap += 0.25 * (whole.first[k].hi - whole.first[k].lo) * (cell.high[axes[k]] - cell.low[axes[k]]);
    }
    return gap;
}

void set_quadratic_bounds(const Quadratic& q, const Cell& cell, std::span<const std::size_t> axes,
                          CellBounds& out) {
    const Ways ways = ways_from(q.center, cell, axes);
    const std::array<double, 3> half = halves(cell, axes);
    // the parts of the quadratic function that belong to one axis, and to two
    std::array<std::array<Interval, 3>, 3> own;
    std::array<std::array<std::array<Interval, 3>, 3>, 6> shared;
    std::array<bool, 6> is_shared{};
    Interval below = 0, above = 0;
    // R is at most a diagonal matrix: |t_i| |t_j| <= (t_i^2 l_j/l_i + t_j^2 l_i/l_j) / 2, equal where |t| =
    // l. Squares are below their lines.
    std::array<Interval, 3> rest;
    std::array<std::array<Interval, 3>, 3> off;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto [i, j] = pairs[p];
        if (i >= axes.size() || j >= axes.size()) continue;
        const Interval m(q.second[p]), weight(entries(p));
        const auto most = [&](std::size_t k) {
            return Interval(std::max(size_of(ways[k][0]), size_of(ways[k][2])));
        };
        rest[i] += Interval(q.rest[p]) * most(j) / most(i);
        if (i != j) rest[j] += Interval(q.rest[p]) * most(i) / most(j);
        const Interval largest_rest = weight * Interval(0.5 * q.rest[p]) * most(i) * most(j);
        const Interval bend = weight * math::abs(m) * Interval(half[i]) * Interval(half[j]) * Interval(0.125);
        (q.second[p] > 0 ? below : above) += bend;
        out.gap[i] += 0.5 * (largest_rest.hi + bend.hi);
        out.gap[j] += 0.5 * (largest_rest.hi + bend.hi);
        is_shared[p] = i != j && q.second[p] != 0;
        for (std::size_t a = 0; a < 3; ++a) {
            if (i == j) own[i][a] = q.slope[i] * ways[i][a] + Interval(0.5) * m * math::square(ways[i][a]);
            if (is_shared[p])
                for (std::size_t b = 0; b < 3; ++b) shared[p][a][b] = m * ways[i][a] * ways[j][b];
        }
    }
    for (std::size_t k = 0; k < axes.size(); ++k)
        for (std::size_t a = 0; a < 3; ++a) off[k][a] = Interval(0.5) * rest[k] * math::square(ways[k][a]);
    // The sums of the lattice in doubles: fewer than 16 additions, each within 2^-53 of the sizes' sum.
    Interval slack = Interval(radius_of(q.value)), sizes = Interval(size_of(q.value)) + below + above;
    std::array<std::array<double, 3>, 3> rise{}, spread{};
    std::array<std::array<std::array<double, 3>, 3>, 6> twist{};
    for (std::size_t k = 0; k < axes.size(); ++k) {
        slack += largest_of(own[k], radius_of);
        sizes += Interval(largest_of(own[k], size_of)) + Interval(largest_of(off[k], size_of));
        for (std::size_t a = 0; a < 3; ++a) {
            rise[k][a] = middle_of(own[k][a]);
            spread[k][a] = off[k][a].hi;
        }
    }
    for (std::size_t p = 3; p < pairs.size(); ++p) {
        if (!is_shared[p]) continue;
        for (std::size_t a = 0; a < 3; ++a) {
            slack += largest_of(shared[p][a], radius_of);
            sizes += largest_of(shared[p][a], size_of);
            for (std::size_t b = 0; b < 3; ++b) twist[p][a][b] = middle_of(shared[p][a][b]);
        }
    }
    slack += sizes * Interval(0x1p-48);
    const double middle = middle_of(q.value), lowered = (below + slack).hi, raised = (above + slack).hi;
    set_bounds(
        axes.size(),
        [&](const Digits& digits) {
            double sum = middle, rests = 0;
            for (std::size_t k = 0; k < axes.size(); ++k) {
                sum += rise[k][digits[k]];
                rests += spread[k][digits[k]];
            }
            for (std::size_t p = 3; p < pairs.size(); ++p)
                if (is_shared[p]) sum += twist[p][digits[pairs[p][0]]][digits[pairs[p][1]]];
            return Interval(sum - rests - lowered, sum + rests + raised);
        },
        out);
}

void set_mean_value_bounds(const Cell& cell, std::span<const std::size_t> axes, const Jet& whole,
                           const Jet& middle, CellBounds& out) {
    std::array<double, 3> center{};
    for (std::size_t axis = 0; axis < 3; ++axis) center[axis] = cell.middle(axis);
    const Ways ways = ways_from(center, cell, axes);
    std::array<std::array<Interval, 3>, 3> rise, error;  // of the plane, and off it at most
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const Interval slope(whole.first[k].lo, whole.first[k].hi);
        const double plane = middle_of(slope);
        const double spread = size_of(slope - Interval(plane));
        for (std::size_t place = 0; place < 3; ++place) {
            rise[k][place] = Interval(plane) * ways[k][place];
            error[k][place] = Interval(spread) * math::abs(ways[k][place]);
            out.gap[k] = std::max(out.gap[k], error[k][place].hi);
        }
    }
    set_bounds(
        axes.size(),
        [&](const Digits& digits) {
            Interval sum = middle.value, off = 0;
            for (std::size_t k = 0; k < axes.size(); ++k) {
                sum += rise[k][digits[k]];
                off += error[k][digits[k]];
            }
            return Interval((sum - Interval(off.hi)).lo, (sum + Interval(off.hi)).hi);
        },
        out);
}

}  // namespace frep::measuring
