// Ranges of Bezier volumes over 16 boxes. Included by tile_forward.h alone. Method: the Bernstein
// coefficients of the part of the volume over a box, whose hull bounds it; along each axis they are the
// blossom at the ends of the box, a matrix times the control values (as in
// field/kernels/freeform_interval.h). Tested by tests/unit/eval/tile_sums_test.cpp.
#pragma once

#include "frep/eval/tile_ranges.h"

namespace frep::tile {
namespace {

constexpr int most_controls = 27;  ///< along an axis

/// Coefficient j over lo .. hi is sum of share[j][i] value i: the products of (1-t, t) at lo count-1-j times
/// and at hi j times.
struct Shares {
    V share[most_controls][most_controls];

    Shares(V lo, V hi, int count) {
        for (int j = 0; j < count; ++j) {
            V* row = share[j];
            row[0] = all(1.0f);
            for (int level = 1; level < count; ++level) {
                const V t = level <= j ? hi : lo, rest = all(1.0f) - t;
                row[level] = t * row[level - 1];
                for (int i = level - 1; i > 0; --i) row[i] = rest * row[i] + t * row[i - 1];
                row[0] = rest * row[0];
            }
        }
    }
};

/// The hull of the coefficients.
void bezier_hull(const double* values, const int* size, const Shares* shares, V& lo, V& hi) {
    V slice[most_controls * most_controls], line[most_controls];
    const int plane = size[1] * size[2];
    lo = all(endless), hi = all(-endless);
    for (int i = 0; i < size[0]; ++i) {
        for (int n = 0; n < plane; ++n) {
            V sum = all(0.0f);
            for (int m = 0; m < size[0]; ++m)
                sum = sum + shares[0].share[i][m] * all(static_cast<float>(values[m * plane + n]));
            slice[n] = sum;
        }
        for (int j = 0; j < size[1]; ++j) {
            for (int n = 0; n < size[2]; ++n) {
                V sum = all(0.0f);
                for (int m = 0; m < size[1]; ++m) sum = sum + shares[1].share[j][m] * slice[m * size[2] + n];
                line[n] = sum;
            }
            for (int k = 0; k < size[2]; ++k) {
                V sum = all(0.0f);
                for (int n = 0; n < size[2]; ++n) sum = sum + shares[2].share[k][n] * line[n];
                lo = least(lo, sum);
                hi = most(hi, sum);
            }
        }
    }
}

/// Bezier volumes of constant control values; false for all else. `f`: flags, `bad`: boxes that it did not
/// bound.
__attribute__((noinline)) bool bezier_range(const Job& job, Reader clause, Row& r, std::uint32_t& f,
                                            unsigned& bad) {
    if (clause.in(1) == 0) return false;
    const Block& block = job.blocks[clause.in(1) - 1];
    if (block.count < 4) return false;
    int size[3], degrees = 0, count = 1;
    for (int i = 0; i < 3; ++i) {
        if (!(block.items[i] >= 1 && block.items[i] <= most_controls)) return false;
        size[i] = static_cast<int>(block.items[i]);
        degrees += size[i];
        count *= size[i];
    }
    if (block.count != static_cast<std::size_t>(count) + 3) return false;
    double largest_of = 0;
    for (int i = 0; i < count; ++i) {
        const double v = block.items[3 + i], magnitude_of = v < 0 ? -v : v;
        if (!(magnitude_of < 1e15)) return false;
        largest_of = magnitude_of > largest_of ? magnitude_of : largest_of;
    }
    const std::uint32_t* in = job.operands + clause.in(0);
    for (int c = 0; c < 16; c += width) {
        // the sum of the magnitudes of the Bernstein polynomials, which errors grow by
        V weight = all(static_cast<float>(largest_of));
        V from[3], to[3];
        for (int i = 0; i < 3; ++i) {
            const Row& a = job.rows[in[i]];
            from[i] = load(a.lo + c), to[i] = load(a.hi + c);
            const V one = all(1.0f), l = magnitude(from[i]) + magnitude(one - from[i]);
            const V step = most(l, magnitude(to[i]) + magnitude(one - to[i])) * all(1 + 8 * place);
            for (int n = 1; n < size[i]; ++n) weight = weight * step;
        }
        const M tame_weight = less(weight, all(1e25f));
        const Shares shares[3] = {
            {from[0], to[0], size[0]}, {from[1], to[1], size[1]}, {from[2], to[2], size[2]}};
        V lo, hi;
        bezier_hull(block.items + 3, size, shares, lo, hi);
        const V lost = weight * all(static_cast<float>(2 * degrees + 8) * place);
        put(r, c, pick(tame_weight, lo - lost, all(-endless)), pick(tame_weight, hi + lost, all(endless)));
        bad |= bits(~tame_weight) << c;
    }
    f = job.flags[in[0]] | job.flags[in[1]] | job.flags[in[2]];
    return true;
}

}  // namespace
}  // namespace frep::tile
