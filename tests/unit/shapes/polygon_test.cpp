// Polygons as functions: the worked example of the monotone formula, signs against point-in-polygon tests on
// shapes with nested pockets, collinear chains and random stars, zeros on the boundary only, distances, and
// what is refused.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/shapes/polygon.h"
#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

/// Even-odd rule along +x.
bool is_inside(const std::vector<Vec2>& v, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 &a = v[i], &b = v[(i + 1) % v.size()];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}
double distance_to(const std::vector<Vec2>& v, double x, double y) {
    double best = 1e300;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 &a = v[i], &b = v[(i + 1) % v.size()];
        const double ex = b.x - a.x, ey = b.y - a.y;
        const double t =
            std::min(1.0, std::max(0.0, ((x - a.x) * ex + (y - a.y) * ey) / (ex * ex + ey * ey)));
        best = std::min(best, std::hypot(x - a.x - t * ex, y - a.y - t * ey));
    }
    return best;
}

Items numbers_of(Sketch& s, const std::vector<Vec2>& v) {
    Items out;
    for (const Vec2& p : v) {
        out.push_back(s.number(p.x));
        out.push_back(s.number(p.y));
    }
    return out;
}

void check_signs(const std::vector<Vec2>& v, double reach) {
    using Kind = shapes::SetSystem::Kind;
    for (const auto& system : {shapes::SetSystem{Kind::r0, 0}, shapes::SetSystem{Kind::min_max, 0}}) {
        Sketch s;
        s.build.set_system = system;
        Items points = numbers_of(s, v);
        const Expression f = s.call("hfPolygon", {s.x, points}), d = s.call("hfDPolygon", {s.x, points});
        REQUIRE(s.warnings.empty());
        std::size_t wrong = 0;
        for (int i = 0; i < 57; ++i) {
            for (int k = 0; k < 53; ++k) {
                const double x = reach * (i / 28.0 - 1.0013), y = reach * (k / 26.0 - 0.9987);
                const double away = distance_to(v, x, y);
                if (away < 1e-9) continue;
                const bool inside = is_inside(v, x, y);
                wrong += (at(f, x, y, 0) > 0) != inside;
                wrong += std::abs(at(d, x, y, 0) - (inside ? away : -away)) > 1e-12 * reach;
            }
        }
        CHECK(wrong == 0);
        for (std::size_t i = 0; i < v.size(); ++i) {  // 0 on the boundary
            const Vec2 &a = v[i], &b = v[(i + 1) % v.size()];
            for (const double t : {0.0, 0.3, 0.77})
                CHECK(std::abs(at(f, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0)) < 1e-13 * reach);
        }
    }
}

}  // namespace

