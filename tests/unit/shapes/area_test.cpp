// Areas as functions: distances against every edge, signs against winding numbers, overlaps and seams, the
// gradient, enclosures, and the library functions on top.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "frep/eval/evaluator.h"
#include "frep/shapes/area.h"
#include "frep/shapes/area_edges.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

using Ring = std::vector<Vec2>;

Expression field_of(Sketch& s, const Area& area) {
    auto data = shapes::area_data(area);
    if (!data) FAIL(data.error().message);
    const NodeId lead[] = {s.x[0].id(), s.x[1].id()};
    return {s.graph, s.graph.make_block(Op::outline_distance, lead, std::move(*data))};
}

int winding(const Ring& v, double x, double y) {
    int count = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 a = v[i], b = v[(i + 1) % v.size()];
        const double t = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
        if (a.y <= y && b.y > y && t > 0) ++count;
        if (b.y <= y && a.y > y && t < 0) --count;
    }
    return count;
}
bool inside(const Area& area, double x, double y) {
    for (const FilledPart& part : area.parts) {
        int count = 0;
        for (const Ring& ring : part.contours) count += winding(ring, x, y);
        if (part.rule == FillRule::nonzero ? count != 0 : count % 2 != 0) return true;
    }
    return false;
}
double edge_distance(Vec2 a, Vec2 b, double x, double y) {
    const double ex = b.x - a.x, ey = b.y - a.y;
    const double t = std::clamp(((x - a.x) * ex + (y - a.y) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    return std::hypot(x - a.x - t * ex, y - a.y - t * ey);
}
/// Where no edge lies inside another part: the distance to all edges.
double distance(const Area& area, double x, double y) {
    double best = 1e300;
    for (const FilledPart& part : area.parts)
        for (const Ring& v : part.contours)
            for (std::size_t i = 0; i < v.size(); ++i)
                best = std::min(best, edge_distance(v[i], v[(i + 1) % v.size()], x, y));
    return inside(area, x, y) ? best : -best;
}

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
Ring reversed(Ring ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
}
/// A ring whose radius swings; `n` edges.
Ring wavy(int n, double radius, double swing, int waves, Vec2 at = {}) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        const double phi = 2 * std::acos(-1.0) * i / n, r = radius + swing * std::sin(waves * phi);
        ring.push_back({at.x + r * std::cos(phi), at.y + r * std::sin(phi)});
    }
    return ring;
}
/// {5/2}: every second corner of a pentagon.
Ring pentagram() {
    Ring ring;
    for (int i = 0; i < 5; ++i) {
        const double phi = std::acos(-1.0) * (0.5 + 0.8 * i);
        ring.push_back({std::cos(phi), std::sin(phi)});
    }
    return ring;
}

void check_against_all_edges(const Area& area, double reach, int points) {
    Sketch s;
    const Expression f = field_of(s, area);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-reach, reach);
    for (int i = 0; i < points; ++i) {
        const double x = place(random), y = place(random), want = distance(area, x, y);
        CAPTURE(x);
        CAPTURE(y);
        CHECK(std::fabs(at(f, x, y, 0) - want) <= 1e-12 * reach);
    }
}

}  // namespace

TEST_CASE("signed distance of holes, islands and far parts") {
    check_against_all_edges({{{{box(-1, -1, 1, 2)}, FillRule::nonzero}}}, 4, 500);
    check_against_all_edges({{{{reversed(box(-1, -1, 1, 2))}, FillRule::nonzero}}}, 4, 500);
    const Ring outer = box(-3, -3, 3, 3), hole = box(-2, -2, 2, 2), island = box(-1, -1, 1, 1);
    check_against_all_edges({{{{outer, hole, island}, FillRule::even_odd}}}, 5, 2000);
    check_against_all_edges({{{{outer, reversed(hole), island}, FillRule::nonzero}}}, 5, 2000);
    Area apart;
    for (int i = 0; i < 40; ++i) {
        const Vec2 m{3.0 * (i % 7) - 9, 3.0 * (i / 7) - 9};
        const auto rule = i % 2 ? FillRule::nonzero : FillRule::even_odd;
        apart.parts.push_back({{wavy(20 + i, 1.2, 0.2, 5, m), reversed(wavy(9, 0.5, 0.1, 2, m))}, rule});
    }
    check_against_all_edges(apart, 12, 3000);
}

TEST_CASE("thousands of edges") {
    check_against_all_edges(
        {{{{wavy(5000, 3, 0.7, 11), reversed(wavy(3001, 1, 0.3, 6))}, FillRule::nonzero}}}, 5, 2000);
}

