// Blending unions, intersections and subtractions: the values of docs/theory (1994 displacement, bounded
// blends by control points and by a bounding solid, derived blends), exact locality, gradients.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

constexpr double tiny = 1e-9;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double op_value(Op op, std::vector<double> arguments) { return meaning<double>(op, arguments, {}); }

bool same_bits(double a, double b) { return math::to_bits(a) == math::to_bits(b); }

/// Zero of a function of one variable that falls from a to b, by bisection.
template <class F>
double root(F f, double a, double b) {
    for (int i = 0; i < 200; ++i) {
        const double m = 0.5 * (a + b);
        (f(m) >= 0.0 ? a : b) = m;
    }
    return 0.5 * (a + b);
}

Expression norm(Expression a, Expression b, Expression c) { return hypot(hypot(a, b), c); }

}  // namespace

TEST_CASE("global displacement of 1994") {
    CHECK(op_value(Op::blend_uni, {0.5, -1, 1, 2, 0.5}) == Approx(0.815564852947).epsilon(1e-12));
    const double s = root([](double t) { return op_value(Op::blend_uni, {-t, -t, 1, 1, 1}); }, 0, 3);
    CHECK(s == Approx(0.775247134869).epsilon(1e-11));
    const double r = root([](double t) { return -op_value(Op::blend_int, {t, t, -1, 1, 1}); }, 0, 3);
    CHECK(r == Approx(0.775247134869).epsilon(1e-11));
    // the surface f1 = 0 moves everywhere
    const auto moved = [](double f2) {
        return root([=](double t) { return op_value(Op::blend_uni, {-t, f2, 1, 1, 1}); }, 0, 3);
    };
    CHECK(moved(-2) == Approx(0.2092).epsilon(1e-3));
    CHECK(moved(-5) == Approx(0.0386).epsilon(1e-2));
    CHECK(moved(-10) == Approx(0.0099).epsilon(1e-2));
}

TEST_CASE("scaling law: F(l f; l a) = l F") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> a(5), b(5), c(7), d(7);
        const double scale = std::exp(uniform(random));
        for (std::size_t k = 0; k < 5; ++k) b[k] = scale * (a[k] = uniform(random));
        for (std::size_t k = 0; k < 7; ++k) d[k] = scale * (c[k] = uniform(random));
        for (const Op op : {Op::blend_uni, Op::blend_int, Op::point_uni, Op::point_int})
            CHECK(op_value(op, b) == Approx(scale * op_value(op, a)).epsilon(1e-9));
        for (const Op op : {Op::bounded_uni, Op::bounded_int})
            CHECK(op_value(op, d) == Approx(scale * op_value(op, c)).epsilon(1e-9));
    }
}

TEST_CASE("only the ratios of a1, a2, a3 matter") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> a(7);
        for (double& v : a) v = uniform(random);
        std::vector<double> b = a;
        const double scale = std::exp(uniform(random));
        for (std::size_t k = 4; k < 7; ++k) b[k] *= scale;
        CHECK(op_value(Op::bounded_uni, b) == Approx(op_value(Op::bounded_uni, a)).epsilon(1e-12));
    }
}

TEST_CASE("displacement function") {
    // base 0 from f1 = 0 and f2 <= 0; u = r^2 by f2
    const auto bell = [](double r) { return op_value(Op::point_uni, {0, -r, 1, 1, 1}); };
    CHECK(bell(0) == 1);
    CHECK(bell(0.25) == Approx(0.775505514706).epsilon(1e-11));
    CHECK(bell(0.5) == Approx(0.3375).epsilon(1e-14));
    CHECK(bell(0.75) == Approx(0.05359375).epsilon(1e-13));
    CHECK(bell(0.9) == Approx(0.003789502762).epsilon(1e-9));
    CHECK(bell(0.99) == Approx(3.9799e-6).epsilon(1e-4));
    CHECK(bell(1) == 0);
    CHECK(bell(1.5) == 0);
}

