// What is wanted of a clause and how it is passed on to the operands, for the pass from the root down
// (tile_reverse.h). Included by tile_smooth.h alone. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_ranges.h"

namespace frep::tile {
namespace {

/// What is wanted of a clause: boxes that need it, those that need its value; the others need its sign, and
/// its value where that is no larger than `margin`.
struct Demand {
    unsigned live, value;
    float margin;
    float gain = endless;  ///< as in Wanted
    unsigned sign() const { return live & ~value; }
    Demand only(unsigned boxes) const { return {live & boxes, value & boxes, margin, gain}; }
    Demand as_value() const { return {live, live, 0, gain}; }
    Demand scaled(float c) const { return {live, value, margin, gain * c}; }
};

/// x and a little more, so that what holds within a margin holds about its end too.
inline float widened(float x) { return x * 1.0001f; }

struct Walk {
    const Job& job;
    Reader clause;

    /// Row of operand k.
    std::uint32_t row(int k) const {
        return clause.listed() ? job.operands[clause.in(0) + static_cast<std::uint32_t>(k)] : clause.in(k);
    }
    bool is_constant(int k) const { return row(k) < job.constants; }
    const Row& range(int k) const { return job.rows[row(k)]; }
    unsigned undefined(int k) const { return job.flags[row(k)] & 0xffffu; }
    void ask(int k, Demand d) const {
        Wanted& wanted = job.wanted[row(k)];
        wanted.live |= static_cast<std::uint16_t>(d.live);
        wanted.value |= static_cast<std::uint16_t>(d.value);
        if (d.margin > wanted.margin && d.sign() != 0) wanted.margin = d.margin;
        if (d.live != 0) wanted.gain += d.gain;
    }
    /// All of operand k, where the clause is needed.
    void ask_value(int k, unsigned boxes, float gain = endless) const { ask(k, {boxes, boxes, 0, gain}); }

    unsigned positive(int k) const { return above(range(k), 0.0f); }
    unsigned negative(int k) const { return below(range(k), 0.0f); }
    /// Boxes where the range lies above, below x.
    static unsigned above(const Row& a, float x) {
        unsigned m = 0;
        for (int c = 0; c < 16; c += width) m |= bits(less(all(x), load(a.lo + c))) << c;
        return m;
    }
    static unsigned below(const Row& a, float x) {
        unsigned m = 0;
        for (int c = 0; c < 16; c += width) m |= bits(less(load(a.hi + c), all(x))) << c;
        return m;
    }
    /// Boxes where all of operand j lies below all of operand k.
    unsigned ordered(int j, int k) const {
        const Row &a = range(j), &b = range(k);
        unsigned m = 0;
        for (int c = 0; c < 16; c += width) m |= bits(less(load(a.hi + c), load(b.lo + c))) << c;
        return m;
    }
    /// Boxes where operand k is no larger than `most`.
    unsigned within(int k, float most_of) const {
        const Row& a = range(k);
        unsigned m = 0;
        for (int c = 0; c < 16; c += width)
            m |= bits(less(most(-load(a.lo + c), load(a.hi + c)), all(most_of))) << c;
        return m & ~undefined(k);
    }
    /// Boxes where operand k is 0.
    unsigned zero(int k) const {
        const Row& a = range(k);
        unsigned m = 0;
        for (int c = 0; c < 16; c += width)
            m |= bits(same(load(a.lo + c), all(0.0f)) & same(load(a.hi + c), all(0.0f))) << c;
        return m & ~undefined(k);
    }
};

/// The size of a constant operand; 0 where it is no constant, or 0, or endless.
inline float constant_size(const Walk& w, int k) {
    if (!w.is_constant(k) || w.undefined(k) != 0) return 0;
    const float x = w.range(k).lo[0], size = x < 0 ? -x : x;
    return size < endless && size > 1e-30f ? size : 0;
}

/// The largest size of a range over all boxes.
inline float farthest(const Row& a) {
    V far = all(0.0f);
    for (int c = 0; c < 16; c += width)
        far = most(far, most(magnitude(load(a.lo + c)), magnitude(load(a.hi + c))));
    for (int step = width / 2; step > 0; step /= 2)
        for (int i = 0; i < step; ++i) far[i] = far[i] < far[i + step] ? far[i + step] : far[i];
    const float most_of = far[0];
    return most_of;
}

}  // namespace
}  // namespace frep::tile
