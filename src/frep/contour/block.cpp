// Implementation of block.h: thesis 1.5.3, steps 1 to 4, for the cells of one block. Edge nodes by bisection
// on the predicate "defined and F >= 0", all edges of the block in one batch (docs/numerics.md, rule 9).
#include "frep/contour/block.h"

#include <limits>

#include "frep/contour/cell.h"

namespace frep::contouring {

namespace {

constexpr int bisection_steps = 40;   // an edge halved 40 times: 1e-12 of its length
constexpr double node_margin = 1e-4;  // least distance of a node from the grid's corners, in edges

constexpr double outside_by_decree = -std::numeric_limits<double>::infinity();

double component(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

void set_component(Vec3& v, int axis, double value) { (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value; }

double magnitude(double v) { return v < 0 ? -v : v; }

}  // namespace

Vec3 outward_normal(Vec3 gradient) {
    const double a = magnitude(gradient.x), b = magnitude(gradient.y), c = magnitude(gradient.z);
    const double largest = a > b ? (a > c ? a : c) : (b > c ? b : c);
    // NaN in any component fails the second test.
    if (!(largest > 0) || !(a + b + c <= std::numeric_limits<double>::infinity())) return {0, 0, 0};
    if (largest == std::numeric_limits<double>::infinity()) return {0, 0, 0};
    const Vec3 scaled = gradient / largest;
    return -(scaled / length(scaled));
}

Vec3 BlockContourer::sample_point(const Local& l) const {
    return grid_.point(with_layer(0, l[0]) - 1, with_layer(1, l[1]) - 1, with_layer(2, l[2]) - 1);
}

std::unique_ptr<BlockMesh> BlockContourer::contour(std::uint64_t code) {
    if (!sample(code)) return nullptr;
    mesh_ = {};
    brackets_.clear();
    collect_nodes();
    bisect();
    set_positions();
    take_normals();
    add_cells();
    if (mesh_.edges.empty() && mesh_.polygons.empty()) return nullptr;
    mesh_.polygons.shrink_to_fit();
    return std::make_unique<BlockMesh>(std::move(mesh_));
}

/// Counts an undefined sample of this block's own and notes inside samples at the sides of the box.
void BlockContourer::note_sample(const Local& l, double value, std::uint64_t code) {
    const bool own = l[0] < block_side && l[1] < block_side && l[2] < block_side;
    if (value != value && own) undefined.add(1, code, (l[2] * block_side + l[1]) * block_side + l[0]);
    if (!(value >= 0)) return;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t i = with_layer(a, l[a]) - 1;
        if (i == 0) touches[2 * a] = true;
        if (i == grid_.cells[a]) touches[2 * a + 1] = true;
    }
}

/// Step 1: the values at the corners of the block's cells. False if they are all of one sign.
bool BlockContourer::sample(std::uint64_t code) {
    const Local block = morton_decode(code);
    for (std::size_t a = 0; a < 3; ++a) lo_[a] = block[a] * block_side;
    sampled_.clear();
    x_.clear();
    y_.clear();
    z_.clear();
    Local l{};
    for (l[2] = 0; l[2] < lattice_side; ++l[2]) {
        for (l[1] = 0; l[1] < lattice_side; ++l[1]) {
            for (l[0] = 0; l[0] < lattice_side; ++l[0]) {
                values_[lattice_index(l)] = outside_by_decree;
                if (is_layer(l)) continue;
                const Vec3 p = sample_point(l);
                x_.push_back(p.x);
                y_.push_back(p.y);
                z_.push_back(p.z);
                sampled_.push_back(lattice_index(l));
            }
        }
    }
    out_.resize(x_.size());
    field_.values({x_, y_, z_}, out_);
    std::size_t inside = 0;
    for (std::size_t s = 0; s < sampled_.size(); ++s) {
        const std::uint32_t at = sampled_[s];
        values_[at] = out_[s];
        inside += out_[s] >= 0 ? 1 : 0;
        note_sample({at % lattice_side, at / lattice_side % lattice_side, at / (lattice_side * lattice_side)},
                    out_[s], code);
    }
    return inside > 0 && (inside < sampled_.size() || (options_.cap && inside < values_.size()));
}

/// Step 2: a node for every own edge with different signs at its ends, in ascending order of edges.
void BlockContourer::collect_nodes() {
    constexpr std::array<std::uint32_t, 3> stride{1, lattice_side, lattice_side * lattice_side};
    Local l{};
    for (l[2] = 0; l[2] < block_side; ++l[2]) {
        for (l[1] = 0; l[1] < block_side; ++l[1]) {
            for (l[0] = 0; l[0] < block_side; ++l[0]) {
                const std::uint32_t at = lattice_index(l);
                for (std::size_t a = 0; a < 3; ++a) {
                    if ((values_[at] >= 0) != (values_[at + stride[a]] >= 0)) add_node(l, a);
                }
            }
        }
    }
}

void BlockContourer::add_node(const Local& lower, std::size_t axis) {
    Local upper = lower;
    ++upper[axis];
    const bool lower_is_inside = values_[lattice_index(lower)] >= 0;
    const auto edge = static_cast<std::uint16_t>(
        ((lower[2] * block_side + lower[1]) * block_side + lower[0]) * 3 + static_cast<std::uint32_t>(axis));
    if (is_layer(lower) || is_layer(upper)) {
        const Local& inside = lower_is_inside ? lower : upper;
        std::size_t cap_axis = 0;
        if (!options_.cap || cap_edge(inside, cap_axis) != lower || cap_axis != axis) return;
        mesh_.edges.push_back(edge);
        add_cap_node(inside);
        return;
    }
    Bracket b;
    b.lower = sample_point(lower);
    b.axis = static_cast<int>(axis);
    b.upper = component(sample_point(upper), axis);
    b.inside = lower_is_inside ? 0 : 1;
    b.outside = lower_is_inside ? 1 : 0;
    const double outside_value = values_[lattice_index(lower_is_inside ? upper : lower)];
    b.wall = outside_value != outside_value;
    b.node = static_cast<std::uint32_t>(mesh_.edges.size());
    brackets_.push_back(b);
    mesh_.edges.push_back(edge);
    mesh_.positions.push_back(b.lower);
    mesh_.normals.push_back({0, 0, 0});
}

BlockContourer::Local BlockContourer::cap_edge(const Local& inside, std::size_t& axis) const {
    Local lower = inside;
    for (axis = 0; axis < 3; ++axis) {
        const std::uint32_t e = with_layer(axis, inside[axis]);
        if (e == 1) {
            --lower[axis];
            return lower;
        }
        if (e == grid_.cells[axis] + 1) return lower;
    }
    axis = 3;
    return lower;
}

/// The node of an inside sample on the box's boundary: the sample itself, one node even if it lies on two or
/// three sides of the box. Its normal is that of the sides.
void BlockContourer::add_cap_node(const Local& inside) {
    Vec3 normal{0, 0, 0};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t e = with_layer(a, inside[a]);
        const double low = e == 1 ? -1 : 0;
        const double high = e == grid_.cells[a] + 1 ? 1 : 0;
        set_component(normal, static_cast<int>(a), low + high);
    }
    mesh_.positions.push_back(sample_point(inside));
    mesh_.normals.push_back(normal / length(normal));
}

/// Values at the middle of every bracket, to out_.
void BlockContourer::evaluate_brackets() {
    const std::size_t count = brackets_.size();
    x_.resize(count);
    y_.resize(count);
    z_.resize(count);
    out_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Bracket& b = brackets_[i];
        const double start = component(b.lower, static_cast<std::size_t>(b.axis));
        const double at = start + 0.5 * (b.inside + b.outside) * (b.upper - start);
        x_[i] = b.axis == 0 ? at : b.lower.x;
        y_[i] = b.axis == 1 ? at : b.lower.y;
        z_[i] = b.axis == 2 ? at : b.lower.z;
    }
    field_.values({x_, y_, z_}, out_);
}