TEST_CASE("example A: half-planes, control points (0,2) and (1,0)") {
    Sketch s;
    const Expression f = s.call("hfPointBlendUni", {-s.x[0], -s.x[1], 1.0, 1.0, 2.0});
    CHECK(at(f, 0.3, 0.4, 0) == Approx(0.382746017699).epsilon(1e-11));
    const auto height = [&](double x) { return root([&](double y) { return at(f, x, y, 0); }, 0, 3); };
    CHECK(height(0.25) == Approx(1.043713249).epsilon(tiny));
    CHECK(height(0.5) == Approx(0.427480004).epsilon(tiny));
    CHECK(height(0.75) == Approx(0.055324713).epsilon(1e-8));
    CHECK(height(0.9) == Approx(0.003797290).epsilon(1e-6));
    CHECK(height(1.0) == Approx(0.0));
    CHECK(height(1.3) == Approx(0.0));
    const double x = root([&](double t) { return at(f, t, 1.9, 0); }, 0, 3);
    CHECK(x == Approx(0.000487239).epsilon(1e-6));
    const double d = root([&](double t) { return at(f, t, t, 0); }, 0, 3);
    CHECK(d == Approx(0.479584333749).epsilon(1e-11));
}

TEST_CASE("circular fillet: a0 = a/(2 sqrt 2)") {
    const auto diagonal = [](double a0) {
        return root([=](double t) { return op_value(Op::point_uni, {-t, -t, a0, 1, 1}); }, 0, 1);
    };
    const double expected[][2] = {{0.1, 0.144264}, {0.353553390593, 0.292893},
                                  {1, 0.401526},   {3.5147, 0.500000},
                                  {10, 0.558587},  {100, 0.636775},
                                  {1e4, 0.691750}};
    for (const auto& [a0, value] : expected) CHECK(diagonal(a0) == Approx(value).epsilon(4e-6));
    CHECK(diagonal(1 / (2 * std::sqrt(2.0))) == Approx(1 - 1 / std::sqrt(2.0)).epsilon(1e-12));
}

TEST_CASE("example B: sphere and cylinder") {
    Sketch s;
    const Expression sphere = 1.0 - square(s.x[0]) - square(s.x[1]) - square(s.x[2]);
    const Expression cylinder = 0.25 - square(s.x[0]) - square(s.x[1]);
    const Expression f = s.call("hfPointBlendUni", {sphere, cylinder, 0.15, 0.69, 0.39});
    const auto profile = [&](double z) { return root([&](double x) { return at(f, x, 0, z); }, 0, 2); };
    const double expected[][2] = {
        {0.6, 0.8},         {0.7, 0.723531576}, {0.8, 0.656056904}, {0.8660254, 0.619442632},
        {0.9, 0.603597349}, {1, 0.558469296},   {1.1, 0.514712449}, {1.2, 0.5},
        {1.5, 0.5},         {-0.9, 0.603597349}};
    for (const auto& [z, x] : expected) CHECK(profile(z) == Approx(x).epsilon(3e-9));
}

TEST_CASE("example C: bounding ball") {
    Sketch s;
    const Expression ball = 1.0 - square(s.x[0]) - square(s.x[1]) - square(s.x[2]);
    const Expression f = s.call("hfBoundedBlendUni", {-s.x[0], -s.x[1], ball, 0.5, 1.0, 1.0, 1.0});
    CHECK(at(f, 0.3, 0.2, 0) == Approx(0.13161046).epsilon(1e-7));
    CHECK(at(f, 0, 0, 0) == 0.5);
    CHECK(at(f, 0, 0, 0.999) == 0.5);
    CHECK(at(f, 0, 0, 1) == 0.0);
    CHECK(at(f, 0.5, 0.5, 0.5) == Approx(-0.292530111).epsilon(1e-8));
    CHECK(at(f, 0.6, 0.6, 0.6) == Approx(-0.351471863).epsilon(1e-8));
    CHECK(at(f, 2, 2, 2) == Approx(-1.171572875).epsilon(1e-8));
    CHECK(at(f, -0.3, 0.2, 0.1) == Approx(0.728160854).epsilon(1e-8));
    const double expected[][2] = {{0, 0.312993893},     {0.3, 0.295721904},  {0.6, 0.237714243},
                                  {0.9, 0.104976780},   {0.99, 0.019129894}, {0.999, 0.002947045},
                                  {0.9999, 0.000427335}};
    for (const auto& row : expected) {
        const double t = root([&](double u) { return at(f, u, u, row[0]); }, 0, 1);
        CHECK(t == Approx(row[1]).epsilon(2e-6));
    }
}

