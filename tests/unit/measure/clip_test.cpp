// Shares and moments of the positive part of a piecewise linear function in the cube [-1,1]^D.
#include "frep/measure/clip.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace frep::measuring;

namespace {

/// Values at the corners of d + n . u.
std::vector<double> plane(int dimension, const std::vector<double>& n, double d) {
    std::vector<double> out;
    for (int corner = 0; corner < 1 << dimension; ++corner) {
        double v = d;
        for (int i = 0; i < dimension; ++i) v += (corner >> i & 1 ? 1 : -1) * n[static_cast<std::size_t>(i)];
        out.push_back(v);
    }
    return out;
}

bool close(double a, double b) { return std::abs(a - b) <= clip_error; }

}  // namespace

TEST_CASE("whole and empty") {
    for (const int d : {2, 3}) {
        const PartMoments whole = positive_part(d, plane(d, {0, 0, 0}, 1));
        CHECK(close(whole.share, 1));
        CHECK(close(whole.first[0], 0));
        CHECK(close(whole.second[1], 1.0 / 3));
        CHECK(close(whole.second[3], 0));
        CHECK(positive_part(d, plane(d, {0, 0, 0}, -1)).share == 0);
    }
}

TEST_CASE("a half space across an axis") {
    // u_1 > 1/2: a quarter of the cube, its middle at 3/4
    for (const int d : {2, 3}) {
        const PartMoments m = positive_part(d, plane(d, {0, 1, 0}, -0.5));
        CHECK(close(m.share, 0.25));
        CHECK(close(m.first[1], 0.25 * 0.75));
        CHECK(close(m.first[0], 0));
        CHECK(close(m.second[1], (1 - 0.125) / 6));  // 1/2 integral of u^2 over 1/2..1
        CHECK(close(m.second[0], 0.25 / 3));
    }
}

TEST_CASE("a corner is cut off") {
    // u_0 + u_1 + u_2 > 2: a simplex with legs 1, size 1/6 of 8; its middle 3/4 along each axis
    const PartMoments m = positive_part(3, plane(3, {1, 1, 1}, -2));
    CHECK(close(m.share, 1.0 / 48));
    for (std::size_t i = 0; i < 3; ++i) CHECK(close(m.first[i], 0.75 / 48));
    const PartMoments flat = positive_part(2, plane(2, {1, 1}, -1));
    CHECK(close(flat.share, 0.125));
    CHECK(close(flat.first[0], 0.125 * 2 / 3));
}

TEST_CASE("what is positive and what is negative make the whole") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int n = 0; n < 2000; ++n) {
        const int d = 2 + n % 2;
        CAPTURE(n);
        std::vector<double> f, g;
        for (int corner = 0; corner < 1 << d; ++corner) f.push_back(number(random));
        if (n % 5 == 0) f[1] = 0;
        for (const double v : f) g.push_back(-v);
        const PartMoments a = positive_part(d, f), b = positive_part(d, g);
        CHECK(std::abs(a.share + b.share - 1) < 2 * clip_error);
        for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
            CHECK(std::abs(a.first[i] + b.first[i]) < 2 * clip_error);
            CHECK(std::abs(a.second[i] + b.second[i] - 1.0 / 3) < 2 * clip_error);
        }
        CHECK(std::abs(a.second[3] + b.second[3]) < 2 * clip_error);
    }
}

TEST_CASE("a lattice of parts has the moments of the whole for a linear function") {
    const std::vector<double> n{0.3, -0.8, 0.5};
    std::vector<double> points;
    for (int p = 0; p < 27; ++p)
        points.push_back(0.2 + n[0] * (p % 3 - 1) + n[1] * (p / 3 % 3 - 1) + n[2] * (p / 9 - 1));
    const PartMoments a = positive_part(3, plane(3, n, 0.2)), b = positive_part_of_lattice(3, points);
    CHECK(close(a.share, b.share));
    for (std::size_t k = 0; k < 3; ++k) CHECK(close(a.first[k], b.first[k]));
    for (std::size_t k = 0; k < 6; ++k) CHECK(close(a.second[k], b.second[k]));
    // a pyramid over the square: 1/2 - |u| - |v|, half of the square's half
    std::vector<double> roof;
    for (int p = 0; p < 9; ++p) roof.push_back(0.5 - std::abs(p % 3 - 1) - std::abs(p / 3 - 1));
    CHECK(close(positive_part_of_lattice(2, roof).share, 0.125));
}

TEST_CASE("moments agree with sums over samples") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int n = 0; n < 10; ++n) {
        const std::vector<double> normal{number(random), number(random), number(random)};
        const double d = 0.5 * number(random);
        const PartMoments m = positive_part(3, plane(3, normal, d));
        constexpr int side = 60;
        double share = 0, first = 0, product = 0;
        for (int i = 0; i < side * side * side; ++i) {
            const double u = (i % side + 0.5) * 2 / side - 1, v = (i / side % side + 0.5) * 2 / side - 1;
            const double w = (i / side / side + 0.5) * 2 / side - 1;
            if (normal[0] * u + normal[1] * v + normal[2] * w + d <= 0) continue;
            share += 1;
            first += w;
            product += u * w;
        }
        const double count = side * side * side;
        CAPTURE(n);
        CHECK(m.share == doctest::Approx(share / count).epsilon(0.01));
        CHECK(std::abs(m.first[2] - first / count) < 0.004);
        CHECK(std::abs(m.second[4] - product / count) < 0.004);
    }
}
