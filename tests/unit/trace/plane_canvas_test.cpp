// Tests of trace/plane_canvas.h: covered areas, even strokes, clipping.
#include "frep/trace/plane_canvas.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace frep;
using namespace frep::drawing;

namespace {

/// How many pixels' worth of black there is on white paper.
double ink_of(const Canvas& canvas) {
    double sum = 0;
    for (int y = 0; y < canvas.image().height; ++y) {
        for (int x = 0; x < canvas.image().width; ++x) sum += 1 - canvas.get(x, y).r;
    }
    return sum;
}

constexpr Color black{0, 0, 0}, white{1, 1, 1};

}  // namespace

TEST_CASE("a rectangle covers its area, wherever its sides lie") {
    for (const double shift : {0.0, 0.25, 0.5, 0.8}) {
        Canvas canvas(30, 30, white);
        canvas.fill({5 + shift, 6 - shift, 20 + shift, 15 - shift}, black);
        CHECK(ink_of(canvas) == doctest::Approx(15 * 9).epsilon(0.003));
    }
    Canvas canvas(10, 10, white);
    canvas.fill({-5, -5, 50, 50}, black);
    CHECK(ink_of(canvas) == doctest::Approx(100));
    canvas.fill({20, 20, 30, 30}, white);
    CHECK(ink_of(canvas) == doctest::Approx(100));
}

TEST_CASE("a convex polygon covers its area in either direction") {
    for (const bool turned : {false, true}) {
        Canvas canvas(60, 60, white);
        std::array<Vec2, 3> corners{{{5.3, 7.1}, {50.2, 20.4}, {20.9, 52.6}}};
        if (turned) std::swap(corners[0], corners[1]);
        canvas.fill_convex(corners, black);
        const Vec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
        const double twice = a.x * b.y - a.y * b.x;
        CHECK(ink_of(canvas) == doctest::Approx((twice > 0 ? twice : -twice) / 2).epsilon(0.005));
    }
}

TEST_CASE("a stroke has the width of its pen at every angle") {
    for (int k = 0; k < 8; ++k) {
        Canvas canvas(100, 100, white);
        const Vec2 far{90.0, 12.0 + 11 * k};
        const std::array<Segment, 1> line{{{{10, 10}, far}}};
        const double length = std::sqrt(80.0 * 80 + (far.y - 10) * (far.y - 10));
        canvas.stroke(line, 3, black);
        CHECK(ink_of(canvas) == doctest::Approx(3 * length + 9 * 0.785).epsilon(0.02));
        Canvas thin(100, 100, white);
        thin.stroke(line, 0.5, black);
        CHECK(ink_of(thin) == doctest::Approx(0.5 * length).epsilon(0.04));
    }
}

TEST_CASE("strokes that meet are drawn once") {
    Canvas once(40, 40, white), twice(40, 40, white);
    const Segment s{{5, 5}, {30, 22}};
    const std::array<Segment, 1> one{{s}};
    const std::array<Segment, 3> many{{s, s, {s.b, s.a}}};
    once.stroke(one, 1.3, black, 0.4, once.whole());
    twice.stroke(many, 1.3, black, 0.4, twice.whole());
    CHECK(once.image().pixels == twice.image().pixels);
}

TEST_CASE("clipping and the picture's edge") {
    Canvas canvas(20, 20, white);
    const std::array<Segment, 1> line{{{{-50, 10}, {70, 10.5}}}};
    canvas.stroke(line, 4, black, 1, {5, 5, 15, 15});
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            if (x < 5 || x >= 15) CHECK(canvas.get(x, y) == white);
        }
    }
    CHECK(canvas.get(10, 10) == black);
    const std::array<Segment, 1> away{{{{-500, -500}, {-100, -100}}}};
    canvas.stroke(away, 4, black);
    CHECK(ink_of(canvas) <= 50);
}
