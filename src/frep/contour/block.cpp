// Implementation of block.h: thesis 1.5.3, steps 1 to 4, for the cells of one block. Edge nodes by bisection
// on the predicate "defined and F >= 0", all edges of the block in one batch (docs/numerics.md, rule 9).
#include "frep/contour/block.h"

#include <algorithm>
#include <limits>

#include "frep/contour/cell.h"

namespace frep::contouring {

namespace {

constexpr int bisection_steps = 40;   // an edge halved 40 times: 1e-12 of its length
constexpr double node_margin = 1e-4;  // least distance of a node from the grid's corners, in edges

constexpr double outside_by_decree = -std::numeric_limits<double>::infinity();

double component(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

void set_component(Vec3& v, std::size_t axis, double value) {
    (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
}

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

void BlockContourer::Brackets::clear() {
    lower.clear();
    for (std::vector<double>* v : {&start, &end, &length, &inside, &outside}) v->clear();
    wall.clear();
    node.clear();
}

Box3 block_box(const Grid& grid, std::uint64_t code) {
    std::array<std::uint32_t, 3> first = morton_decode(code), last{};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t lo = first[a] * block_side;  // with layer: sample i is number i + 1
        first[a] = lo == 0 ? 0 : lo - 1;
        last[a] = std::min(lo + block_side - 1, grid.cells[a]);
    }
    return {grid.point(first[0], first[1], first[2]), grid.point(last[0], last[1], last[2])};
}

std::unique_ptr<BlockMesh> BlockContourer::contour(std::uint64_t code, SampledField& part) {
    part_ = &part;
    place(code);
    if (!sample(code)) return nullptr;
    mesh_.edges.clear();
    mesh_.positions.clear();
    mesh_.normals.clear();
    mesh_.attributes.clear();
    mesh_.polygons.clear();
    cap_nodes_.clear();
    for (Brackets& b : brackets_) b.clear();
    collect_nodes();
    bisect();
    take_attributes();
    set_positions();
    take_normals();
    add_cells();
    if (mesh_.edges.empty() && mesh_.polygons.empty()) return nullptr;
    return std::make_unique<BlockMesh>(mesh_);  // a copy: exactly as large as needed
}

void BlockContourer::place(std::uint64_t code) {
    const Local block = morton_decode(code);
    is_at_side_ = false;
    for (std::size_t a = 0; a < 3; ++a) {
        lo_[a] = block[a] * block_side;
        first_[a] = lo_[a] == 0 ? 1 : 0;
        const std::uint32_t end = grid_.cells[a] + 1 - lo_[a];  // the box's last sample
        last_[a] = end < block_side ? end : block_side;
        is_at_side_ = is_at_side_ || lo_[a] == 0 || end <= block_side;
    }
}

/// Step 1: the values at the corners of the block's cells. False if there is no surface among them.
bool BlockContourer::sample(std::uint64_t code) {
    x_.clear();
    y_.clear();
    z_.clear();
    Local l{};
    for (l[2] = first_[2]; l[2] <= last_[2]; ++l[2]) {
        const double z = grid_.coordinate(2, lo_[2] + l[2] - 1);
        for (l[1] = first_[1]; l[1] <= last_[1]; ++l[1]) {
            const double y = grid_.coordinate(1, lo_[1] + l[1] - 1);
            for (l[0] = first_[0]; l[0] <= last_[0]; ++l[0]) {
                x_.push_back(grid_.coordinate(0, lo_[0] + l[0] - 1));
                y_.push_back(y);
                z_.push_back(z);
            }
        }
    }
    out_.resize(x_.size());
    part_->values({x_, y_, z_}, out_);
    if (x_.size() < lattice_size) values_.fill(outside_by_decree);
    const double* next = out_.data();
    for (l[2] = first_[2]; l[2] <= last_[2]; ++l[2]) {
        for (l[1] = first_[1]; l[1] <= last_[1]; ++l[1]) {
            double* row = &values_[lattice_index({0, l[1], l[2]})];
            for (l[0] = first_[0]; l[0] <= last_[0]; ++l[0]) row[l[0]] = *next++;
        }
    }
    std::size_t inside = 0;
    bool is_defined = true;
    for (std::size_t i = 0; i < lattice_size; ++i) {
        inside_[i] = values_[i] >= 0 ? 1 : 0;
        inside += inside_[i];
        is_defined = is_defined && values_[i] == values_[i];
    }
    if (!is_defined || (is_at_side_ && inside > 0)) note_samples(code);
    return inside > 0 && (inside < x_.size() || (options_.cap && inside < lattice_size));
}

/// Counts the undefined samples of this block's own and notes inside samples at the sides of the box.
void BlockContourer::note_samples(std::uint64_t code) {
    Local l{};
    for (l[2] = first_[2]; l[2] <= last_[2]; ++l[2]) {
        for (l[1] = first_[1]; l[1] <= last_[1]; ++l[1]) {
            for (l[0] = first_[0]; l[0] <= last_[0]; ++l[0]) {
                const double value = values_[lattice_index(l)];
                const bool own = l[0] < block_side && l[1] < block_side && l[2] < block_side;
                if (value != value && own) {
                    undefined.add(1, code, (l[2] * block_side + l[1]) * block_side + l[0]);
                }
                if (value >= 0) note_inside(l);
            }
        }
    }
}

void BlockContourer::note_inside(const Local& l) {
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t i = with_layer(a, l[a]) - 1;
        if (i == 0) touches[2 * a] = true;
        if (i == grid_.cells[a]) touches[2 * a + 1] = true;
    }
}

/// Step 2: a node for every own edge with different signs at its ends, in ascending order of edges.
void BlockContourer::collect_nodes() {
    Local l{};
    for (l[2] = 0; l[2] < block_side; ++l[2]) {
        for (l[1] = 0; l[1] < block_side; ++l[1]) {
            for (l[0] = 0; l[0] < block_side; ++l[0]) {
                const std::uint32_t at = lattice_index(l);
                for (std::size_t a = 0; a < 3; ++a) {
                    if (inside_[at] != inside_[at + stride[a]]) add_node(l, a);
                }
            }
        }
    }
}

void BlockContourer::add_node(const Local& lower, std::size_t axis) {
    Local upper = lower;
    ++upper[axis];
    const bool lower_is_inside = inside_[lattice_index(lower)] != 0;
    const auto edge = static_cast<std::uint16_t>(
        ((lower[2] * block_side + lower[1]) * block_side + lower[0]) * 3 + static_cast<std::uint32_t>(axis));
    if (is_at_side_ && (is_layer(lower) || is_layer(upper))) {
        const Local& inside = lower_is_inside ? lower : upper;
        std::size_t cap_axis = 0;
        if (!options_.cap || cap_edge(inside, cap_axis) != lower || cap_axis != axis) return;
        mesh_.edges.push_back(edge);
        add_cap_node(inside);
        return;
    }
    const Vec3 p = sample_point(lower);
    const double start = component(p, axis);
    const double outside_value = values_[lattice_index(lower_is_inside ? upper : lower)];
    Brackets& b = brackets_[axis];
    b.lower.push_back(p);
    b.start.push_back(start);
    b.end.push_back(component(sample_point(upper), axis));
    b.length.push_back(b.end.back() - start);
    b.inside.push_back(lower_is_inside ? 0 : 1);
    b.outside.push_back(lower_is_inside ? 1 : 0);
    b.wall.push_back(outside_value != outside_value ? 1 : 0);
    b.node.push_back(static_cast<std::uint32_t>(mesh_.edges.size()));
    mesh_.edges.push_back(edge);
    mesh_.positions.push_back(p);
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
        set_component(normal, a, low + high);
    }
    cap_nodes_.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
    mesh_.positions.push_back(sample_point(inside));
    mesh_.normals.push_back(normal / length(normal));
}

/// Puts the middles of the brackets along `axis` into that axis' column, from entry `first` on.
void BlockContourer::set_middles(std::size_t axis, std::size_t first) {
    const Brackets& b = brackets_[axis];
    double* at = column(axis).data() + first;
    for (std::size_t i = 0; i < b.size(); ++i) {
        at[i] = b.start[i] + 0.5 * (b.inside[i] + b.outside[i]) * b.length[i];
    }
}

void BlockContourer::bisect() {
    x_.clear();
    y_.clear();
    z_.clear();
    for (const Brackets& b : brackets_) {
        for (const Vec3& p : b.lower) {
            x_.push_back(p.x);
            y_.push_back(p.y);
            z_.push_back(p.z);
        }
    }
    if (x_.empty()) return;
    out_.resize(x_.size());
    const std::array<std::size_t, 3> first{0, brackets_[0].size(), brackets_[0].size() + brackets_[1].size()};
    for (int step = 0; step < bisection_steps; ++step) {
        for (std::size_t a = 0; a < 3; ++a) set_middles(a, first[a]);
        part_->values({x_, y_, z_}, out_);
        for (std::size_t a = 0; a < 3; ++a) {
            Brackets& b = brackets_[a];
            const double* value = out_.data() + first[a];
            for (std::size_t i = 0; i < b.size(); ++i) {
                const double middle = 0.5 * (b.inside[i] + b.outside[i]);
                const bool is_inside = value[i] >= 0;
                b.inside[i] = is_inside ? middle : b.inside[i];
                b.outside[i] = is_inside ? b.outside[i] : middle;
                b.wall[i] = is_inside ? b.wall[i] : static_cast<std::uint8_t>(value[i] != value[i]);
            }
        }
    }
}

/// Attributes at the inside ends of the brackets, where F >= 0: library functions that set colors write only
/// there. Uses the columns of bisect(), whose order is that of the brackets; cap nodes follow.
void BlockContourer::take_attributes() {
    const std::size_t wanted = options_.attributes;
    if (wanted == 0 || mesh_.edges.empty()) return;
    std::size_t p = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const Brackets& b = brackets_[a];
        for (std::size_t i = 0; i < b.size(); ++i) {
            column(a)[p++] = b.inside[i] == 1 ? b.end[i] : b.start[i] + b.inside[i] * b.length[i];
        }
    }
    const std::size_t bisected = p;
    for (std::size_t a = 0; a < 3; ++a) {
        column(a).resize(bisected);
        for (const std::uint32_t node : cap_nodes_) column(a).push_back(component(mesh_.positions[node], a));
    }
    const std::size_t count = x_.size();
    attribute_columns_.resize(wanted * count);
    std::vector<std::span<double>> columns;
    for (std::size_t k = 0; k < wanted; ++k) columns.emplace_back(&attribute_columns_[k * count], count);
    field_.attributes({x_, y_, z_}, columns);
    mesh_.attributes.resize(wanted * mesh_.edges.size());
    p = 0;
    const auto store = [&](std::uint32_t node) {
        for (std::size_t k = 0; k < wanted; ++k) mesh_.attributes[node * wanted + k] = columns[k][p];
        ++p;
    };
    for (const Brackets& b : brackets_) {
        for (const std::uint32_t node : b.node) store(node);
    }
    for (const std::uint32_t node : cap_nodes_) store(node);
    for (std::size_t a = 0; a < 3; ++a) column(a).resize(bisected);
}

