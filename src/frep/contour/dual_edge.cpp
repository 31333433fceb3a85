// Implementation of dual_edge.h.
#include "frep/contour/dual_edge.h"

#include <algorithm>
#include <span>

#include "frep/base/result.h"
#include "frep/contour/cell.h"
#include "frep/contour/dual_cell.h"

namespace frep::contouring {

namespace {

double component(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
double magnitude(double v) { return v < 0 ? -v : v; }

/// Whether the quadrants lie on the positive side of the edge: counter-clockwise from (+, +).
constexpr std::array<bool, 4> positive_u{true, false, false, true};
constexpr std::array<bool, 4> positive_v{true, true, false, false};

/// A polygon's corner seen along the edge: u and v from the edge, h along it from its lower end.
struct Corner {
    double u = 0, v = 0, h = 0;
};

double turn(const Corner& a, const Corner& b) { return a.u * b.v - a.v * b.u; }

/// The part of an edge that no leaf around it subdivides, held off its ends.
struct Span {
    double low = 0, high = 1, margin = 0;
};

/// Where the edge passes through the triangle, if it is within the span.
bool pierces(const Corner& a, const Corner& b, const Corner& c, const Span& span, double& at) {
    const double wa = turn(b, c), wb = turn(c, a), wc = turn(a, b);
    if (!(wa > 0 && wb > 0 && wc > 0)) return false;
    at = (wa * a.h + wb * b.h + wc * c.h) / (wa + wb + wc);
    return at >= span.low + span.margin && at <= span.high - span.margin;
}

/// Whether the line from c to a passes the half plane of n inside of the triangle of n and the edge.
bool passes(const Corner& c, const Corner& n, const Corner& a, const Span& span) {
    constexpr double largest = 0.999;  // beyond that a, n and c are nearly on one line
    const double cn = turn(c, n), na = turn(n, a), ca = turn(c, a);
    if (!(cn > 0 && na > 0 && ca > 0)) return false;
    const double part = ca / (cn + na);  // the crossing's distance from the edge, by that of n
    if (!(part <= largest)) return false;
    const double h = c.h + cn / (cn + na) * (a.h - c.h);
    const double low = span.low + part * (n.h - span.low), high = span.high + part * (n.h - span.high);
    const double margin = span.margin * (1 - part);
    return h >= low + margin && h <= high - margin;
}

/// Whether the polygon a b c d may be cut along a - c; `at`: where the edge passes.
bool cuts(const Corner& a, const Corner& b, const Corner& c, const Corner& d, const Span& span, double& at) {
    constexpr double nothing = 1e-12;  // the cut meets the edge itself
    const double side = turn(c, a);
    if (side > nothing) return pierces(a, b, c, span, at) && passes(c, d, a, span);
    if (side < -nothing) return pierces(a, c, d, span, at) && passes(a, b, c, span);
    const double from_a = magnitude(a.u) + magnitude(a.v), from_c = magnitude(c.u) + magnitude(c.v);
    at = a.h + from_a / (from_a + from_c) * (c.h - a.h);
    return at >= span.low + span.margin && at <= span.high - span.margin;
}

double squared_distance(const Corner& a, const Corner& b) {
    return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v) + (a.h - b.h) * (a.h - b.h);
}

}  // namespace

bool EdgeStar::look(std::uint32_t number) {
    const Lattice lower = local_of(number / 3);
    for (std::size_t a = 0; a < 3; ++a) lower_[a] = static_cast<std::int32_t>(lower[a]);
    axis_ = number % 3;
    u_ = (axis_ + 1) % 3;
    v_ = (axis_ + 2) % 3;
    const DualBlock& block = *around_.blocks[13];
    root_ = block.roots[block.edges.rank(number)];
    bool found = false;
    for (std::size_t q = 0; q < 4; ++q) {
        if (!find_side(q)) return false;
        const Side& side = sides_[q];
        if (!side.cell) continue;
        found = true;
        lower_is_inside_ = (side.cell->signs >> edge_corners[side.edge][0] & 1u) != 0;
    }
    return found;
}

bool EdgeStar::find_side(std::size_t q) {
    Side& side = sides_[q];
    side = {};
    side.corner = lower_;
    if (!positive_u[q]) --side.corner[u_];
    if (!positive_v[q]) --side.corner[v_];
    std::size_t which = 0;
    Lattice local{};
    std::uint32_t outside = 0;
    constexpr std::array<std::size_t, 3> steps{1, 3, 9};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto whole = static_cast<std::int64_t>(around_.lo[a]) + side.corner[a];
        const std::int64_t first = around_.cap ? 0 : 1, last = around_.cells[a] + (around_.cap ? 1 : 0);
        if (whole < first) outside += 1u << (2 * a);
        if (whole > last) outside += 2u << (2 * a);
        const std::int32_t block = side.corner[a] < 0 ? 0 : 1;
        which += steps[a] * static_cast<std::size_t>(block);
        side.block_corner[a] = (block - 1) * static_cast<std::int32_t>(block_side);
        local[a] = static_cast<std::uint32_t>(side.corner[a] - side.block_corner[a]);
    }
    if (outside != 0) {
        side.key = ~outside;  // vertices never get that far
        return true;
    }
    side.block = around_.blocks[which];
    const std::uint32_t cell = local_number(local);
    if (!side.block || !side.block->cell_set.has(cell)) return false;
    side.cell = &side.block->cells[side.block->cell_set.rank(cell)];
    const unsigned bits = (positive_u[q] ? 0u : 1u << u_) | (positive_v[q] ? 0u : 1u << v_);
    side.edge = cell_edge_at(axis_, bits);
    const CellPattern& pattern = cell_pattern(side.cell->signs);
    side.sheets = pattern.sheets;
    if (pattern.sheet_of[side.edge] == no_sheet) return false;
    const std::uint32_t sheet = side.cell->level > 0 ? 0 : pattern.sheet_of[side.edge];
    side.local_vertex = side.cell->vertex + sheet;
    side.vertex = around_.first_vertex[which] + side.local_vertex;
    side.key = side.vertex;
    return true;
}

