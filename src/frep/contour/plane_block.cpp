// Implementation of plane_block.h: marching squares with the decider of cell.h on ambiguous cells, which is
// that of a face between two cubic cells; nodes by bisection, as in block.cpp.
#include "frep/contour/plane_block.h"

#include <limits>

#include "frep/contour/cell.h"

namespace frep::contouring {

namespace {

constexpr int bisection_steps = 40;   // an edge halved 40 times: 1e-12 of its length
constexpr double node_margin = 1e-4;  // least distance of a node from the grid's corners, in edges
constexpr double outside_by_decree = -std::numeric_limits<double>::infinity();

/// Corners counter-clockwise; edge k runs from corner k to corner k + 1.
constexpr std::array<std::array<std::uint32_t, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

}  // namespace

bool PlaneContourer::is_at_side(const Local& l) const {
    for (std::size_t a = 0; a < 2; ++a) {
        const std::uint32_t e = with_layer(a, l[a]);
        if (e == 1 || e == grid_.cells[a] + 1) return true;
    }
    return false;
}

PlanePart PlaneContourer::contour(const PlaneBlock& block) {
    for (std::size_t a = 0; a < 2; ++a) {
        lo_[a] = block[a] * plane_block_side;
        first_[a] = lo_[a] == 0 ? 1 : 0;
        const std::uint32_t end = grid_.cells[a] + 1 - lo_[a];  // the box's last sample
        last_[a] = end < plane_block_side ? end : plane_block_side;
    }
    part_ = {};
    brackets_.clear();
    if (sample()) {
        collect_nodes();
        bisect();
        add_pieces();
    }
    return std::move(part_);
}

/// Puts a point of the plane into the columns of space.
void PlaneContourer::put(std::size_t at, Vec2 p) {
    const Vec3 q = grid_.in_space(p);
    x_[at] = q.x;
    y_[at] = q.y;
    z_[at] = q.z;
}

/// The values at the corners of the block's cells. False if there is no outline among them.
bool PlaneContourer::sample() {
    const std::size_t count = std::size_t{last_[0] - first_[0] + 1} * std::size_t{last_[1] - first_[1] + 1};
    for (std::vector<double>* v : {&x_, &y_, &z_, &out_}) v->resize(count);
    std::size_t at = 0;
    Local l{};
    for (l[1] = first_[1]; l[1] <= last_[1]; ++l[1]) {
        for (l[0] = first_[0]; l[0] <= last_[0]; ++l[0]) put(at++, sample_point(l));
    }
    field_.values({x_, y_, z_}, out_);
    values_.fill(outside_by_decree);
    at = 0;
    for (l[1] = first_[1]; l[1] <= last_[1]; ++l[1]) {
        for (l[0] = first_[0]; l[0] <= last_[0]; ++l[0]) values_[index(l)] = out_[at++];
    }
    std::size_t inside = 0;
    for (std::size_t i = 0; i < lattice_size; ++i) {
        inside_[i] = values_[i] >= 0 ? 1 : 0;
        inside += inside_[i];
    }
    note_samples();
    return inside > 0 && (inside < count || (cap_ && inside < lattice_size));
}

/// Counts the undefined samples of this block's own and notes inside samples at the sides of the box.
void PlaneContourer::note_samples() {
    Local l{};
    for (l[1] = first_[1]; l[1] <= last_[1]; ++l[1]) {
        for (l[0] = first_[0]; l[0] <= last_[0]; ++l[0]) {
            const double value = values_[index(l)];
            const bool own = l[0] < plane_block_side && l[1] < plane_block_side;
            if (value != value && own) undefined.add(1, number(l));
            if (!(value >= 0)) continue;
            for (std::size_t a = 0; a < 2; ++a) {
                const std::uint32_t e = with_layer(a, l[a]);
                if (e == 1) touches[2 * a] = true;
                if (e == grid_.cells[a] + 1) touches[2 * a + 1] = true;
            }
        }
    }
}

void PlaneContourer::collect_nodes() {
    Local l{};
    for (l[1] = 0; l[1] < plane_block_side; ++l[1]) {
        for (l[0] = 0; l[0] < plane_block_side; ++l[0]) {
            const bool here = inside_[index(l)] != 0;
            if (here != (inside_[index({l[0] + 1, l[1]})] != 0)) add_node(l, 0);
            if (here != (inside_[index({l[0], l[1] + 1})] != 0)) add_node(l, 1);
            if (cap_ && here && is_at_side(l))
                part_.nodes.push_back({number(l) * 3 + cap_node, sample_point(l)});
        }
    }
}

void PlaneContourer::add_node(const Local& lower, std::size_t axis) {
    Local upper = lower;
    ++upper[axis];
    if (is_layer(lower) || is_layer(upper)) return;  // the sample itself is the node, with the cap
    const Vec2 p = sample_point(lower), q = sample_point(upper);
    const bool lower_is_inside = inside_[index(lower)] != 0;
    Bracket b{.node = part_.nodes.size(), .axis = axis};
    b.start = axis == 0 ? p.x : p.y;
    b.length = (axis == 0 ? q.x : q.y) - b.start;
    b.inside = lower_is_inside ? 0 : 1;
    b.outside = lower_is_inside ? 1 : 0;
    brackets_.push_back(b);
    part_.nodes.push_back({number(lower) * 3 + axis, p});
}

/// All edges at a time; the inside ends become the nodes, kept away from the corners.
void PlaneContourer::bisect() {
    const std::size_t count = brackets_.size();
    if (count == 0) return;
    for (std::vector<double>* v : {&x_, &y_, &z_, &out_}) v->resize(count);
    const auto point_at = [&](const Bracket& b, double t) {
        Vec2 p = part_.nodes[b.node].point;
        (b.axis == 0 ? p.x : p.y) = b.start + t * b.length;
        return p;
    };
    for (int step = 0; step < bisection_steps; ++step) {
        for (std::size_t i = 0; i < count; ++i)
            put(i, point_at(brackets_[i], 0.5 * (brackets_[i].inside + brackets_[i].outside)));
        field_.values({x_, y_, z_}, out_);
        for (std::size_t i = 0; i < count; ++i) {
            Bracket& b = brackets_[i];
            const double middle = 0.5 * (b.inside + b.outside);
            (out_[i] >= 0 ? b.inside : b.outside) = middle;
        }
    }
    for (const Bracket& b : brackets_) {
        const double high = b.inside > 1 - node_margin ? 1 - node_margin : b.inside;
        part_.nodes[b.node].point = point_at(b, high < node_margin ? node_margin : high);
    }
}

/// The pieces of the block's cells; cells of the layer only with the cap.
void PlaneContourer::add_pieces() {
    Local begin{}, end{plane_block_side, plane_block_side};
    for (std::size_t a = 0; a < 2 && !cap_; ++a) {
        begin[a] = first_[a];
        end[a] = last_[a] < plane_block_side ? last_[a] : plane_block_side;
    }
    Local l{};
    for (l[1] = begin[1]; l[1] < end[1]; ++l[1]) {
        for (l[0] = begin[0]; l[0] < end[0]; ++l[0]) add_cell(l);
    }
}

void PlaneContourer::add_cell(const Local& corner) {
    std::array<double, 4> values{};
    unsigned signs = 0;
    for (unsigned k = 0; k < 4; ++k) {
        const std::uint32_t at = index({corner[0] + corners[k][0], corner[1] + corners[k][1]});
        values[k] = values_[at];
        signs |= static_cast<unsigned>(inside_[at]) << k;
    }
    if (signs == 0 || signs == 15) return;
    const bool ambiguous = signs == 0b0101 || signs == 0b1010;
    const unsigned first = signs == 0b0101 ? 0 : 1;  // the first inside corner of an ambiguous cell
    const bool joined = ambiguous && face_joins_inside(values[first], values[first + 2], values[1 - first],
                                                       values[3 - first]);
    const auto corner_is_inside = [signs](unsigned k) { return ((signs >> (k % 4)) & 1u) != 0; };
    // Walking counter-clockwise, an edge that leaves the inside begins a piece, which ends at an edge that
    // enters it: the one before (around the inside corners between) or, when joined, the one after.
    for (unsigned k = 0; k < 4; ++k) {
        if (!corner_is_inside(k) || corner_is_inside(k + 1)) continue;
        const unsigned step = joined ? 1 : 3;
        unsigned to = (k + step) % 4;
        while (!(!corner_is_inside(to) && corner_is_inside(to + 1))) to = (to + step) % 4;
        const PlanePiece piece{node_id(corner, k), node_id(corner, to)};
        if (piece.from != piece.to) part_.pieces.push_back(piece);
    }
}

std::uint64_t PlaneContourer::node_id(const Local& cell, std::size_t edge) const {
    const auto& a = corners[edge];
    const auto& b = corners[(edge + 1) % 4];
    const Local p{cell[0] + a[0], cell[1] + a[1]}, q{cell[0] + b[0], cell[1] + b[1]};
    if (is_layer(p) || is_layer(q)) return number(inside_[index(p)] ? p : q) * 3 + cap_node;
    const std::size_t axis = edge % 2;  // 0 and 2 run along right, 1 and 3 along up
    return number(edge == 0 || edge == 1 ? p : q) * 3 + axis;
}

}  // namespace frep::contouring
