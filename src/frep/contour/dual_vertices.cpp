// Implementation of dual_vertices.h.
#include "frep/contour/dual_vertices.h"

#include <algorithm>
#include <limits>

#include "frep/contour/cell.h"
#include "frep/contour/dual_cell.h"

namespace frep::contouring {

namespace {

double magnitude(double v) { return v < 0 ? -v : v; }

Vec3 position_of(const Lattice& l) {
    return {static_cast<double>(l[0]), static_cast<double>(l[1]), static_cast<double>(l[2])};
}

Box3 box_of(const Lattice& lower, std::uint32_t side, double margin) {
    const Vec3 low = position_of(lower);
    const double s = static_cast<double>(side) - margin;
    return {low + Vec3{margin, margin, margin}, low + Vec3{s, s, s}};
}

Vec3 unit(const Vec3& v) {
    const double l = length(v);
    return l > 0 ? v / l : Vec3{0, 0, 0};
}

/// The normal of the plane through points without known normals, towards `outward`.
Vec3 fitted_normal(std::span<const Vec3> points, const Vec3& outward) {
    Vec3 middle;
    for (const Vec3& p : points) middle = middle + p;
    middle = middle / static_cast<double>(points.size());
    std::array<double, 6> m{};
    for (const Vec3& p : points) {
        const Vec3 d = p - middle;
        const std::array<double, 6> squares{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
        for (std::size_t i = 0; i < 6; ++i) m[i] += squares[i];
    }
    const Vec3 normal = eigen_of(m).vectors[2];
    return dot(normal, outward) < 0 ? -normal : normal;
}

/// The point on the way from `anchor` to `goal` that stays on the sheet's side of its planes; `lower` is the
/// cell's first corner. The anchor lies strictly on that side.
Vec3 on_sheet_side(const CellPattern& pattern, std::size_t sheet, const Vec3& lower, const Vec3& anchor,
                   const Vec3& goal) {
    double way = 1;
    for (std::size_t k = 0; k + 1 < pattern.sheets; ++k) {
        const SheetPlane& plane = pattern.planes[sheet][k];
        const Vec3 n{static_cast<double>(plane.normal[0]), static_cast<double>(plane.normal[1]),
                     static_cast<double>(plane.normal[2])};
        const double room = 0.5 * plane.twice_offset - dot(n, anchor - lower);
        const double used = dot(n, goal - anchor);
        if (used > 0.5 * room) way = std::min(way, 0.5 * room / used);
    }
    return anchor + (goal - anchor) * way;
}

}  // namespace

bool DualVertices::make(DualBlock& block, const NextBlocks& next) {
    if (!collect(block, next)) return false;
    if (options_.tolerance > 0) {
        for (std::size_t level = 0; level < 4; ++level) {
            const std::size_t side = block_side >> level;
            leaves_[level].assign(side * side * side, {});
        }
    }
    block.vertices.clear();
    for (std::size_t i = 0; i < block.cells.size(); ++i) {
        DualCell& cell = block.cells[i];
        cell.vertex = static_cast<std::uint32_t>(block.vertices.size());
        const std::size_t count = first_of_[i + 1] - first_of_[i];
        const CellPattern& pattern = cell_pattern(cell.signs);
        for (std::size_t sheet = 0; sheet < pattern.sheets; ++sheet)
            make_sheet(block, cell, sheet, {&crossings_[first_of_[i]], count});
    }
    if (options_.tolerance > 0) {
        merge(block);
        number_vertices(block);
    }
    return true;
}

/// Finds the crossings of all cells.
bool DualVertices::collect(const DualBlock& block, const NextBlocks& next) {
    crossings_.clear();
    first_of_.clear();
    edge_of_.clear();
    for (const DualCell& cell : block.cells) {
        first_of_.push_back(static_cast<std::uint32_t>(crossings_.size()));
        const Lattice corner = local_of(cell.number);
        const CellPattern& pattern = cell_pattern(cell.signs);
        for (std::uint8_t e = 0; e < 12; ++e) {
            if (pattern.sheet_of[e] == no_sheet) continue;
            const auto& low = corner_offsets[edge_corners[e][0]];
            const auto& high = corner_offsets[edge_corners[e][1]];
            const std::size_t axis = low[0] != high[0] ? 0 : low[1] != high[1] ? 1 : 2;
            Lattice at{corner[0] + low[0], corner[1] + low[1], corner[2] + low[2]};
            Vec3 point = position_of(at);
            std::size_t which = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                which |= static_cast<std::size_t>(at[a] / block_side) << a;
                at[a] %= block_side;
            }
            const DualBlock* owner = next[which];
            const std::uint32_t number = edge_number(at, axis);
            if (!owner || !owner->edges.has(number)) return false;
            const std::uint32_t rank = owner->edges.rank(number);
            (axis == 0 ? point.x : axis == 1 ? point.y : point.z) += owner->roots[rank];
            const double* attributes =
                options_.attributes > 0 ? &owner->attributes[rank * options_.attributes] : nullptr;
            crossings_.push_back({point, owner->normals[rank], attributes});
            edge_of_.push_back(e);
        }
    }
    first_of_.push_back(static_cast<std::uint32_t>(crossings_.size()));
    return true;
}

void DualVertices::make_sheet(DualBlock& block, const DualCell& cell, std::size_t sheet,
                              std::span<const Crossing> all) {
    const CellPattern& pattern = cell_pattern(cell.signs);
    const Lattice corner = local_of(cell.number);
    const Vec3 lower = position_of(corner);
    const Box3 box = box_of(corner, 1, options_.margin);
    const std::uint8_t* edges = &edge_of_[static_cast<std::size_t>(all.data() - crossings_.data())];
    QuadraticError error;
    Vec3 anchor, outward;  // the mean of the crossings held off the corners; where the edges lead out
    std::array<Vec3, 12> points;
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (pattern.sheet_of[edges[i]] != sheet) continue;
        error.add(all[i].point, all[i].normal);
        const auto& ends = edge_corners[edges[i]];
        const Vec3 a{static_cast<double>(corner_offsets[ends[0]][0]),
                     static_cast<double>(corner_offsets[ends[0]][1]),
                     static_cast<double>(corner_offsets[ends[0]][2])};
        const Vec3 b{static_cast<double>(corner_offsets[ends[1]][0]),
                     static_cast<double>(corner_offsets[ends[1]][1]),
                     static_cast<double>(corner_offsets[ends[1]][2])};
        const double t = dot(all[i].point - lower - a, b - a);
        const double held = std::min(std::max(t, options_.margin), 1 - options_.margin);
        anchor = anchor + lower + a + (b - a) * held;
        outward = outward + ((cell.signs >> ends[0]) & 1u ? b - a : a - b);
        points[count++] = all[i].point;
    }
    anchor = anchor / static_cast<double>(count);
    DualVertex vertex;
    vertex.normal = unit(error.normal_sum());
    if (vertex.normal == Vec3{0, 0, 0}) vertex.normal = fitted_normal({points.data(), count}, outward);
    vertex.position = error.minimum(box);
    if (pattern.sheets > 1) vertex.position = on_sheet_side(pattern, sheet, lower, anchor, vertex.position);
    block.vertices.push_back(vertex);
    if (options_.attributes > 0) {
        std::array<std::size_t, 12> members{};
        std::size_t n = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (pattern.sheet_of[edges[i]] == sheet) members[n++] = i;
        }
        append_attributes(block, all, {members.data(), n});
    }
    if (options_.tolerance > 0) {
        Leaf& leaf = leaves_[0][cell.number];
        leaf = {error, vertex.position, pattern.is_simple(), false};
    }
}