TEST_CASE("derivatives of the bounded displacement") {
    Sketch s;
    const Expression f = s.call("hfBoundedBlendUni", {s.x[0], s.x[1], s.x[2], 0.7, 0.8, 1.1, 0.9});
    const auto d = gradient_at(f, 0.3, -0.2, 0.5), plain = gradient_at(r_or(s.x[0], s.x[1]), 0.3, -0.2, 0.5);
    CHECK(d.value - plain.value == Approx(0.134857422082).epsilon(1e-11));
    CHECK(d.d[0] - plain.d[0] == Approx(-0.909696918282).epsilon(1e-11));
    CHECK(d.d[1] - plain.d[1] == Approx(0.320774670909).epsilon(1e-11));
    CHECK(d.d[2] - plain.d[2] == Approx(0.674128019333).epsilon(1e-11));
}

TEST_CASE("gradients are total: 1 and 1 at f1 = f2 = 0, finite everywhere") {
    using Dual = math::Dual<double>;
    const Dual f1 = Dual::variable(0, 0), f2 = Dual::variable(0, 1);
    const auto extents = std::vector<Dual>{Dual(0.5), Dual(1.0), Dual(2.0)};
    for (const Op op : {Op::blend_uni, Op::blend_int, Op::point_uni, Op::point_int}) {
        const Dual r = meaning<Dual>(op, std::vector<Dual>{f1, f2, extents[0], extents[1], extents[2]}, {});
        CHECK(r.d[0] == 1);
        CHECK(r.d[1] == 1);
    }
    for (const double f3 : {-1.0, 0.0, 1.0}) {
        for (const Op op : {Op::bounded_uni, Op::bounded_int}) {
            const Dual third = Dual::variable(f3, 2);
            const Dual r = meaning<Dual>(
                op, std::vector<Dual>{f1, f2, third, extents[0], extents[1], extents[2], Dual(1.0)}, {});
            CHECK(r.d[0] == 1);
            CHECK(r.d[1] == 1);
            CHECK(r.d[2] == 0);
        }
    }
    const double odd[] = {0.0, -0.0, 1e-320, -1e-320, 1e-160, 1e160, -1e160, 1e308, -1.0, 1.0};
    std::mt19937_64 random(3);
    for (int i = 0; i < 20000; ++i) {
        std::vector<Dual> a(7);
        for (std::size_t k = 0; k < 7; ++k) a[k] = Dual(odd[random() % 10]);
        for (std::size_t k = 0; k < 3; ++k) a[k] = Dual::variable(a[k].value, static_cast<int>(k));
        const Dual r = meaning<Dual>(Op::bounded_uni, a, {});
        CHECK(r.value == r.value);
        for (const double d : r.d) CHECK(std::abs(d) <= std::numeric_limits<double>::max());
    }
}

