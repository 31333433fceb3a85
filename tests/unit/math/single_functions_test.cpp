// The kernels of binary32 against those of binary64 (whose error is a billionth of the bounds here), over
// floats in steps, at special points and bit patterns; exact functions against their definitions; the widths
// against each other. The bounds are those stated at the functions.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "oracle.h"

namespace fm = frep::math;
using Four = fm::SinglesN<4>;
using Eight = fm::SinglesN<8>;
using oracle::Random;

namespace {

std::uint32_t bits(float x) {
    std::uint32_t w;
    std::memcpy(&w, &x, sizeof w);
    return w;
}
float from_bits(std::uint32_t w) {
    float x;
    std::memcpy(&x, &w, sizeof x);
    return x;
}
bool same(float a, float b) { return (a != a && b != b) || bits(a) == bits(b); }

/// |got - exact| in units in the last place of a float of the size of `exact`; infinite where one is NaN and
/// the other is not, or one is infinite and the other does not round to that.
double ulps(float got, double exact) {
    if (exact != exact || got != got) return exact != exact && got != got ? 0.0 : INFINITY;
    const float nearest = static_cast<float>(exact);
    if (std::isinf(nearest) || std::isinf(got)) {
        if (got == nearest) return 0.0;
        if (std::isinf(exact) || !(std::abs(exact) < 0x1.000001p128)) return INFINITY;
        got = std::isinf(got) ? std::copysign(0x1.fffffep127f, got) : got;
        return 1.0 + std::abs(static_cast<double>(got) - exact) / 0x1p104;
    }
    int exponent = 0;
    std::frexp(exact, &exponent);
    return std::abs(static_cast<double>(got) - exact) / std::ldexp(1.0, std::max(exponent - 24, -149));
}

struct Function {
    const char* name;
    Four (*kernel)(Four);
    double (*exact)(double);
    double bound;
};
const Function functions[] = {
    {"exp", [](Four x) { return fm::exp(x); }, [](double x) { return fm::exp(x); }, 2.0},
    {"log", [](Four x) { return fm::log(x); }, [](double x) { return fm::log(x); }, 1.0},
    {"sin", [](Four x) { return fm::sin(x); }, [](double x) { return fm::sin(x); }, 2.0},
    {"cos", [](Four x) { return fm::cos(x); }, [](double x) { return fm::cos(x); }, 2.0},
    {"atan", [](Four x) { return fm::atan(x); }, [](double x) { return fm::atan(x); }, 2.0},
};

/// Largest error over the floats first, first + step, ... of both signs.
double worst_over_all(const Function& f, std::uint32_t step, float& where) {
    double worst = 0;
    for (std::uint64_t w = step / 2; w < 0x100000000u; w += 4ull * step) {
        Four x;
        for (int i = 0; i < 4; ++i)
            x.set(i, from_bits(static_cast<std::uint32_t>(w + static_cast<std::uint64_t>(i) * step)));
        const Four y = f.kernel(x);
        for (int i = 0; i < 4; ++i) {
            const double e = ulps(y[i], f.exact(static_cast<double>(x[i])));
            if (!(e <= worst)) {
                worst = e;
                where = x[i];
            }
        }
    }
    return worst;
}

float argument(Random& r) {
    switch (r.next() % 4) {
        case 0:
            return from_bits(static_cast<std::uint32_t>(r.next()));
        case 1:
            return static_cast<float>(r.between(-1, 1));
        case 2:
            return static_cast<float>(r.magnitude(-12, 14));
        default:
            return static_cast<float>(std::floor(r.between(-6, 6)) * 0.5);
    }
}

}  // namespace

TEST_CASE("binary32: stated error bounds over the floats") {
    // 9973 is prime; the long run takes every 97th float
    const std::uint32_t step = oracle::count(1) > 1 ? 97 : 9973;
    for (const Function& f : functions) {
        float where = 0;
        const double worst = worst_over_all(f, step, where);
        MESSAGE(f.name, ": largest error ", worst, " ulp at ", where);
        CHECK(worst <= f.bound);
    }
}

TEST_CASE("binary32: error bounds where reduction is hard") {
    Random random{5};
    double worst[4] = {};
    for (long i = 0; i < oracle::count(200000); ++i) {
        // the floats next to multiples of pi/2, and of ln 2
        const double k = std::floor(random.between(-3000, 3000));
        const auto near = [&](double x) {
            return from_bits(bits(static_cast<float>(x)) + static_cast<std::uint32_t>(random.next() % 5) - 2);
        };
        const float angle = near(k * fm::half_pi), power = near(std::floor(k / 25) * fm::ln2 * 0.5);
        const float one = near(1.0);
        const float arguments[4] = {power, one, angle, angle};
        for (int f = 0; f < 4; ++f) {
            const double e =
                ulps(functions[f].kernel(Four(arguments[f]))[0], functions[f].exact(arguments[f]));
            worst[f] = std::max(worst[f], e);
        }
    }
    for (int f = 0; f < 4; ++f) {
        INFO(functions[f].name);
        CHECK(worst[f] <= functions[f].bound);
        CHECK(worst[f] > 0.0);
    }
}

