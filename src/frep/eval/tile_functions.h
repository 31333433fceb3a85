// Ranges of exp, sine and cosine in lanes. Included by tile_forward.h alone. Method: reduction of the
// argument in two or three parts (Cody and Waite), Taylor polynomials, and steps several times their error;
// extrema by counting quarter turns. Errors by tests/unit/eval/prune_test.cpp, which compares with the
// kernels of math.
#pragma once

#include "frep/eval/tile_kernels.h"
#include "frep/eval/tile_vector.h"

namespace frep::tile {
namespace {

/// x rounded to an integer, for sizes below 2^22.
inline V nearest(V x) {
    const V shift = all(0x1.8p23f);
    return (x + shift) - shift;
}

/// e^x for x in -87 .. 88, within 3e-7 of it, relative.
inline V exponential_of(V x) {
    const V n = nearest(x * all(1.44269504f));
    const V r = (x - n * all(0.693359375f)) + n * all(2.12194440e-4f);  // ln 2 in two parts
    V p = all(1.0f / 5040) * r + all(1.0f / 720);
    p = p * r + all(1.0f / 120);
    p = p * r + all(1.0f / 24);
    p = p * r + all(1.0f / 6);
    p = p * r + all(0.5f);
    p = (p * r) * r + r + all(1.0f);
    return p * (V)((__builtin_convertvector(n, Integers) + 127) << 23);
}

void exponential(const Row& a, Row& r) {
    constexpr float by = 10 * 0x1p-23f;
    const V low_end = all(-87.0f), high_end = all(88.0f);
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c);
        const V p = exponential_of(most(low_end, least(al, high_end)));
        const V q = exponential_of(most(low_end, least(ah, high_end)));
        store(r.lo + c, pick(less(al, low_end), all(0.0f), p - p * all(by)));
        store(r.hi + c, pick(less(high_end, ah), all(__builtin_huge_valf()), q + q * all(by)));
    }
}

/// What a binary32 engine may call 1.
constexpr float about_one = 1.0000005f;
/// The largest argument that the reduction of wave_at() takes.
constexpr float wave_limit = 4096.0f;

/// sin(x + turns * pi/2) for turns 0 or 1; `slack`: more than its error, and than that of a binary32 engine.
inline V wave_at(V x, int turns, V& slack) {
    const V n = nearest(x * all(0.636619772f));
    const V r = ((x - n * all(1.5703125f)) - n * all(4.837512969970703125e-4f)) - n * all(7.54978995e-8f);
    const V t = r * r;
    V s = all(1.0f / 362880) * t - all(1.0f / 5040);
    s = s * t + all(1.0f / 120);
    s = s * t - all(1.0f / 6);
    s = (s * t) * r + r;
    V u = all(1.0f / 40320) - all(1.0f / 3628800) * t;
    u = u * t - all(1.0f / 720);
    u = u * t + all(1.0f / 24);
    u = u * t - all(0.5f);
    u = u * t + all(1.0f);
    const Integers quarter = __builtin_convertvector(n, Integers) + turns;
    const V size = pick(has_bit(quarter, 1), u, s);
    const V value = (V)((Integers)size ^ ((quarter << 30) & static_cast<std::int32_t>(0x80000000u)));
    slack = all(1e-6f);
    // about 0 the sine is known relatively, its zero exactly
    if (turns == 0) slack = pick(same(n, all(0.0f)), magnitude(value) * all(10 * 0x1p-23f), slack);
    return value;
}

/// True where some integer k = phase (mod 4) may lie in [low, high].
inline M may_hold(V low, V high, float phase) {
    const V quarter = (low - all(phase)) * all(0.25f);
    V k = nearest(quarter);
    k = k + pick(less(k, quarter), all(1.0f), all(0.0f));
    return less_equal(k * all(4.0f) + all(phase), high);
}

/// Sine (turns 0) or cosine (turns 1). Returns the boxes that it did not bound.
template <int turns>
unsigned wave(const Row& a, Row& r) {
    unsigned bad = 0;
    for (int c = 0; c < 16; c += width) {
        const V al = load(a.lo + c), ah = load(a.hi + c), end = all(wave_limit);
        bad |= bits(~(less(-end, al) & less(ah, end))) << c;
        V slack_low, slack_high;
        const V p = wave_at(most(-end, least(al, end)), turns, slack_low);
        const V q = wave_at(most(-end, least(ah, end)), turns, slack_high);
        V lo = most(all(-about_one), least(p - slack_low, q - slack_high));
        V hi = least(all(about_one), most(p + slack_low, q + slack_high));
        // quarter turns of the ends, widened beyond the rounding of their products
        const V s = al * all(0.636619772f), t = ah * all(0.636619772f);
        const V from = s - magnitude(s) * all(0x1p-21f), to = t + magnitude(t) * all(0x1p-21f);
        hi = pick(may_hold(from, to, static_cast<float>(1 - turns)), all(about_one), hi);
        lo = pick(may_hold(from, to, static_cast<float>(3 - turns)), all(-about_one), lo);
        store(r.lo + c, lo);
        store(r.hi + c, hi);
    }
    return bad;
}

}  // namespace
}  // namespace frep::tile
