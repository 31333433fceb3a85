// Implementation of dual_vertices.h.
#include "frep/contour/dual_vertices.h"

#include <algorithm>
#include <bit>
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

/// The point of the unit cell on the way from `anchor` to `goal` that stays on the sheet's side of its
/// planes. The anchor lies strictly on that side.
Vec3 on_sheet_side(const CellPattern& pattern, std::size_t sheet, const Vec3& anchor, const Vec3& goal) {
    double way = 1;
    for (std::size_t k = 0; k + 1 < pattern.sheets; ++k) {
        const SheetPlane& plane = pattern.planes[sheet][k];
        const Vec3 n{static_cast<double>(plane.normal[0]), static_cast<double>(plane.normal[1]),
                     static_cast<double>(plane.normal[2])};
        const double room = 0.5 * plane.twice_offset - dot(n, anchor);
        const double used = dot(n, goal - anchor);
        if (used > 0.5 * room) way = std::min(way, 0.5 * room / used);
    }
    return anchor + (goal - anchor) * way;
}

/// [n]: the edges of block n of NextBlocks that lie on cells of the first block: those with the coordinate 0
/// along each step of n, and not along it.
constexpr std::array<std::array<std::uint64_t, 24>, 7> edges_at_block = [] {
    std::array<std::array<std::uint64_t, 24>, 7> sets{};
    for (std::uint32_t n = 0; n < 7; ++n) {
        for (std::uint32_t number = 0; number < 3 * 512; ++number) {
            const Lattice at = local_of(number / 3);
            bool is_near = true;
            for (std::uint32_t a = 0; a < 3; ++a)
                is_near = is_near && (!(n >> a & 1) || (at[a] == 0 && number % 3 != a));
            if (is_near) sets[n][number / 64] |= std::uint64_t{1} << number % 64;
        }
    }
    return sets;
}();

}  // namespace

std::uint32_t DualVertices::number_sheets(DualBlock& block) {
    const std::array<CellPattern, 256>& patterns = cell_patterns();
    std::uint32_t count = 0;
    for (DualCell& cell : block.cells) {
        cell.vertex = count;
        count += patterns[cell.signs].sheets;
    }
    return count;
}

bool DualVertices::make(DualBlock& block, const NextBlocks& next) {
    if (!sum_errors(block, next)) return false;
    if (keeps_crossings()) {
        crossings_.clear();
        first_of_.clear();
        for (const DualCell& cell : block.cells) {
            first_of_.push_back(static_cast<std::uint32_t>(crossings_.size()));
            collect(block, next, cell);
        }
        first_of_.push_back(static_cast<std::uint32_t>(crossings_.size()));
    }
    if (options_.tolerance > 0) {
        for (std::size_t level = 0; level < 4; ++level) {
            const std::size_t side = block_side >> level;
            leaves_[level].assign(side * side * side, {});
        }
    }
    for (std::size_t i = 0; i < block.cells.size(); ++i) {
        const std::size_t sheets = patterns_[block.cells[i].signs].sheets;
        for (std::size_t sheet = 0; sheet < sheets; ++sheet) make_sheet(block, next, i, sheet);
    }
    if (options_.tolerance > 0) {
        merge(block);
        number_vertices(block);
    }
    return true;
}