/// The means of the defined attributes of some crossings; NaN if there is none.
void DualVertices::append_attributes(DualBlock& block, std::span<const Crossing> all,
                                     std::span<const std::size_t> members) {
    for (std::size_t k = 0; k < options_.attributes; ++k) {
        double sum = 0;
        std::size_t defined = 0;
        for (const std::size_t i : members) {
            const double value = all[i].attributes[k];
            if (value != value) continue;
            sum += value;
            ++defined;
        }
        block.vertex_attributes.push_back(defined > 0 ? sum / static_cast<double>(defined)
                                                      : std::numeric_limits<double>::quiet_NaN());
    }
}

/// Bottom-up: cubes whose eight parts are leaves or empty.
void DualVertices::merge(DualBlock& block) {
    for (Leaf& leaf : leaves_[0]) leaf.exists = leaf.exists || leaf.is_empty;
    for (std::size_t level = 1; level < 4; ++level) {
        const std::uint32_t count = block_side >> level;
        for (std::uint32_t i = 0; i < count * count * count; ++i) {
            if (!(block.mergeable[level - 1] >> i & 1)) continue;
            merge_cube(block, level, {i % count, i / count % count, i / (count * count)});
        }
    }
}

void DualVertices::merge_cube(const DualBlock& block, std::size_t level, const Lattice& cube) {
    const std::uint32_t count = block_side >> level;
    Leaf merged;
    for (std::uint32_t c = 0; c < 8; ++c) {
        const Lattice part{cube[0] * 2 + (c & 1), cube[1] * 2 + (c >> 1 & 1), cube[2] * 2 + (c >> 2)};
        const Leaf& leaf = leaves_[level - 1][(part[2] * 2 * count + part[1]) * 2 * count + part[0]];
        if (!leaf.exists) return;
        if (leaf.is_empty) continue;
        merged.is_empty = false;
        merged.error.add(leaf.error);
    }
    Leaf& target = leaves_[level][(cube[2] * count + cube[1]) * count + cube[0]];
    merged.exists = true;
    if (!merged.is_empty) {
        const std::uint32_t side = 1u << level;
        const Lattice lower{cube[0] * side, cube[1] * side, cube[2] * side};
        merged.position = merged.error.minimum(box_of(lower, side, options_.margin));
        for (std::size_t i = 0; i < block.cells.size(); ++i) {
            const Lattice at = local_of(block.cells[i].number);
            if (at[0] / side != cube[0] || at[1] / side != cube[1] || at[2] / side != cube[2]) continue;
            for (std::uint32_t k = first_of_[i]; k < first_of_[i + 1]; ++k) {
                const Crossing& c = crossings_[k];
                // Where the normal is unknown nothing may merge.
                if (c.normal == Vec3{0, 0, 0}) return;
                if (!(magnitude(dot(c.normal, merged.position - c.point)) <= options_.tolerance)) return;
            }
        }
    }
    target = merged;
}