TEST_CASE("exact locality: where the blend is not active the value is the plain operation bit for bit") {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(-2, 2);
    int inside = 0;
    for (int i = 0; i < 200000; ++i) {
        const double f1 = uniform(random), f2 = uniform(random), f3 = -std::abs(uniform(random));
        const double a0 = uniform(random), a1 = uniform(random), a2 = uniform(random), a3 = uniform(random);
        const double either = op_value(Op::r_or, {f1, f2}), both = op_value(Op::r_and, {f1, f2});
        bool same = same_bits(op_value(Op::bounded_uni, {f1, f2, f3, a0, a1, a2, a3}), either) &&
                    same_bits(op_value(Op::bounded_int, {f1, f2, f3, a0, a1, a2, a3}), both) &&
                    same_bits(op_value(Op::bounded_uni, {f1, f2, -f3, 0, a1, a2, a3}), either) &&
                    same_bits(op_value(Op::blend_uni, {f1, f2, 0, a1, a2}), either) &&
                    same_bits(op_value(Op::point_int, {f1, f2, 0, a1, a2}), both);
        if ((f1 / a1) * (f1 / a1) + (f2 / a2) * (f2 / a2) >= 1)
            same = same && same_bits(op_value(Op::point_uni, {f1, f2, a0, a1, a2}), either);
        if (!same) FAIL_CHECK("not the plain operation at " << f1 << " " << f2 << " " << f3);
        const double moved = op_value(Op::bounded_uni, {f1, f2, -f3, 1, a1, a2, a3}) - either;
        inside += moved > 0 && moved <= 1 + 1e-12;
    }
    CHECK(inside > 180000);
}

TEST_CASE("degenerate extents and undefined operands") {
    for (const Op op : {Op::blend_uni, Op::point_uni}) {
        CHECK(op_value(op, {0, 0, 1, 0, 1}) == 0);
        CHECK(op_value(op, {0, 0, 1, 1, 0}) == 0);
        CHECK(op_value(op, {-1, 0, 1, -2, -2}) == op_value(op, {-1, 0, 1, 2, 2}));
        for (std::size_t k = 0; k < 5; ++k) {
            std::vector<double> a = {-0.1, 0.2, 1, 2, 2};
            a[k] = undefined;
            CHECK(std::isnan(op_value(op, a)));
        }
    }
    for (std::size_t k = 4; k < 7; ++k) {
        std::vector<double> a = {0, 0, 1, 1, 1, 1, 1};
        a[k] = 0;
        CHECK(op_value(Op::bounded_uni, a) == 0);
        a[k] = -1;
        CHECK(op_value(Op::bounded_uni, a) == 1);
    }
    for (std::size_t k = 0; k < 7; ++k) {
        std::vector<double> a = {-0.1, 0.2, 1, 1, 1, 1, 1};
        a[k] = undefined;
        CHECK(std::isnan(op_value(Op::bounded_uni, a)));
    }
    CHECK(op_value(Op::bounded_uni, {1e-200, -1e-200, 1e-200, 1, 1, 1, 1}) ==
          Approx(op_value(Op::bounded_uni, {1, -1, 1, 1, 1, 1, 1}) - std::sqrt(2.0)).epsilon(1e-12));
    CHECK(op_value(Op::bounded_uni, {-1e200, -1e200, 1e200, 1, 1, 1, 1}) < 0);
}

TEST_CASE("multiple blend: torus and bar, two bounding balls") {
    Sketch s;
    const Expression x = s.x[0], y = s.x[1], z = s.x[2];
    const Expression torus = 0.5 - hypot(hypot(x, y) - 2.0, z);
    const Expression bar = r_and(r_and(3.5 - abs(x), 0.3 - abs(y)), 0.3 - abs(z));
    const Expression balls = r_or(0.9 - norm(x - 2.0, y, z), 0.9 - norm(x + 2.0, y, z));
    const Expression f = s.call("hfBoundedBlendUni", {torus, bar, balls, 0.2, 0.25, 0.25, 0.5});
    const Expression plain = r_or(torus, bar);
    CHECK(at(f, 1.5, 0.35, 0) == Approx(0.153197229).epsilon(1e-8));
    CHECK(at(f, -1.5, 0.35, 0) == Approx(0.153197229).epsilon(1e-8));
    CHECK(at(plain, 1.5, 0.35, 0) == Approx(0.053498).epsilon(1e-5));
    CHECK(at(f, 2.6, 0.35, 0) == Approx(-0.037108401).epsilon(1e-8));
    CHECK(at(plain, 2.6, 0.35, 0) == Approx(-0.043750).epsilon(1e-4));
    CHECK(same_bits(at(f, 0, 0.35, 0), at(plain, 0, 0.35, 0)));
    CHECK(at(f, 0, 0.35, 0) == Approx(-0.053260912).epsilon(1e-8));
}

