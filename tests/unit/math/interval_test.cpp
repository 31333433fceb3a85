// Intervals: random boxes, random points in them; the double kernel's value and MPFR's exact value must lie
// inside, and an undefined value must be announced. Then cases where the flag must not be set, and tightness.
#include <doctest/doctest.h>

#include <cstdio>

#include "oracle.h"

using frep::math::Interval;
namespace fm = frep::math;
using oracle::Exact;
using oracle::Random;

namespace {

/// A random interval of one of several kinds: a point, narrow, wide, of small integers, any bit patterns.
Interval random_interval(Random& r) {
    const auto ordered = [](double a, double b) { return a <= b ? Interval(a, b) : Interval(b, a); };
    switch (r.next() % 7) {
        case 0:
            return Interval(r.magnitude(-20, 20));
        case 1: {
            const double x = r.magnitude(-4, 6);
            return ordered(x, x + r.between(0, 1) * std::ldexp(1.0, -static_cast<int>(r.next() % 40)));
        }
        case 2:
            return ordered(r.between(-8, 8), r.between(-8, 8));
        case 3:
            return ordered(std::floor(r.between(-5, 5)), std::floor(r.between(-5, 5)));
        case 4:
            return ordered(r.magnitude(-300, 300), r.magnitude(-300, 300));
        case 5:
            return ordered(r.between(-1, 1), r.between(-1, 1));
        default: {
            const double a = r.pattern(), b = r.pattern();
            return a != a || b != b ? Interval(0.0, 1.0) : ordered(a, b);
        }
    }
}
/// A point of the interval: an end, 0, or one in between (also by bit pattern).
double point_of(const Interval& a, Random& r) {
    switch (r.next() % 6) {
        case 0:
            return a.lo;
        case 1:
            return a.hi;
        case 2:
            return a.contains(0.0) ? 0.0 : a.lo;
        case 3:
            return fm::min(a.hi, fm::step_up(a.lo, static_cast<int>(r.next() % 1000)));
        default: {
            const double lo = fm::max(a.lo, -fm::max_finite), hi = fm::min(a.hi, fm::max_finite);
            const double t = r.unit();
            const double x = lo * (1 - t) + hi * t;
            return a.contains(x) ? x : a.hi;
        }
    }
}
bool encloses(const Interval& r, double value) {
    return value != value ? r.maybe_undefined : r.contains(value);
}
bool encloses(const Interval& r, const Exact& e) {
    if (mpfr_nan_p(e.v)) return true;  // judged by the kernel's value
    return mpfr_cmp_d(e.v, r.lo) >= 0 && mpfr_cmp_d(e.v, r.hi) <= 0;
}

struct Unary {
    const char* name;
    Interval (*box)(Interval);
    double (*point)(double);
    oracle::MpfrUnary exact;
};
struct Binary {
    const char* name;
    Interval (*box)(Interval, Interval);
    double (*point)(double, double);
    oracle::MpfrBinary exact;
};

int exact_log(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t m) {
    if (mpfr_zero_p(x)) return mpfr_set_nan(r), 0;
    return mpfr_log(r, x, m);
}
int exact_log10(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t m) {
    if (mpfr_zero_p(x)) return mpfr_set_nan(r), 0;
    return mpfr_log10(r, x, m);
}
int exact_div(mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t m) { return mpfr_div(r, x, y, m); }
int exact_atan2(mpfr_ptr r, mpfr_srcptr y, mpfr_srcptr x, mpfr_rnd_t m) {
    Exact a, b;
    mpfr_set(a.v, y, m);
    mpfr_set(b.v, x, m);
    if (mpfr_zero_p(a.v)) mpfr_set_zero(a.v, 1);
    if (mpfr_zero_p(b.v)) mpfr_set_zero(b.v, 1);
    return mpfr_atan2(r, a.v, b.v, m);
}

const Unary unary[] = {
    {"neg", [](Interval a) { return -a; }, [](double a) { return -a; }, mpfr_neg},
    {"abs", fm::abs, fm::abs<double>, mpfr_abs},
    {"sign", fm::sign, fm::sign<double>, nullptr},
    {"floor", fm::floor, fm::floor<double>, nullptr},
    {"ceil", fm::ceil, fm::ceil<double>, nullptr},
    {"trunc", fm::trunc, fm::trunc<double>, nullptr},
    {"round_half_up", fm::round_half_up, fm::round_half_up<double>, nullptr},
    {"square", fm::square, fm::square<double>, mpfr_sqr},
    {"sqrt", fm::sqrt, fm::sqrt, mpfr_sqrt},
    {"exp", fm::exp, fm::exp, mpfr_exp},
    {"log", fm::log, fm::log, exact_log},
    {"log10", fm::log10, fm::log10, exact_log10},
    {"sin", fm::sin, fm::sin, mpfr_sin},
    {"cos", fm::cos, fm::cos, mpfr_cos},
    {"tan", fm::tan, fm::tan, mpfr_tan},
    {"asin", fm::asin, fm::asin, mpfr_asin},
    {"acos", fm::acos, fm::acos, mpfr_acos},
    {"atan", fm::atan, fm::atan, mpfr_atan},
    {"sinh", fm::sinh, fm::sinh, mpfr_sinh},
    {"cosh", fm::cosh, fm::cosh, mpfr_cosh},
    {"tanh", fm::tanh, fm::tanh, mpfr_tanh},
};
const Binary binary[] = {
    {"add", [](Interval a, Interval b) { return a + b; }, [](double a, double b) { return a + b; }, mpfr_add},
    {"sub", [](Interval a, Interval b) { return a - b; }, [](double a, double b) { return a - b; }, mpfr_sub},
    {"mul", [](Interval a, Interval b) { return a * b; }, [](double a, double b) { return a * b; }, mpfr_mul},
    {"div", [](Interval a, Interval b) { return a / b; }, [](double a, double b) { return a / b; },
     exact_div},
    {"min", fm::min, fm::min<double>, mpfr_min},
    {"max", fm::max, fm::max<double>, mpfr_max},
    {"remainder_trunc", fm::remainder_trunc, fm::remainder_trunc, nullptr},
    {"hypot", fm::hypot, fm::hypot, mpfr_hypot},
    {"atan2", fm::atan2, fm::atan2, exact_atan2},
    {"pow", fm::pow, fm::pow, nullptr},
    {"r_and", fm::r_and, fm::r_and<double>, nullptr},
    {"r_or", fm::r_or, fm::r_or<double>, nullptr},
};

}  // namespace