void BlockContourer::bisect() {
    if (brackets_.empty()) return;
    for (int step = 0; step < bisection_steps; ++step) {
        evaluate_brackets();
        for (std::size_t i = 0; i < brackets_.size(); ++i) {
            Bracket& b = brackets_[i];
            const double middle = 0.5 * (b.inside + b.outside);
            if (out_[i] >= 0) {
                b.inside = middle;
            } else {
                b.outside = middle;
                b.wall = out_[i] != out_[i];
            }
        }
    }
}

/// The inside ends become the nodes, kept away from the corners.
void BlockContourer::set_positions() {
    for (const Bracket& b : brackets_) {
        const double high = b.inside > 1 - node_margin ? 1 - node_margin : b.inside;
        const double t = high < node_margin ? node_margin : high;
        const double start = component(b.lower, static_cast<std::size_t>(b.axis));
        Vec3& p = mesh_.positions[b.node];
        p = b.lower;
        set_component(p, b.axis, start + t * (b.upper - start));
    }
}

/// Normals from the gradient. A wall, where F ends without a zero, has nothing to do with the gradient.
void BlockContourer::take_normals() {
    const std::size_t count = brackets_.size();
    if (count == 0) return;
    for (std::vector<double>* v : {&x_, &y_, &z_, &out_, &gx_, &gy_, &gz_}) v->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3& p = mesh_.positions[brackets_[i].node];
        x_[i] = p.x;
        y_[i] = p.y;
        z_[i] = p.z;
    }
    field_.gradients({x_, y_, z_}, out_, {gx_, gy_, gz_});
    for (std::size_t i = 0; i < count; ++i) {
        if (!brackets_[i].wall) mesh_.normals[brackets_[i].node] = outward_normal({gx_[i], gy_[i], gz_[i]});
    }
}

