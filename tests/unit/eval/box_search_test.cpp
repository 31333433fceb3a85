// The search itself: known largest values in one to three variables, places at ends, inside, on the ball, in
// concave and other functions; the number of looks stays small where functions are smooth.
#include "frep/eval/box_search.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "frep/field/expression.h"

using namespace frep;
using math::Interval;

namespace {

/// A function as a graph over coordinates, computed in slopes.
class GraphFunction final : public SearchedFunction {
  public:
    GraphFunction(const Graph& graph, NodeId root) : graph_(graph), slopes_(root + 1) {}
    Slope slope(std::span<const Interval> box) override {
        for (NodeId id = 0; id < slopes_.size(); ++id) {
            const Node& node = graph_.node(id);
            if (node.op == Op::constant) {
                slopes_[id] = Slope::constant(Interval(graph_.constant_of(id)));
            } else if (node.op == Op::coordinate) {
                slopes_[id] = node.payload < box.size() ? Slope::variable(box[node.payload], node.payload)
                                                        : Slope::constant(Interval(0.0));
            } else {
                std::vector<const Slope*> arguments;
                for (const NodeId a : graph_.arguments(id)) arguments.push_back(&slopes_[a]);
                const auto parts = rounded_minimum(graph_, id);
                auto rounded = parts ? rounded_minimum_slope(slopes_[parts->a], slopes_[parts->b],
                                                             slopes_[parts->r], box.size(), true)
                                     : std::nullopt;
                slopes_[id] =
                    rounded ? *rounded : slope_of(node.op, arguments, graph_.block_of(id), box.size());
            }
        }
        return slopes_.back();
    }

  private:
    const Graph& graph_;
    std::vector<Slope> slopes_;
};

struct Problem {
    Graph graph;
    Expression t[3] = {
        {graph, graph.coordinate(0)}, {graph, graph.coordinate(1)}, {graph, graph.coordinate(2)}};

    BoxSearchResult search(Expression f, std::size_t variables, double tolerance, bool in_ball = false) {
        GraphFunction function(graph, f.id());
        return search_box(function, {variables, tolerance, in_ball, 1 << 15});
    }
};

/// Finished, and the value is within the tolerance of `want` (which both bounds enclose).
bool finds(const BoxSearchResult& r, double want, double tolerance) {
    const double slack = 1.01 * tolerance * std::max(1.0, std::abs(want));
    return r.finished && r.least <= want + 1e-12 && r.most >= want - 1e-12 && r.least >= want - slack;
}

}  // namespace

TEST_CASE("one variable: smooth, at the ends, kinked, with many peaks, without slopes") {
    Problem p;
    const Expression t = p.t[0];
    const BoxSearchResult smooth = p.search(2.0 - square(t - 0.3), 1, 1e-9);
    CHECK(finds(smooth, 2, 1e-9));
    CHECK(smooth.place[0] == doctest::Approx(0.3));
    CHECK(smooth.calls < 8);
    CHECK(finds(p.search(t - 5.0, 1, 1e-9), -4, 1e-9));
    CHECK(finds(p.search(exp(-t), 1, 1e-9), 1, 1e-9));
    const BoxSearchResult kink = p.search(-abs(t - 0.7), 1, 1e-9);
    CHECK(finds(kink, 0, 1e-9));
    CHECK(kink.calls < 12);
    const double pi = 3.14159265358979323846;
    CHECK(
        finds(p.search(sin(10 * pi * t) + 0.1 * t, 1, 1e-6), 1 + 0.1 * (0.85 + 0.1 / (200 * pi * pi)), 1e-5));
    CHECK(finds(p.search(floor(3.0 * t + 0.2) - abs(t - 0.5), 1, 1e-3), 3.5 - 2.8 / 3, 1e-3));  // a step
    const double s = std::sqrt(1.25) - 1;
    CHECK(finds(p.search(sqrt(t - 0.5) + log(0.75 - t), 1, 1e-3), s + std::log(0.25 - s * s), 1e-3));
    const BoxSearchResult none = p.search(log(t - 2.0), 1, 1e-6);
    CHECK(none.finished);
    CHECK(none.most == -math::infinity);
}

TEST_CASE("two and three variables") {
    Problem p;
    const Expression u = p.t[0], v = p.t[1], w = p.t[2];
    const Expression bowl = 1.0 - square(u - 0.3) - 2.0 * square(v - 0.6) - (u - 0.3) * (v - 0.6);
    const BoxSearchResult smooth = p.search(bowl, 2, 1e-6);
    CHECK(finds(smooth, 1, 1e-6));
    CHECK(finds(p.search(bowl - square(w - 0.9), 3, 1e-6), 1, 1e-6));
    CHECK(finds(p.search(bowl + 3.0 * w, 3, 1e-6), 4, 1e-6));   // a face
    CHECK(finds(p.search(u + v * 2.0 - w, 3, 1e-6), 3, 1e-6));  // a corner
    // two cones: not concave
    const auto cone = [&](double a, double b, double height) { return height - hypot(u - a, v - b); };
    CHECK(finds(p.search(max(cone(0.2, 0.3, 1.0), cone(0.7, 0.8, 1.1)), 2, 1e-3), 1.1, 1e-3));
    // the smaller of two cones, largest half way between: a kink across the axes
    CHECK(finds(p.search(min(cone(0.1, 0.2, 1.0), cone(0.7, 1.0, 1.0)), 2, 1e-4), 0.5, 1e-4));
    const Expression near = hypot(hypot(u - 0.1, v - 0.2), w - 0.3),
                     far = hypot(hypot(u - 0.7, v - 1.0), w - 0.3);
    const BoxSearchResult lens = p.search(min(1.0 - near, 1.0 - far), 3, 1e-3);
    CHECK(finds(lens, 0.5, 1e-3));
    CHECK(lens.calls < 400);
}

