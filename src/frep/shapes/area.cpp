// Data of areas. See area.h.
#include "frep/shapes/area.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "frep/field/kernels/outline.h"
#include "frep/shapes/area_edges.h"

namespace frep::shapes {

namespace {

using namespace kernels::outline_detail;

/// The tree over the edges, all of them with side 1 at first.
class TreeData {
  public:
    TreeData(const Arrangement& arrangement, const Area& area) : a_(arrangement) {
        const std::size_t n = a_.edges.size();
        data_.assign(Tree::items_of(n), 0.0);
        data_[0] = static_cast<double>(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Arrangement::Edge& edge = a_.edges[i];
            const Vec2 from = a_.vertices[edge.from], to = a_.vertices[edge.to];
            const double part = static_cast<double>(edge.part);
            const double group = area.parts[edge.part].rule == FillRule::nonzero ? part : -1.0 - part;
            const double numbers[edge_size] = {from.x, from.y, to.x, to.y, 1.0, group};
            std::copy(std::begin(numbers), std::end(numbers), edge_at(i));
        }
        fill_nodes();
    }

    Tree tree() const {
        const double* edges = data_.data() + 1;
        return {edges, edges + a_.edges.size() * edge_size, a_.edges.size(),
                Tree::leaves_of(a_.edges.size())};
    }
    void set_side(std::size_t edge, double side) { edge_at(edge)[4] = side; }
    std::vector<double> take() { return std::move(data_); }

  private:
    double* edge_at(std::size_t i) { return data_.data() + 1 + i * edge_size; }
    double* node_at(std::size_t i) { return edge_at(a_.edges.size()) + i * node_size; }

    void fill_nodes() {
        std::vector<Part> parts, waiting{{0, 0, Tree::leaves_of(a_.edges.size())}};
        while (!waiting.empty()) {
            const Part part = waiting.back();
            waiting.pop_back();
            parts.push_back(part);
            if (part.is_leaf()) continue;
            waiting.push_back(part.right());
            waiting.push_back(part.left());
        }
        for (std::size_t i = parts.size(); i-- > 0;) fill_node(parts[i]);  // what is below comes first
    }

    void fill_node(const Part& part) {
        double* node = node_at(part.node);
        const std::size_t first = part.first * leaf_edges;
        const std::size_t last = std::min(part.last * leaf_edges, a_.edges.size()) - 1;
        node[0] = node[1] = math::infinity;
        node[2] = node[3] = -math::infinity;
        const auto add = [node](const double* low, const double* high) {
            for (int axis = 0; axis < 2; ++axis) {
                node[axis] = math::min(node[axis], low[axis]);
                node[axis + 2] = math::max(node[axis + 2], high[axis]);
            }
        };
        if (part.is_leaf()) {
            for (std::size_t i = first; i <= last; ++i) {
                add(edge_at(i), edge_at(i));
                add(edge_at(i) + 2, edge_at(i) + 2);
            }
        } else {
            for (const Part& half : {part.left(), part.right()})
                add(node_at(half.node), node_at(half.node) + 2);
        }
        const auto& edges = a_.edges;
        node[4] = edge_at(first)[1];
        node[5] = node[7] = edge_at(last)[3];
        if (edges[first].contour == edges[last].contour) {
            node[6] = node[7] = 0.0;
            return;
        }
        std::size_t end = first, begin = last;
        while (edges[end + 1].contour == edges[first].contour) ++end;
        while (edges[begin - 1].contour == edges[last].contour) --begin;
        node[5] = edge_at(end)[3];
        node[6] = edge_at(begin)[1];
    }

    const Arrangement& a_;
    std::vector<double> data_;
};

/// Edges of the same two vertices, seen from the lower to the upper, or from the left to the right one.
struct Bundle {
    Vec2 low, high;
    std::vector<std::size_t> edges;
    std::map<double, int> times;  ///< by group: how often along less how often against that direction
};

/// Which sides of an edge are filled.
class Sides {
  public:
    Sides(const Tree& tree, double reach) : tree_(tree), reach_(reach) {}