bool EdgeStar::is_one_leaf(std::size_t q) const { return sides_[q].key == sides_[(q + 1) % 4].key; }

EdgeStar::Face EdgeStar::face(std::size_t q) const {
    const Side& here = sides_[q];
    const Side& next = sides_[(q + 1) % 4];
    switch (q) {
        case 0:
            return {u_, v_, true, &next, &here};
        case 1:
            return {v_, u_, false, &next, &here};
        case 2:
            return {u_, v_, false, &here, &next};
        default:
            return {v_, u_, true, &here, &next};
    }
}

bool EdgeStar::is_ambiguous(const Face& face) const {
    const Side& side = *face.above;
    return side.cell->level == 0 && face.below->cell->level == 0 &&
           (cell_pattern(side.cell->signs).ambiguous_faces >> (2 * face.normal) & 1) != 0;
}

/// Computed in the frame of the block of the cell below the face, so that both ends of the arc find the same.
bool EdgeStar::is_turned(std::size_t q) const {
    const Face f = face(q);
    if (!f.below->cell || !f.above->cell || is_one_leaf(q)) return false;
    if (f.below->sheets != 1 || f.above->sheets != 1 || is_ambiguous(f)) return false;
    const Side& small = f.below->cell->level <= f.above->cell->level ? *f.below : *f.above;
    const Vec3 a = f.below->block->vertices[f.below->local_vertex].position;
    const Signed& origin = f.below->block_corner;
    const Vec3 shift{static_cast<double>(f.above->block_corner[0] - origin[0]),
                     static_cast<double>(f.above->block_corner[1] - origin[1]),
                     static_cast<double>(f.above->block_corner[2] - origin[2])};
    const Vec3 b = f.above->block->vertices[f.above->local_vertex].position + shift;
    const double plane = static_cast<double>(lower_[f.normal] - origin[f.normal]);
    const double part = (plane - component(a, f.normal)) / (component(b, f.normal) - component(a, f.normal));
    const Vec3 at = a + (b - a) * part;
    const double margin = 0.5 * around_.margin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis == f.normal) continue;
        double start = static_cast<double>(small.leaf_start(axis) - origin[axis]);
        double end = start + static_cast<double>(small.size());
        // Both leaves may go on behind faces side by side (dual_vertices.h); then so does their common face.
        if (f.below->cell->granted == f.above->cell->granted) {
            if (small.cell->granted == 2 * axis) start -= 1;
            if (small.cell->granted == 2 * axis + 1) end += 1;
        }
        const double c = component(at, axis);
        if (!(c >= start + margin && c <= end - margin)) return false;
    }
    return true;
}