TEST_CASE("binary32: the angle of a point") {
    Random random{8};
    double worst = 0;
    long wrong = 0;
    for (long i = 0; i < oracle::count(400000); ++i) {
        const float y = argument(random),
                    x = i % 3 ? argument(random) : y * static_cast<float>(random.between(-3, 3));
        const float got = fm::atan2(Four(y), Four(x))[1];
        const double exact = fm::atan2(static_cast<double>(y), static_cast<double>(x));
        if (y == 0) {
            wrong += !same(got, static_cast<float>(exact));
            continue;
        }
        const double e = ulps(got, exact);
        if (!(e <= worst)) worst = e;
    }
    MESSAGE("atan2: largest error ", worst, " ulp");
    CHECK(worst <= 3.0);
    CHECK(wrong == 0);
    const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, INFINITY, -INFINITY, NAN, 0x1p-149f, 0x1.fffffep127f};
    for (const float y : special)
        for (const float x : special) {
            INFO(y, " ", x);
            CHECK(same(fm::atan2(Four(y), Four(x))[0],
                       static_cast<float>(fm::atan2(static_cast<double>(y), static_cast<double>(x)))));
        }
}

TEST_CASE("binary32: special values") {
    const float inf = INFINITY, nan = NAN, tiny = 0x1p-149f, most = 0x1.fffffep127f;
    const auto at = [](Four (*f)(Four), float x) { return f(Four(x))[2]; };
    const auto exp = functions[0].kernel, log = functions[1].kernel, sin = functions[2].kernel,
               cos = functions[3].kernel;
    CHECK(same(at(exp, inf), inf));
    CHECK(same(at(exp, -inf), 0.0f));
    CHECK(same(at(exp, -most), 0.0f));
    CHECK(same(at(exp, most), inf));
    CHECK(same(at(exp, -104.0f), 0.0f));
    CHECK(same(at(exp, -103.0f), 0x1p-149f));  // e^-103 = 1.32 * 2^-149
    CHECK(same(at(exp, 0.0f), 1.0f));
    CHECK(same(at(exp, -0.0f), 1.0f));
    CHECK(same(at(exp, nan), nan));
    CHECK(same(at(log, 0.0f), nan));
    CHECK(same(at(log, -0.0f), nan));
    CHECK(same(at(log, -1.0f), nan));
    CHECK(same(at(log, 1.0f), 0.0f));
    CHECK(same(at(log, inf), inf));
    CHECK(same(at(log, nan), nan));
    CHECK(same(at(log, tiny), -103.27893f));
    CHECK(same(at(sin, 0.0f), 0.0f));
    CHECK(same(at(sin, -0.0f), -0.0f));
    CHECK(same(at(sin, tiny), tiny));
    CHECK(same(at(sin, -tiny), -tiny));
    CHECK(same(at(sin, inf), nan));
    CHECK(same(at(sin, nan), nan));
    CHECK(same(at(cos, 0.0f), 1.0f));
    CHECK(same(at(cos, -inf), nan));
    CHECK(same(at(cos, nan), nan));
}

TEST_CASE("binary32: exact functions") {
    Random random{6};
    long wrong = 0;
    for (long i = 0; i < oracle::count(200000); ++i) {
        const float x = argument(random), y = argument(random);
        const Four a(x), b(y);
        const bool nan = x != x || y != y;
        wrong += !same((a + b)[0], x + y) + !same((a - b)[1], x - y) + !same((a * b)[2], x * y);
        wrong += !same((a / b)[3], x / y) + !same(fm::sqrt(a)[0], std::sqrt(x)) + !same((-a)[1], -x);
        wrong += !same(fm::abs(a)[0], std::abs(x)) + !same(fm::floor(a)[1], std::floor(x));
        wrong += !same(fm::ceil(a)[2], std::ceil(x)) + !same(fm::trunc(a)[3], std::trunc(x));
        const float c = std::ceil(x);
        wrong += !same(fm::round_half_up(a)[0], c - x > 0.5f ? c - 1.0f : c);
        wrong += !(nan ? fm::min(a, b)[0] != fm::min(a, b)[0] : fm::min(a, b)[0] == std::fmin(x, y));
        wrong += !(nan ? fm::max(a, b)[1] != fm::max(a, b)[1] : fm::max(a, b)[1] == std::fmax(x, y));
        wrong += less(a, b)[0] != (x < y) || equal(a, b)[1] != (x == y) || less_equal(a, b)[2] != (x <= y);
    }
    CHECK(wrong == 0);
    CHECK(same(fm::min(Four(-0.0), Four(0.0))[0], -0.0f));
    CHECK(same(fm::min(Four(0.0), Four(-0.0))[0], -0.0f));
    CHECK(same(fm::max(Four(-0.0), Four(0.0))[0], 0.0f));
    CHECK(same(fm::max(Four(0.0), Four(-0.0))[0], 0.0f));
}

TEST_CASE("binary32: a lane gives the same bits in every width") {
    Random random{7};
    long wrong = 0;
    for (const Function& f : functions) {
        for (long i = 0; i < oracle::count(20000); ++i) {
            Eight x;
            for (int k = 0; k < 8; ++k) x.set(k, argument(random));
            const Eight y = &f == functions       ? fm::exp(x)
                            : &f == functions + 1 ? fm::log(x)
                            : &f == functions + 2 ? fm::sin(x)
                            : &f == functions + 3 ? fm::cos(x)
                                                  : fm::atan(x);
            for (int k = 0; k < 8; ++k) wrong += !same(y[k], f.kernel(Four(x[k]))[0]);
        }
    }
    CHECK(wrong == 0);
}
