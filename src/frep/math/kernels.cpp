// The one place where the kernels are instantiated, for double and for the lane widths in use.
// Checked by tests/unit/math/kernels_test.cpp (MPFR) and lanes_test.cpp (scalar and lanes bit by bit).
#include "frep/math/functions.h"
#include "frep/math/hyperbolic.h"
#include "frep/math/inverse_trig.h"
#include "frep/math/power.h"
#include "frep/math/remainder.h"
#include "frep/math/rfunctions.h"
#include "frep/math/trig.h"

FREP_MATH_OPEN

namespace kernel {
template <LaneType T>
inline T hypot(T a, T b) {
    const T x = abs(a), y = abs(b);
    const auto swap = less(x, y);
    const T r = hypot_ordered(select(swap, y, x), select(swap, x, y));
    const T value = select(equal(select(swap, y, x), T(infinity)), T(infinity), r);
    return select(is_nan(a), a, select(is_nan(b), b, value));
}
}  // namespace kernel

// The width of the engines, and that of one register where it is more.
#if defined(__AVX512F__)
#define FREP_MATH_WIDTHS(name)          \
    template LanesN<4> name(LanesN<4>); \
    template LanesN<8> name(LanesN<8>);
#define FREP_MATH_WIDTHS_2(name)                   \
    template LanesN<4> name(LanesN<4>, LanesN<4>); \
    template LanesN<8> name(LanesN<8>, LanesN<8>);
#else
#define FREP_MATH_WIDTHS(name) template LanesN<4> name(LanesN<4>);
#define FREP_MATH_WIDTHS_2(name) template LanesN<4> name(LanesN<4>, LanesN<4>);
#endif

#define FREP_MATH_UNARY(name)                         \
    double name(double x) { return kernel::name(x); } \
    template <int N>                                  \
    LanesN<N> name(LanesN<N> x) {                     \
        return kernel::name(x);                       \
    }                                                 \
    FREP_MATH_WIDTHS(name)
#define FREP_MATH_BINARY(name)                                     \
    double name(double a, double b) { return kernel::name(a, b); } \
    template <int N>                                               \
    LanesN<N> name(LanesN<N> a, LanesN<N> b) {                     \
        return kernel::name(a, b);                                 \
    }                                                              \
    FREP_MATH_WIDTHS_2(name)

FREP_MATH_UNARY(exp)
FREP_MATH_UNARY(log)
FREP_MATH_UNARY(log10)
FREP_MATH_UNARY(sin)
FREP_MATH_UNARY(cos)
FREP_MATH_UNARY(tan)
FREP_MATH_UNARY(asin)
FREP_MATH_UNARY(acos)
FREP_MATH_UNARY(atan)
FREP_MATH_UNARY(sinh)
FREP_MATH_UNARY(cosh)
FREP_MATH_UNARY(tanh)
FREP_MATH_BINARY(atan2)
FREP_MATH_BINARY(hypot)
FREP_MATH_BINARY(remainder_trunc)
FREP_MATH_BINARY(pow)

double powi(double x, int n) { return kernel::powi(x, n); }
template <int N>
LanesN<N> powi(LanesN<N> x, int n) {
    return kernel::powi(x, n);
}
template LanesN<4> powi(LanesN<4>, int);
#if defined(__AVX512F__)
template LanesN<8> powi(LanesN<8>, int);
#endif

FREP_MATH_CLOSE