/// The inside ends become the nodes, kept away from the corners.
void BlockContourer::set_positions() {
    for (std::size_t a = 0; a < 3; ++a) {
        const Brackets& b = brackets_[a];
        for (std::size_t i = 0; i < b.size(); ++i) {
            const double high = b.inside[i] > 1 - node_margin ? 1 - node_margin : b.inside[i];
            const double t = high < node_margin ? node_margin : high;
            set_component(mesh_.positions[b.node[i]], a, b.start[i] + t * b.length[i]);
        }
    }
}

/// Normals from the gradient. A wall, where F ends without a zero, has nothing to do with the gradient.
void BlockContourer::take_normals() {
    const std::size_t count = x_.size();
    if (brackets_[0].size() + brackets_[1].size() + brackets_[2].size() == 0) return;
    for (std::vector<double>* v : {&gx_, &gy_, &gz_}) v->resize(count);
    std::size_t p = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        for (const std::uint32_t node : brackets_[a].node) {
            column(a)[p++] = component(mesh_.positions[node], a);
        }
    }
    part_->gradients({x_, y_, z_}, out_, {gx_, gy_, gz_});
    p = 0;
    for (const Brackets& b : brackets_) {
        for (std::size_t i = 0; i < b.size(); ++i, ++p) {
            if (!b.wall[i]) mesh_.normals[b.node[i]] = outward_normal({gx_[p], gy_[p], gz_[p]});
        }
    }
}

