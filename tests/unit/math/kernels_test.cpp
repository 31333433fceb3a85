// The elementary functions against MPFR: random arguments over the ranges in use, and random bit patterns.
#include <doctest/doctest.h>

#include <cstdio>

#include "oracle.h"

namespace fm = frep::math;
using oracle::Exact;
using oracle::Random;

namespace {

struct Case {
    const char* name;
    double (*ours)(double);
    oracle::MpfrUnary exact;
    int bound;
    double low, high;       // uniform arguments
    int smallest, largest;  // exponents of log-uniform arguments
};

const Case cases[] = {
    {"exp", fm::exp, mpfr_exp, fm::ulp_bound::exp, -746, 711, -60, 9},
    {"log", fm::log, mpfr_log, fm::ulp_bound::log, 0, 4, -1074, 1023},
    {"log10", fm::log10, mpfr_log10, fm::ulp_bound::log10, 0, 4, -1074, 1023},
    {"sin", fm::sin, mpfr_sin, fm::ulp_bound::sin, -50, 50, -40, 1023},
    {"cos", fm::cos, mpfr_cos, fm::ulp_bound::cos, -50, 50, -40, 1023},
    {"tan", fm::tan, mpfr_tan, fm::ulp_bound::tan, -50, 50, -40, 1023},
    {"asin", fm::asin, mpfr_asin, fm::ulp_bound::asin, -1, 1, -60, -1},
    {"acos", fm::acos, mpfr_acos, fm::ulp_bound::acos, -1, 1, -60, -1},
    {"atan", fm::atan, mpfr_atan, fm::ulp_bound::atan, -5, 5, -60, 60},
    {"sinh", fm::sinh, mpfr_sinh, fm::ulp_bound::sinh, -30, 30, -60, 9},
    {"cosh", fm::cosh, mpfr_cosh, fm::ulp_bound::cosh, -30, 30, -60, 9},
    {"tanh", fm::tanh, mpfr_tanh, fm::ulp_bound::tanh, -30, 30, -60, 6},
};

/// Rule 5: log is undefined at 0 too.
double error(const Case& c, double x) {
    Exact y(x);
    c.exact(y.v, y.v, MPFR_RNDN);
    if (mpfr_inf_p(y.v) && x == 0.0) mpfr_set_nan(y.v);
    return oracle::ulps(c.ours(x), y);
}

}  // namespace

TEST_CASE("elementary functions stay within their stated ulp bounds") {
    for (const Case& c : cases) {
        Random random{0x5eed};
        double worst = 0, at = 0;
        const long n = oracle::count(70000);
        for (long i = 0; i < 3 * n; ++i) {
            const double x = i % 3 == 0   ? random.between(c.low, c.high)
                             : i % 3 == 1 ? random.magnitude(c.smallest, c.largest)
                                          : random.pattern();
            const double e = error(c, x);
            if (!(e <= worst)) worst = e, at = x;
        }
        std::printf("  %-6s %8ld arguments, max error %.4f ulp at %a\n", c.name, 3 * n, worst, at);
        INFO(c.name << " at " << at);
        // Twice the error stays below bound + 1: the condition of ulp_bound (functions.h).
        CHECK(2 * worst <= c.bound + 1);
    }
}

TEST_CASE("trigonometric functions near multiples of pi/2") {
    for (const Case& c : cases) {
        if (c.exact != mpfr_sin && c.exact != mpfr_cos && c.exact != mpfr_tan) continue;
        Random random{7};
        double worst = 0, at = 0;
        for (long i = 0; i < oracle::count(20000); ++i) {
            const double k =
                std::floor(random.unit() * std::ldexp(1.0, static_cast<int>(random.next() % 40)));
            double x = k * 1.5707963267948966;
            x = fm::step_up(x, static_cast<int>(random.next() % 5));
            const double e = error(c, x);
            if (!(e <= worst)) worst = e, at = x;
        }
        // The double nearest to a multiple of pi/2, relatively (Muller et al., Handbook of floating-point).
        const double hard = error(c, 0x1.6ac5b262ca1ffp+849);
        std::printf("  %-6s near k pi/2: %.4f ulp at %a, hardest %.4f\n", c.name, worst, at, hard);
        CHECK(2 * worst <= c.bound + 1);
        CHECK(2 * hard <= c.bound + 1);
    }
}

TEST_CASE("atan2 and hypot against MPFR") {
    Random random{99};
    double worst_angle = 0, worst_length = 0;
    for (long i = 0; i < oracle::count(200000); ++i) {
        const double a = i % 2 ? random.pattern() : random.magnitude(-30, 30);
        const double b = i % 2 ? random.pattern() : random.magnitude(-30, 30);
        Exact x(b), y(a), r;
        mpfr_hypot(r.v, y.v, x.v, MPFR_RNDN);
        if (a != a || b != b) mpfr_set_nan(r.v);  // rule 5: undefined even beside an infinity
        worst_length = std::fmax(worst_length, oracle::ulps(fm::hypot(a, b), r));
        if (b == 0) mpfr_set_zero(x.v, 1);  // zeros have no sign in our atan2
        if (a == 0) mpfr_set_zero(y.v, 1);
        mpfr_atan2(r.v, y.v, x.v, MPFR_RNDN);
        const double e = oracle::ulps(fm::atan2(a, b), r);
        worst_angle = std::fmax(worst_angle, e);
    }
    std::printf("  atan2 max error %.4f ulp, hypot %.4f ulp\n", worst_angle, worst_length);
    CHECK(2 * worst_angle <= fm::ulp_bound::atan2 + 1);
    CHECK(2 * worst_length <= fm::ulp_bound::hypot + 1);
}

TEST_CASE("special values") {
    CHECK(oracle::same(fm::exp(-fm::infinity), 0.0));
    CHECK(fm::exp(fm::infinity) == fm::infinity);
    CHECK(fm::exp(0.0) == 1.0);
    CHECK(fm::log(1.0) == 0.0);
    CHECK(fm::log(0.0) != fm::log(0.0));
    CHECK(fm::log(-1.0) != fm::log(-1.0));
    CHECK(fm::log10(1000.0) == 3.0);
    using Unary = double (*)(double);
    for (const Unary f : {Unary(fm::sin), Unary(fm::tan), Unary(fm::asin), Unary(fm::atan), Unary(fm::sinh),
                          Unary(fm::tanh)}) {
        CHECK(oracle::same(f(-0.0), -0.0));
        CHECK(oracle::same(f(0.0), 0.0));
    }
    CHECK(fm::cos(0.0) == 1.0);
    CHECK(fm::acos(1.0) == 0.0);
    CHECK(fm::acos(-1.0) == fm::pi);
    CHECK(fm::asin(1.0) == fm::half_pi);
    CHECK(fm::asin(1.0000000000000002) != fm::asin(1.0000000000000002));
    CHECK(fm::tan(fm::half_pi) == doctest::Approx(1.633123935319537e16));
    CHECK(fm::sin(fm::infinity) != fm::sin(fm::infinity));
    CHECK(fm::atan2(0.0, -1.0) == fm::pi);
    CHECK(fm::atan2(-0.0, -1.0) == fm::pi);
    CHECK(fm::atan2(0.0, 0.0) == 0.0);
    CHECK(fm::atan2(-fm::infinity, fm::infinity) == -fm::half_pi / 2);
    CHECK(fm::hypot(3.0, -4.0) == 5.0);
    CHECK(fm::hypot(1e300, 1e300) == doctest::Approx(1.4142135623730951e300));
}
