// R-functions and hypot of binary32: the sign for every pair of floats, saturation, undefined operands, and
// the error against the formula in binary64.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "oracle.h"

namespace fm = frep::math;
using Four = fm::SinglesN<4>;
using oracle::Random;

namespace {

float from_bits(std::uint32_t w) {
    float x;
    std::memcpy(&x, &w, sizeof x);
    return x;
}
int sign(float x) { return (x > 0) - (x < 0); }
double ulp(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, std::max(exponent - 24, -149));
}

/// Pairs of every kind: any bits, near each other, opposite, special.
void pair(Random& r, float& a, float& b) {
    static const float special[] = {
        0.0f, -0.0f,     1.0f,       -1.0f,     INFINITY,        -INFINITY,
        NAN,  0x1p-149f, -0x1p-149f, 0x1p-126f, 0x1.fffffep127f, -0x1.fffffep127f};
    a = from_bits(static_cast<std::uint32_t>(r.next()));
    b = from_bits(static_cast<std::uint32_t>(r.next()));
    switch (r.next() % 6) {
        case 0:
            b = std::nextafter(-a, r.next() % 2 ? INFINITY : -INFINITY);
            break;
        case 1:
            b = -a;
            break;
        case 2:
            a = special[r.next() % 12];
            break;
        case 3:
            a = static_cast<float>(r.between(-2, 2));
            b = static_cast<float>(r.magnitude(-30, 2));
            break;
        case 4:
            b = special[r.next() % 12];
            break;
        default:
            break;
    }
}

}  // namespace

TEST_CASE("binary32: the sign of R-functions is that of min and max, for every pair") {
    Random random{9};
    long wrong = 0, undefined = 0, unsaturated = 0;
    for (long i = 0; i < oracle::count(400000); ++i) {
        float a, b;
        pair(random, a, b);
        const float conjunction = fm::r_and(Four(a), Four(b))[1], disjunction = fm::r_or(Four(a), Four(b))[2];
        if (a != a || b != b) {
            undefined += conjunction == conjunction || disjunction == disjunction;
            continue;
        }
        wrong += sign(conjunction) != sign(std::fmin(a, b)) || sign(disjunction) != sign(std::fmax(a, b));
        unsaturated += !(std::abs(conjunction) <= 1e18f && std::abs(disjunction) <= 1e18f);
    }
    CHECK(wrong == 0);
    CHECK(undefined == 0);
    CHECK(unsaturated == 0);
    CHECK(fm::r_and(Four(INFINITY), Four(INFINITY))[0] == 1e18f);
    CHECK(fm::r_and(Four(-INFINITY), Four(INFINITY))[0] == -1e18f);
    CHECK(fm::r_and(Four(INFINITY), Four(0.5))[0] == 0.5f);
    CHECK(fm::r_or(Four(-INFINITY), Four(-0.5))[0] == -0.5f);
}

TEST_CASE("binary32: values of R-functions and hypot") {
    Random random{10};
    double worst = 0, worst_hypot = 0;
    for (long i = 0; i < oracle::count(200000); ++i) {
        const float a = static_cast<float>(random.magnitude(-40, 40)),
                    b = static_cast<float>(random.magnitude(-40, 40));
        const double exact = fm::r_and(static_cast<double>(a), static_cast<double>(b));
        if (std::abs(exact) < 1e18)
            worst = std::max(
                worst, std::abs(static_cast<double>(fm::r_and(Four(a), Four(b))[0]) - exact) / ulp(exact));
        const float c = from_bits(static_cast<std::uint32_t>(random.next()));
        const float d = from_bits(static_cast<std::uint32_t>(random.next()));
        const double length = fm::hypot(static_cast<double>(c), static_cast<double>(d));
        const float got = fm::hypot(Four(c), Four(d))[3];
        if (length != length) {
            CHECK(got != got);
        } else if (length > 0x1.fffffep127) {
            CHECK(got >= 0x1.fffffcp127f);
        } else {
            worst_hypot = std::max(worst_hypot, std::abs(static_cast<double>(got) - length) / ulp(length));
        }
    }
    MESSAGE("r_and ", worst, " ulp, hypot ", worst_hypot, " ulp");
    CHECK(worst <= 4.0);
    CHECK(worst > 0.5);
    CHECK(worst_hypot <= 2.0);
}