/// Steps 3 and 4: the polygons of the block's cells; cells of the layer only with the cap.
void BlockContourer::add_cells() {
    Local begin{}, end{block_side, block_side, block_side};
    for (std::size_t a = 0; a < 3 && !options_.cap; ++a) {
        begin[a] = first_[a];
        end[a] = last_[a] < block_side ? last_[a] : block_side;
    }
    Local l{};
    for (l[2] = begin[2]; l[2] < end[2]; ++l[2]) {
        for (l[1] = begin[1]; l[1] < end[1]; ++l[1]) {
            // The four signs across the row at x: 0 all outside, 4 all inside.
            const std::uint8_t* row = &inside_[lattice_index({0, l[1], l[2]})];
            const auto across = [row](std::uint32_t x) {
                return row[x] + row[x + stride[1]] + row[x + stride[2]] + row[x + stride[1] + stride[2]];
            };
            int here = across(begin[0]);
            for (l[0] = begin[0]; l[0] < end[0]; ++l[0]) {
                const int next = across(l[0] + 1);
                if (here + next != 0 && here + next != 8 && !is_flat_cell(l)) add_cell(l);
                here = next;
            }
        }
    }
}

bool BlockContourer::is_flat_cell(const Local& cell) const {
    int layers = 0;
    for (std::size_t a = 0; a < 3 && is_at_side_; ++a) {
        const std::uint32_t e = with_layer(a, cell[a]);
        if (e == 0 || e == grid_.cells[a] + 1) ++layers;
    }
    return layers >= 2;
}

