// Polygons and their rows. See polygon.h.
#include "frep/shapes/polygon.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/math/number.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/set_operations.h"

namespace frep::shapes {

namespace {

/// Vertices of one polygon function; its edges are tested pair by pair.
constexpr std::size_t most_vertices = 4096;

double turn(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

double area(const std::vector<Vec2>& v) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 &a = v[i], &b = v[(i + 1) % v.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * sum;
}

bool between(double a, double b, double c) { return std::min(a, b) <= c && c <= std::max(a, b); }

/// True when the segments a-b and c-d have a common point.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    const auto sign = [](double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; };
    const int c_side = sign(turn(a, b, c)), d_side = sign(turn(a, b, d));
    const int a_side = sign(turn(c, d, a)), b_side = sign(turn(c, d, b));
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    const auto on = [](Vec2 p, Vec2 q, Vec2 r) { return between(p.x, q.x, r.x) && between(p.y, q.y, r.y); };
    return (c_side == 0 && on(a, b, c)) || (d_side == 0 && on(a, b, d)) || (a_side == 0 && on(c, d, a)) ||
           (b_side == 0 && on(c, d, b));
}

/// The two edges that touch though they should not, as a message; empty for a simple polygon.
std::string crossing(const std::vector<Vec2>& v) {
    const std::size_t n = v.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = v[i], &b = v[(i + 1) % n], &c = v[(i + 2) % n];
        // neighbours share a vertex; they must not lie upon one another
        if (turn(a, b, c) == 0 && (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) < 0)
            return fmt::format("the polygon turns back at vertex {}", (i + 1) % n + 1);
        for (std::size_t k = i + 2; k < n; ++k) {
            if (i == 0 && k == n - 1) continue;
            if (meet(a, b, v[k], v[(k + 1) % n]))
                return fmt::format("the edges after the vertices {} and {} meet", i + 1, k + 1);
        }
    }
    return {};
}

class Formula {
  public:
    Formula(const SetSystem& system, const std::vector<Vec2>& vertices, Expression x, Expression y)
        : system_(system), v_(vertices), x_(x), y_(y) {}

    /// The whole ring as a chain from a vertex of the hull to itself. A chain is divided at the vertices of
    /// its hull; its parts are edges, or pockets, which are chains of the other operation. A loop, since
    /// pockets may nest as deep as there are vertices.
    Expression whole() {
        const std::size_t n = v_.size();
        // start at a vertex that is surely on the hull
        std::size_t start = 0;
        for (std::size_t i = 1; i < n; ++i)
            if (v_[i].x < v_[start].x || (v_[i].x == v_[start].x && v_[i].y < v_[start].y)) start = i;
        struct Task {
            std::size_t first, last;
            bool conjunction;
            std::vector<std::size_t> corners;  ///< of the hull, from first to last
            std::size_t next = 0;
            std::vector<Expression> parts;
        };
        std::vector<Task> stack;
        Expression done;
        const auto push = [&](std::size_t first, std::size_t last, bool conjunction) {
            stack.push_back({first, last, conjunction, hull(first, last), 0, {}});
        };
        push(start, start + n, true);
        while (!stack.empty()) {
            Task& task = stack.back();
            if (task.next + 1 == task.corners.size()) {
                done = task.conjunction ? conjunction(system_, task.parts) : disjunction(system_, task.parts);
                stack.pop_back();
                if (!stack.empty()) stack.back().parts.push_back(done);
                continue;
            }
            const std::size_t first = task.corners[task.next], last = task.corners[task.next + 1];
            ++task.next;
            if (last == first + 1) {
                task.parts.push_back(half_plane(first));
            } else {
                push(first, last, !task.conjunction);
            }
        }
        return done;
    }

  private:
    Vec2 at(std::size_t i) const { return v_[i % v_.size()]; }