/// The error of each sheet. False when a crossing is missing.
bool DualVertices::sum_errors(const DualBlock& block, const NextBlocks& next) {
    errors_.assign(block.vertices.size(), {});
    seen_.assign(block.cells.size(), 0);
    for (std::size_t i = 0; i < block.cells.size(); ++i)
        rank_of_[block.cells[i].number] = static_cast<std::uint16_t>(i);
    for (std::uint32_t n = 0; n < 7; ++n) {
        const DualBlock* owner = next[n];
        if (!owner) continue;
        const Lattice shift{(n & 1) * block_side, (n >> 1 & 1) * block_side, (n >> 2) * block_side};
        for (std::uint32_t w = 0; w < owner->edges.bits.size(); ++w) {
            const std::uint64_t all = owner->edges.bits[w];
            for (std::uint64_t left = all & edges_at_block[n][w]; left != 0; left &= left - 1) {
                const std::uint32_t number = w * 64 + static_cast<std::uint32_t>(std::countr_zero(left));
                const std::uint64_t smaller = all & ((left & -left) - 1);
                const std::uint32_t rank = owner->edges.before[w] + bit_count(smaller);
                Lattice lower = local_of(number / 3);
                for (std::size_t a = 0; a < 3; ++a) lower[a] += shift[a];
                add_crossing(block, lower, number % 3, owner->roots[rank], owner->normals[rank]);
            }
        }
    }
    for (std::size_t i = 0; i < block.cells.size(); ++i) {
        if (seen_[i] != patterns_[block.cells[i].signs].edges) return false;
    }
    return true;
}

/// Adds a crossing to the sheets of the block's cells around its edge.
void DualVertices::add_crossing(const DualBlock& block, const Lattice& lower, std::size_t axis, double root,
                                const Vec3& normal) {
    Vec3 point = position_of(lower);
    (axis == 0 ? point.x : axis == 1 ? point.y : point.z) += root;
    const QuadraticError error = QuadraticError::of(point, normal);
    const std::size_t u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
    constexpr std::array<std::uint32_t, 3> steps{1, block_side, block_side * block_side};
    const std::uint32_t at = local_number(lower);  // beyond the block where a coordinate is 8
    const auto add = [&](std::uint32_t number, std::uint8_t edge) {
        if (!block.cell_set.has(number)) return;
        const std::uint32_t rank = rank_of_[number];
        const DualCell& cell = block.cells[rank];
        const std::uint8_t sheet = patterns_[cell.signs].sheet_of[edge];
        seen_[rank] = static_cast<std::uint16_t>(seen_[rank] | 1u << edge);
        if (sheet != no_sheet) errors_[cell.vertex + sheet].add(error);
    };
    const bool has_u = lower[u] > 0, has_v = lower[v] > 0;
    const bool is_in_u = lower[u] < block_side, is_in_v = lower[v] < block_side;
    const auto& edges = cell_edges_at[axis];
    if (is_in_u && is_in_v) add(at, edges[0]);
    if (has_u && is_in_v) add(at - steps[u], edges[1u << u]);
    if (is_in_u && has_v) add(at - steps[v], edges[1u << v]);
    if (has_u && has_v) add(at - steps[u] - steps[v], edges[1u << u | 1u << v]);
}

/// Appends the crossings of a cell, all of which are there.
void DualVertices::collect(const DualBlock& block, const NextBlocks& next, const DualCell& cell) {
    const Lattice corner = local_of(cell.number);
    for (std::uint8_t e = 0; e < 12; ++e) {
        if (patterns_[cell.signs].sheet_of[e] == no_sheet) continue;
        const auto& low = corner_offsets[edge_corners[e][0]];
        const std::size_t axis = edge_axes[e];
        const Lattice at{corner[0] + low[0], corner[1] + low[1], corner[2] + low[2]};
        const std::size_t which = at[0] / block_side | at[1] / block_side << 1 | at[2] / block_side << 2;
        const DualBlock& owner = which == 0 ? block : *next[which];
        const std::uint32_t rank =
            owner.edges.rank(edge_number({at[0] % block_side, at[1] % block_side, at[2] % block_side}, axis));
        Crossing crossing{position_of(at), owner.normals[rank], nullptr, e};
        (axis == 0 ? crossing.point.x : axis == 1 ? crossing.point.y : crossing.point.z) += owner.roots[rank];
        if (options_.attributes > 0) crossing.attributes = &owner.attributes[rank * options_.attributes];
        crossings_.push_back(crossing);
    }
}

std::span<const DualVertices::Crossing> DualVertices::crossings_of(const DualBlock& block,
                                                                   const NextBlocks& next, std::size_t rank) {
    if (keeps_crossings())
        return {crossings_.data() + first_of_[rank], crossings_.data() + first_of_[rank + 1]};
    crossings_.clear();
    collect(block, next, block.cells[rank]);
    return crossings_;
}

