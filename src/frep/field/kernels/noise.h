// Kernels of lattice noise and turbulence (Perlin, An image synthesizer, 1985): pseudo-random unit gradients
// at the points of the integer lattice, products with the offsets, interpolated by 3t^2 - 2t^3. One fixed
// table: gradient number k of 256 and the permutation come from SplitMix64 counters k with seeds 1 and 2, so
// that every build and machine has the same noise. |noise| < 0.8661: by Jensen's inequality it is at most the
// root of the interpolated square distances, sqrt(3/4). Tested by tests/unit/shapes/noise_test.cpp.
#pragma once

#include <cstdint>

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace noise_detail {

inline constexpr double noise_bound = 0.8661;

/// SplitMix64 (Steele, Lea and Flood 2014) of a counter and a seed.
constexpr std::uint64_t random_bits(std::uint64_t counter, std::uint64_t seed) {
    std::uint64_t z = (counter + 1) * 0x9e3779b97f4a7c15u + seed * 0xd1342543de82ef95u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

struct Lattice {
    std::uint8_t permutation[256];
    double gradient[256][3];

    Lattice() {
        for (int i = 0; i < 256; ++i) permutation[i] = static_cast<std::uint8_t>(i);
        for (std::uint64_t i = 255; i > 0; --i) {
            const std::uint64_t j = random_bits(i, 2) % (i + 1);
            const std::uint8_t kept = permutation[i];
            permutation[i] = permutation[j];
            permutation[j] = kept;
        }
        std::uint64_t counter = 0;
        for (auto& g : gradient) {  // points of the unit ball, not too near to its centre, on the sphere
            double square;
            do {
                for (double& c : g) c = static_cast<double>(random_bits(counter++, 1) >> 11) * 0x1p-52 - 1.0;
                square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
            } while (!(square <= 1.0 && square > 0.01));
            const double length = math::sqrt(square);
            for (double& c : g) c /= length;
        }
    }
    const double* at(int i, int j, int k) const {
        const int h = permutation[(permutation[(permutation[i & 255] + j) & 255] + k) & 255];
        return gradient[h];
    }
};
inline const Lattice& lattice() {
    static const Lattice instance;
    return instance;
}

/// A lattice coordinate modulo 256.
inline int wrapped(double cell) { return static_cast<int>(cell - 256.0 * math::floor(cell * (1.0 / 256.0))); }

/// Interpolation of the eight corner products of the cell (i, j, k) at offsets x, y, z in 0..1.
template <class S>
S cell_noise(const int* cell, S x, S y, S z) {
    const S t[3] = {x, y, z};
    S weight[3][2], offset[3][2];
    for (int axis = 0; axis < 3; ++axis) {
        if constexpr (is_interval<S>) {
            weight[axis][1] = -decreasing([](S u) { return -(math::square(u) * (3.0 - 2.0 * u)); }, t[axis]);
        } else {
            weight[axis][1] = math::square(t[axis]) * (3.0 - 2.0 * t[axis]);
        }
        weight[axis][0] = 1.0 - weight[axis][1];
        offset[axis][0] = t[axis];
        offset[axis][1] = t[axis] - 1.0;
    }
    S sum = zero<S>();
    for (int corner = 0; corner < 8; ++corner) {
        const int a = corner & 1, b = (corner >> 1) & 1, c = corner >> 2;
        const double* g = lattice().at(cell[0] + a, cell[1] + b, cell[2] + c);
        const S product = offset[0][a] * g[0] + offset[1][b] * g[1] + offset[2][c] * g[2];
        sum += weight[0][a] * weight[1][b] * weight[2][c] * product;
    }
    return sum;
}

/// Noise at numbers of type double or Dual<double>.
template <class S>
S scalar_noise(S x, S y, S z) {
    const double at[3] = {number_of(x), number_of(y), number_of(z)};
    double base[3];
    int cell[3];
    for (int i = 0; i < 3; ++i) {
        if (!(math::abs(at[i]) < math::infinity)) return math::constant<S>(math::quiet_nan);
        base[i] = math::floor(at[i]);
        cell[i] = wrapped(base[i]);
    }
    return cell_noise<S>(cell, x - base[0], y - base[1], z - base[2]);
}

}  // namespace noise_detail

template <class T>
T lattice_noise(T x, T y, T z) {
    return lane_by_lane([](double a, double b, double c) { return noise_detail::scalar_noise(a, b, c); }, x,
                        y, z);
}
template <class T>
math::Dual<T> lattice_noise(math::Dual<T> x, math::Dual<T> y, math::Dual<T> z) {
    return dual_by_lane(
        [](const math::Dual<double>* v) { return noise_detail::scalar_noise(v[0], v[1], v[2]); },
        std::array<math::Dual<T>, 3>{x, y, z});
}
/// Cell by cell for up to 8 cells, else the bound of the noise.
inline Interval lattice_noise(Interval x, Interval y, Interval z) {
    const Interval at[3] = {x, y, z};
    const Interval bound = {-noise_detail::noise_bound, noise_detail::noise_bound};
    if (any_empty(x, y, z)) return Interval::empty();
    const bool undefined = any_flagged(x, y, z) || !within(math::max_finite, x, y, z);
    double first[3], cells = 1.0;
    for (int i = 0; i < 3; ++i) {
        first[i] = math::floor(at[i].lo);
        cells *= math::floor(at[i].hi) - first[i] + 1.0;
    }
    // beyond 2^40 a box has hardly any points inside a cell; beyond 2^53 the next cell has no number
    if (!(cells <= 8.0) || !within(0x1p40, x, y, z)) return bound.flagged(undefined);
    Interval range = Interval::empty();
    for (double i = first[0]; i <= x.hi; i += 1.0)
        for (double j = first[1]; j <= y.hi; j += 1.0)
            for (double k = first[2]; k <= z.hi; k += 1.0) {
                const int cell[3] = {noise_detail::wrapped(i), noise_detail::wrapped(j),
                                     noise_detail::wrapped(k)};
                const double base[3] = {i, j, k};
                Interval offset[3];
                for (int axis = 0; axis < 3; ++axis) {
                    const Interval part = cut(at[axis], base[axis], base[axis] + 1.0);
                    offset[axis] = cut(part - Interval(base[axis]), 0.0, 1.0);
                }
                const Interval value = noise_detail::cell_noise(cell, offset[0], offset[1], offset[2]);
                range = range.is_empty() ? value : math::hull(range, value);
            }
    return cut(Interval(range.lo, range.hi), bound.lo, bound.hi).flagged(undefined);
}

/// Sum of |2 noise(f x) - 1|/f over f = freq, freq/2, ... while f >= 1; every finite freq ends the sum.
template <class T>
T turbulence(T x, T y, T z, T freq) {
    T sum = zero<T>(), f = freq;
    for (int octave = 0; octave <= 1024; ++octave) {
        const auto counts = math::less_equal(one<T>(), f);
        if (!can_hold(counts)) break;
        T divisor = f;  // only octaves with f >= 1 count
        if constexpr (is_interval<T>) divisor = cut(f, 1.0, math::infinity);
        const T term = math::abs(2.0 * lattice_noise(f * x, f * y, f * z) - 1.0) / divisor;
        sum += math::select(counts, term, zero<T>());
        f = f * 0.5;
    }
    return defined_with(sum, x, y, z, freq);
}

}  // namespace frep::kernels
