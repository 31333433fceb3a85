// pow and powi against MPFR, and rule 8 of numerics.md: snapped exponents, small bases, signs.
#include <doctest/doctest.h>

#include <cstdio>

#include "oracle.h"

namespace fm = frep::math;
using oracle::Exact;
using oracle::Random;

TEST_CASE("fractional and huge powers against MPFR") {
    Random random{21};
    double worst = 0, at_base = 0, at_exponent = 0;
    for (long i = 0; i < oracle::count(300000); ++i) {
        double b = i % 2 ? random.between(0, 10) : std::fabs(random.magnitude(-1000, 1000));
        double e = i % 3 == 0 ? random.magnitude(-10, 3) : random.between(-6, 6);
        if (i % 5 == 0) {  // near 1 with long exponents
            b = 1.0 + random.between(-0.01, 0.01);
            e = random.between(-70000, 70000);
        }
        if (i % 17 == 0) e = std::floor(e) * 1025;
        if (b < 1e-6 || e - std::floor(e) < 1e-6) {
            if (std::fabs(e) <= 1024 || b < 1e-6) continue;
        }
        Exact x(b), y(e);
        mpfr_pow(x.v, x.v, y.v, MPFR_RNDN);
        const double error = oracle::ulps(fm::pow(b, e), x);
        if (!(error <= worst)) worst = error, at_base = b, at_exponent = e;
    }
    std::printf("  pow max error %.4f ulp at %a ^ %a\n", worst, at_base, at_exponent);
    CHECK(2 * worst <= fm::ulp_bound::pow + 1);
}

TEST_CASE("powi stays within the bound of its chain") {
    Random random{22};
    long wrong = 0;
    double worst = 0;
    for (long i = 0; i < oracle::count(200000); ++i) {
        const int n = static_cast<int>(random.next() % 61) - 30;
        const double b = random.magnitude(-20, 20);
        Exact x(b);
        mpfr_pow_si(x.v, x.v, n, MPFR_RNDN);
        const double error = oracle::ulps(fm::powi(b, n), x);
        wrong += !(error <= fm::ulp_bound::powi(n));
        worst = std::fmax(worst, error);
    }
    std::printf("  powi |n| <= 30 max error %.4f ulp\n", worst);
    CHECK(wrong == 0);
}

TEST_CASE("rule 8: exponents, small bases, signs") {
    const double nan = fm::quiet_nan, inf = fm::infinity;
    const auto undefined = [](double x) { return x != x; };
    CHECK(fm::pow(3.0, 2.0) == 9.0);
    CHECK(fm::pow(3.0, 2.0000005) == 9.0);
    CHECK(fm::pow(3.0, 1.9999995) != 9.0);
    CHECK(fm::pow(-2.0, 3.0) == -8.0);
    CHECK(fm::pow(-2.0, -3.0) == -0.125);
    CHECK(fm::pow(2.0, 0.5) == 1.4142135623730951);
    CHECK(undefined(fm::pow(-2.0, 0.5)));
    CHECK(fm::pow(0.0, 0.5) == 0.0);
    CHECK(fm::pow(1e-7, 2.0) == 0.0);
    CHECK(fm::pow(-1e-7, 0.5) == 0.0);
    CHECK(undefined(fm::pow(0.0, 0.0)));
    CHECK(undefined(fm::pow(0.0, 1e-7)));
    CHECK(fm::pow(0.0, -1.0) == inf);
    CHECK(fm::pow(-0.0, -1.0) == inf);
    CHECK(fm::pow(5.0, 0.0) == 1.0);
    CHECK(fm::pow(inf, 0.5) == inf);
    CHECK(fm::pow(inf, -0.5) == 0.0);
    CHECK(fm::pow(-inf, 3.0) == -inf);
    CHECK(fm::pow(2.0, inf) == inf);
    CHECK(fm::pow(0.5, inf) == 0.0);
    CHECK(undefined(fm::pow(nan, 0.0)));
    CHECK(undefined(fm::pow(1.0, nan)));
    CHECK(fm::pow(-1.0, 4097.0) == -1.0);
    CHECK(fm::pow(-1.0, 4096.0) == 1.0);
    CHECK(fm::pow(-1.0000001, 5001.0) == doctest::Approx(-1.0005002).epsilon(1e-6));
    CHECK(fm::pow(10.0, 400.5) == inf);
    CHECK(fm::pow(10.0, -400.5) == 0.0);
    CHECK(fm::powi(2.0, 10) == 1024.0);
    CHECK(fm::powi(2.0, -1) == 0.5);
    CHECK(fm::powi(0.0, 0) == 1.0);
    CHECK(undefined(fm::powi(nan, 0)));
    CHECK(fm::powi(1e-7, 2) == 1e-7 * 1e-7);
    CHECK(fm::powi(1.0, INT32_MIN) == 1.0);
}