    /// 1 or -1 when the area lies to the left or right of the bundle's direction only, 0 when both sides are
    /// alike; 1 when that is in doubt, which `doubtful` says.
    double side(const Bundle& bundle, bool& doubtful) {
        const Vec2 m{0.5 * (bundle.low.x + bundle.high.x), 0.5 * (bundle.low.y + bundle.high.y)};
        const bool is_level = bundle.low.y == bundle.high.y;
        doubtful = !is_level && !(m.y > bundle.low.y && m.y < bundle.high.y);
        bool left = false, right = false;
        double group = 0;
        int winding = 0;
        bool begun = false;
        const auto finish = [&] {
            if (!begun) return;
            const auto times = bundle.times.find(group);
            const int own = times == bundle.times.end() ? 0 : times->second;
            // the ray towards +x begins left of the bundle without its own edges, or above one that is level
            left = left || is_filled(group, is_level ? winding : winding + own);
            right = right || is_filled(group, is_level ? winding - own : winding);
            winding = 0;
        };
        const auto add = [&](double of, int crossings) {
            if (of != group) finish();
            begun = true;
            group = of;
            winding += crossings;
        };
        waiting_.assign(1, {0, 0, tree_.leaves});
        while (!waiting_.empty() && !doubtful) {
            const Part part = waiting_.back();
            waiting_.pop_back();
            const double* node = tree_.node(part.node);
            const std::size_t first = part.first * leaf_edges;
            const std::size_t last = std::min(part.last * leaf_edges, tree_.count);
            const auto ends = [&](const double* piece) {
                return (piece[1] > m.y ? 1 : 0) - (piece[0] > m.y ? 1 : 0);
            };
            if (m.y < node[1] - reach_ || m.y > node[3] + reach_ || m.x > node[2] + reach_) continue;
            if (m.x < node[0] - reach_) {
                add(tree_.edge(first)[5], ends(node + 4));
                add(tree_.edge(last - 1)[5], ends(node + 6));
            } else if (part.is_leaf()) {
                for (std::size_t i = first; i < last && !doubtful; ++i) {
                    const double* e = tree_.edge(i);
                    const bool own = is_end(e, bundle.low, bundle.high) || is_end(e, bundle.high, bundle.low);
                    if (!own) doubtful = foot_on(e, m.x, m.y).square < reach_ * reach_;
                    add(e[5], own ? 0 : crossing(e, m.x, m.y));
                }
            } else {
                waiting_.push_back(part.right());
                waiting_.push_back(part.left());
            }
        }
        finish();
        if (doubtful) return 1;
        return left == right ? 0 : left ? 1 : -1;
    }

  private:
    static bool is_end(const double* e, Vec2 a, Vec2 b) {
        return e[0] == a.x && e[1] == a.y && e[2] == b.x && e[3] == b.y;
    }

    const Tree& tree_;
    double reach_;
    std::vector<Part> waiting_;
};

std::vector<Bundle> bundles_of(const Arrangement& a, const Tree& tree) {
    std::vector<std::size_t> order(a.edges.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [&](std::size_t i) { return std::minmax({a.edges[i].from, a.edges[i].to}); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t k) { return key(i) < key(k); });
    std::vector<Bundle> bundles;
    for (std::size_t n = 0; n < order.size(); ++n) {
        const std::size_t i = order[n];
        const Vec2 from = a.vertices[a.edges[i].from], to = a.vertices[a.edges[i].to];
        const bool up = from.y != to.y ? from.y < to.y : from.x < to.x;
        if (n == 0 || key(order[n - 1]) != key(i))
            bundles.push_back({up ? from : to, up ? to : from, {}, {}});
        bundles.back().edges.push_back(i);
        bundles.back().times[tree.edge(i)[5]] += up ? 1 : -1;
    }
    return bundles;
}

}  // namespace

Result<std::vector<double>> area_data(const Area& area) {
    const Result<Arrangement> arranged = arrange(area);
    if (!arranged) return arranged.error();
    TreeData data(*arranged, area);
    const Tree tree = data.tree();
    Sides sides(tree, 0.25 * arranged->weld);
    bool bounded = false;
    for (const Bundle& bundle : bundles_of(*arranged, tree)) {
        bool doubtful = false;
        const double side = sides.side(bundle, doubtful);
        bounded = bounded || (side != 0 && !doubtful);
        for (const std::size_t i : bundle.edges) {
            const double* e = tree.edge(i);
            const bool along = e[0] == bundle.low.x && e[1] == bundle.low.y;
            const bool counts = doubtful || i == bundle.edges.front();
            data.set_side(i, counts ? (along ? side : -side) : 0);
        }
    }
    if (!bounded) return Error{ErrorKind::invalid_argument, "the contours enclose no area"};
    return data.take();
}

AreaBox box_of(const Area& area) {
    AreaBox box{{math::infinity, math::infinity}, {-math::infinity, -math::infinity}};
    for (const FilledPart& part : area.parts)
        for (const auto& contour : part.contours)
            for (const Vec2& p : contour) {
                const double at[2] = {p.x, p.y};
                for (int axis = 0; axis < 2; ++axis) {
                    box.low[axis] = math::min(box.low[axis], at[axis]);
                    box.high[axis] = math::max(box.high[axis], at[axis]);
                }
            }
    return box;
}

}  // namespace frep::shapes