TEST_CASE("partial edge blend, and a blend on that blend") {
    Sketch s;
    const Expression x = s.x[0], y = s.x[1], z = s.x[2];
    const Expression others = r_and(r_and(1.0 + x, 1.0 + z), 1.0 - abs(y));
    const Expression place = r_and(0.35 - hypot(x - 1.0, z - 1.0), 0.5 - abs(y));
    const Expression edge = s.call("hfBoundedBlendInt", {1.0 - x, 1.0 - z, place, -0.1, 0.2, 0.2, 0.3});
    const Expression f = r_and(others, edge), plain = r_and(others, r_and(1.0 - x, 1.0 - z));
    CHECK(at(f, 0.97, 0, 0.97) == Approx(-0.057928797).epsilon(1e-8));
    CHECK(at(plain, 0.97, 0, 0.97) == Approx(0.017327366).epsilon(1e-7));
    CHECK(same_bits(at(f, 0.97, 0.6, 0.97), at(plain, 0.97, 0.6, 0.97)));
    CHECK(at(f, 0.97, 0.6, 0.97) == Approx(0.017109707).epsilon(1e-7));

    const Expression post = r_and(r_and(z - 0.2, 1.8 - z), 0.25 - hypot(x - 0.85, y));
    const Expression ball = 0.6 - norm(x - 0.85, y, z - 1.0);
    const Expression twice = s.call("hfBoundedBlendUni", {f, post, ball, 0.08, 0.15, 0.15, 0.3});
    CHECK(at(twice, 1.05, 0, 1.05) == Approx(0.054598257).epsilon(1e-8));
}

TEST_CASE("subtraction with a rounded rim") {
    Sketch s;
    const Expression x = s.x[0], y = s.x[1], z = s.x[2];
    const Expression cube = r_and(r_and(1.0 - abs(x), 1.0 - abs(y)), 1.0 - abs(z));
    const Expression hole = 0.5 - hypot(x, y);
    const Expression place = 0.3 - hypot(hypot(x, y) - 0.5, z - 1.0);
    const Expression f = s.call("hfBoundedBlendSub", {cube, hole, place, -0.1, 0.2, 0.2, 0.3});
    const Expression plain = r_and(cube, -hole);
    CHECK(at(f, 0.52, 0, 0.98) == Approx(-0.079538353).epsilon(1e-8));
    CHECK(at(plain, 0.52, 0, 0.98) == Approx(0.011555247).epsilon(1e-7));
    CHECK(same_bits(at(f, 0.52, 0, -0.98), at(plain, 0.52, 0, -0.98)));
    CHECK(at(s.call("hfPointBlendSub", {x, y, 1.0, 1.0, 1.0}), 0.1, 0.2, 0) ==
          at(s.call("hfPointBlendInt", {x, -y, 1.0, 1.0, 1.0}), 0.1, 0.2, 0));
    CHECK(at(s.call("hfBlendSub", {x, y, 1.0, 1.0, 1.0}), 0.1, 0.2, 0) ==
          at(s.call("hfBlendInt", {x, -y, 1.0, 1.0, 1.0}), 0.1, 0.2, 0));
}

TEST_CASE("an extent of 0 is warned of") {
    Sketch s;
    s.call("hfBlendUni", {s.x[0], s.x[1], 1.0, 0.0, 1.0});
    CHECK(s.warnings.size() == 1);
}
