// Kernels of exp and log in binary32. Method: exp by x = k ln2 + r (Cody and Waite 1980) and a polynomial in
// r; log by x = 2^k m, 1/sqrt(2) <= m < sqrt(2), s = f/(2+f), f = m - 1 and ln m = f - (f^2/2 - s (f^2/2 +
// R)) with R = 2 artanh(s) - 2 s (the arrangement of K. C. Ng, 1986). Straight-line, for every float. Checked
// over the floats by tests/unit/math/single_functions_test.cpp.
#pragma once

#include "frep/math/double_double.h"
#include "frep/math/functions.h"
#include "frep/math/single/coefficients.h"

FREP_MATH_OPEN
namespace single {

/// 1.5 * 2^23, and its bits: adding it rounds to the nearest integer and leaves that in the low bits.
inline constexpr double to_integer = 0x1.8p23;
inline constexpr std::uint32_t to_integer_bits = 0x4b400000;

/// y * 2^k for |k| <= 200 and y near 1, rounded once.
template <SingleType T>
inline T scale(T y, word_t<T> k) {
    const word_t<T> half = (k + std::uint32_t{256}) >> 1;
    const T first = float_of<T>((half - std::uint32_t{1}) << 23);
    const T second = float_of<T>((k - half + std::uint32_t{255}) << 23);
    return y * first * second;
}

}  // namespace single

/// e^x; +inf above 88.72, 0 below -103.97. Error <= 1 ulp, of the least denormal for denormal results.
template <SingleType T>
inline T exp(T x) {
    namespace c = single::coefficients;
    const T high = select(less(T(89.0), x), T(89.0), x);
    const T at = select(less(high, T(-104.5)), T(-104.5), high);
    const T shifted = at * c::log2_e + single::to_integer;
    const T k = shifted - single::to_integer;
    const T r = (at - k * c::ln2_1) - k * c::ln2_2;
    const T y = 1.0 + (r + r * r * polynomial(r, c::exp_tail));
    return single::scale(y, bits_of(shifted) - single::to_integer_bits);
}

/// The natural logarithm; NaN for x <= 0. Error <= 1 ulp.
template <SingleType T>
inline T log(T x) {
    namespace c = single::coefficients;
    const auto tiny = less(x, T(0x1p-126));
    const T normal = select(tiny, x * 0x1p24, x);
    const word_t<T> bits = bits_of(normal);
    // Exponent of normal/sqrt(1/2), with 128 added to stay positive.
    constexpr std::uint32_t root = 0x3f3504f3;  // sqrt(1/2)
    const word_t<T> k = (bits - root + (std::uint32_t{128} << 23)) >> 23;
    const T m = float_of<T>(bits - ((k - std::uint32_t{128}) << 23));
    const T exponent =
        float_of<T>(k | std::uint32_t{0x4b000000}) - (0x1p23 + 128.0) - select(tiny, T(24.0), T(0.0));
    const T f = m - 1.0, s = f / (2.0 + f), z = s * s;
    const T half = 0.5 * (f * f), tail = z * polynomial(z, c::artanh_tail);
    const T near = half - (s * (half + tail) + exponent * c::ln2_2);
    const T inside = exponent * c::ln2_1 - (near - f);
    const T r = select(equal(x, T(infinity)), x, inside);
    return select(less(T(0.0), x), r, T(quiet_nan));
}

FREP_MATH_CLOSE
