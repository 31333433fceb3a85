// Implementation of dual_vertices.h.
#include "frep/contour/dual_vertices.h"

#include <algorithm>
#include <limits>
#include <utility>

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

double component(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// A corner of the unit cell.
Vec3 corner_place(std::uint8_t corner) {
    const auto& o = corner_offsets[corner];
    return {static_cast<double>(o[0]), static_cast<double>(o[1]), static_cast<double>(o[2])};
}

/// Whether the four corners of a face have one sign.
bool has_one_sign(unsigned signs, std::uint8_t face) {
    static constexpr std::array<std::uint8_t, 6> corners = [] {
        std::array<std::uint8_t, 6> sets{};
        for (std::size_t f = 0; f < 6; ++f) {
            for (unsigned c = 0; c < 8; ++c) {
                if (corner_offsets[c][f / 2] == f % 2) sets[f] = static_cast<std::uint8_t>(sets[f] | 1u << c);
            }
        }
        return sets;
    }();
    const unsigned of_face = signs & corners[face];
    return of_face == 0 || of_face == corners[face];
}

/// The nearer of the two faces through which the line from `at`, in the unit cell, goes out, if it has one
/// sign; else the other one, if that has; else no_wish.
std::uint8_t way_out(unsigned signs, const Vec3& at, const Vec3& along) {
    std::array<double, 2> ways{1e9, 1e9};
    std::array<std::uint8_t, 2> faces{no_wish, no_wish};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = component(at, axis), d = component(along, axis);
        if (d == 0) continue;
        for (std::size_t way = 0; way < 2; ++way) {
            const bool is_up = (d > 0) == (way == 0);
            const double distance = magnitude(((is_up ? 1 : 0) - a) / d);
            if (!(distance < ways[way])) continue;
            ways[way] = distance;
            faces[way] = static_cast<std::uint8_t>(2 * axis + (is_up ? 1 : 0));
        }
    }
    if (ways[1] < ways[0]) std::swap(faces[0], faces[1]);
    for (const std::uint8_t face : faces) {
        if (face != no_wish && has_one_sign(signs, face)) return face;
    }
    return no_wish;
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
        block.cells[i].vertex = static_cast<std::uint32_t>(block.vertices.size());
        const std::size_t sheets = cell_pattern(block.cells[i].signs).sheets;
        for (std::size_t sheet = 0; sheet < sheets; ++sheet) make_sheet(block, i, sheet);
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

void DualVertices::make_sheet(DualBlock& block, std::size_t rank, std::size_t sheet) {
    DualCell& cell = block.cells[rank];
    const CellPattern& pattern = cell_pattern(cell.signs);
    const Lattice corner = local_of(cell.number);
    std::array<std::uint32_t, 12> all{};
    std::size_t count = 0;
    QuadraticError error;
    for (std::uint32_t k = first_of_[rank]; k < first_of_[rank + 1]; ++k) {
        if (pattern.sheet_of[edge_of_[k]] != sheet) continue;
        error.add(crossings_[k].point, crossings_[k].normal);
        all[count++] = k;
    }
    const std::span<const std::uint32_t> members{all.data(), count};
    DualVertex vertex;
    vertex.normal = unit(error.normal_sum());
    if (vertex.normal == Vec3{0, 0, 0}) vertex.normal = fitted(cell, members);
    QuadraticError::Free free;
    vertex.position = error.minimum(box_of(corner, 1, options_.margin), &free);
    if (pattern.sheets > 1) {
        vertex.position =
            on_sheet_side(pattern, sheet, position_of(corner), anchor(cell, members), vertex.position);
    } else {
        note_wish(block, rank, free);
    }
    block.vertices.push_back(vertex);
    append_attributes(block, members);
    if (options_.tolerance > 0) {
        Leaf& leaf = leaves_[0][cell.number];
        leaf = {error, vertex.position, pattern.is_simple(), false};
    }
}

/// The mean of the crossings, held off the corners of the cell.
Vec3 DualVertices::anchor(const DualCell& cell, std::span<const std::uint32_t> members) const {
    const Vec3 lower = position_of(local_of(cell.number));
    Vec3 sum;
    for (const std::uint32_t k : members) {
        const Vec3 a = corner_place(edge_corners[edge_of_[k]][0]),
                   b = corner_place(edge_corners[edge_of_[k]][1]);
        const double t = dot(crossings_[k].point - lower - a, b - a);
        sum = sum + lower + a + (b - a) * std::min(std::max(t, options_.margin), 1 - options_.margin);
    }
    return sum / static_cast<double>(members.size());
}

/// The normal of the plane through crossings without known normals, towards the outside ends of their edges.
Vec3 DualVertices::fitted(const DualCell& cell, std::span<const std::uint32_t> members) const {
    Vec3 middle, outward;
    for (const std::uint32_t k : members) {
        const auto& ends = edge_corners[edge_of_[k]];
        const Vec3 along = corner_place(ends[1]) - corner_place(ends[0]);
        outward = outward + ((cell.signs >> ends[0]) & 1u ? along : -along);
        middle = middle + crossings_[k].point;
    }
    middle = middle / static_cast<double>(members.size());
    std::array<double, 6> m{};
    for (const std::uint32_t k : members) {
        const Vec3 d = crossings_[k].point - middle;
        const std::array<double, 6> squares{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
        for (std::size_t i = 0; i < 6; ++i) m[i] += squares[i];
    }
    const Vec3 normal = eigen_of(m).vectors[2];
    return dot(normal, outward) < 0 ? -normal : normal;
}

/// The means of the defined attributes of some crossings; NaN if there is none.
void DualVertices::append_attributes(DualBlock& block, std::span<const std::uint32_t> members) const {
    for (std::size_t k = 0; k < options_.attributes; ++k) {
        double sum = 0;
        std::size_t defined = 0;
        for (const std::uint32_t i : members) {
            const double value = crossings_[i].attributes[k];
            if (value != value) continue;
            sum += value;
            ++defined;
        }
        block.vertex_attributes.push_back(defined > 0 ? sum / static_cast<double>(defined)
                                                      : std::numeric_limits<double>::quiet_NaN());
    }
}

/// Notes the face through which a sharp edge leaves the cell, if its corners have one sign: the face behind
/// which the free minimum lies, no farther than a cell, or the one through which the edge's line goes out.
void DualVertices::note_wish(DualBlock& block, std::size_t rank, const QuadraticError::Free& free) const {
    DualCell& cell = block.cells[rank];
    const Vec3 at = free.point - position_of(local_of(cell.number));
    const double low = options_.margin, high = 1 - options_.margin;
    std::uint8_t face = no_wish;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double c = component(at, axis);
        if (c >= low && c <= high) continue;
        if (face != no_wish || !(c >= low - 1 && c <= high + 1)) return;
        face = static_cast<std::uint8_t>(2 * axis + (c > 0.5 ? 1 : 0));
    }
    if (face == no_wish) {
        if (free.along == Vec3{0, 0, 0}) return;
        face = way_out(cell.signs, at, free.along);
        if (face == no_wish) return;
    } else if (!has_one_sign(cell.signs, face)) {
        return;
    }
    cell.wish = face;
    block.wishes.push_back({static_cast<std::uint32_t>(rank), free.point});
}

void DualVertices::grant_wishes(DualBlock& block, const std::array<const DualBlock*, 27>& around,
                                const Lattice& cells) const {
    using Signed = std::array<std::int32_t, 3>;
    const Lattice first = morton_decode(block.code);
    const auto block_of = [&](const Signed& at, Lattice& local) {
        std::size_t which = 0;
        constexpr std::array<std::size_t, 3> steps{1, 3, 9};
        for (std::size_t a = 0; a < 3; ++a) {
            which += steps[a] * static_cast<std::size_t>((at[a] >> 3) + 1);
            local[a] = static_cast<std::uint32_t>(at[a] & 7);
        }
        return around[which];
    };
    const auto step_of = [](std::uint8_t face) { return face % 2 == 0 ? -1 : 1; };
    for (const DualBlock::Wish& wish : block.wishes) {
        DualCell& cell = block.cells[wish.cell];
        if (cell.level > 0) continue;
        const Lattice own = local_of(cell.number);
        Signed behind{};
        bool is_free = true;
        for (std::size_t a = 0; a < 3; ++a) {
            behind[a] = static_cast<std::int32_t>(own[a]);
            if (a == cell.wish / 2) behind[a] += step_of(cell.wish);
            const std::int64_t whole = static_cast<std::int64_t>(first[a]) * block_side + behind[a];
            is_free = is_free && whole >= 1 && whole <= cells[a];
        }
        Lattice local{};
        const DualBlock* owner = is_free ? block_of(behind, local) : nullptr;
        if (owner) {
            is_free = !owner->cell_set.has(local_number(local));
            for (std::uint32_t k = 0; k < 3 && is_free; ++k) {
                const std::uint32_t count = block_side >> (k + 1);
                const std::uint32_t cube =
                    ((local[2] >> (k + 1)) * count + (local[1] >> (k + 1))) * count + (local[0] >> (k + 1));
                is_free = !(owner->merged[k] >> cube & 1);
            }
        }
        // Of several wishes for a cell the first face's counts.
        for (std::uint8_t face = 0; face < cell.wish && is_free; ++face) {
            Signed other = behind;
            other[face / 2] -= step_of(face);
            const DualBlock* there = block_of(other, local);
            const std::uint32_t number = local_number(local);
            if (!there || !there->cell_set.has(number)) continue;
            const DualCell& rival = there->cells[there->cell_set.rank(number)];
            is_free = !(rival.wish == face && rival.level == 0);
        }
        if (!is_free) continue;
        cell.granted = cell.wish;
        block.vertices[cell.vertex].position = wish.position;
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

void DualVertices::merge_cube(DualBlock& block, std::size_t level, const Lattice& cube) {
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
    if (!merged.is_empty)
        block.merged[level - 1] |= std::uint64_t{1} << ((cube[2] * count + cube[1]) * count + cube[0]);
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
