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

/// y * 2^k for y near 1 and -151 <= k <= 128, rounded once. Denormal results are counted in units of 2^-149,
/// by an addition: a product that is denormal costs many times as much.
template <SingleType T>
inline T scale(T y, word_t<T> k) {
    const T normal = float_of<T>(bits_of(y) + (k << 23));
    const T units = y * float_of<T>((k + std::uint32_t{149 + 127}) << 23);
    const T denormal = float_of<T>(bits_of(units + 0x1p23) - std::uint32_t{0x4b000000});
    return select(less_equal(T(0x1p-126), normal), normal, denormal);
}

}  // namespace single

/// e^x; +inf above 88.72, 0 below -103.97. Error <= 2 ulp (found: 1.06).
template <SingleType T>
inline T exp(T x) {
    namespace c = single::coefficients;
    const T shifted = x * c::log2_e + single::to_integer;
    const T k = shifted - single::to_integer;
    const T r = (x - k * c::ln2_1) - k * c::ln2_2;
    const T y = 1.0 + (r + r * r * polynomial(r, c::exp_tail));
    const T value = single::scale(y, bits_of(shifted) - single::to_integer_bits);
    const T low = select(less(x, T(-104.0)), T(0.0), value);
    return select(less_equal(x, T(0x1.62e42ep+6)), low, x + infinity);
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
