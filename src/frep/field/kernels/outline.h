// Kernel of outline_distance: the true signed distance to areas of the plane that are bounded by many edges.
// The sign is the winding number of each group of closed contours under its fill rule (a point is inside when
// one of the groups says so), the distance that to the nearest edge of the boundary. Both are found by a
// binary tree over the edges in the order of the contours: a part of a contour whose box lies beside the
// point crosses the point's ray as its two ends say, so that only boxes around the point are opened (after
// Jacobson, Kavan and Sorkine-Hornung, Robust inside-outside segmentation using generalized winding numbers,
// 2013). Data are made by shapes/area.h. Tested by tests/unit/shapes/area_test.cpp.
#pragma once

#include <cstddef>

#include "frep/field/kernels/support.h"

namespace frep::kernels {

namespace outline_detail {

/// Data: the number of edges n; n edges of six numbers; the nodes of the tree, eight numbers each, a node
/// before its left part and that before its right part. The layout follows from n alone.
///
/// An edge: a.x, a.y, b.x, b.y; side, 1 or -1 when the boundary has its inside to the left or right of the
/// edge, 0 when the edge bounds nothing; group, whose parts are counted together: g for the nonzero rule,
/// -1 - g for the even-odd rule. A node: low x, low y, high x, high y of its edges; from and to y of the part
/// of a contour that it begins with, and of the one that it ends with (0, 0 when that is the same).
inline constexpr std::size_t edge_size = 6, node_size = 8, leaf_edges = 4;

/// Coordinates up to this magnitude are valid.
inline constexpr double most_coordinate = 1e12;

/// A read-only view of valid data.
struct Tree {
    const double* edges;
    const double* nodes;
    std::size_t count;   ///< of edges
    std::size_t leaves;  ///< of the tree

    static std::size_t leaves_of(std::size_t count) { return (count + leaf_edges - 1) / leaf_edges; }
    static std::size_t items_of(std::size_t count) {
        return 1 + count * edge_size + (2 * leaves_of(count) - 1) * node_size;
    }
    const double* edge(std::size_t i) const { return edges + i * edge_size; }
    const double* node(std::size_t i) const { return nodes + i * node_size; }
};

/// False for data of another make.
template <class T>
bool read_tree(const Data<T>& data, Tree& tree) {
    if (!data.is_constant() || data.size() < 1) return false;
    const double n = data.number(0);
    if (!(n >= 1.0 && n <= 1e8)) return false;
    tree.count = static_cast<std::size_t>(n);
    if (Tree::items_of(tree.count) != data.size()) return false;
    tree.edges = data.block() + 1;
    tree.nodes = tree.edges + tree.count * edge_size;
    tree.leaves = Tree::leaves_of(tree.count);
    for (int i = 0; i < 4; ++i)
        if (!(math::abs(tree.nodes[i]) <= most_coordinate)) return false;
    return true;
}

/// A node and the leaves below it.
struct Part {
    std::size_t node, first, last;

    bool is_leaf() const { return last - first == 1; }
    Part left() const { return {node + 1, first, first + (last - first) / 2}; }
    Part right() const {
        const std::size_t half = (last - first) / 2;
        return {node + 2 * half, first + half, last};
    }
};

/// Parts that wait; a tree of 1e8 edges is 25 deep.
inline constexpr std::size_t most_waiting = 64;

/// Twice the area of the triangle a, b, p of an edge: positive when p is to the left.
inline double turn(const double* e, double x, double y) {
    return (e[2] - e[0]) * (y - e[1]) - (e[3] - e[1]) * (x - e[0]);
}

/// How often the ray from (x, y) towards +x is crossed upward less downward by an edge.
inline int crossing(const double* e, double x, double y) {
    const bool from = e[1] > y, to = e[3] > y;
    if (from == to) return 0;
    const double t = turn(e, x, y);
    return to ? (t > 0.0 ? 1 : 0) : (t < 0.0 ? -1 : 0);
}

/// Whether a group with this winding number is inside, by its rule.
inline bool is_filled(double group, int winding) { return group < 0.0 ? (winding & 1) != 0 : winding != 0; }

/// Adds up winding numbers of groups that come in order; says whether one of them is filled.
struct Fill {
    double group = 0.0;
    int winding = 0;
    bool filled = false;

