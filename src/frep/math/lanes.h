// LanesN<N>: N doubles that go through one computation together; LaneMask<N>: N truth values; LaneWords<N>:
// their bits. Every operation is the IEEE operation of each lane, so lanes and scalars agree bit for bit.
// Method: GCC/clang vectors (pack.h). Checked by tests/unit/math/lanes_test.cpp.
#pragma once

#include "frep/math/bits.h"
#include "frep/math/pack.h"

FREP_MATH_OPEN

/// N truth values, each all ones or all zeros.
template <int N>
struct LaneMask {
    using Items = Pack<std::int64_t, N>;
    Items items;

    /// Truth value of lane i.
    bool operator[](int i) const { return items.get(i) != 0; }
    /// Sets lane i.
    void set(int i, bool b) { items.set(i, b ? -1 : 0); }
    friend LaneMask operator&(LaneMask a, LaneMask b) {
        return {each<Items>([](auto x, auto y) { return x & y; }, a.items, b.items)};
    }
    friend LaneMask operator|(LaneMask a, LaneMask b) {
        return {each<Items>([](auto x, auto y) { return x | y; }, a.items, b.items)};
    }
    friend LaneMask operator!(LaneMask a) {
        return {each<Items>([](auto x) { return ~x; }, a.items)};
    }
};

/// The bits of N doubles, with the integer operations that the kernels need (modulo 2^64).
template <int N>
struct LaneWords {
    using Items = Pack<std::uint64_t, N>;
    Items items;

    friend LaneWords operator+(LaneWords a, LaneWords b) {
        return {each<Items>([](auto x, auto y) { return x + y; }, a.items, b.items)};
    }
    friend LaneWords operator-(LaneWords a, LaneWords b) {
        return {each<Items>([](auto x, auto y) { return x - y; }, a.items, b.items)};
    }
    friend LaneWords operator&(LaneWords a, LaneWords b) {
        return {each<Items>([](auto x, auto y) { return x & y; }, a.items, b.items)};
    }
    friend LaneWords operator|(LaneWords a, LaneWords b) {
        return {each<Items>([](auto x, auto y) { return x | y; }, a.items, b.items)};
    }
    friend LaneWords operator^(LaneWords a, LaneWords b) {
        return {each<Items>([](auto x, auto y) { return x ^ y; }, a.items, b.items)};
    }
    friend LaneWords operator+(LaneWords a, std::uint64_t b) { return a + LaneWords{Items::all(b)}; }
    friend LaneWords operator-(LaneWords a, std::uint64_t b) { return a - LaneWords{Items::all(b)}; }
    friend LaneWords operator&(LaneWords a, std::uint64_t b) { return a & LaneWords{Items::all(b)}; }
    friend LaneWords operator|(LaneWords a, std::uint64_t b) { return a | LaneWords{Items::all(b)}; }
    friend LaneWords operator<<(LaneWords a, int n) {
        return {each<Items>([n](auto x) { return x << n; }, a.items)};
    }
    friend LaneWords operator>>(LaneWords a, int n) {
        return {each<Items>([n](auto x) { return x >> n; }, a.items)};
    }
    /// True where the lowest bit is set.
    friend LaneMask<N> mask_of_low_bit(LaneWords a) {
        return {each<Pack<std::int64_t, N>>([](auto x) { return -(x & std::uint64_t{1}); }, a.items)};
    }
};

/// N doubles. The default constructor leaves them unset; a double converts to N copies of itself.
template <int N>
struct LanesN {
    using Items = Pack<double, N>;
    using Words = LaneWords<N>;
    static constexpr int size = N;
    Items items;

    LanesN() = default;
    LanesN(double all) : items(Items::all(all)) {}
    explicit LanesN(Items each_lane) : items(each_lane) {}
    explicit LanesN(Words bits) : items(each<Items>([](auto x) { return x; }, bits.items)) {}

