// LanesOf<E, N>: N doubles or floats that go through one computation together; LaneMaskOf: N truth values;
// LaneWordsOf: their bits. LanesN<N> are doubles, SinglesN<N> floats. Every operation is the IEEE operation
// of each lane, so lanes and scalars agree bit for bit. Method: GCC/clang vectors (pack.h). Checked by
// tests/unit/math/lanes_test.cpp.
#pragma once

#include "frep/math/bits.h"
#include "frep/math/pack.h"

FREP_MATH_OPEN

/// The integers of the size of E, and facts of its format.
template <class E>
struct Format;
template <>
struct Format<double> {
    using Integer = std::int64_t;
    using Word = std::uint64_t;
    static constexpr Word sign = 0x8000000000000000u, magnitude = 0x7fffffffffffffffu;
    static constexpr double whole = 0x1p52;  ///< numbers of at least this size are integers
    static constexpr double max_finite = 0x1.fffffffffffffp+1023;
};
template <>
struct Format<float> {
    using Integer = std::int32_t;
    using Word = std::uint32_t;
    static constexpr Word sign = 0x80000000u, magnitude = 0x7fffffffu;
    static constexpr double whole = 0x1p23;
    static constexpr double max_finite = 0x1.fffffep+127;
};

/// N truth values, each all ones or all zeros, of lanes E.
template <class E, int N>
struct LaneMaskOf {
    using Items = Pack<typename Format<E>::Integer, N>;
    Items items;

    /// Truth value of lane i.
    bool operator[](int i) const { return items.get(i) != 0; }
    /// Sets lane i.
    void set(int i, bool b) { items.set(i, b ? -1 : 0); }
    friend LaneMaskOf operator&(LaneMaskOf a, LaneMaskOf b) {
        return {each<Items>([](auto x, auto y) { return x & y; }, a.items, b.items)};
    }
    friend LaneMaskOf operator|(LaneMaskOf a, LaneMaskOf b) {
        return {each<Items>([](auto x, auto y) { return x | y; }, a.items, b.items)};
    }
    friend LaneMaskOf operator!(LaneMaskOf a) {
        return {each<Items>([](auto x) { return ~x; }, a.items)};
    }
};

/// The bits of N lanes, with the integer operations that the kernels need (modulo 2^64 or 2^32).
template <class E, int N>
struct LaneWordsOf {
    using Word = typename Format<E>::Word;
    using Items = Pack<Word, N>;
    Items items;

    friend LaneWordsOf operator+(LaneWordsOf a, LaneWordsOf b) {
        return {each<Items>([](auto x, auto y) { return x + y; }, a.items, b.items)};
    }
    friend LaneWordsOf operator-(LaneWordsOf a, LaneWordsOf b) {
        return {each<Items>([](auto x, auto y) { return x - y; }, a.items, b.items)};
    }
    friend LaneWordsOf operator&(LaneWordsOf a, LaneWordsOf b) {
        return {each<Items>([](auto x, auto y) { return x & y; }, a.items, b.items)};
    }
    friend LaneWordsOf operator|(LaneWordsOf a, LaneWordsOf b) {
        return {each<Items>([](auto x, auto y) { return x | y; }, a.items, b.items)};
    }
    friend LaneWordsOf operator^(LaneWordsOf a, LaneWordsOf b) {
        return {each<Items>([](auto x, auto y) { return x ^ y; }, a.items, b.items)};
    }
    friend LaneWordsOf operator+(LaneWordsOf a, Word b) { return a + LaneWordsOf{Items::all(b)}; }
    friend LaneWordsOf operator-(LaneWordsOf a, Word b) { return a - LaneWordsOf{Items::all(b)}; }
    friend LaneWordsOf operator&(LaneWordsOf a, Word b) { return a & LaneWordsOf{Items::all(b)}; }
    friend LaneWordsOf operator|(LaneWordsOf a, Word b) { return a | LaneWordsOf{Items::all(b)}; }
    friend LaneWordsOf operator<<(LaneWordsOf a, int n) {
        return {each<Items>([n](auto x) { return x << n; }, a.items)};
    }
    friend LaneWordsOf operator>>(LaneWordsOf a, int n) {
        return {each<Items>([n](auto x) { return x >> n; }, a.items)};
    }
    /// True where the lowest bit is set.
    friend LaneMaskOf<E, N> mask_of_low_bit(LaneWordsOf a) {
        using Truth = typename LaneMaskOf<E, N>::Items;
        return {each<Truth>([](auto x) { return (x & Word{1}) == Word{1}; }, a.items)};
    }
};

/// N numbers. The default constructor leaves them unset; a double converts to N copies of itself, rounded.
template <class E, int N>
struct LanesOf {
    using Item = E;
    using Items = Pack<E, N>;
    using Words = LaneWordsOf<E, N>;
    using Mask = LaneMaskOf<E, N>;
    static constexpr int size = N;
    Items items;

