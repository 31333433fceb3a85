// Ranges of sums over points and segments (blobs, metaballs, soft objects, Cauchy convolutions) over 16
// boxes, term by term: each decreases with the distance, so that the nearest and the farthest point of a box
// bound it. Included by tile_forward.h alone. Method: distances of a box by centre and half sides, moved by
// more than their rounding; the terms as in field/kernels/skeleton.h and convolution.h. Tested by
// tests/unit/eval/tile_sums_test.cpp.
#pragma once

#include "frep/eval/tile_functions.h"
#include "frep/eval/tile_ranges.h"

namespace frep::tile {
namespace {

constexpr double far_away = 1e6;  ///< squares up to there are far from overflow
constexpr double steepest = 1e3;  ///< widths of Cauchy kernels whose squares there do not overflow

/// The sum of the terms so far, in each box.
struct Total {
    Row range;
    alignas(64) float size[16];  ///< of the terms, added up
    alignas(64) float least_term[16];
    std::size_t terms = 0;

    Total() {
        for (int c = 0; c < 16; c += width) {
            put(range, c, all(0.0f), all(0.0f));
            store(size + c, all(0.0f));
            store(least_term + c, all(0.0f));
        }
    }
    void add(int c, V lo, V hi) {
        put(range, c, load(range.lo + c) + lo, load(range.hi + c) + hi);
        store(size + c, load(size + c) + most(magnitude(lo), magnitude(hi)));
        store(least_term + c, least(load(least_term + c), lo));
    }
    /// The range, with what the additions may have lost; sums of terms above 0 are above 0.
    void finish(Row& r) const {
        const float by = static_cast<float>(terms + 1) * place;
        for (int c = 0; c < 16; c += width) {
            const V lost = load(size + c) * all(by);
            const V lo = load(range.lo + c) - lost, zero = all(0.0f);
            put(r, c, pick(less(load(least_term + c), zero), lo, most(lo, zero)), load(range.hi + c) + lost);
        }
    }
};

/// b times lo .. hi >= 0, for a constant b.
inline void add_scaled(Total& total, int c, double b, V lo, V hi) {
    const float by = static_cast<float>(b);
    const V p = lo * all(by * (1 - 2 * place)), q = hi * all(by * (1 + 2 * place));
    if (b < 0)
        total.add(c, q, p);
    else
        total.add(c, p, q);
}

/// The squared distance of the boxes from a point.
inline void square_distance(const Row* const* at, int c, const double* point, V& near, V& far) {
    near = far = all(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const auto p = static_cast<float>(point[axis]);
        const V lost = all((p < 0 ? -p : p) * place);
        const V l = load(at[axis]->lo + c) - all(p), h = load(at[axis]->hi + c) - all(p);
        const V x = most(all(0.0f), most(l, -h) - lost), y = most(-l, h) + lost;
        near = near + x * x;
        far = far + y * y;
    }
    near = near - near * all(8 * place);
    far = far + far * all(8 * place);
}

/// exp(-x) for x >= 0 at the ends of a range: below, above.
inline V exponential_below(V x) {
    const V p = exponential_of(most(all(-87.0f), -x));
    return pick(less(all(87.0f), x), all(0.0f), p - p * all(16 * place));
}
inline V exponential_above(V x) {
    const V p = exponential_of(most(all(-87.0f), -x));
    return p + p * all(16 * place);
}

/// Bells that end at relative distance 1, with what rounding may do to them there.
constexpr float bell_slack = 4e-6f, bell_end = 1.00001f;
inline V metaball_of(V q2) {
    const V q = root(q2), rest = all(1.0f) - q;
    return pick(less(q, all(1.0f / 3)), all(1.0f) - all(3.0f) * q2, all(1.5f) * rest * rest);
}
inline V soft_of(V q) { return all(1.0f) - q * (all(22.0f / 9) - q * (all(17.0f / 9) - q * all(4.0f / 9))); }

/// One term at squared distances near .. far; false where it has no form in lanes.
bool radial_term(Op op, const double* item, V near, V far, int c, Total& total) {
    const V one = all(1.0f);
    if (op == Op::blobby) {
        if (!(item[3] >= 0)) return false;
        const auto a = static_cast<float>(item[3]);
        add_scaled(total, c, item[4], exponential_below(far * all(a * (1 + 4 * place))),
                   exponential_above(near * all(a * (1 - 4 * place))));
        return true;
    }
    if (op == Op::conv_point) {
        if (!(item[3] >= -steepest && item[3] <= steepest)) return false;
        const auto s2 = static_cast<float>(item[3] * item[3]);
        const V p = one + all(s2) * far, q = one + all(s2) * near;
        total.add(c, all(1 - 16 * place) / (p * p), all(1 + 16 * place) / (q * q));
        return true;
    }
    const double size = op == Op::soft ? item[3] : item[4];
    const bool counts = op == Op::fitted_blob ? size > 1e-6 : size > 0;
    if (!counts) return true;
    if (!(size > 1e-5)) return false;
    const V scale = all(static_cast<float>(1 / (size * size)));
    near = near * scale;
    far = far * scale;
    if (op == Op::fitted_blob) {
        add_scaled(total, c, item[3], all(1 - 16 * place) / (one + far), all(1 + 16 * place) / (one + near));
        return true;
    }
    const V slack = all(bell_slack), end = all(bell_end), zero = all(0.0f);
    const V x = least(far, end), y = least(near, end);
    const V lo = op == Op::soft ? soft_of(x) : metaball_of(x),
            hi = op == Op::soft ? soft_of(y) : metaball_of(y);
    const V bottom = pick(less(far, end), lo - slack, zero), top = pick(less(near, end), hi + slack, zero);
    if (op == Op::soft)
        total.add(c, bottom, top);
    else
        add_scaled(total, c, item[3], most(bottom, zero), top);
    return true;
}

/// Numbers of a term of these sums; 0 for other operations.
constexpr std::size_t items_of_term(Op op) {
    switch (op) {
        case Op::conv_point:
        case Op::soft:
            return 4;
        case Op::blobby:
        case Op::metaball:
        case Op::fitted_blob:
            return 5;
        case Op::conv_line:
            return 7;
        default:
            return 0;
    }
}

/// atan2(y, x) for y >= 0, not both 0; to about 4 places of it.
inline V angle_of(V y, V x) {
    constexpr float half_turn = 3.14159274f, quarter = 1.57079637f, eighth = 0.785398185f;
    const V one = all(1.0f), u = magnitude(x);
    const M steep = less(u, y);
    V t = pick(steep, u, y) / pick(steep, y, u);  // 0 .. 1
    const M wide = less(all(0.41421356f), t);     // atan t = pi/4 + atan((t - 1)/(t + 1))
    t = pick(wide, (t - one) / (t + one), t);
    const V w = t * t;
    V p = all(-1.0f / 15);
    p = p * w + all(1.0f / 13);
    p = p * w - all(1.0f / 11);
    p = p * w + all(1.0f / 9);
    p = p * w - all(1.0f / 7);
    p = p * w + all(1.0f / 5);
    p = p * w - all(1.0f / 3);
    V angle = (p * w) * t + t;
    angle = pick(wide, angle + all(eighth), angle);
    angle = pick(steep, all(quarter) - angle, angle);
    return pick(less(x, all(0.0f)), all(half_turn) - angle, angle);
}

/// A segment prepared for lanes.
struct LineTerm {
    float begin[3], along[3];
    float length, half, s, s2, begin_size;
};
inline LineTerm line_term(const double* item) {
    LineTerm t{};
    double span[3], square = 0;
    for (int i = 0; i < 3; ++i) {
        span[i] = item[3 + i] - item[i];
        square += span[i] * span[i];
    }
    const double length = __builtin_sqrt(square), s = item[6] < 0 ? -item[6] : item[6];
    for (int i = 0; i < 3; ++i) {
        t.begin[i] = static_cast<float>(item[i]);
        t.begin_size += t.begin[i] < 0 ? -t.begin[i] : t.begin[i];
        t.along[i] = static_cast<float>(length > 0 ? span[i] / length : 0.0);
    }
    t.length = static_cast<float>(length);
    t.half = static_cast<float>(0.5 * length);
    t.s = static_cast<float>(s);
    t.s2 = static_cast<float>(s * s);
    return t;
}

/// True for a segment whose ends binary32 places well within the width of the kernel.
inline bool is_ordinary(const LineTerm& t) {
    return t.s > 1e-6f && t.s <= static_cast<float>(steepest) && t.s * t.length < 1e5f;
}

/// The integral over a segment for points at `off` from its middle plane and squared distance rho2 from its
/// line; `slack`: more than its error. atan(sx/p) + atan(s(l-x)/p) is one angle.
inline V line_value(const LineTerm& t, V off, V rho2, V& slack) {
    const V one = all(1.0f), s2 = all(t.s2), x = all(t.half) + off, rest = all(t.half) - off;
    const V p2 = one + s2 * rho2, p = root(p2), product = s2 * (x * rest);
    const V a = p2 + s2 * (x * x), b = p2 + s2 * (rest * rest);
    const V ends = all(t.length) * ((p2 + product) / a) / b;
    const V size = all(t.length) * ((p2 + magnitude(product)) / a) / b;
    const V angles = angle_of(all(t.s * t.length) / p, one - product / p2) / (all(t.s) * p);
    const V scale = all(0.5f) / p2;
    slack = (size + angles) * scale * all(24 * place) + x * all(4 * place) / (b * b);
    return (ends + angles) * scale;
}

/// Centres and half sides of boxes.
struct Middles {
    Row centre_and_half[3];       ///< lo: the centre, hi: half the side, rounded up
    alignas(64) float reach[16];  ///< half the diagonal