    /// The vertices of the chain that lie on its convex hull, in the order of the chain, with its two ends
    /// (Andrew 1979). Vertices on the hull's edges count, so that each part of a chain has fewer vertices.
    std::vector<std::size_t> hull(std::size_t first, std::size_t last) const {
        std::vector<std::size_t> sorted;
        for (std::size_t i = first; i <= last; ++i)
            if (i == first || i % v_.size() != first % v_.size()) sorted.push_back(i);
        std::sort(sorted.begin(), sorted.end(), [this](std::size_t i, std::size_t k) {
            return at(i).x != at(k).x ? at(i).x < at(k).x : at(i).y < at(k).y;
        });
        std::vector<std::size_t> out{first, last}, side;
        for (const double sense : {1.0, -1.0}) {
            side.clear();
            for (const std::size_t i : sorted) {
                while (side.size() > 1 && sense * turn(at(side[side.size() - 2]), at(side.back()), at(i)) < 0)
                    side.pop_back();
                side.push_back(i);
            }
            out.insert(out.end(), side.begin(), side.end());
        }
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    Expression half_plane(std::size_t i) const {
        const Vec2 a = at(i), b = at(i + 1);
        const double length = math::hypot(b.x - a.x, b.y - a.y);
        const double nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;
        return (x_ - a.x) * nx + (y_ - a.y) * ny;
    }

    const SetSystem& system_;
    const std::vector<Vec2>& v_;
    Expression x_, y_;
};

}  // namespace

Outline make_outline(std::vector<Vec2> vertices) {
    Outline out;
    const auto same = [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; };
    for (const Vec2& v : vertices) {
        if (v.x - v.x != 0 || v.y - v.y != 0) return {{}, "a vertex is not finite"};
        if (out.vertices.empty() || !same(out.vertices.back(), v)) out.vertices.push_back(v);
    }
    while (out.vertices.size() > 1 && same(out.vertices.front(), out.vertices.back()))
        out.vertices.pop_back();
    if (out.vertices.size() < 3) return {{}, "a polygon has at least three different vertices"};
    if (out.vertices.size() > most_vertices)
        return {{}, fmt::format("a polygon has at most {} vertices", most_vertices)};
    out.problem = crossing(out.vertices);
    if (!out.problem.empty()) return out;
    if (area(out.vertices) < 0) std::reverse(out.vertices.begin(), out.vertices.end());
    return out;
}

bool outlines_meet(const Outline& first, const Outline& second) {
    const std::vector<Vec2>&v = first.vertices, &w = second.vertices;
    for (std::size_t i = 0; i < v.size(); ++i)
        for (std::size_t k = 0; k < w.size(); ++k)
            if (meet(v[i], v[(i + 1) % v.size()], w[k], w[(k + 1) % w.size()])) return true;
    return false;
}

Expression monotone_polygon(const SetSystem& system, const Outline& outline, Expression x, Expression y) {
    return Formula(system, outline.vertices, x, y).whole();
}

Expression polygon_distance(const Outline& outline, Expression x, Expression y) {
    const std::vector<Vec2>& v = outline.vertices;
    std::vector<Expression> edges;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 a = v[i], b = v[(i + 1) % v.size()];
        const double ex = b.x - a.x, ey = b.y - a.y, square_length = ex * ex + ey * ey;
        const Expression px = x - a.x, py = y - a.y;
        const Expression along = max(min((px * ex + py * ey) / square_length, 1.0), 0.0);
        edges.push_back(hypot(px - along * ex, py - along * ey));
    }
    const SetSystem sharp{SetSystem::Kind::min_max, 0};
    const Expression distance = conjunction(sharp, edges);
    const Expression sign = monotone_polygon(sharp, outline, x, y);
    return select(less(sign, 0.0), -distance, distance);
}

namespace {

/// The outline that an array of coordinates says, for the present parameters.
Outline outline_of(Build& build, Array points) {
    std::vector<Vec2> vertices;
    if (points.size() % 2 != 0) return {{}, "the vertices must be pairs of numbers"};
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        const auto px = known(build, points[i]), py = known(build, points[i + 1]);
        if (!px || !py) return {{}, "a vertex depends on the point of space"};
        vertices.push_back({*px, *py});
    }
    return make_outline(std::move(vertices));
}

template <class Make>
Expression polygon_of(Build& build, Array x, Array points, Make make) {
    if (x.size() < 2) return build.error("x must have 2 items or more");
    const Outline outline = outline_of(build, points);
    if (!outline.problem.empty()) return build.error(outline.problem);
    return make(outline);
}

Expression polygon(Build& build, Array x, Array points) {
    return polygon_of(build, x, points, [&](const Outline& outline) {
        return monotone_polygon(build.set_system, outline, x[0], x[1]);
    });
}
Expression distance(Build& build, Array x, Array points) {
    return polygon_of(build, x, points,
                      [&](const Outline& outline) { return polygon_distance(outline, x[0], x[1]); });
}

}  // namespace

Rows polygon_rows() {
    constexpr std::string_view names = "x, points", cite = "pasko1996";
    constexpr std::string_view note =
        "points = {x1, y1, x2, y2, ...}, a simple polygon in either direction; one that crosses itself is "
        "refused. Holes: subtract their polygons.";
    return {
        row<&polygon>(
            "hfPolygon", names,
            {"Polygon of the plane by the monotone formula: each edge's half-plane once.",
             "h1 & (h2 | h3 & ...) over convex hulls, by the file's system of operations", cite, note},
            false),
        row<&distance>("hfDPolygon", names,
                       {"Signed distance to a polygon of the plane, positive inside.",
                        "+-min over edges of the distance to the edge",
                        {},
                        note},
                       false),
    };
}

}  // namespace frep::shapes