TEST_CASE("the worked example: one notch") {
    Sketch s;
    Items points = numbers_of(s, {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
    const Expression f = s.call("hfPolygon", {s.x, points});
    // the same half-planes by hand: h0 & h1 & (h2 | h3) & h4
    const auto h = [&](double ax, double ay, double bx, double by) {
        const double l = std::hypot(bx - ax, by - ay);
        return (s.x[0] - ax) * (-(by - ay) / l) + (s.x[1] - ay) * ((bx - ax) / l);
    };
    const Expression h0 = h(0, 0, 4, 0), h1 = h(4, 0, 4, 4), h2 = h(4, 4, 2, 1), h3 = h(2, 1, 0, 4),
                     h4 = h(0, 4, 0, 0);
    const Expression by_hand = r_and(r_and(r_and(h0, h1), r_or(h2, h3)), h4);
    CHECK(at(by_hand, 2, 0.5, 0) == Approx(0.312859751066).epsilon(1e-10));
    for (const auto& [x, y] : {std::pair{2.0, 0.5}, {2.0, 2.0}, {1.0, 1.0}, {5.0, 5.0}, {0.5, 3.0}})
        CHECK((at(f, x, y, 0) > 0) == (at(by_hand, x, y, 0) > 0));
    CHECK(std::abs(at(f, 2, 1, 0)) < 1e-15);
    std::size_t half_planes = 0;  // each occurs once: five sums of two products
    const NodeId roots[] = {f.id()};
    const std::vector<bool> needed = reachable(s.graph, roots);
    for (NodeId id = 0; id < s.graph.size(); ++id)
        half_planes += needed[id] && s.graph.node(id).op == Op::add;
    CHECK(half_planes <= 5);
}

TEST_CASE("signs of polygons with nested pockets") {
    check_signs({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}, 5);
    // a spiral: pockets in pockets in pockets
    check_signs({{-4, -4},   {4, -4},      {4, 4},       {-3, 4},    {-3, -3},    {3, -3},      {3, 3},
                 {-2, 3},    {-2, -2},     {2, -2},      {2, 2},     {-1, 2},     {-1, -1},     {1, -1},
                 {1, -1.5},  {-1.5, -1.5}, {-1.5, 2.5},  {2.5, 2.5}, {2.5, -2.5}, {-2.5, -2.5}, {-2.5, 3.5},
                 {3.5, 3.5}, {3.5, -3.5},  {-3.5, -3.5}, {-3.5, 4},  {-4, 4}},
                5);
    // teeth of one height: collinear vertices on the hull and on lids
    check_signs({{-4, -2},
                 {4, -2},
                 {4, 2},
                 {3, 2},
                 {3, 0},
                 {2, 0},
                 {2, 2},
                 {1, 2},
                 {1, 0},
                 {0, 0},
                 {0, 2},
                 {-1, 2},
                 {-1, 0},
                 {-2, 0},
                 {-2, 2},
                 {-4, 2}},
                5);
    // collinear vertices on an edge, clockwise
    check_signs({{-2, -2}, {-2, 0}, {-2, 1}, {-2, 2}, {2, 2}, {2, -2}, {1, -2}, {0, -2}}, 3);
}

TEST_CASE("signs of random stars and of a pocket that bends back") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> radius(0.2, 2);
    for (int n = 5; n < 60; n += 9) {
        std::vector<Vec2> v;
        for (int i = 0; i < n; ++i) {
            const double phi = 6.283185307179586 * i / n, r = radius(random);
            v.push_back({r * std::cos(phi), r * std::sin(phi)});
        }
        check_signs(v, 2.2);
    }
    // a chain that is not monotone in any direction: scans in the order of the chain get its hull wrong
    check_signs({{0, 0},
                 {6, 0},
                 {6, 5},
                 {4, 5},
                 {4, 2},
                 {2, 2},
                 {2, 3},
                 {3, 3},
                 {3, 4.5},
                 {1, 4.5},
                 {1, 1},
                 {5, 1},
                 {5, 0.5},
                 {0, 0.5}},
                7);
}

TEST_CASE("what is no simple polygon is refused") {
    const auto refused = [](const std::vector<Vec2>& v, const char* text) {
        Sketch s;
        Items points = numbers_of(s, v);
        CHECK(at(s.call("hfPolygon", {s.x, points}), 0, 0, 0) == shapes::error_value);
        REQUIRE(s.warnings.size() == 1);
        CHECK(s.warnings[0].find(text) != std::string::npos);
    };
    refused({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, "the edges after the vertices 1 and 3 meet");
    refused({{0, 0}, {1, 1}}, "three different vertices");
    refused({{0, 0}, {0, 0}, {1, 1}, {0, 0}}, "three different vertices");
    refused({{0, 0}, {2, 0}, {1, 0}, {1, 1}}, "turns back at vertex 2");
    refused({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}, "meet");  // a vertex on another edge
    Sketch s;
    Items odd = s.list({0, 0, 1, 0, 1});
    CHECK(at(s.call("hfPolygon", {s.x, odd}), 0, 0, 0) == shapes::error_value);
    Items moving = s.list({0, 0, 1, 0, 1, 1});
    moving[0] = s.x[0];
    CHECK(at(s.call("hfPolygon", {s.x, moving}), 0, 0, 0) == shapes::error_value);
}

TEST_CASE("vertices that repeat, and a closed ring, count once") {
    const auto outline = shapes::make_outline({{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
    CHECK(outline.problem.empty());
    CHECK(outline.vertices.size() == 4);
}