    LanesOf() = default;
    LanesOf(double all) : items(Items::all(static_cast<E>(all))) {}
    explicit LanesOf(Items each_lane) : items(each_lane) {}
    explicit LanesOf(Words bits) : items(each<Items>([](auto x) { return x; }, bits.items)) {}

    /// N copies of a value.
    static LanesOf broadcast(double all) { return LanesOf(all); }
    /// Reads N numbers from memory (any alignment).
    static LanesOf load(const E* from) { return LanesOf(Items::load(from)); }
    /// Writes N numbers to memory (any alignment).
    void store(E* to) const { items.store(to); }
    /// The value of lane i.
    E operator[](int i) const { return items.get(i); }
    /// Sets lane i.
    void set(int i, E x) { items.set(i, x); }
    /// The bits of every lane.
    Words bits() const {
        using Bits = typename Words::Items;
        return {each<Bits>([](auto x) { return x; }, items)};
    }

    friend LanesOf operator+(LanesOf a, LanesOf b) {
        return LanesOf(each<Items>([](auto x, auto y) { return x + y; }, a.items, b.items));
    }
    friend LanesOf operator-(LanesOf a, LanesOf b) {
        return LanesOf(each<Items>([](auto x, auto y) { return x - y; }, a.items, b.items));
    }
    friend LanesOf operator*(LanesOf a, LanesOf b) {
        return LanesOf(each<Items>([](auto x, auto y) { return x * y; }, a.items, b.items));
    }
    friend LanesOf operator/(LanesOf a, LanesOf b) {
        return LanesOf(each<Items>([](auto x, auto y) { return x / y; }, a.items, b.items));
    }
    friend LanesOf operator-(LanesOf a) {
        return LanesOf(a.bits() ^ Words{Words::Items::all(Format<E>::sign)});
    }
    LanesOf& operator+=(LanesOf b) { return *this = *this + b; }
    LanesOf& operator-=(LanesOf b) { return *this = *this - b; }
    LanesOf& operator*=(LanesOf b) { return *this = *this * b; }
    LanesOf& operator/=(LanesOf b) { return *this = *this / b; }

    using Truth = typename Mask::Items;
    friend Mask less(LanesOf a, LanesOf b) {
        return {each<Truth>([](auto x, auto y) { return x < y; }, a.items, b.items)};
    }
    friend Mask less_equal(LanesOf a, LanesOf b) {
        return {each<Truth>([](auto x, auto y) { return x <= y; }, a.items, b.items)};
    }
    friend Mask equal(LanesOf a, LanesOf b) {
        return {each<Truth>([](auto x, auto y) { return x == y; }, a.items, b.items)};
    }
    friend Mask is_nan(LanesOf a) {
        return {each<Truth>([](auto x) { return x != x; }, a.items)};
    }
    friend LanesOf select(Mask m, LanesOf a, LanesOf b) {
        return LanesOf(
            each<Items>([](auto mask, auto x, auto y) { return mask ? x : y; }, m.items, a.items, b.items));
    }
};

/// Lanes of doubles and of floats, their masks and bits.
template <int N>
using LanesN = LanesOf<double, N>;
template <int N>
using SinglesN = LanesOf<float, N>;
template <int N>
using LaneMask = LaneMaskOf<double, N>;
template <int N>
using LaneWords = LaneWordsOf<double, N>;

/// The width that the engines use: four doubles, two SSE2 registers or one AVX register.
using Lanes = LanesN<4>;

/// Comparison and selection of lanes under qualified names. The friends above are the same and
/// also take a double for either operand.
template <class E, int N>
inline LaneMaskOf<E, N> less(LanesOf<E, N> a, LanesOf<E, N> b) {
    return less(a, b);  // the friend: it is no template, so it is preferred
}
template <class E, int N>
inline LaneMaskOf<E, N> less_equal(LanesOf<E, N> a, LanesOf<E, N> b) {
    return less_equal(a, b);
}
template <class E, int N>
inline LaneMaskOf<E, N> equal(LanesOf<E, N> a, LanesOf<E, N> b) {
    return equal(a, b);
}
template <class E, int N>
inline LaneMaskOf<E, N> is_nan(LanesOf<E, N> a) {
    return is_nan(a);
}
template <class E, int N>
inline LanesOf<E, N> select(LaneMaskOf<E, N> m, LanesOf<E, N> a, LanesOf<E, N> b) {
    return select(m, a, b);
}

/// True if some lane is true.
template <class E, int N>
inline bool any(LaneMaskOf<E, N> m) {
    return any_set(m.items);
}
/// True if every lane is true.
template <class E, int N>
inline bool all(LaneMaskOf<E, N> m) {
    return !any_set((!m).items);
}

FREP_MATH_CLOSE