    explicit Middles(const Row* const* at) {
        for (int c = 0; c < 16; c += width) {
            V square = all(0.0f);
            for (int i = 0; i < 3; ++i) {
                const V l = load(at[i]->lo + c), h = load(at[i]->hi + c), m = all(0.5f) * l + all(0.5f) * h;
                const V half = most(h - m, m - l) * all(1 + 4 * place);
                put(centre_and_half[i], c, m, half);
                square = square + half * half;
            }
            store(reach + c, root(square) * all(1 + 8 * place));
        }
    }
    V centre(int axis, int c) const { return load(centre_and_half[axis].lo + c); }
    V half(int axis, int c) const { return load(centre_and_half[axis].hi + c); }
};

/// What of the boxes lies where about a segment, beyond rounding.
struct Beside {
    V off_near, off_far;    ///< from its middle plane
    V rho2_near, rho2_far;  ///< squared distance from its line
};
inline Beside beside(const LineTerm& t, const Middles& boxes, int c) {
    V d[3], h[3], size = all(t.begin_size);
    for (int i = 0; i < 3; ++i) {
        d[i] = boxes.centre(i, c) - all(t.begin[i]);
        h[i] = boxes.half(i, c);
        size = size + all(4.0f) * magnitude(d[i]);
    }
    const V lost = (size + all(t.length)) * all(2 * place), zero = all(0.0f);
    V x = zero, w = lost;
    for (int i = 0; i < 3; ++i) {
        x = x + d[i] * all(t.along[i]);
        w = w + magnitude(all(t.along[i])) * h[i];
    }
    Beside b;
    const V off = magnitude(x - all(t.half));
    b.off_near = most(zero, off - w);
    b.off_far = off + w;
    V square = zero;
    b.rho2_near = b.rho2_far = zero;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const V m = magnitude(d[j] * all(t.along[k]) - d[k] * all(t.along[j]));
        const V v = magnitude(all(t.along[k])) * h[j] + magnitude(all(t.along[j])) * h[k] + lost;
        const V near = most(zero, m - v), far = m + v;
        square = square + m * m;
        b.rho2_near = b.rho2_near + near * near;
        b.rho2_far = b.rho2_far + far * far;
    }
    // half the diagonal bounds the way across as well
    const V rho = root(square), reach = load(boxes.reach + c) + all(2.0f) * lost;
    const V nearest = most(zero, rho - reach), farthest = rho + reach;
    b.rho2_near = most(b.rho2_near, nearest * nearest) * all(1 - 16 * place);
    b.rho2_far = least(b.rho2_far, farthest * farthest) * all(1 + 16 * place);
    return b;
}

/// The closed form at both ends, cut to the length times the kernel there.
inline void line_range(const LineTerm& t, const Beside& b, int c, Total& total) {
    const auto kernel = [&](V off, V rho2) {
        const V k = all(1.0f) + all(t.s2) * (rho2 + off * off);
        return all(t.length) / (k * k);
    };
    V slack_low, slack_high;
    const V low = line_value(t, b.off_far, b.rho2_far, slack_low);
    const V high = line_value(t, b.off_near, b.rho2_near, slack_high);
    const V least_of = kernel(b.off_far + all(t.half), b.rho2_far);
    const V most_of = kernel(most(all(0.0f), b.off_near - all(t.half)), b.rho2_near);
    total.add(c, most(low - slack_low, least_of - least_of * all(32 * place)),
              least(high + slack_high, most_of + most_of * all(32 * place)));
}

/// Boxes with a bound beyond far_away, or none.
inline unsigned far_boxes(const Row* const* at) {
    unsigned far = 0;
    const V end = all(static_cast<float>(far_away));
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < 16; c += width)
            far |= bits(~(less(-end, load(at[axis]->lo + c)) & less(load(at[axis]->hi + c), end))) << c;
    return far;
}

