// The constants of the kernels of binary32, all of them floats. Written by
// tools/kernel_coefficients.py (method there). Do not edit. Checked by
// tests/unit/math/single_functions_test.cpp.
#pragma once

#include "frep/math/isa.h"

FREP_MATH_OPEN
namespace single::coefficients {

/// (e^z - 1 - z)/z^2, for z in [-0.3470, 0.3470]; error 6.5e-8.
inline constexpr double exp_tail[] = {0x1.0000000000000p-1, 0x1.5554dc0000000p-3, 0x1.5555180000000p-5,
                                      0x1.120c000000000p-7, 0x1.6d119a0000000p-10};

/// 2 (artanh(s)/s - 1)/z with z = s^2, for z in [0, 0.0295]; error 1.9e-7.
inline constexpr double artanh_tail[] = {0x1.55555c0000000p-1, 0x1.997c100000000p-2, 0x1.2eebda0000000p-2};

/// (sin(x) - x)/x^3 with z = x^2, for z in [0, 0.6175]; error 2.8e-11.
inline constexpr double sin_tail[] = {-0x1.5555560000000p-3, 0x1.11110e0000000p-7, -0x1.a013a40000000p-13,
                                      0x1.6dbcec0000000p-19};

/// (cos(x) - 1)/z with z = x^2, for z in [0, 0.6175]; error 3.1e-10.
inline constexpr double cos_tail[] = {-0x1.0000000000000p-1, 0x1.55554c0000000p-5, -0x1.6c0e040000000p-10,
                                      0x1.9a6da60000000p-16};

/// (atan(x) - x)/x^3 with z = x^2, for z in [0, 0.1717]; error 1.6e-8.
inline constexpr double atan_tail[] = {-0x1.5555540000000p-2, 0x1.9997300000000p-3, -0x1.241ffa0000000p-3,
                                       0x1.b80b480000000p-4, -0x1.08351c0000000p-4};

/// pi/2 in parts of 12, 12, 12 and 24 bits.
inline constexpr double half_pi_1 = 0x1.9200000000000p+0;
inline constexpr double half_pi_2 = 0x1.fb40000000000p-12;
inline constexpr double half_pi_3 = 0x1.4440000000000p-24;
inline constexpr double half_pi_4 = 0x1.68c2340000000p-39;

/// ln 2 in parts of 15 and 24 bits.
inline constexpr double ln2_1 = 0x1.62e4000000000p-1;
inline constexpr double ln2_2 = 0x1.7f7d1c0000000p-20;

/// pi/2 in two floats.
inline constexpr double half_pi_hi = 0x1.921fb60000000p+0;
inline constexpr double half_pi_lo = -0x1.777a5c0000000p-25;

/// pi/4 in two floats.
inline constexpr double quarter_pi_hi = 0x1.921fb60000000p-1;
inline constexpr double quarter_pi_lo = -0x1.777a5c0000000p-26;

/// pi in two floats.
inline constexpr double pi_hi = 0x1.921fb60000000p+1;
inline constexpr double pi_lo = -0x1.777a5c0000000p-24;

/// 3 pi/4 in two floats.
inline constexpr double three_quarter_pi_hi = 0x1.2d97c80000000p+1;
inline constexpr double three_quarter_pi_lo = -0x1.99bc5c0000000p-28;

/// 1/ln 2.
inline constexpr double log2_e = 0x1.7154760000000p+0;

/// 2/pi.
inline constexpr double two_over_pi = 0x1.45f3060000000p-1;

/// tan(pi/8) = sqrt(2) - 1.
inline constexpr double tan_eighth_pi = 0x1.a8279a0000000p-2;

}  // namespace single::coefficients
FREP_MATH_CLOSE