TEST_CASE("a contour that crosses itself is filled by its rule, and inner edges do not count") {
    Sketch s;
    const Expression whole = field_of(s, {{{{pentagram()}, FillRule::nonzero}}});
    const Expression odd = field_of(s, {{{{pentagram()}, FillRule::even_odd}}});
    const double inner = std::cos(72 * std::acos(-1.0) / 180);  // distance of the edges from the centre
    const double notch = inner / std::cos(36 * std::acos(-1.0) / 180);  // and of the points where they cross
    CHECK(at(whole, 0, 0, 0) == Approx(notch).epsilon(1e-9));
    CHECK(at(odd, 0, 0, 0) == Approx(-inner).epsilon(1e-9));
    CHECK(at(whole, 0, inner, 0) > 0.1);  // upon an inner edge
    CHECK(std::fabs(at(odd, 0, inner, 0)) < 1e-12);
    for (const Expression& f : {whole, odd}) {
        CHECK(at(f, 0, 0.9, 0) > 0);
        CHECK(at(f, 0, -0.9, 0) < 0);
        CHECK(at(f, 0, 2, 0) == Approx(-1));
    }
}

TEST_CASE("overlapping parts are one shape") {
    Sketch s;
    const Expression cross = field_of(
        s, {{{{box(-3, -1, 3, 1)}, FillRule::nonzero}, {{reversed(box(-1, -3, 1, 3))}, FillRule::even_odd}}});
    CHECK(at(cross, 0, 0, 0) == Approx(std::sqrt(2.0)));  // the nearest of the boundary is a notch
    CHECK(at(cross, 0, 1, 0) == Approx(1));               // upon an edge that is inside
    CHECK(at(cross, 2, 0, 0) == Approx(1));
    CHECK(at(cross, 2, 2, 0) == Approx(-1));
    const Expression contained =
        field_of(s, {{{{box(-3, -3, 3, 3)}, FillRule::nonzero}, {{box(-1, -1, 1, 1)}, FillRule::nonzero}}});
    CHECK(at(contained, 0, 0, 0) == 3);
    CHECK(at(contained, 1, 0, 0) == 2);
    const Expression twice =
        field_of(s, {{{{box(-1, -1, 1, 1)}, FillRule::nonzero}, {{box(-1, -1, 1, 1)}, FillRule::nonzero}}});
    CHECK(at(twice, 0, 0, 0) == 1);
    CHECK(at(twice, 1, 0, 0) == 0);
    CHECK(at(twice, 3, 0, 0) == -2);
}

TEST_CASE("seams between parts vanish") {
    Sketch s;
    // tiles that share edges, and one that meets three others with its side
    const Expression tiles = field_of(s, {{{{box(0, 0, 1, 1)}, FillRule::nonzero},
                                           {{box(1, 0, 2, 1)}, FillRule::nonzero},
                                           {{box(2, 0, 3, 1)}, FillRule::nonzero},
                                           {{box(0, 1, 3, 2)}, FillRule::nonzero}}});
    const Expression one = field_of(s, {{{{box(0, 0, 3, 2)}, FillRule::nonzero}}});
    for (int i = -4; i <= 16; ++i)
        for (int k = -4; k <= 12; ++k)
            CHECK(at(tiles, 0.25 * i, 0.25 * k, 0) == Approx(at(one, 0.25 * i, 0.25 * k, 0)));
    // corners that lie on a slanted edge but for rounding
    const Vec2 a{0.1, 0.2}, b{1.3, 0.9}, m{a.x + (b.x - a.x) * 0.37, a.y + (b.y - a.y) * 0.37};
    const Area slanted{{{{{a, b, {1.3, -1}}}, FillRule::nonzero},
                        {{{a, {0.1, 1.5}, m}}, FillRule::nonzero},
                        {{{m, {0.1, 1.5}, b}}, FillRule::nonzero}}};
    const Expression f = field_of(s, slanted);
    for (const double t : {0.2, 0.5, 0.8})
        CHECK(at(f, a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, 0) > 0.05);
}

TEST_CASE("the gradient is the direction of the nearest place") {
    Sketch s;
    const Area area{{{{wavy(301, 2, 0.5, 5), reversed(box(-0.5, -0.5, 0.5, 0.5))}, FillRule::nonzero}}};
    const Expression f = field_of(s, area);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-3, 3);
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
        const double x = place(random), y = place(random), h = 1e-6;
        const auto g = gradient_at(f, x, y, 0);
        CHECK(std::hypot(g.d[0], g.d[1]) == Approx(1).epsilon(1e-9));
        const double dx = (at(f, x + h, y, 0) - at(f, x - h, y, 0)) / (2 * h);
        const double dy = (at(f, x, y + h, 0) - at(f, x, y - h, 0)) / (2 * h);
        if (std::hypot(dx, dy) < 0.999) continue;  // across the medial axis
        CHECK(g.d[0] == Approx(dx).epsilon(1e-3));
        CHECK(g.d[1] == Approx(dy).epsilon(1e-3));
        ++compared;
    }
    CHECK(compared > 350);
    const Expression square = field_of(s, {{{{reversed(box(-1, -1, 1, 1))}, FillRule::nonzero}}});
    const auto on_edge = gradient_at(square, 1, 0.3, 0);  // inward, though the contour runs clockwise
    CHECK(on_edge.value == 0);
    CHECK(on_edge.d[0] == -1);
    CHECK(on_edge.d[1] == 0);
    const auto corner = gradient_at(square, 1, 1, 0);
    CHECK(std::hypot(corner.d[0], corner.d[1]) == 1);
}