/// The vertices of the leaves that are left, in the order of their first cells.
void DualVertices::number_vertices(DualBlock& block) {
    std::vector<DualVertex> vertices;
    std::vector<double> attributes;
    std::array<std::vector<std::uint32_t>, 4> vertex_of;
    for (std::size_t level = 1; level < 4; ++level) vertex_of[level].assign(leaves_[level].size(), ~0u);
    const std::size_t wanted = options_.attributes;
    for (DualCell& cell : block.cells) {
        const Lattice at = local_of(cell.number);
        const std::uint32_t old = cell.vertex;
        cell.level = 0;
        std::size_t leaf = 0;
        for (std::uint8_t level = 1; level < 4; ++level) {
            const std::uint32_t count = block_side >> level;
            const std::size_t i = ((at[2] >> level) * count + (at[1] >> level)) * count + (at[0] >> level);
            if (!leaves_[level][i].exists) break;
            cell.level = level;
            leaf = i;
        }
        cell.vertex = static_cast<std::uint32_t>(vertices.size());
        const std::size_t sheets = cell.level > 0 ? 1 : cell_pattern(cell.signs).sheets;
        if (cell.level > 0) {
            std::uint32_t& known = vertex_of[cell.level][leaf];
            if (known != ~0u) {
                cell.vertex = known;
                continue;
            }
            known = cell.vertex;
            const Leaf& merged = leaves_[cell.level][leaf];
            vertices.push_back({merged.position, unit(merged.error.normal_sum())});
        } else {
            for (std::size_t s = 0; s < sheets; ++s) vertices.push_back(block.vertices[old + s]);
        }
        for (std::size_t k = 0; k < sheets * wanted; ++k)
            attributes.push_back(block.vertex_attributes[old * wanted + k]);
    }
    block.vertices = std::move(vertices);
    block.vertex_attributes = std::move(attributes);
}

}  // namespace frep::contouring
