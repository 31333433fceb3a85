// Helpers of the math tests: exact values from MPFR, errors in ulps, random doubles of several kinds, the
// number of cases to run. Method: 240-bit MPFR arithmetic, counter-based random numbers.
#pragma once

#include <mpfr.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "frep/math/number.h"

namespace oracle {

/// The number of cases: `normal`, or 50 times that with FREP_FULL=1.
inline long count(long normal) {
    const char* full = std::getenv("FREP_FULL");
    return full != nullptr && std::string(full) == "1" ? 50 * normal : normal;
}

/// A stream of 64-bit numbers (splitmix64, Steele, Lea and Flood 2014).
struct Random {
    std::uint64_t state;
    std::uint64_t next() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    double between(double a, double b) { return a + (b - a) * unit(); }
    /// Any bit pattern, with special values mixed in.
    double pattern() {
        static const double special[] = {0.0,
                                         -0.0,
                                         1.0,
                                         -1.0,
                                         frep::math::infinity,
                                         -frep::math::infinity,
                                         frep::math::quiet_nan,
                                         0x1p-1074,
                                         -0x1p-1074,
                                         0x1p-1022,
                                         frep::math::max_finite,
                                         -frep::math::max_finite,
                                         0.5,
                                         2.0,
                                         -2.0};
        const std::uint64_t w = next();
        if (w % 16 == 0) return special[(w >> 8) % 15];
        return frep::math::from_bits(next());
    }
    /// A magnitude 2^[low, high] with either sign.
    double magnitude(int low, int high) {
        const double m = 1.0 + unit();
        const int e = low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
        const double r = std::ldexp(m, e);
        return (next() & 1) != 0 ? -r : r;
    }
};

/// An MPFR number that frees itself.
struct Exact {
    mpfr_t v;
    Exact() { mpfr_init2(v, 240); }
    explicit Exact(double x) : Exact() { mpfr_set_d(v, x, MPFR_RNDN); }
    Exact(const Exact&) = delete;
    Exact& operator=(const Exact&) = delete;
    ~Exact() { mpfr_clear(v); }
};

/// |got - exact| in units in the last place of the exact value; 0 for NaN against NaN or a right overflow.
inline double ulps(double got, const Exact& exact) {
    if (mpfr_nan_p(exact.v) || got != got) return mpfr_nan_p(exact.v) && got != got ? 0.0 : INFINITY;
    if (mpfr_inf_p(exact.v) || std::isinf(got)) {
        if (mpfr_get_d(exact.v, MPFR_RNDN) == got) return 0.0;
        if (mpfr_inf_p(exact.v)) return INFINITY;
        // An infinite result just short of the overflow threshold: measure it as 2^1024.
        Exact top;
        mpfr_set_ui_2exp(top.v, 1, 1024, MPFR_RNDN);
        mpfr_sub(top.v, top.v, exact.v, MPFR_RNDN);
        return std::fabs(mpfr_get_d(top.v, MPFR_RNDN)) * 0x1p-971;
    }
    if (mpfr_zero_p(exact.v)) return got == 0.0 ? 0.0 : INFINITY;
    const long e = mpfr_get_exp(exact.v);
    const long unit = e - 53 < -1074 ? -1074 : e - 53;
    Exact difference;
    mpfr_d_sub(difference.v, got, exact.v, MPFR_RNDN);
    mpfr_mul_2si(difference.v, difference.v, -unit, MPFR_RNDN);
    return std::fabs(mpfr_get_d(difference.v, MPFR_RNDU));
}

using MpfrUnary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using MpfrBinary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// The same bits, or both NaN.
inline bool same(double a, double b) {
    return frep::math::to_bits(a) == frep::math::to_bits(b) || (a != a && b != b);
}

}  // namespace oracle
