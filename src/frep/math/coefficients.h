// The constants of the math kernels. Written by tools/kernel_coefficients.py (method there).
// Do not edit. Checked by tests/unit/math/kernels_test.cpp against MPFR.
#pragma once

#include <cstdint>

#include "frep/math/isa.h"

FREP_MATH_OPEN
namespace coefficients {

/// (e^z - 1 - z)/z^2, for z in [-0.3467, 0.3467]; error 1.4e-18.
inline constexpr double exp_tail[] = {0x1.0000000000000p-1,  0x1.5555555555557p-3,  0x1.5555555555556p-5,
                                      0x1.11111111100d3p-7,  0x1.6c16c16c162cfp-10, 0x1.a01a01abeccc3p-13,
                                      0x1.a01a01a6db488p-16, 0x1.71de02225a2f3p-19, 0x1.27e4db5bb725ap-22,
                                      0x1.af4e092e1705bp-26, 0x1.1f7315649f2d7p-29};

/// (artanh(s)/s - 1 - z/3)/z^2 with z = s^2, for z in [0, 0.0295]; error 9.6e-19.
inline constexpr double artanh_tail[] = {0x1.999999999999ap-3, 0x1.2492492492524p-3, 0x1.c71c71c6ea01fp-4,
                                         0x1.745d177b22bcfp-4, 0x1.3b1395976d2f0p-4, 0x1.1118d458653bcp-4,
                                         0x1.df7a2eafecf14p-5, 0x1.e0499f72e39b9p-5};

/// (sin(x) - x)/x^3 with z = x^2, for z in [0, 0.6170]; error 1.2e-20.
inline constexpr double sin_tail[] = {-0x1.5555555555555p-3, 0x1.1111111111110p-7,   -0x1.a01a01a019936p-13,
                                      0x1.71de3a5460533p-19, -0x1.ae64541251e39p-26, 0x1.61217eaffbfdbp-33,
                                      -0x1.ab179e14267cdp-41};

/// (cos(x) - 1 + z/2)/z^2 with z = x^2, for z in [0, 0.6170]; error 6.5e-22.
inline constexpr double cos_tail[] = {0x1.5555555555555p-5,   -0x1.6c16c16c16c16p-10, 0x1.a01a01a019d09p-16,
                                      -0x1.27e4fb7712b8cp-22, 0x1.1eed8deb644b7p-29,  -0x1.9394b9bb6e16dp-37,
                                      0x1.ab782b04de8dep-45};

/// (atan(x) - x)/x^3 with z = x^2, for z in [0, 0.1717]; error 1.2e-18.
inline constexpr double atan_tail[] = {-0x1.5555555555555p-2, 0x1.9999999999953p-3,  -0x1.249249248d768p-3,
                                       0x1.c71c71c2fe5d9p-4,  -0x1.745d165cb83aap-4, 0x1.3b1392b641b06p-4,
                                       -0x1.110e858a72e28p-4, 0x1.e199da4156fd9p-5,  -0x1.ac78ec6b8cb98p-5,
                                       0x1.74d64aa665b0ap-5,  -0x1.1b2058fb5da30p-5, 0x1.0aa87c56e3eb5p-6};

/// pi/2 in parts of 33, 33, 33 and 53 bits.
inline constexpr double half_pi_1 = 0x1.921fb54400000p+0;
inline constexpr double half_pi_2 = 0x1.0b4611a600000p-34;
inline constexpr double half_pi_3 = 0x1.3198a2e000000p-69;
inline constexpr double half_pi_4 = 0x1.b839a252049c1p-104;

/// pi/2 in three doubles.
inline constexpr double half_pi_hi = 0x1.921fb54442d18p+0;
inline constexpr double half_pi_lo = 0x1.1a62633145c07p-54;
inline constexpr double half_pi_end = -0x1.f1976b7ed8fbcp-110;

/// pi/4 in two doubles.
inline constexpr double quarter_pi_hi = 0x1.921fb54442d18p-1;
inline constexpr double quarter_pi_lo = 0x1.1a62633145c07p-55;

/// 3 pi/4 in two doubles.
inline constexpr double three_quarter_pi_hi = 0x1.2d97c7f3321d2p+1;
inline constexpr double three_quarter_pi_lo = 0x1.a79394c9e8a0ap-54;

/// pi in two doubles.
inline constexpr double pi_hi = 0x1.921fb54442d18p+1;
inline constexpr double pi_lo = 0x1.1a62633145c07p-53;

/// ln 2 in parts of 42 and 53 bits.
inline constexpr double ln2_1 = 0x1.62e42fefa3800p-1;
inline constexpr double ln2_2 = 0x1.ef35793c76730p-45;

/// 1/ln 10 in two doubles.
inline constexpr double log10_e_hi = 0x1.bcb7b1526e50ep-2;
inline constexpr double log10_e_lo = 0x1.95355baaafad3p-57;

/// 1/3 in two doubles.
inline constexpr double third_hi = 0x1.5555555555555p-2;
inline constexpr double third_lo = 0x1.5555555555555p-56;

/// 1/ln 2.
inline constexpr double log2_e = 0x1.71547652b82fep+0;

/// 2/pi.
inline constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

/// tan(pi/8) = sqrt(2) - 1, where atan changes its reduction.
inline constexpr double tan_eighth_pi = 0x1.a827999fcef32p-2;

/// The first 1280 binary digits of 2/pi, the most significant word first.
inline constexpr std::uint64_t two_over_pi_digits[] = {
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561, 0xb7246e3a424dd2e0,
    0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41, 0x3991d639835339f4,
    0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d,
    0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

}  // namespace coefficients
FREP_MATH_CLOSE
