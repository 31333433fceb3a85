// Ranges of lattice noise over 16 boxes. Included by tile_forward.h alone. Method: as in
// field/kernels/noise.h the noise is an interpolation of the corner products of a cell; over a part of a cell
// their ranges are interpolated, by weights at either end of theirs. The cells of all boxes go through the
// lanes together. Boxes of more than two cells along an axis get the bound of the noise. Tested by
// tests/unit/eval/tile_sums_test.cpp.
#pragma once

#include "frep/eval/tile_ranges.h"

namespace frep::tile {
namespace {

constexpr float bound_of_noise = 0.86611f;
constexpr float most_of_lattice = 1e5f;  ///< coordinates up to there know their cell
constexpr float noise_slack = 4e-6f;     ///< more than the rounding here

struct Ends {
    V lo, hi;
};

/// Parts of up to 16 cells, with the boxes that they belong to.
struct CellParts {
    int count = 0;
    int box[16];
    alignas(64) float from[3][16], to[3][16];  ///< offsets in 0..1
    alignas(64) float gradient[8][3][16];      ///< of the corners
};

/// a interpolated with b by weights s.lo .. s.hi.
inline Ends mixed(Ends a, Ends b, Ends s) {
    const V low = b.lo - a.lo, high = b.hi - a.hi;
    return {least(a.lo + s.lo * low, a.lo + s.hi * low), most(a.hi + s.lo * high, a.hi + s.hi * high)};
}
inline V smooth_step(V t) { return t * t * (all(3.0f) - all(2.0f) * t); }

/// Joins the ranges of the parts to those of their boxes.
void join_parts(CellParts& parts, Row& r) {
    Row range;
    for (int n = parts.count; n < 16; ++n) {  // the rest repeats the first
        for (int axis = 0; axis < 3; ++axis) {
            parts.from[axis][n] = parts.from[axis][0];
            parts.to[axis][n] = parts.to[axis][0];
            for (auto& corner : parts.gradient) corner[axis][n] = corner[axis][0];
        }
    }
    for (int c = 0; c < 16; c += width) {
        Ends weight[3], offset[3][2];
        for (int axis = 0; axis < 3; ++axis) {
            const V from = load(parts.from[axis] + c), to = load(parts.to[axis] + c);
            weight[axis] = {smooth_step(from), smooth_step(to)};
            offset[axis][0] = {from, to};
            offset[axis][1] = {from - all(1.0f), to - all(1.0f)};
        }
        Ends product[8];
        for (int corner = 0; corner < 8; ++corner) {
            product[corner] = {all(0.0f), all(0.0f)};
            for (int axis = 0; axis < 3; ++axis) {
                const V g = load(parts.gradient[corner][axis] + c);
                const Ends o = offset[axis][corner >> axis & 1];
                const V p = g * o.lo, q = g * o.hi;
                product[corner].lo = product[corner].lo + least(p, q);
                product[corner].hi = product[corner].hi + most(p, q);
            }
        }
        Ends face[4], edge[2];
        for (int k = 0; k < 4; ++k) face[k] = mixed(product[2 * k], product[2 * k + 1], weight[0]);
        for (int k = 0; k < 2; ++k) edge[k] = mixed(face[2 * k], face[2 * k + 1], weight[1]);
        const Ends value = mixed(edge[0], edge[1], weight[2]);
        put(range, c, value.lo - all(noise_slack), value.hi + all(noise_slack));
    }
    for (int n = 0; n < parts.count; ++n) {
        const int k = parts.box[n];
        r.lo[k] = r.lo[k] < range.lo[n] ? r.lo[k] : range.lo[n];
        r.hi[k] = r.hi[k] > range.hi[n] ? r.hi[k] : range.hi[n];
    }
    parts.count = 0;
}

/// The cells of a box along an axis.
struct CellSpan {
    int first, last;
};
inline int floor_of(float x) {
    const int n = static_cast<int>(x);
    return static_cast<float>(n) > x ? n - 1 : n;
}
inline CellSpan cells_along(const Row& a, int k) {
    const int first = floor_of(a.lo[k]), last = -floor_of(-a.hi[k]) - 1;
    return {first, last > first ? last : first};
}

void add_part(const NoiseLattice& lattice, const Row* const* at, int k, const int* cell, CellParts& parts) {
    const int n = parts.count++;
    parts.box[n] = k;
    for (int axis = 0; axis < 3; ++axis) {
        const auto base = static_cast<float>(cell[axis]);
        const float from = at[axis]->lo[k] - base, to = at[axis]->hi[k] - base;
        parts.from[axis][n] = from > 0 ? from : 0;
        parts.to[axis][n] = to < 1 ? to : 1;
    }
    const std::uint8_t* p = lattice.permutation;
    for (int corner = 0; corner < 8; ++corner) {
        const int x = p[(cell[0] + (corner & 1)) & 255];
        const int y = p[(x + cell[1] + (corner >> 1 & 1)) & 255];
        const float* g = lattice.gradient + 3 * p[(y + cell[2] + (corner >> 2)) & 255];
        for (int axis = 0; axis < 3; ++axis) parts.gradient[corner][axis][n] = g[axis];
    }
}

/// Ranges of the noise. Returns the boxes that it did not bound.
unsigned noise_range(const NoiseLattice& lattice, const Row* const* at, Row& r) {
    unsigned bad = 0;
    CellParts parts;
    for (int k = 0; k < 16; ++k) {
        r.lo[k] = -bound_of_noise;
        r.hi[k] = bound_of_noise;
        CellSpan span[3];
        bool is_far = false, is_wide = false;
        for (int axis = 0; axis < 3; ++axis) {
            is_far = is_far || !(at[axis]->lo[k] > -most_of_lattice && at[axis]->hi[k] < most_of_lattice);
            if (is_far) break;
            span[axis] = cells_along(*at[axis], k);
            is_wide = is_wide || span[axis].last - span[axis].first > 1;
        }
        if (is_far) bad |= 1u << k;
        if (is_far || is_wide) continue;
        r.lo[k] = endless;
        r.hi[k] = -endless;
        int cell[3];
        for (cell[0] = span[0].first; cell[0] <= span[0].last; ++cell[0])
            for (cell[1] = span[1].first; cell[1] <= span[1].last; ++cell[1])
                for (cell[2] = span[2].first; cell[2] <= span[2].last; ++cell[2]) {
                    add_part(lattice, at, k, cell, parts);
                    if (parts.count == 16) join_parts(parts, r);
                }
    }
    if (parts.count > 0) join_parts(parts, r);
    for (int c = 0; c < 16; c += width)
        put(r, c, most(load(r.lo + c), all(-bound_of_noise)), least(load(r.hi + c), all(bound_of_noise)));
    return bad;
}

/// Lattice noise. `f`: flags. Returns the boxes that it did not bound.
unsigned noise_of(const Job& job, Reader clause, Row& r, std::uint32_t& f) {
    const Row* at[3];
    for (int i = 0; i < 3; ++i) {
        at[i] = &job.rows[clause.in(i)];
        f |= job.flags[clause.in(i)];
    }
    return noise_range(job.lattice, at, r);
}

}  // namespace
}  // namespace frep::tile
