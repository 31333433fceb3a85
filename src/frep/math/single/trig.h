// Kernels of sin and cos in binary32. Method: reduction by pi/2 in four parts, the first three of which have
// exact products with every quadrant number that can come up (Cody and Waite 1980); the rest of the
// subtraction is carried along; one polynomial whose coefficients are picked lane by lane for the sine or the
// cosine. Beyond 2^12 the rare lanes go through the kernels of binary64. Checked over the floats by
// tests/unit/math/single_functions_test.cpp.
#pragma once

#include "frep/math/functions.h"
#include "frep/math/single/coefficients.h"
#include "frep/math/single/exp_log.h"

FREP_MATH_OPEN
namespace single {

/// Arguments up to here are reduced in binary32.
inline constexpr double largest_fast_angle = 0x1p12;

/// sin(x + turn pi/2) for |x| <= 2^12, but for the sign of a zero.
template <SingleType T>
inline T sin_of_angle(T x, std::uint32_t turn) {
    namespace c = coefficients;
    const T shifted = x * c::two_over_pi + to_integer;
    const T k = shifted - to_integer;
    const T a = (x - k * c::half_pi_1) - k * c::half_pi_2;  // exact
    const T third = k * c::half_pi_3;
    const T r = a - third;
    const T rest = ((a - r) - third) - k * c::half_pi_4;
    const word_t<T> quadrant = bits_of(shifted) + turn;
    const auto odd = mask_of_low_bit(quadrant);
    const T z = r * r;
    // r + r z S(z) + rest, or 1 + z C(z) - r rest
    const auto pick = [&](int i) { return select(odd, T(c::cos_tail[i]), T(c::sin_tail[i])); };
    const T tail = pick(0) + z * (pick(1) + z * (pick(2) + z * pick(3)));
    const T lead = select(odd, T(1.0), r), factor = select(odd, z, z * r);
    const T carried = rest * select(odd, -r, T(1.0));
    const T value = lead + (factor * tail + carried);
    return float_of<T>(bits_of(value) ^ ((quadrant & std::uint32_t{2}) << 30));
}

/// The shared scalar paths for |x| > 2^12.
inline float sin_far(float x) { return static_cast<float>(math::sin(static_cast<double>(x))); }
inline float cos_far(float x) { return static_cast<float>(math::cos(static_cast<double>(x))); }

}  // namespace single

/// Sine and cosine of x radians, any size; NaN for infinities. Error <= 2 ulp.
template <SingleType T>
inline T sin(T x) {
    const T size = abs(x);
    const T r = single::sin_of_angle(size, 0);
    const T value = float_of<T>(bits_of(r) ^ (bits_of(x) & Format<float>::sign));
    return patch(less(T(single::largest_fast_angle), size), value, x, single::sin_far);
}
template <SingleType T>
inline T cos(T x) {
    const T size = abs(x);
    return patch(less(T(single::largest_fast_angle), size), single::sin_of_angle(size, 1), x,
                 single::cos_far);
}

FREP_MATH_CLOSE