void BlockContourer::add_cell(const Local& corner) {
    std::array<double, 8> values{};
    for (std::size_t c = 0; c < 8; ++c) {
        const auto& offset = corner_offsets[c];
        values[c] =
            values_[lattice_index({corner[0] + offset[0], corner[1] + offset[1], corner[2] + offset[2]})];
    }
    if (part_ != &field_) take_whole_values(corner, values);
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

/// Off the surface a part has values of its own, which the part of the next block does not share. Where the
/// polygons of a cell depend on values, both blocks at a face take those of the whole field.
void BlockContourer::take_whole_values(const Local& corner, std::array<double, 8>& values) {
    unsigned inside = 0;
    for (unsigned c = 0; c < 8; ++c) inside |= (values[c] >= 0 ? 1U : 0U) << c;
    if (!has_ambiguous_face(inside)) return;
    for (std::size_t c = 0; c < 8; ++c) {
        const auto& offset = corner_offsets[c];
        const Local l{corner[0] + offset[0], corner[1] + offset[1], corner[2] + offset[2]};
        if (is_layer(l)) continue;
        const Vec3 p = sample_point(l);
        double value = 0;
        field_.values({{&p.x, 1}, {&p.y, 1}, {&p.z, 1}}, {&value, 1});
        if ((value >= 0) == (values[c] >= 0)) values[c] = value;
    }
}

PolygonNode BlockContourer::polygon_node(const Local& cell, std::uint8_t cell_edge) const {
    const auto& low = corner_offsets[edge_corners[cell_edge][0]];
    const auto& high = corner_offsets[edge_corners[cell_edge][1]];
    Local lower{cell[0] + low[0], cell[1] + low[1], cell[2] + low[2]};
    Local upper{cell[0] + high[0], cell[1] + high[1], cell[2] + high[2]};
    std::size_t axis = high[0] != low[0] ? 0 : high[1] != low[1] ? 1 : 2;
    if (is_at_side_ && (is_layer(lower) || is_layer(upper))) {
        lower = cap_edge(inside_[lattice_index(lower)] ? lower : upper, axis);
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
