// Edges that share vertices only. See area_edges.h.
#include "frep/shapes/area_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>

#include "frep/geom/predicates.h"

namespace frep::shapes {

namespace {

constexpr std::size_t most_edges = 500'000, most_pairs = 200'000'000;
constexpr double most_coordinate = 1e12, relative_weld = 1e-9;
constexpr int most_rounds = 8;

struct Bounds {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};

    void add(Vec2 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    void add(const Bounds& other) {
        add(other.low);
        add(other.high);
    }
    bool meets(const Bounds& other, double reach) const {
        return low.x <= other.high.x + reach && other.low.x <= high.x + reach &&
               low.y <= other.high.y + reach && other.low.y <= high.y + reach;
    }
};

/// The place of a box's centre on a Z-order curve over `whole`.
std::uint32_t morton(const Bounds& box, const Bounds& whole) {
    const auto cell = [](double low, double high, double at) {
        const double t = high > low ? (at - low) / (high - low) : 0;
        return static_cast<std::uint32_t>(std::clamp(t, 0.0, 1.0) * 65535.0);
    };
    const std::uint32_t x = cell(whole.low.x, whole.high.x, 0.5 * (box.low.x + box.high.x));
    const std::uint32_t y = cell(whole.low.y, whole.high.y, 0.5 * (box.low.y + box.high.y));
    std::uint32_t code = 0;
    for (unsigned bit = 0; bit < 16; ++bit)
        code |= (((x >> bit) & 1u) << (2 * bit)) | (((y >> bit) & 1u) << (2 * bit + 1));
    return code;
}

/// 0..n-1 in the order of the boxes along the curve.
std::vector<std::size_t> in_order(const std::vector<Bounds>& boxes, const Bounds& whole) {
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::uint32_t> keys;
    for (const Bounds& box : boxes) keys.push_back(morton(box, whole));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
    return order;
}

/// Vertices, none within `weld` of another.
class Vertices {
  public:
    Vertices(std::vector<Vec2>& points, double weld) : points_(points), weld_(weld) {}

    std::uint32_t add(Vec2 p) {
        const std::int64_t cx = cell(p.x), cy = cell(p.y);
        for (std::int64_t dy = -1; dy <= 1; ++dy)
            for (std::int64_t dx = -1; dx <= 1; ++dx) {
                const auto [first, last] = cells_.equal_range(key(cx + dx, cy + dy));
                for (auto i = first; i != last; ++i) {
                    const Vec2 away = points_[i->second] - p;
                    if (away.x * away.x + away.y * away.y <= weld_ * weld_) return i->second;
                }
            }
        points_.push_back(p);
        const auto id = static_cast<std::uint32_t>(points_.size() - 1);
        cells_.emplace(key(cx, cy), id);
        return id;
    }

  private:
    std::int64_t cell(double a) const { return static_cast<std::int64_t>(std::floor(a / (2 * weld_))); }
    static std::uint64_t key(std::int64_t x, std::int64_t y) {
        return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^
               static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu;
    }

    std::vector<Vec2>& points_;
    double weld_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

class Arranger {
  public:
    explicit Arranger(const Area& area) : area_(area) {}

    Result<Arrangement> run() {
        Bounds whole;
        for (const FilledPart& part : area_.parts)
            for (const auto& contour : part.contours)
                for (const Vec2& p : contour) {
                    if (!(std::fabs(p.x) <= most_coordinate && std::fabs(p.y) <= most_coordinate))
                        return Error{ErrorKind::invalid_argument, "a coordinate is not finite or too large"};
                    whole.add(p);
                }
        const double size = std::max(whole.high.x - whole.low.x, whole.high.y - whole.low.y);
        // no finer than the coordinates are
        const double largest = std::max({std::fabs(whole.low.x), std::fabs(whole.low.y),
                                         std::fabs(whole.high.x), std::fabs(whole.high.y)});
        out_.weld = std::max(relative_weld * size, 0x1p-48 * largest);
        if (!(size > 0)) return Error{ErrorKind::invalid_argument, "there is no area"};
        Vertices vertices(out_.vertices, out_.weld);
        collect(vertices, whole);
        for (int round = 0; round < most_rounds; ++round) {
            if (out_.edges.size() > most_edges) break;
            if (!find_cuts(vertices))
                return Error{ErrorKind::over_limit, "the contours cross one another too often"};
            if (cuts_.empty()) break;
            divide();
        }
        if (out_.edges.empty()) return Error{ErrorKind::invalid_argument, "there is no area"};
        if (out_.edges.size() > most_edges)
            return Error{ErrorKind::over_limit,
                         fmt::format("more than {} edges between crossings", most_edges)};
        return std::move(out_);
    }

  private:
    void collect(Vertices& vertices, const Bounds& whole) {
        std::vector<Bounds> parts(area_.parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i)
            for (const auto& contour : area_.parts[i].contours)
                for (const Vec2& p : contour) parts[i].add(p);
        std::uint32_t contour_number = 0;
        for (const std::size_t i : in_order(parts, whole)) {
            const FilledPart& part = area_.parts[i];
            std::vector<Bounds> boxes(part.contours.size());
            for (std::size_t k = 0; k < boxes.size(); ++k)
                for (const Vec2& p : part.contours[k]) boxes[k].add(p);
            for (const std::size_t k : in_order(boxes, whole)) {
                std::vector<std::uint32_t> ring;
                for (const Vec2& p : part.contours[k]) {
                    const std::uint32_t id = vertices.add(p);
                    if (ring.empty() || ring.back() != id) ring.push_back(id);
                }
                while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
                if (ring.size() < 2) continue;
                for (std::size_t e = 0; e < ring.size(); ++e)
                    out_.edges.push_back({ring[e], ring[(e + 1) % ring.size()], static_cast<std::uint32_t>(i),
                                          contour_number});
                ++contour_number;
            }
        }
    }