TEST_CASE("intervals of functions of one argument enclose kernel and exact values") {
    for (const Unary& f : unary) {
        Random random{11};
        long wrong = 0;
        for (long i = 0; i < oracle::count(20000); ++i) {
            const Interval a = random_interval(random);
            const Interval r = f.box(a);
            for (int k = 0; k < 4; ++k) {
                const double x = point_of(a, random);
                const double y = f.point(x);
                Exact e(x);
                if (f.exact != nullptr) f.exact(e.v, e.v, MPFR_RNDN);
                const bool good = encloses(r, y) && (f.exact == nullptr || y != y || encloses(r, e));
                if (good) continue;
                if (++wrong > 3) continue;
                std::printf("    %s([%a,%a]) = [%a,%a]%d misses f(%a) = %a\n", f.name, a.lo, a.hi, r.lo, r.hi,
                            r.maybe_undefined, x, y);
            }
        }
        INFO(f.name);
        CHECK(wrong == 0);
    }
}

TEST_CASE("intervals of functions of two arguments enclose kernel and exact values") {
    for (const Binary& f : binary) {
        Random random{12};
        long wrong = 0;
        for (long i = 0; i < oracle::count(30000); ++i) {
            const Interval a = random_interval(random), b = random_interval(random);
            const Interval r = f.box(a, b);
            for (int k = 0; k < 5; ++k) {
                const double x = point_of(a, random), y = point_of(b, random);
                const double z = f.point(x, y);
                Exact e(x), g(y);
                if (f.exact != nullptr) f.exact(e.v, e.v, g.v, MPFR_RNDN);
                const bool good = encloses(r, z) && (f.exact == nullptr || z != z || encloses(r, e));
                if (good) continue;
                if (++wrong > 3) continue;
                std::printf("    %s([%a,%a],[%a,%a]) = [%a,%a]%d misses f(%a,%a) = %a\n", f.name, a.lo, a.hi,
                            b.lo, b.hi, r.lo, r.hi, r.maybe_undefined, x, y, z);
            }
        }
        INFO(f.name);
        CHECK(wrong == 0);
    }
}

