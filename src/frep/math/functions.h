// The elementary functions for double and lanes: declarations and error bounds. Each kernel is written once,
// as a template over the lane type (exp_log.h, trig.h, inverse_trig.h, hyperbolic.h, power.h) and
// instantiated in kernels.cpp. Undefined is NaN. Checked against MPFR by tests/unit/math/kernels_test.cpp.
#pragma once

#include "frep/math/rounding.h"

FREP_MATH_OPEN

/// Stated error bounds in units in the last place of the exact result. Twice the true error of a kernel is at
/// most its bound + 1, so that end points stepped outward by bound + 1 enclose what the kernel computes
/// inside.
namespace ulp_bound {
inline constexpr int basic = 1;  ///< + - * / sqrt (correctly rounded: 1/2)
inline constexpr int exp = 1, log = 1, log10 = 1;
inline constexpr int sin = 1, cos = 1, tan = 1;
inline constexpr int asin = 1, acos = 1, atan = 1, atan2 = 1;
inline constexpr int sinh = 1, cosh = 1, tanh = 1;
inline constexpr int hypot = 2;
inline constexpr int pow = 2;         ///< exponents that do not take the chain
inline constexpr int r_function = 4;  ///< r_and, r_or; intervals step 2 * 4 + 1, see interval.h
/// powi(b, n) for n > 0 without underflow on the way: each product may double the error before it.
constexpr int powi(int n) { return n < 0 ? -n + 1 : (n > 1 ? n - 1 : 1); }
}  // namespace ulp_bound

#define FREP_MATH_UNARY(name) \
    double name(double x);    \
    template <int N>          \
    LanesN<N> name(LanesN<N> x);
#define FREP_MATH_BINARY(name)       \
    double name(double a, double b); \
    template <int N>                 \
    LanesN<N> name(LanesN<N> a, LanesN<N> b);

/// e^x; +inf above 709.78, 0 below -745.13.
FREP_MATH_UNARY(exp)
/// The natural logarithm; NaN for x <= 0.
FREP_MATH_UNARY(log)
/// The logarithm to base 10; NaN for x <= 0.
FREP_MATH_UNARY(log10)
/// Sine, cosine, tangent of x radians, any size; NaN for infinities. Near a pole tan is large and finite.
FREP_MATH_UNARY(sin)
FREP_MATH_UNARY(cos)
FREP_MATH_UNARY(tan)
/// Inverse sine in [-pi/2,pi/2] and cosine in [0,pi]; NaN outside [-1,1].
FREP_MATH_UNARY(asin)
FREP_MATH_UNARY(acos)
/// Inverse tangent in [-pi/2,pi/2].
FREP_MATH_UNARY(atan)
/// Hyperbolic sine, cosine, tangent.
FREP_MATH_UNARY(sinh)
FREP_MATH_UNARY(cosh)
FREP_MATH_UNARY(tanh)
/// The angle of the point (x = b, y = a) in (-pi, pi]. Zeros have no sign here: (y = +-0, x < 0) is pi, and
/// (+-0, +-0) is the zero y.
FREP_MATH_BINARY(atan2)
/// sqrt(a*a + b*b) without overflow or underflow on the way.
FREP_MATH_BINARY(hypot)
/// C's fmod: a - trunc(a/b)*b, exact, with the sign of a; NaN for b = 0 or infinite a.
FREP_MATH_BINARY(remainder_trunc)
/// a^b by rule 8 of numerics.md: an exponent less than 1e-6 above an integer n is that integer, taken by powi
/// up to |n| = 1024; others by exp(b ln a) in twice the precision. |a| < 1e-6 counts as 0: gives 0 for b > 0,
/// NaN for b = 0, +inf for b < 0. a < 0 with a fractional b is NaN.
FREP_MATH_BINARY(pow)
/// x^n by repeated squaring from the lowest bit of |n|; the reciprocal of that for n < 0; 1 for n = 0 (NaN
/// stays NaN). Knows nothing of pow's rule for small bases.
double powi(double x, int n);
template <int N>
LanesN<N> powi(LanesN<N> x, int n);

#undef FREP_MATH_UNARY
#undef FREP_MATH_BINARY

FREP_MATH_CLOSE