/// The place of a leaf's vertex from the first sample of the block in the middle.
Vec3 EdgeStar::place(const Side& side) const {
    const Signed& c = side.block_corner;
    const Vec3 shift{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
    return side.block->vertices[side.local_vertex].position + shift;
}

std::uint8_t EdgeStar::state() const {
    std::uint8_t turned = 0;
    std::array<std::size_t, 4> corners{};
    std::size_t count = 0, open = 0;
    bool is_whole = true;
    for (std::size_t q = 0; q < 4; ++q) {
        is_whole = is_whole && sides_[q].cell;
        if (is_one_leaf(q)) continue;
        corners[count++] = q;
        if (is_turned(q)) {
            turned = static_cast<std::uint8_t>(turned | 1u << q);
        } else {
            ++open;
        }
    }
    if (count < 3) return State::dead;
    if (!is_whole || open > 0) return turned | State::kept;
    return cut(turned, {corners.data(), count});
}

/// The state of an edge all of whose arcs are turned.
std::uint8_t EdgeStar::cut(std::uint8_t turned, std::span<const std::size_t> quadrants) const {
    std::array<Corner, 4> c{};
    Span span{-1e9, 1e9, 0.5 * around_.margin};
    for (std::size_t i = 0; i < quadrants.size(); ++i) {
        const Side& side = sides_[quadrants[i]];
        const Vec3 p = place(side);
        c[i] = {component(p, u_) - lower_[u_], component(p, v_) - lower_[v_],
                component(p, axis_) - lower_[axis_]};
        const double start = static_cast<double>(side.leaf_start(axis_) - lower_[axis_]);
        span.low = std::max(span.low, start);
        span.high = std::min(span.high, start + static_cast<double>(side.size()));
    }
    double at = 0, other = 0;
    if (quadrants.size() == 3) {
        const bool is_good =
            pierces(c[0], c[1], c[2], span, at) && magnitude(at - root_) <= around_.keep_distance;
        return is_good ? turned : static_cast<std::uint8_t>(turned | State::kept);
    }
    const bool first = cuts(c[0], c[1], c[2], c[3], span, at);
    const bool second = cuts(c[1], c[2], c[3], c[0], span, other);
    const double first_off = first ? magnitude(at - root_) : 1e9;
    const double second_off = second ? magnitude(other - root_) : 1e9;
    if (std::min(first_off, second_off) > around_.keep_distance) return turned | State::kept;
    constexpr double same = 1e-6;
    bool takes_second = second_off < first_off;
    if (first && second && magnitude(first_off - second_off) <= same)
        takes_second = squared_distance(c[1], c[3]) < squared_distance(c[0], c[2]) * (1 - same);
    return takes_second ? static_cast<std::uint8_t>(turned | State::second_diagonal) : turned;
}

EdgeName EdgeStar::partner(std::size_t q) const {
    const Face f = face(q);
    const bool takes_above =
        !f.below->cell || (f.above->cell && f.above->cell->level <= f.below->cell->level);
    const Side& small = takes_above ? *f.above : *f.below;
    Signed at{};
    std::size_t axis = 0;
    if (small.cell->level == 0) {
        const std::size_t number = 2 * f.normal + (takes_above ? 0 : 1);
        const std::uint8_t edge = cell_pattern(small.cell->signs).partner[number][small.edge];
        FREP_CHECK(edge != no_edge);
        const auto& low = corner_offsets[edge_corners[edge][0]];
        const auto& high = corner_offsets[edge_corners[edge][1]];
        axis = low[0] != high[0] ? 0 : low[1] != high[1] ? 1 : 2;
        for (std::size_t a = 0; a < 3; ++a) at[a] = small.corner[a] + low[a];
        return name_of(at, axis);
    }
    return crossing_on_sides(f, small);
}

/// The name of the edge from a sample of the block in the middle or near it.
EdgeName EdgeStar::name_of(const Signed& lower, std::size_t axis) const {
    constexpr std::array<std::size_t, 3> steps{1, 3, 9};
    EdgeName name{0, 0};
    Lattice local{};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::int32_t block = lower[a] >> 3;
        name.block += steps[a] * static_cast<std::size_t>(block + 1);
        local[a] = static_cast<std::uint32_t>(lower[a] & 7);
    }
    name.number = edge_number(local, axis);
    return name;
}

bool EdgeStar::is_crossed(const EdgeName& name) const {
    const DualBlock* block = around_.blocks[name.block];
    return block && block->edges.has(name.number);
}

/// The crossing on the other sides of the face of a leaf larger than a cell; there is one.
EdgeName EdgeStar::crossing_on_sides(const Face& f, const Side& small) const {
    const std::int32_t size = small.size();
    const std::int32_t along = small.leaf_start(axis_), across = small.leaf_start(f.away);
    Signed at = lower_;
    at[f.away] = f.is_forward ? across + size : across;
    for (std::int32_t i = 0; i < size; ++i) {
        at[axis_] = along + i;
        const EdgeName name = name_of(at, axis_);
        if (is_crossed(name)) return name;
    }
    for (const std::int32_t end : {along, along + size}) {
        at[axis_] = end;
        for (std::int32_t i = 0; i < size; ++i) {
            at[f.away] = across + i;
            const EdgeName name = name_of(at, f.away);
            if (is_crossed(name)) return name;
        }
    }
    FREP_CHECK(false);  // keeps_topology() of dual_block.cpp gives the face two crossings
    return {};
}

}  // namespace frep::contouring
