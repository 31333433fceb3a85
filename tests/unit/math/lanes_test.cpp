// Lanes against double, lane by lane and bit by bit (all NaNs equal), for every function, on bit patterns and
// on ordinary numbers; then the exact functions against their definitions.
#include <doctest/doctest.h>

#include <cstdio>

#include "oracle.h"

namespace fm = frep::math;
using fm::Lanes;
using oracle::Random;

namespace {

struct Unary {
    const char* name;
    double (*point)(double);
    Lanes (*lanes)(Lanes);
};
struct Binary {
    const char* name;
    double (*point)(double, double);
    Lanes (*lanes)(Lanes, Lanes);
};
#define BOTH(f)                                                                 \
    {                                                                           \
#f, [](double x) { return fm::f(x); }, [](Lanes x) { return fm::f(x); } \
    }
#define BOTH2(f)                                                                                         \
    {                                                                                                    \
#f, [](double x, double y) { return fm::f(x, y); }, [](Lanes x, Lanes y) { return fm::f(x, y); } \
    }
#define OPERATOR(name, op)                                                                       \
    {                                                                                            \
        name, [](double x, double y) { return x op y; }, [](Lanes x, Lanes y) { return x op y; } \
    }

const Unary unary[] = {
    BOTH(abs),   BOTH(sign),  BOTH(square),
    BOTH(sqrt),  BOTH(floor), BOTH(ceil),
    BOTH(trunc), BOTH(exp),   BOTH(round_half_up),
    BOTH(log),   BOTH(log10), BOTH(sin),
    BOTH(cos),   BOTH(tan),   BOTH(asin),
    BOTH(acos),  BOTH(atan),  BOTH(sinh),
    BOTH(cosh),  BOTH(tanh),  {"neg", [](double x) { return -x; }, [](Lanes x) { return -x; }}};
const Binary binary[] = {
    BOTH2(min),   BOTH2(max),  BOTH2(atan2),     BOTH2(hypot),     BOTH2(remainder_trunc), BOTH2(pow),
    BOTH2(r_and), BOTH2(r_or), OPERATOR("+", +), OPERATOR("-", -), OPERATOR("*", *),       OPERATOR("/", /)};
#undef BOTH
#undef BOTH2
#undef OPERATOR

double argument(Random& r) {
    switch (r.next() % 4) {
        case 0:
            return r.pattern();
        case 1:
            return r.between(-1, 1);
        case 2:
            return r.magnitude(-12, 24);
        default:
            return std::floor(r.between(-6, 6)) * 0.5;
    }
}

}  // namespace

TEST_CASE("lanes equal doubles bit by bit") {
    for (const Unary& f : unary) {
        Random random{31};
        long wrong = 0;
        for (long i = 0; i < oracle::count(40000); ++i) {
            Lanes x;
            for (int k = 0; k < Lanes::size; ++k) x.set(k, argument(random));
            const Lanes y = f.lanes(x);
            for (int k = 0; k < Lanes::size; ++k) wrong += !oracle::same(y[k], f.point(x[k]));
        }
        INFO(f.name);
        CHECK(wrong == 0);
    }
    for (const Binary& f : binary) {
        Random random{32};
        long wrong = 0;
        for (long i = 0; i < oracle::count(40000); ++i) {
            Lanes x, y;
            for (int k = 0; k < Lanes::size; ++k) {
                x.set(k, argument(random));
                y.set(k, i % 4 == 0 && k > 0 ? y[0] : argument(random));
            }
            const Lanes z = f.lanes(x, y);
            for (int k = 0; k < Lanes::size; ++k) wrong += !oracle::same(z[k], f.point(x[k], y[k]));
        }
        INFO(f.name);
        CHECK(wrong == 0);
    }
    Random random{33};
    for (int n = -40; n <= 40; ++n) {
        Lanes x;
        for (int k = 0; k < Lanes::size; ++k) x.set(k, argument(random));
        const Lanes y = fm::powi(x, n);
        for (int k = 0; k < Lanes::size; ++k) CHECK(oracle::same(y[k], fm::powi(x[k], n)));
    }
}

TEST_CASE("exact functions follow their definitions") {
    Random random{34};
    long wrong = 0;
    for (long i = 0; i < oracle::count(300000); ++i) {
        const double x = i % 2 ? random.pattern() : random.magnitude(-3, 54);
        const double y = i % 2 ? random.pattern() : random.magnitude(-3, 54);
        wrong += !(fm::floor(x) == std::floor(x) || x != x);
        wrong += !(fm::ceil(x) == std::ceil(x) || x != x);
        wrong += !(fm::trunc(x) == std::trunc(x) || x != x);
        const double c = std::ceil(x);
        wrong += !(fm::round_half_up(x) == (c - x > 0.5 ? c - 1 : c) || x != x);
        wrong += !oracle::same(fm::sqrt(x), std::sqrt(x));
        const bool nan = x != x || y != y;
        wrong += !(nan ? fm::min(x, y) != fm::min(x, y) : fm::min(x, y) == std::fmin(x, y));
        wrong += !(nan ? fm::max(x, y) != fm::max(x, y) : fm::max(x, y) == std::fmax(x, y));
        wrong += !(fm::next_up(x) == std::nextafter(x, fm::infinity) || x != x);
        wrong += !(fm::next_down(x) == std::nextafter(x, -fm::infinity) || x != x);
    }
    CHECK(wrong == 0);
    CHECK(oracle::same(fm::min(-0.0, 0.0), -0.0));
    CHECK(oracle::same(fm::min(0.0, -0.0), -0.0));
    CHECK(oracle::same(fm::max(-0.0, 0.0), 0.0));
    CHECK(oracle::same(fm::max(0.0, -0.0), 0.0));
    CHECK(fm::round_half_up(2.5) == 3.0);
    CHECK(fm::round_half_up(-2.5) == -2.0);
    CHECK(fm::sign(-3.0) == -1.0);
    CHECK(fm::sign(fm::quiet_nan) != fm::sign(fm::quiet_nan));
    CHECK(fm::step_up(fm::max_finite, 5) == fm::infinity);
    CHECK(fm::step_down(fm::step_up(-0x1p-1074, 3), 3) == -0x1p-1074);
}

TEST_CASE("masks and lanes") {
    const double values[] = {1, -2, 3, fm::quiet_nan};
    const Lanes a = Lanes::load(values), b(0.0);
    const auto m = less(a, b);
    CHECK_FALSE(m[0]);
    CHECK(m[1]);
    CHECK(any(fm::less(a, b)));
    CHECK(fm::select(m, b, a)[1] == 0.0);
    CHECK_FALSE(all(m));
    CHECK(all(m | !m));
    CHECK(is_nan(a)[3]);
    CHECK(select(m, b, a)[1] == 0.0);
    CHECK(select(m, b, a)[2] == 3.0);
    double out[4];
    (a + 1.0).store(out);
    CHECK(out[2] == 4.0);
    CHECK(fm::constant<Lanes>(-0.0)[3] == 0.0);
    CHECK(std::signbit(fm::constant<Lanes>(-0.0)[3]));
    CHECK(fm::constant<fm::Interval>(2.0).lo == 2.0);
    CHECK(fm::constant<fm::Dual<Lanes>>(2.0).value[1] == 2.0);
}
