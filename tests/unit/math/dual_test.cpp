// Dual numbers: derivatives against central differences at ordinary points, the rules at singular points, and
// no NaN in a derivative where the value is finite, on any bit patterns; double and lanes agree.
#include <doctest/doctest.h>

#include <cstdio>

#include "oracle.h"

namespace fm = frep::math;
using fm::Lanes;
using oracle::Random;
using D = fm::Dual<double>;
using DL = fm::Dual<Lanes>;

namespace {

struct Unary {
    const char* name;
    double (*point)(double);
    D (*dual)(const D&);
    DL (*lanes)(const DL&);
    double low, high;  // where it is smooth
};
struct Binary {
    const char* name;
    double (*point)(double, double);
    D (*dual)(const D&, const D&);
    DL (*lanes)(const DL&, const DL&);
    double low, high;
};
// clang-format off
#define ONE(f, a, b)                                                               \
    {#f, [](double x) { return fm::f(x); }, [](const D& x) { return fm::f(x); },   \
     [](const DL& x) { return fm::f(x); }, a, b}
#define TWO(f, a, b)                                                               \
    {#f, [](double x, double y) { return fm::f(x, y); },                           \
     [](const D& x, const D& y) { return fm::f(x, y); },                           \
     [](const DL& x, const DL& y) { return fm::f(x, y); }, a, b}
// clang-format on
const Unary unary[] = {ONE(sqrt, 0.1, 9),
                       ONE(square, -3, 3),
                       ONE(abs, 0.1, 3),
                       ONE(exp, -3, 3),
                       ONE(log, 0.1, 9),
                       ONE(log10, 0.1, 9),
                       ONE(sin, -9, 9),
                       ONE(cos, -9, 9),
                       ONE(tan, -1, 1),
                       ONE(asin, -0.9, 0.9),
                       ONE(acos, -0.9, 0.9),
                       ONE(atan, -5, 5),
                       ONE(sinh, -3, 3),
                       ONE(cosh, -3, 3),
                       ONE(tanh, -3, 3),
                       ONE(sign, 1, 2),
                       ONE(floor, 1.1, 1.9),
                       ONE(ceil, 1.1, 1.9),
                       ONE(trunc, 1.1, 1.9),
                       ONE(round_half_up, 1.6, 2.4),
                       {"neg", [](double x) { return -x; }, [](const D& x) { return -x; },
                        [](const DL& x) { return -x; }, -3, 3}};
const Binary binary[] = {TWO(hypot, 0.2, 4), TWO(atan2, 0.2, 4),        TWO(pow, 0.2, 4.0),
                         TWO(r_and, -4, 4),  TWO(r_or, -4, 4),          TWO(min, -4, 4),
                         TWO(max, -4, 4),    TWO(remainder_trunc, 1, 2)};
const Binary arithmetic[] = {
    {"+", [](double x, double y) { return x + y; }, [](const D& x, const D& y) { return x + y; },
     [](const DL& x, const DL& y) { return x + y; }, -4, 4},
    {"-", [](double x, double y) { return x - y; }, [](const D& x, const D& y) { return x - y; },
     [](const DL& x, const DL& y) { return x - y; }, -4, 4},
    {"*", [](double x, double y) { return x * y; }, [](const D& x, const D& y) { return x * y; },
     [](const DL& x, const DL& y) { return x * y; }, -4, 4},
    {"/", [](double x, double y) { return x / y; }, [](const D& x, const D& y) { return x / y; },
     [](const DL& x, const DL& y) { return x / y; }, 0.5, 4}};

bool total(const D& r) {
    if (r.value != r.value || fm::abs(r.value) == fm::infinity) return true;
    for (const double d : r.d) {
        if (!(fm::abs(d) <= fm::max_finite)) return false;
    }
    return true;
}
bool agrees(const D& a, const DL& b, int lane) {
    bool same = oracle::same(a.value, b.value[lane]);
    for (std::size_t i = 0; i < 3; ++i) same = same && oracle::same(a.d[i], b.d[i][lane]);
    return same;
}
D random_dual(Random& r) {
    const auto partial = [&] { return fm::finite(r.next() % 4 ? r.between(-2, 2) : r.pattern()); };
    return {r.pattern(), {partial(), partial(), partial()}};
}
DL four(const D (&x)[4]) {
    DL r;
    for (int k = 0; k < 4; ++k) {
        r.value.set(k, x[k].value);
        for (std::size_t i = 0; i < 3; ++i) r.d[i].set(k, x[k].d[i]);
    }
    return r;
}
template <class F>
double slope(F f, double x) {
    const double h = 1e-5;
    return (f(x + h) - f(x - h)) / (2 * h);
}
void check_binary(const Binary& f) {
    INFO(f.name);
    Random random{61};
    for (int i = 0; i < 200; ++i) {
        const double x = random.between(f.low, f.high), y = random.between(f.low, f.high) * 1.0001;
        if (std::fabs(x - y) < 1e-3 || std::fabs(y - std::round(y)) < 1e-3) continue;
        if (std::fabs(std::round(x / y) - x / y) < 1e-3) continue;
        const D r = f.dual(D::variable(x, 0), D::variable(y, 2));
        CHECK(r.d[0] == doctest::Approx(slope([&](double t) { return f.point(t, y); }, x)).epsilon(1e-5));
        CHECK(r.d[2] == doctest::Approx(slope([&](double t) { return f.point(x, t); }, y)).epsilon(1e-5));
        CHECK(r.d[1] == 0.0);
        CHECK(r.value == f.point(x, y));
    }
    long partial = 0, unequal = 0;
    for (long i = 0; i < oracle::count(20000); ++i) {
        D x[4], y[4];
        for (int k = 0; k < 4; ++k) x[k] = random_dual(random), y[k] = random_dual(random);
        const DL r = f.lanes(four(x), four(y));
        for (int k = 0; k < 4; ++k) {
            const D s = f.dual(x[k], y[k]);
            partial += !total(s);
            unequal += !agrees(s, r, k);
        }
    }
    CHECK(partial == 0);
    CHECK(unequal == 0);
}

}  // namespace