void DualVertices::make_sheet(DualBlock& block, const NextBlocks& next, std::size_t rank, std::size_t sheet) {
    DualCell& cell = block.cells[rank];
    const CellPattern& pattern = patterns_[cell.signs];
    const Vec3 corner = position_of(local_of(cell.number));
    const std::size_t vertex = cell.vertex + sheet;
    const QuadraticError& error = errors_[vertex];
    const Vec3 sum = error.normal_sum();
    const double squares = dot(sum, sum);
    if (pattern.sheets > 1 || squares == 0 || keeps_crossings()) {
        members_.clear();
        for (const Crossing& crossing : crossings_of(block, next, rank)) {
            if (pattern.sheet_of[crossing.edge] == sheet) members_.push_back(crossing);
        }
    }
    block.vertex_normals[vertex] = squares > 0 ? sum * (1 / __builtin_sqrt(squares)) : fitted(cell, members_);
    QuadraticError::Free free;
    const Vec3 held{options_.margin, options_.margin, options_.margin};
    const Vec3 one{1, 1, 1};
    Vec3& position = block.vertices[vertex];
    position = error.minimum({corner + held, corner + (one - held)}, &free) - corner;
    if (pattern.sheets > 1) {
        position = on_sheet_side(pattern, sheet, anchor(corner, members_), position);
    } else {
        note_wish(block, rank, corner, free);
    }
    append_attributes(block, members_);
    if (options_.tolerance > 0) leaves_[0][cell.number] = {error, position, pattern.is_simple(), false};
}

/// The mean of the crossings, held off the corners of the cell, from its lower corner.
Vec3 DualVertices::anchor(const Vec3& corner, std::span<const Crossing> members) const {
    Vec3 sum;
    for (const Crossing& c : members) {
        const Vec3 a = corner_place(edge_corners[c.edge][0]), b = corner_place(edge_corners[c.edge][1]);
        const double t = dot(c.point - corner - a, b - a);
        sum = sum + a + (b - a) * std::min(std::max(t, options_.margin), 1 - options_.margin);
    }
    return sum / static_cast<double>(members.size());
}

/// The normal of the plane through crossings without known normals, towards the outside ends of their edges.
Vec3 DualVertices::fitted(const DualCell& cell, std::span<const Crossing> members) const {
    Vec3 middle, outward;
    for (const Crossing& c : members) {
        const auto& ends = edge_corners[c.edge];
        const Vec3 along = corner_place(ends[1]) - corner_place(ends[0]);
        outward = outward + ((cell.signs >> ends[0]) & 1u ? along : -along);
        middle = middle + c.point;
    }
    middle = middle / static_cast<double>(members.size());
    std::array<double, 6> m{};
    for (const Crossing& c : members) {
        const Vec3 d = c.point - middle;
        const std::array<double, 6> squares{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
        for (std::size_t i = 0; i < 6; ++i) m[i] += squares[i];
    }
    const Vec3 normal = eigen_of(m).vectors[2];
    return dot(normal, outward) < 0 ? -normal : normal;
}

/// The means of the defined attributes of some crossings; NaN if there is none.
void DualVertices::append_attributes(DualBlock& block, std::span<const Crossing> members) const {
    for (std::size_t k = 0; k < options_.attributes; ++k) {
        double sum = 0;
        std::size_t defined = 0;
        for (const Crossing& c : members) {
            const double value = c.attributes[k];
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
void DualVertices::note_wish(DualBlock& block, std::size_t rank, const Vec3& corner,
                             const QuadraticError::Free& free) const {
    DualCell& cell = block.cells[rank];
    const Vec3 at = free.point - corner;
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
    block.wishes.push_back({static_cast<std::uint32_t>(rank), at});
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
        block.vertices[cell.vertex] = wish.position;
    }
}

}  // namespace frep::contouring