    /// N copies of a value.
    static LanesN broadcast(double all) { return LanesN(all); }
    /// Reads N doubles from memory (any alignment).
    static LanesN load(const double* from) {
        LanesN r;
        __builtin_memcpy(&r.items, from, sizeof(Items));
        return r;
    }
    /// Writes N doubles to memory (any alignment).
    void store(double* to) const { __builtin_memcpy(to, &items, sizeof(Items)); }
    /// The value of lane i.
    double operator[](int i) const { return items.get(i); }
    /// Sets lane i.
    void set(int i, double x) { items.set(i, x); }
    /// The bits of every lane.
    Words bits() const {
        using Bits = typename Words::Items;
        return {each<Bits>([](auto x) { return x; }, items)};
    }

    friend LanesN operator+(LanesN a, LanesN b) {
        return LanesN(each<Items>([](auto x, auto y) { return x + y; }, a.items, b.items));
    }
    friend LanesN operator-(LanesN a, LanesN b) {
        return LanesN(each<Items>([](auto x, auto y) { return x - y; }, a.items, b.items));
    }
    friend LanesN operator*(LanesN a, LanesN b) {
        return LanesN(each<Items>([](auto x, auto y) { return x * y; }, a.items, b.items));
    }
    friend LanesN operator/(LanesN a, LanesN b) {
        return LanesN(each<Items>([](auto x, auto y) { return x / y; }, a.items, b.items));
    }
    friend LanesN operator-(LanesN a) {
        return LanesN(a.bits() ^ Words{Words::Items::all(0x8000000000000000u)});
    }
    LanesN& operator+=(LanesN b) { return *this = *this + b; }
    LanesN& operator-=(LanesN b) { return *this = *this - b; }
    LanesN& operator*=(LanesN b) { return *this = *this * b; }
    LanesN& operator/=(LanesN b) { return *this = *this / b; }

    using Truth = typename LaneMask<N>::Items;
    friend LaneMask<N> less(LanesN a, LanesN b) {
        return {each<Truth>([](auto x, auto y) { return x < y; }, a.items, b.items)};
    }
    friend LaneMask<N> less_equal(LanesN a, LanesN b) {
        return {each<Truth>([](auto x, auto y) { return x <= y; }, a.items, b.items)};
    }
    friend LaneMask<N> equal(LanesN a, LanesN b) {
        return {each<Truth>([](auto x, auto y) { return x == y; }, a.items, b.items)};
    }
    friend LaneMask<N> is_nan(LanesN a) {
        return {each<Truth>([](auto x) { return x != x; }, a.items)};
    }
    friend LanesN select(LaneMask<N> m, LanesN a, LanesN b) {
        const auto pick = [](auto mask, auto x, auto y) {
            using Integers = decltype(mask);
            return (reinterpret_cast<Integers>(x) & mask) | (reinterpret_cast<Integers>(y) & ~mask);
        };
        return LanesN(each<Items>(pick, m.items, a.items, b.items));
    }
};

/// The width that the engines use: four doubles, two SSE2 registers or one AVX register.
using Lanes = LanesN<4>;

/// Comparison and selection of lanes under qualified names. The friends above are the same and
/// also take a double for either operand.
template <int N>
inline LaneMask<N> less(LanesN<N> a, LanesN<N> b) {
    return less(a, b);  // the friend: it is no template, so it is preferred
}
template <int N>
inline LaneMask<N> less_equal(LanesN<N> a, LanesN<N> b) {
    return less_equal(a, b);
}
template <int N>
inline LaneMask<N> equal(LanesN<N> a, LanesN<N> b) {
    return equal(a, b);
}
template <int N>
inline LaneMask<N> is_nan(LanesN<N> a) {
    return is_nan(a);
}
template <int N>
inline LanesN<N> select(LaneMask<N> m, LanesN<N> a, LanesN<N> b) {
    return select(m, a, b);
}

/// True if some lane is true.
template <int N>
inline bool any(LaneMask<N> m) {
    std::int64_t r = 0;
    for (int i = 0; i < N; ++i) r |= m.items.get(i);
    return r != 0;
}
/// True if every lane is true.
template <int N>
inline bool all(LaneMask<N> m) {
    std::int64_t r = -1;
    for (int i = 0; i < N; ++i) r &= m.items.get(i);
    return r != 0;
}

FREP_MATH_CLOSE