TEST_CASE("in the ball: inside, on its surface") {
    Problem p;
    const Expression u = p.t[0], v = p.t[1], w = p.t[2];
    const double corner = 0.5 * std::sqrt(2.0);
    CHECK(finds(p.search(u + v, 2, 1e-6, true), 1 + corner, 1e-6));
    CHECK(finds(p.search(u + v + w, 3, 1e-6, true), 1.5 + 0.5 * std::sqrt(3.0), 1e-6));
    CHECK(finds(p.search(1.0 - square(u - 0.6) - square(v - 0.5), 2, 1e-6, true), 1, 1e-6));
    CHECK(finds(p.search(-square(u - 2.0) - square(v - 0.5) - square(w - 0.5), 3, 1e-6, true), -1, 1e-6));
    // convex: the largest value on the surface, on both sides
    CHECK(finds(p.search(square(u - 0.5) + 0.5 * square(v - 0.5), 2, 1e-3, true), 0.25, 1e-3));
}

TEST_CASE("the rounded smaller one of a block and a ball is known to be concave") {
    Problem p;
    const auto [u, v, w] = p.t;
    const Expression block = min(min(0.3 - abs(u - 0.5), 0.2 - abs(v - 0.4)), 0.25 - abs(w - 0.5));
    const Expression ball = 0.04 - square(u - 0.9) - square(v - 0.3) - square(w - 0.6);
    const Expression r = Expression::constant(u, 0.01);
    const Expression f = 0.5 * (block + ball + r - hypot(block - ball, r));
    CHECK(rounded_minimum(p.graph, p.graph.arguments(f.id())[1]));
    CHECK_FALSE(rounded_minimum(p.graph, f.id()));
    const BoxSearchResult found = p.search(f, 3, 1e-3);
    double most = -1;
    for (int i = 0; i <= 60; ++i)
        for (int j = 0; j <= 60; ++j)
            for (int k = 0; k <= 60; ++k) {
                const double x = i / 60.0, y = j / 60.0, z = k / 60.0;
                const double a =
                    std::min({0.3 - std::abs(x - 0.5), 0.2 - std::abs(y - 0.4), 0.25 - std::abs(z - 0.5)});
                const double b = 0.04 - (x - 0.9) * (x - 0.9) - (y - 0.3) * (y - 0.3) - (z - 0.6) * (z - 0.6);
                most = std::max(most, 0.5 * (a + b + 0.01 - std::hypot(a - b, 0.01)));
            }
    CHECK(found.finished);
    CHECK(found.most >= most);
    CHECK(found.least >= most - 1e-3);
    CHECK(found.least <= most + 0.01);
    CHECK(found.calls < 120);
}

TEST_CASE("the slopes of random points lie within those of boxes around them") {
    Problem p;
    const Expression u = p.t[0], v = p.t[1];
    const Expression parts[] = {
        u * v - square(u) / (1.5 + v),
        hypot(u - 0.4, v - 0.5) * exp(-u),
        r_and(u - 0.3, 0.6 - v),
        r_or(u - v, square(v) - 0.2),
        min(sin(3.0 * u), cos(2.0 * v + u)),
        max(abs(u - v), atan(4.0 * u) * 0.5),
        sqrt(u + 0.1) + log(v + 0.5),
        pow(u - 0.5, 3.0) + pow(v + 0.2, 1.5) - pow(u, 2.0),
        sin(u) + square(v) + 0.3 - hypot(sin(u) - square(v), 0.3),
    };
    for (const Expression& f : parts) {
        GraphFunction function(p.graph, f.id());
        for (int i = 0; i < 200; ++i) {
            const double a = 0.05 * (i % 17), b = 0.06 * (i % 13), size = 0.04 * (i % 5);
            const Interval box[] = {{a, a + size}, {b, b + size}};
            const Slope whole = function.slope(box);
            const auto at = [&](double x, double y) {
                const Interval point[] = {Interval(x), Interval(y)};
                return function.slope(point).value.lo;
            };
            const double h = size / 7;
            for (int k = 0; k < 49 && size > 0; ++k) {
                const double x = a + h * (k % 6), y = b + h * static_cast<double>(k / 7 % 6);
                const double du = (at(x + h, y) - at(x, y)) / h, dv = (at(x, y + h) - at(x, y)) / h;
                CAPTURE(i);
                CHECK(du >= whole.d[0].lo - 1e-9);
                CHECK(du <= whole.d[0].hi + 1e-9);
                CHECK(dv >= whole.d[1].lo - 1e-9);
                CHECK(dv <= whole.d[1].hi + 1e-9);
                const double bend =
                    (at(x + h, y + h) - 2 * at(x + h / 2, y + h / 2) + at(x, y)) / (h * h / 2);
                CHECK(bend >= whole.curvature.lo - 1e-6);
                CHECK(bend <= whole.curvature.hi + 1e-6);
            }
        }
    }
}
