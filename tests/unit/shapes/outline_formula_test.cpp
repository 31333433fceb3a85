// Areas by the monotone formula against the winding rules at points; zero on the edges and nowhere else; what
// it refuses.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/shapes/outline_formula.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::shapes;
using namespace frep::test;
using doctest::Approx;

namespace {

std::vector<Vec2> square(double half, bool clockwise = false, Vec2 center = {0, 0}) {
    std::vector<Vec2> v{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    if (clockwise) std::swap(v[1], v[3]);
    for (Vec2& p : v) p = p + center;
    return v;
}

/// The value's sign along the positive x axis, at 0.5, 1.5, ...
std::string signs(const Area& area) {
    Sketch s;
    const auto f = area_formula(s.build.set_system, area, s.x[0], s.x[1]);
    if (!f) return f.error().message;
    std::string out;
    for (int i = 0; i < 6; ++i) {
        const double value = at(*f, i + 0.5, 0.25, 0);
        out += value > 0 ? '+' : value < 0 ? '-' : '0';
    }
    return out;
}

}  // namespace

TEST_CASE("nested contours by both fill rules") {
    const auto a = square(1), b = square(2), c = square(3), d = square(4), back = square(2, true);
    CHECK(signs({{{{a, b, c, d}, FillRule::even_odd}}}) == "-+-+--");
    CHECK(signs({{{{d, b, c, a}, FillRule::nonzero}}}) == "++++--");
    CHECK(signs({{{{d, back}, FillRule::nonzero}}}) == "--++--");
    CHECK(signs({{{{a, d, back}, FillRule::nonzero}}}) == "+-++--");
    CHECK(signs({{{{d, back}, FillRule::even_odd}, {{square(0.8, false, {5, 0})}, FillRule::nonzero}}}) ==
          "--++++");
}

TEST_CASE("it is 0 on the edges, for the sharp system the distance to an edge's line") {
    Sketch s;
    const SetSystem sharp{SetSystem::Kind::min_max, 0};
    const Area ring{{{{square(3), square(1, true)}, FillRule::nonzero}}};
    const auto f = area_formula(sharp, ring, s.x[0], s.x[1]);
    REQUIRE(f);
    CHECK(at(*f, 3, 1, 0) == 0);
    CHECK(at(*f, 1, 0.5, 0) == 0);
    CHECK(at(*f, 2.5, 0, 0) == Approx(0.5));
    CHECK(at(*f, 0, 0, 0) == Approx(-1));
    CHECK(at(*f, 7, 0, 0) == Approx(-4));
}

TEST_CASE("what the formula cannot express") {
    const std::vector<Vec2> bow{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    CHECK(signs({{{{bow}, FillRule::nonzero}}}).find("which the formula cannot express") !=
          std::string::npos);
    CHECK(signs({{{{square(1), square(1, false, {1, 1})}, FillRule::nonzero}}}) ==
          "contours meet, which the formula cannot express; hfOutline can");
    std::vector<Vec2> round;
    for (int i = 0; i < 5000; ++i) round.push_back({std::cos(i * 0.001256), std::sin(i * 0.001256)});
    CHECK(signs({{{{round}, FillRule::nonzero}}}).find("has 5000 vertices") != std::string::npos);
}