TEST_CASE("enclosures hold and are no wider than the box") {
    Sketch s;
    const Expression f =
        field_of(s, {{{{wavy(400, 2, 0.6, 7), box(-0.5, -0.5, 0.5, 0.5)}, FillRule::even_odd},
                      {{box(1, 1, 2.5, 2.5)}, FillRule::nonzero}}});
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> place(-3.5, 3.5), unit(-1, 1);
    for (int i = 0; i < 300; ++i) {
        const double x = place(random), y = place(random), hx = std::exp(4 * unit(random) - 4),
                     hy = std::exp(4 * unit(random) - 4);
        const auto range = range_over(f, {{x - hx, x + hx}, {y - hy, y + hy}, {0, 0}});
        for (int k = 0; k < 30; ++k)
            CHECK(range.contains(at(f, x + hx * unit(random), y + hy * unit(random), 0)));
        CHECK(range.hi - range.lo <= 2 * std::hypot(hx, hy) * (1 + 1e-9) + 1e-12);
        CHECK(!range.maybe_undefined);
    }
    const auto whole = range_over(f, {{-1e308, 1e308}, {-1e308, 1e308}, {0, 0}});
    CHECK(whole.contains(at(f, 1e308, -1e308, 0)));
    CHECK(at(f, 1e200, 0, 0) == Approx(-1e200));
    CHECK(gradient_at(f, 1e200, 0, 0).d[0] == Approx(-1));
    CHECK(std::isnan(at(f, std::nan(""), 0, 0)));
}

TEST_CASE("every engine gives the same bits") {
    auto graph = std::make_shared<Graph>();
    auto data =
        shapes::area_data({{{{wavy(700, 2, 0.6, 7), reversed(wavy(55, 1, 0.2, 3))}, FillRule::nonzero}}});
    REQUIRE(data);
    const NodeId lead[] = {graph->coordinate(0), graph->coordinate(1)};
    Field field;
    field.value = graph->make_block(Op::outline_distance, lead, std::move(*data));
    field.graph = graph;
    field.coordinates = 2;
    std::vector<double> xs, ys;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> place(-3, 3);
    for (int i = 0; i < 1003; ++i) {
        xs.push_back(place(random));
        ys.push_back(place(random));
    }
    std::vector<double> expected;
    for (const Engine engine : {Engine::reference, Engine::vm, Engine::jit}) {
        const auto evaluator = make_evaluator(field, {.engine = engine, .compile_at_once = true});
        REQUIRE(evaluator);
        std::vector<double> values(xs.size());
        const double* const points[] = {xs.data(), ys.data()};
        double* const out[] = {values.data()};
        (*evaluator)->values(points, xs.size(), out);
        if (expected.empty()) expected = values;
        CHECK(values == expected);
    }
    for (std::size_t i = 0; i < xs.size(); ++i) CHECK(std::isfinite(expected[i]));
}

TEST_CASE("areas that are none are refused") {
    CHECK(shapes::area_data({}).error().message == "there is no area");
    CHECK(shapes::area_data({{{{{{0, 0}, {1, 0}, {2, 0}}}, FillRule::nonzero}}}).error().message ==
          "the contours enclose no area");
    CHECK(shapes::area_data({{{{{{0, 0}, {1, 1}, {1, 1}, {0, 0}}}, FillRule::nonzero}}}).error().message ==
          "the contours enclose no area");
    CHECK(!shapes::area_data({{{{{{0, 0}, {1, NAN}, {1, 1}}}, FillRule::nonzero}}}));
    CHECK(!shapes::area_data({{{{{{0, 0}, {1e13, 0}, {1, 1}}}, FillRule::nonzero}}}));
    CHECK(!shapes::area_data({{{{box(0, 0, 1, 1), reversed(box(0, 0, 1, 1))}, FillRule::nonzero}}}));
}

TEST_CASE("edges of an arrangement share vertices only") {
    Area area;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> place(0, 1);
    for (int i = 0; i < 12; ++i) {
        Ring ring;
        for (int k = 0; k < 5; ++k) ring.push_back({place(random), place(random)});
        area.parts.push_back({{ring}, FillRule::even_odd});
    }
    const auto result = shapes::arrange(area);
    REQUIRE(result);
    const auto& v = result->vertices;
    const auto turn = [](Vec2 a, Vec2 b, Vec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < result->edges.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const auto &e = result->edges[i], &f = result->edges[k];
            if (e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to) continue;
            const double a = turn(v[e.from], v[e.to], v[f.from]), b = turn(v[e.from], v[e.to], v[f.to]);
            const double c = turn(v[f.from], v[f.to], v[e.from]), d = turn(v[f.from], v[f.to], v[e.to]);
            if (a * b < 0 && c * d < 0) ++crossings;
        }
    CHECK(crossings == 0);
    CHECK(result->edges.size() > 500);  // 60 edges of random triangles cross many times
    // the parts are what they were
    Sketch s;
    const Expression f = field_of(s, area);
    for (int i = 0; i < 2000; ++i) {
        const double x = place(random), y = place(random), value = at(f, x, y, 0);
        if (std::fabs(value) > 1e-8) CHECK((value > 0) == inside(area, x, y));
    }
}
