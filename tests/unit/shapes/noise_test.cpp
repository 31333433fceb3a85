// Gardner noise (published values and bound), lattice noise and turbulence (zero at lattice points, bound,
// smoothness, one fixed table).
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {
double noise(double x, double y, double z) {
    return meaning<double>(Op::lattice_noise, std::vector<double>{x, y, z}, {});
}
}  // namespace

TEST_CASE("Gardner noise") {
    Sketch s;
    const Expression f = s.call("hfNoiseG", {s.x, 2.5, 0.7, 1.4});
    CHECK(at(f, 1, 2, 3) == Approx(43.057563036064).epsilon(1e-12));
    CHECK(at(f, 0, 0, 0) == 0);
    CHECK(at(f, 1, 0, 0) == 0);
    const Expression unit = s.call("hfA_NoiseG", {s.x, 0.7, 1.4});
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-50, 50);
    for (int i = 0; i < 5000; ++i) {
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        CHECK(std::abs(at(f, x, y, z)) <= 99.6878);
        CHECK(at(unit, x, y, z) >= 0);
        CHECK(at(unit, x, y, z) <= 1);
    }
}

TEST_CASE("lattice noise: bound, lattice points, continuity, a fixed table") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-300, 300);
    double largest = 0, mean = 0;
    for (int i = 0; i < 100000; ++i) {
        const double v = noise(uniform(random), uniform(random), uniform(random));
        largest = std::max(largest, std::abs(v));
        mean += v / 100000;
    }
    CHECK(largest < 0.8661);
    CHECK(largest > 0.5);
    CHECK(std::abs(mean) < 0.01);
    for (int i = -300; i < 300; i += 7) {
        CHECK(noise(i, 2 * i, 3 - i) == 0);
        const double y = uniform(random), z = uniform(random), below = noise(i - 1e-9, y, z),
                     above = noise(i + 1e-9, y, z);
        CHECK(below == Approx(above).epsilon(1e-7));
    }
    CHECK(noise(0.25, 0.5, 0.75) == noise(256.25, 0.5, -255.25));
    CHECK(std::isnan(noise(std::nan(""), 0, 0)));
    CHECK(std::isnan(noise(1e308 * 10, 0, 0)));
}

TEST_CASE("gradient of lattice noise") {
    Sketch s;
    const Expression f = s.call("hfA_NoiseP", {s.x});
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-5, 5);
    for (int i = 0; i < 1000; ++i) {
        const double p[3] = {uniform(random), uniform(random), uniform(random)}, h = 1e-6;
        const auto d = gradient_at(f, p[0], p[1], p[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            double q[3] = {p[0], p[1], p[2]};
            q[k] += h;
            const double up = at(f, q[0], q[1], q[2]);
            q[k] -= 2 * h;
            CHECK(d.d[k] == Approx((up - at(f, q[0], q[1], q[2])) / (2 * h)).epsilon(1e-5));
        }
    }
}

TEST_CASE("turbulence is the sum of its octaves") {
    Sketch s;
    const Expression f = s.call("hfA_Turbulence", {s.x, 5.0});
    const double x = 0.31, y = 0.72, z = -0.4;
    double sum = 0;
    for (double q = 5; q >= 1; q /= 2) sum += std::abs(2 * noise(q * x, q * y, q * z) - 1) / q;
    CHECK(at(f, x, y, z) == Approx(sum).epsilon(1e-14));
    CHECK(at(s.call("hfA_Turbulence", {s.x, 0.5}), x, y, z) == 0);
    CHECK(std::isnan(at(s.call("hfA_Turbulence", {s.x, std::nan("")}), x, y, z)));
    CHECK(at(s.call("hfA_Turbulence", {s.x, 1e300}), x, y, z) > 0);
}