/// Steps 3 and 4: the polygons of the block's cells; cells of the layer only with the cap.
void BlockContourer::add_cells() {
    Local l{};
    for (l[2] = 0; l[2] < block_side; ++l[2]) {
        for (l[1] = 0; l[1] < block_side; ++l[1]) {
            for (l[0] = 0; l[0] < block_side; ++l[0]) {
                std::array<double, 8> values{};
                unsigned inside = 0;
                for (std::size_t c = 0; c < 8; ++c) {
                    const auto& offset = corner_offsets[c];
                    values[c] =
                        values_[lattice_index({l[0] + offset[0], l[1] + offset[1], l[2] + offset[2]})];
                    inside += values[c] >= 0 ? 1 : 0;
                }
                if (inside == 0 || inside == 8) continue;
                const Local far{l[0] + 1, l[1] + 1, l[2] + 1};
                if (!options_.cap && (is_layer(l) || is_layer(far))) continue;
                add_cell(l, values);
            }
        }
    }
}

void BlockContourer::add_cell(const Local& corner, const std::array<double, 8>& values) {
    const CellPolygons polygons = trace_cell(values);
    std::size_t at = 0;
    for (std::size_t p = 0; p < polygons.count; ++p) {
        const std::size_t end = at + polygons.lengths[p];
        for (; at < end; ++at) {
            PolygonNode node = polygon_node(corner, polygons.edges[at]);
            node.is_last = at + 1 == end;
            mesh_.polygons.push_back(node);
        }
    }
}

PolygonNode BlockContourer::polygon_node(const Local& cell, std::uint8_t cell_edge) const {
    const auto& low = corner_offsets[edge_corners[cell_edge][0]];
    const auto& high = corner_offsets[edge_corners[cell_edge][1]];
    Local lower{cell[0] + low[0], cell[1] + low[1], cell[2] + low[2]};
    Local upper{cell[0] + high[0], cell[1] + high[1], cell[2] + high[2]};
    std::size_t axis = high[0] != low[0] ? 0 : high[1] != low[1] ? 1 : 2;
    if (is_layer(lower) || is_layer(upper)) {
        lower = cap_edge(values_[lattice_index(lower)] >= 0 ? lower : upper, axis);
    }
    PolygonNode node{};
    constexpr std::uint32_t mask = block_side - 1;
    const std::uint32_t sample =
        ((lower[2] & mask) * block_side + (lower[1] & mask)) * block_side + (lower[0] & mask);
    node.edge = static_cast<std::uint16_t>(sample * 3 + axis);
    const std::uint32_t next =
        lower[0] / block_side | lower[1] / block_side << 1 | lower[2] / block_side << 2;
    node.neighbour = static_cast<std::uint8_t>(next);
    node.cell_edge = cell_edge & 127u;
    return node;
}

}  // namespace frep::contouring