TEST_CASE("derivatives of one argument: slopes, totality, lanes") {
    for (const Unary& f : unary) {
        INFO(f.name);
        Random random{60};
        for (int i = 0; i < 200; ++i) {
            const double x = random.between(f.low, f.high);
            const D r = f.dual(D::variable(x, 1));
            CHECK(r.d[1] == doctest::Approx(slope(f.point, x)).epsilon(1e-5));
            CHECK(r.d[0] == 0.0);
            CHECK(r.value == f.point(x));
        }
        long partial = 0, unequal = 0;
        for (long i = 0; i < oracle::count(20000); ++i) {
            D x[4];
            for (D& v : x) v = random_dual(random);
            const DL r = f.lanes(four(x));
            for (int k = 0; k < 4; ++k) {
                const D s = f.dual(x[k]);
                partial += !total(s);
                unequal += !agrees(s, r, k);
            }
        }
        CHECK(partial == 0);
        CHECK(unequal == 0);
    }
}

TEST_CASE("derivatives of two arguments: slopes, totality, lanes") {
    for (const Binary& f : binary) check_binary(f);
    for (const Binary& f : arithmetic) check_binary(f);
}

TEST_CASE("derivatives at singular points") {
    const auto at = [](double v, int i) { return D::variable(v, i); };
    CHECK(fm::r_and(at(0, 0), at(0, 1)).d[0] == 1.0);
    CHECK(fm::r_or(at(0, 0), at(0, 1)).d[1] == 1.0);
    CHECK(fm::min(at(2, 0), at(2, 1)).d[0] == 0.5);
    CHECK(fm::max(at(2, 0), at(2, 1)).d[1] == 0.5);
    CHECK(fm::sqrt(at(0, 0)).d[0] == 0.0);
    CHECK(fm::abs(at(0, 0)).d[0] == 0.0);
    CHECK(fm::hypot(at(0, 0), at(0, 1)).d[0] == 0.0);
    CHECK(fm::atan2(at(0, 0), at(0, 1)).d[0] == 0.0);
    CHECK(fm::floor(at(1.5, 0)).d[0] == 0.0);
    CHECK(fm::sqrt(at(0x1p-1074, 0)).d[0] > 1e160);
    CHECK((at(1, 0) / at(0x1p-1074, 1)).d[0] == fm::max_finite);
    CHECK(fm::powi(at(3, 0), 3).d[0] == 27.0);
    CHECK(fm::powi(at(3, 0), 0).d[0] == 0.0);
    CHECK(fm::pow(at(3, 0), D(2.0000001)).d[0] == 6.0);
    CHECK(fm::pow(at(0, 0), D(2.0)).d[0] == 0.0);
    CHECK(fm::r_and(at(fm::infinity, 0), at(2, 1)).d[1] == 1.0);
    CHECK(fm::r_and(at(fm::infinity, 0), at(2, 1)).d[0] == 0.0);
    const D picked = select(less(at(1, 0), at(2, 1)), at(1, 0), at(2, 1));
    CHECK(picked.d[0] == 1.0);
    CHECK(picked.d[1] == 0.0);
}