TEST_CASE("intervals of powers enclose the chain and the exact power") {
    Random random{13};
    long wrong = 0;
    for (long i = 0; i < oracle::count(40000); ++i) {
        const Interval a = random_interval(random);
        const int n = static_cast<int>(random.next() % 41) - 20;
        const double fraction = i % 2 ? random.between(-3, 3) : n;
        const Interval r = fm::powi(a, n), p = fm::pow(a, Interval(fraction));
        for (int k = 0; k < 4; ++k) {
            const double x = point_of(a, random);
            Exact e(x), g(fraction);
            mpfr_pow_si(e.v, e.v, n, MPFR_RNDN);
            const double y = fm::powi(x, n);
            bool good = encloses(r, y) && (x == 0.0 || y != y || encloses(r, e));
            mpfr_set_d(e.v, x, MPFR_RNDN);
            mpfr_pow(e.v, e.v, g.v, MPFR_RNDN);
            const double z = fm::pow(x, fraction);
            good = good && encloses(p, z) && (fm::abs(x) < 1e-6 || z != z || encloses(p, e));
            if (!good && ++wrong <= 3) {
                std::printf("    [%a,%a]^%d or ^%a: [%a,%a] [%a,%a] misses %a^: %a %a\n", a.lo, a.hi, n,
                            fraction, r.lo, r.hi, p.lo, p.hi, x, y, z);
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("maybe_undefined is tight and bounds respect the sign") {
    const Interval unit(0.0, 1.0), all = Interval::entire();
    CHECK_FALSE(fm::sqrt(fm::square(Interval(-2, 3)) + fm::square(Interval(-1, 1))).maybe_undefined);
    CHECK(fm::sqrt(Interval(-1, 4)).maybe_undefined);
    CHECK(fm::sqrt(Interval(-1, 4)).lo == 0.0);
    CHECK(fm::sqrt(Interval(-2, -1)).is_empty());
    CHECK(fm::sqrt(Interval(0.0)).hi == 0.0);
    CHECK((all - all).maybe_undefined);
    CHECK((Interval(fm::infinity) - Interval(fm::infinity)).is_empty());
    CHECK_FALSE((Interval(1, 2) - unit).maybe_undefined);
    CHECK((unit * all).maybe_undefined);
    CHECK_FALSE((Interval(1, 2) * all).maybe_undefined);
    CHECK((unit * unit).lo == 0.0);
    CHECK((unit + unit).lo == 0.0);
    CHECK_FALSE((Interval(1, 2) / unit).maybe_undefined);
    CHECK((Interval(1, 2) / unit).lo == -fm::infinity);
    CHECK((unit / unit).maybe_undefined);
    CHECK((Interval(0.0) / Interval(0.0)).is_empty());
    CHECK(fm::log(unit).maybe_undefined);
    CHECK_FALSE(fm::log(Interval(1e-300, 1)).maybe_undefined);
    CHECK(fm::log(Interval(-1, 0)).is_empty());
    CHECK(fm::asin(Interval(0, 1.5)).maybe_undefined);
    CHECK_FALSE(fm::asin(Interval(-1, 1)).maybe_undefined);
    CHECK(fm::acos(Interval(2, 3)).is_empty());
    CHECK(fm::sin(all).maybe_undefined);
    CHECK_FALSE(fm::sin(Interval(0, 1e300)).maybe_undefined);
    CHECK(fm::exp(Interval(-800, -790)).lo == 0.0);
    CHECK(fm::hypot(unit, Interval(0.0)).lo == 0.0);
    CHECK(fm::remainder_trunc(Interval(7, 7.5), Interval(2.0)).lo == 1.0);
    CHECK(fm::remainder_trunc(Interval(7, 7.5), Interval(2.0)).hi == 1.5);
    CHECK(fm::remainder_trunc(Interval(7, 7.5), unit).maybe_undefined);
    CHECK_FALSE(fm::pow(Interval(-2, 2), Interval(2.0)).maybe_undefined);
    CHECK(fm::pow(Interval(-2, 2), Interval(2.0)).lo == 0.0);
    CHECK(fm::pow(Interval(-2, 2), Interval(0.5)).maybe_undefined);
    CHECK_FALSE(fm::pow(unit, Interval(0.5)).maybe_undefined);
    CHECK(fm::pow(unit, Interval(0.0)).maybe_undefined);
    CHECK(fm::tan(Interval(1, 2)).hi == fm::infinity);
    CHECK_FALSE(fm::tan(Interval(1, 2)).maybe_undefined);
    CHECK(fm::sin(Interval(1, 2)).hi == 1.0);
    CHECK(fm::sin(Interval(1, 1.5)).hi < 1.0);
    CHECK((Interval(fm::quiet_nan) + unit).is_empty());
    CHECK(fm::min(Interval::empty(), unit).is_empty());
}

TEST_CASE("comparison and selection of intervals") {
    const Interval a(0, 1), b(2, 3), c(0.5, 2.5);
    CHECK(less(a, b).surely_true());
    CHECK(less(b, a).surely_false());
    CHECK(less(a, c).can_be_true);
    CHECK(less(a, c).can_be_false);
    CHECK(less(a.flagged(true), b).can_be_false);
    CHECK(less(Interval::empty(), b).surely_false());
    CHECK(equal(Interval(1.0), Interval(1.0)).surely_true());
    CHECK(equal(a, b).surely_false());
    CHECK(less_equal(a, Interval(1, 2)).surely_true());
    CHECK(is_nan(Interval::empty()).surely_true());
    CHECK(is_nan(a).surely_false());
    CHECK((!less(a, b)).surely_false());
    CHECK((less(a, b) & less(a, c)).can_be_false);
    const Interval u = select(less(a, c), a, b);
    CHECK(u.lo == 0.0);
    CHECK(u.hi == 3.0);
    CHECK_FALSE(u.maybe_undefined);
    const Interval v = select(less(a, c), Interval::empty(), b);
    CHECK(v.lo == 2.0);
    CHECK(v.maybe_undefined);
    CHECK_FALSE(select(less(a, b), a, Interval::empty()).maybe_undefined);
}

TEST_CASE("intervals of R-functions keep the sign of min and max") {
    Random random{14};
    long wrong = 0;
    const auto sign_of = [](double x) { return fm::sign(x); };
    for (long i = 0; i < oracle::count(200000); ++i) {
        const Interval a = random_interval(random), b = random_interval(random);
        const Interval c = fm::r_and(a, b), m = fm::min(a, b), d = fm::r_or(a, b), n = fm::max(a, b);
        wrong += sign_of(c.lo) != sign_of(m.lo) || sign_of(c.hi) != sign_of(m.hi);
        wrong += sign_of(d.lo) != sign_of(n.lo) || sign_of(d.hi) != sign_of(n.hi);
    }
    CHECK(wrong == 0);
}

TEST_CASE("the whole line over one infinity") {
    const Interval one(fm::infinity, fm::infinity);
    const Interval c = Interval::entire() / one;
    CHECK(c.contains(0.0));    // any finite number over infinity
    CHECK(c.maybe_undefined);  // infinity over infinity
}
