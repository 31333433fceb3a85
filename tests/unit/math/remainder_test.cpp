// remainder_trunc against the C library's fmod, which is exact: ordinary pairs, huge ratios, all bit
// patterns.
#include <doctest/doctest.h>

#include "oracle.h"

namespace fm = frep::math;
using oracle::Random;

TEST_CASE("remainder_trunc is fmod") {
    Random random{51};
    long wrong = 0;
    for (long i = 0; i < oracle::count(600000); ++i) {
        double a, b;
        switch (i % 4) {
            case 0:
                a = random.pattern(), b = random.pattern();
                break;
            case 1:
                a = random.magnitude(-4, 30), b = random.magnitude(-4, 4);
                break;
            case 2:
                a = std::floor(random.between(-1000, 1000)), b = std::floor(random.between(-9, 9)) * 0.25;
                break;
            default:
                b = random.magnitude(-10, 10);
                a = fm::step_up(b * std::floor(random.between(0, 1e8)), static_cast<int>(random.next() % 3));
        }
        wrong += !oracle::same(fm::remainder_trunc(a, b), std::fmod(a, b));
    }
    CHECK(wrong == 0);
    CHECK(fm::remainder_trunc(5.5, fm::infinity) == 5.5);
    CHECK(oracle::same(fm::remainder_trunc(-4.0, 2.0), -0.0));
    CHECK(fm::remainder_trunc(5.0, 0.0) != fm::remainder_trunc(5.0, 0.0));
}
