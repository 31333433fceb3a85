// R-functions: the sign of min and max for every pair of doubles (random bit patterns, 10^6, with FREP_FULL=1
// 10^8), the values of the theory, and their stated error against MPFR.
#include <doctest/doctest.h>

#include <cstdio>

#include "oracle.h"

namespace fm = frep::math;
using fm::Lanes;
using oracle::Exact;
using oracle::Random;

TEST_CASE("R-functions have the sign of min and max, for doubles and lanes") {
    const char* full = std::getenv("FREP_FULL");
    const long pairs = full != nullptr && std::string(full) == "1" ? 100000000 : 1000000;
    Random random{41};
    long wrong = 0, unequal = 0;
    for (long i = 0; i < pairs; i += Lanes::size) {
        Lanes x, y;
        for (int k = 0; k < Lanes::size; ++k) {
            const double a = random.pattern();
            double b = random.pattern();
            if (random.next() % 8 == 0) b = random.next() % 2 ? -a : fm::step_up(-a, 1);
            x.set(k, a);
            y.set(k, b);
        }
        const Lanes u = fm::r_and(x, y), v = fm::r_or(x, y);
        for (int k = 0; k < Lanes::size; ++k) {
            const double a = x[k], b = y[k], c = fm::r_and(a, b), d = fm::r_or(a, b);
            unequal += !oracle::same(c, u[k]) || !oracle::same(d, v[k]);
            if (a != a || b != b) {
                wrong += c == c || d == d;
            } else {
                wrong += fm::sign(c) != fm::sign(fm::min(a, b)) || fm::sign(d) != fm::sign(fm::max(a, b));
                wrong += !(fm::abs(c) <= fm::r_limit) || !(fm::abs(d) <= fm::r_limit);
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(unequal == 0);
}

TEST_CASE("R-functions take the values of the theory") {
    CHECK(fm::r_and(3.0, 4.0) == doctest::Approx(2.0).epsilon(1e-15));
    CHECK(fm::r_or(3.0, 4.0) == 12.0);
    CHECK(fm::r_and(-3.0, 4.0) == doctest::Approx(-4.0).epsilon(1e-15));
    CHECK(fm::r_and(-3.0, -4.0) == -12.0);
    CHECK(fm::r_and(1.0, 1.0) == doctest::Approx(0.585786437627).epsilon(1e-12));
    CHECK(fm::r_or(1.0, 1.0) == doctest::Approx(3.414213562373).epsilon(1e-12));
    CHECK(fm::r_and(0.0, 5.0) == 0.0);
    CHECK(fm::r_and(0.0, 0.0) == 0.0);
    CHECK(fm::r_and(fm::infinity, fm::infinity) == fm::r_limit);
    CHECK(fm::r_and(fm::infinity, -fm::infinity) == -fm::r_limit);
    CHECK(fm::r_and(fm::infinity, 2.0) == 2.0);
    CHECK(fm::r_or(-fm::infinity, 2.0) == 2.0);
}

TEST_CASE("R-functions stay within their bound") {
    Random random{42};
    double worst = 0;
    for (long i = 0; i < oracle::count(200000); ++i) {
        const double a = i % 2 ? random.magnitude(-30, 30) : random.pattern();
        double b = i % 2 ? random.magnitude(-30, 30) : random.pattern();
        if (i % 5 == 0) b = -a * random.between(0.999, 1.001);
        if (i % 7 == 0) b = a * random.between(-1.1, 1.1);
        if (a != a || b != b || std::isinf(a) || std::isinf(b)) continue;
        Exact exact, x(a), y(b);
        mpfr_set_prec(exact.v, 2400);  // the plain formula cancels: give it all the digits it may need
        mpfr_set_prec(x.v, 2400);
        mpfr_set_prec(y.v, 2400);
        mpfr_set_d(x.v, a, MPFR_RNDN);
        mpfr_set_d(y.v, b, MPFR_RNDN);
        mpfr_hypot(exact.v, x.v, y.v, MPFR_RNDN);
        mpfr_sub(exact.v, y.v, exact.v, MPFR_RNDN);
        mpfr_add(exact.v, exact.v, x.v, MPFR_RNDN);
        if (mpfr_cmpabs(exact.v, x.v) == 0 && mpfr_zero_p(exact.v)) continue;
        const double c = fm::r_and(a, b);
        if (fm::abs(c) == fm::r_limit) continue;
        worst = std::fmax(worst, oracle::ulps(c, exact));
    }
    std::printf("  r_and max error %.4f ulp\n", worst);
    CHECK(worst <= fm::ulp_bound::r_function);
}

TEST_CASE("a chain of unions neither overflows nor turns undefined") {
    double f = 1.0;
    for (int i = 0; i < 2000; ++i) f = fm::r_or(f, 1.0 + i);
    CHECK(f > 0.0);
    CHECK(f <= fm::r_limit);
}