    Bounds box_of(const Arrangement::Edge& edge) const {
        Bounds box;
        box.add(out_.vertices[edge.from]);
        box.add(out_.vertices[edge.to]);
        return box;
    }

    /// Boxes over runs of edges: level 0 has the edges, each further level pairs of the one below.
    void build_boxes() {
        levels_.assign(1, {});
        for (const auto& edge : out_.edges) levels_[0].push_back(box_of(edge));
        while (levels_.back().size() > 1) {
            const std::vector<Bounds>& below = levels_.back();
            std::vector<Bounds> above((below.size() + 1) / 2);
            for (std::size_t i = 0; i < below.size(); ++i) above[i / 2].add(below[i]);
            levels_.push_back(std::move(above));
        }
    }

    /// Fills `cuts_` with places where edges are to be divided; false when there are too many pairs.
    bool find_cuts(Vertices& vertices) {
        cuts_.clear();
        build_boxes();
        struct Place {
            std::size_t level, index;
        };
        std::vector<Place> waiting;
        for (std::size_t e = 0; e < out_.edges.size(); ++e) {
            const Bounds box = levels_[0][e];
            waiting.assign(1, {levels_.size() - 1, 0});
            while (!waiting.empty()) {
                const auto [level, index] = waiting.back();
                waiting.pop_back();
                // pairs are tried from their first edge
                if (((index + 1) << level) <= e + 1 || !levels_[level][index].meets(box, 2 * out_.weld))
                    continue;
                if (++pairs_ > most_pairs) return false;
                if (level == 0) {
                    try_pair(e, index, vertices);
                    continue;
                }
                for (std::size_t child = 2 * index;
                     child < std::min(2 * index + 2, levels_[level - 1].size()); ++child)
                    waiting.push_back({level - 1, child});
            }
        }
        return true;
    }

    /// Divides `edge` at a vertex that lies upon it, but for its own ends.
    bool cut_at(std::size_t edge, std::uint32_t vertex) {
        const Arrangement::Edge& e = out_.edges[edge];
        if (vertex == e.from || vertex == e.to) return false;
        const Vec2 a = out_.vertices[e.from], d = out_.vertices[e.to] - a, p = out_.vertices[vertex] - a;
        const double square = d.x * d.x + d.y * d.y, along = p.x * d.x + p.y * d.y;
        const double turn = d.x * p.y - d.y * p.x;
        if (!(along > 0 && along < square) || turn * turn > out_.weld * out_.weld * square) return false;
        cuts_.push_back({edge, along / square, vertex});
        return true;
    }

    void try_pair(std::size_t e, std::size_t f, Vertices& vertices) {
        const Arrangement::Edge a = out_.edges[e], b = out_.edges[f];
        bool touches = a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
        touches |= cut_at(e, b.from);
        touches |= cut_at(e, b.to);
        touches |= cut_at(f, a.from);
        touches |= cut_at(f, a.to);
        if (touches) return;
        const Vec2 p = out_.vertices[a.from], q = out_.vertices[a.to], r = out_.vertices[b.from],
                   s = out_.vertices[b.to];
        if (orient2d(p, q, r) * orient2d(p, q, s) >= 0 || orient2d(r, s, p) * orient2d(r, s, q) >= 0) return;
        const Vec2 u = q - p, v = s - r, w = r - p;
        const double below = u.x * v.y - u.y * v.x;
        const double t = std::clamp((w.x * v.y - w.y * v.x) / below, 0.0, 1.0);
        if (!(t == t)) return;  // nearly parallel beyond what doubles tell
        const std::uint32_t meeting = vertices.add(p + u * t);
        const auto cut = [&](std::size_t edge, const Arrangement::Edge& ends, Vec2 from, Vec2 along) {
            if (meeting == ends.from || meeting == ends.to) return;
            const Vec2 at = out_.vertices[meeting] - from;
            cuts_.push_back(
                {edge, (at.x * along.x + at.y * along.y) / (along.x * along.x + along.y * along.y), meeting});
        };
        cut(e, a, p, u);
        cut(f, b, r, v);
    }

    void divide() {
        std::sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) {
            return a.edge != b.edge     ? a.edge < b.edge
                   : a.along != b.along ? a.along < b.along
                                        : a.vertex < b.vertex;
        });
        std::vector<Arrangement::Edge> edges;
        std::size_t next = 0;
        for (std::size_t e = 0; e < out_.edges.size(); ++e) {
            Arrangement::Edge rest = out_.edges[e];
            for (; next < cuts_.size() && cuts_[next].edge == e; ++next) {
                if (cuts_[next].vertex == rest.from) continue;
                Arrangement::Edge first = rest;
                first.to = rest.from = cuts_[next].vertex;
                edges.push_back(first);
            }
            if (rest.from != rest.to) edges.push_back(rest);
        }
        out_.edges = std::move(edges);
    }

    struct Cut {
        std::size_t edge;
        double along;
        std::uint32_t vertex;
    };

    const Area& area_;
    Arrangement out_;
    std::vector<std::vector<Bounds>> levels_;
    std::vector<Cut> cuts_;
    std::size_t pairs_ = 0;
};

}  // namespace

Result<Arrangement> arrange(const Area& area) { return Arranger(area).run(); }

}  // namespace frep::shapes