/// Sums over constant data; false for all else. `f`: flags, `bad`: boxes that it did not bound.
bool summed(const Job& job, Reader clause, Row& r, std::uint32_t& f, unsigned& bad) {
    const std::size_t stride = items_of_term(clause.op());
    if (stride == 0 || clause.in(1) == 0) return false;
    const Block& block = job.blocks[clause.in(1) - 1];
    for (std::size_t i = 0; i < block.count; ++i)
        if (!(block.items[i] > -far_away && block.items[i] < far_away)) return false;
    const std::uint32_t* in = job.operands + clause.in(0);
    const Row* const at[3] = {&job.rows[in[0]], &job.rows[in[1]], &job.rows[in[2]]};
    Total total;
    const bool lines = clause.op() == Op::conv_line;
    const Middles middles(at);
    for (std::size_t i = 0; i + stride <= block.count; i += stride) {
        const double* item = block.items + i;
        ++total.terms;
        if (lines) {
            const LineTerm term = line_term(item);
            if (term.length == 0) continue;
            if (!is_ordinary(term)) return false;
            for (int c = 0; c < 16; c += width) line_range(term, beside(term, middles, c), c, total);
            continue;
        }
        for (int c = 0; c < 16; c += width) {
            V near, far;
            square_distance(at, c, item, near, far);
            if (!radial_term(clause.op(), item, near, far, c, total)) return false;
        }
    }
    total.finish(r);
    f = job.flags[in[0]] | job.flags[in[1]] | job.flags[in[2]];
    bad = far_boxes(at);
    return true;
}

}  // namespace
}  // namespace frep::tile