    void add(double of, int crossings) {
        if (of != group) finish();
        group = of;
        winding += crossings;
    }
    void finish() {
        filled = filled || is_filled(group, winding);
        winding = 0;
    }
};

inline bool is_inside(const Tree& tree, double x, double y) {
    Part waiting[most_waiting];
    std::size_t count = 0;
    Fill fill;
    waiting[count++] = {0, 0, tree.leaves};
    while (count > 0 && !fill.filled) {
        const Part part = waiting[--count];
        const double* node = tree.node(part.node);
        if (y < node[1] || y >= node[3] || x > node[2]) continue;
        const std::size_t first = part.first * leaf_edges;
        const std::size_t last = part.last * leaf_edges < tree.count ? part.last * leaf_edges : tree.count;
        const auto ends = [y](const double* piece) {
            return (piece[1] > y ? 1 : 0) - (piece[0] > y ? 1 : 0);
        };
        if (x < node[0]) {
            fill.add(tree.edge(first)[5], ends(node + 4));
            fill.add(tree.edge(last - 1)[5], ends(node + 6));
        } else if (part.is_leaf()) {
            for (std::size_t i = first; i < last; ++i)
                fill.add(tree.edge(i)[5], crossing(tree.edge(i), x, y));
        } else if (count + 2 <= most_waiting) {
            waiting[count++] = part.right();
            waiting[count++] = part.left();
        }
    }
    fill.finish();
    return fill.filled;
}

/// The place of an edge that is nearest to a point.
struct Foot {
    const double* edge = nullptr;
    double square = math::infinity;  ///< of the distance
    double along = 0.0;              ///< 0 at a, 1 at b
};

inline Foot foot_on(const double* e, double x, double y) {
    const double ex = e[2] - e[0], ey = e[3] - e[1], px = x - e[0], py = y - e[1];
    const double square_length = ex * ex + ey * ey, dot = px * ex + py * ey;
    if (!(dot > 0.0)) return {e, px * px + py * py, 0.0};
    if (dot >= square_length) {
        const double qx = x - e[2], qy = y - e[3];
        return {e, qx * qx + qy * qy, 1.0};
    }
    const double t = ex * py - ey * px;
    return {e, t * t / square_length, dot / square_length};
}

/// The square of the distance to a node's box.
inline double box_square(const double* node, double x, double y) {
    const double dx = math::max(math::max(node[0] - x, x - node[2]), 0.0);
    const double dy = math::max(math::max(node[1] - y, y - node[3]), 0.0);
    return dx * dx + dy * dy;
}

/// The nearest place of the boundary; no edge when there is none or the square of the distance overflows.
inline Foot nearest(const Tree& tree, double x, double y) {
    struct Wait {
        Part part;
        double square;
    };
    Wait waiting[most_waiting];
    std::size_t count = 0;
    Foot best;
    waiting[count++] = {{0, 0, tree.leaves}, box_square(tree.nodes, x, y)};
    while (count > 0) {
        const Wait next = waiting[--count];
        if (!(next.square < best.square)) continue;
        if (next.part.is_leaf()) {
            const std::size_t first = next.part.first * leaf_edges;
            for (std::size_t i = first; i < first + leaf_edges && i < tree.count; ++i) {
                const double* e = tree.edge(i);
                if (e[4] == 0.0) continue;
                const Foot foot = foot_on(e, x, y);
                if (foot.square < best.square) best = foot;
            }
            continue;
        }
        Wait left = {next.part.left(), 0.0}, right = {next.part.right(), 0.0};
        left.square = box_square(tree.node(left.part.node), x, y);
        right.square = box_square(tree.node(right.part.node), x, y);
        if (count + 2 > most_waiting) break;
        const bool left_first = left.square <= right.square;
        waiting[count++] = left_first ? right : left;
        waiting[count++] = left_first ? left : right;
    }
    return best;
}

/// Signed distance and its derivatives.
struct Signed {
    double value, dx, dy;
};

inline Signed signed_distance(const Tree& tree, double x, double y) {
    if (x != x || y != y) return {math::quiet_nan, 0.0, 0.0};
    const Foot foot = nearest(tree, x, y);
    if (!foot.edge) {  // so far away that the outline is a point; or there is no boundary
        const double* box = tree.nodes;
        const double gx = x - 0.5 * (box[0] + box[2]), gy = y - 0.5 * (box[1] + box[3]);
        const double length = math::hypot(gx, gy);
        if (!(length < math::infinity)) return {-math::infinity, 0.0, 0.0};
        return {-length, length > 0.0 ? -gx / length : 0.0, length > 0.0 ? -gy / length : 0.0};
    }
    const double* e = foot.edge;
    const double ex = e[2] - e[0], ey = e[3] - e[1], length = math::hypot(ex, ey);
    const double sign = is_inside(tree, x, y) ? 1.0 : -1.0;
    if (foot.along > 0.0 && foot.along < 1.0) {
        const double t = turn(e, x, y);
        const double towards = t == 0.0 ? e[4] : t > 0.0 ? sign : -sign;
        return {sign * (math::abs(t) / length), -ey / length * towards, ex / length * towards};
    }
    const double* corner = foot.along > 0.0 ? e + 2 : e;
    const double gx = x - corner[0], gy = y - corner[1], distance = math::hypot(gx, gy);
    if (!(distance > 0.0)) return {0.0, -ey / length * e[4], ex / length * e[4]};
    return {sign * distance, sign * gx / distance, sign * gy / distance};
}

template <class T>
struct OutlineCall {
    static T value(const T* lead, const Tree& tree) {
        return lane_by_lane([&](double x, double y) { return signed_distance(tree, x, y).value; }, lead[0],
                            lead[1]);
    }
};
template <class T>
struct OutlineCall<math::Dual<T>> {
    using Number = math::Dual<T>;
    static Number value(const Number* lead, const Tree& tree) {
        const auto one_lane = [&](const math::Dual<double>* v) {
            const Signed s = signed_distance(tree, v[0].value, v[1].value);
            const auto x = math::chain(s.value, s.dx, v[0]), y = math::chain(s.value, s.dy, v[1]);
            math::Dual<double> r(s.value);
            for (std::size_t i = 0; i < 3; ++i) r.d[i] = x.d[i] + y.d[i];
            return r;
        };
        return dual_by_lane(one_lane, std::array<Number, 2>{lead[0], lead[1]});
    }
};

/// The distance changes no faster than the point moves.
inline Interval outline_range(const Interval* lead, const Tree& tree) {
    if (any_empty(lead[0], lead[1])) return Interval::empty();
    const bool undefined = any_flagged(lead[0], lead[1]);
    const double x = centre_of(lead[0]), y = centre_of(lead[1]);
    const double hx = math::max(lead[0].hi - x, x - lead[0].lo);
    const double hy = math::max(lead[1].hi - y, y - lead[1].lo);
    const double reach = math::hypot(hx, hy);
    if (!(reach < math::infinity)) return Interval(-math::infinity, math::infinity, undefined);
    const double value = signed_distance(tree, x, y).value;
    double size = magnitude(lead[0]) + magnitude(lead[1]);
    for (int i = 0; i < 4; ++i) size += math::abs(tree.nodes[i]);
    return widened(Interval(value, value, undefined), reach + 0x1p-48 * size);
}

}  // namespace outline_detail

/// Undefined for data that no outline has, and for data that are no constants.
template <class T>
T outline_distance(const T* lead, Data<T> data) {
    using namespace outline_detail;
    Tree tree;
    if (!read_tree(data, tree)) return math::constant<T>(math::quiet_nan);
    if constexpr (is_interval<T>) {
        return outline_range(lead, tree);
    } else {
        return OutlineCall<T>::value(lead, tree);
    }
}

}  // namespace frep::kernels
