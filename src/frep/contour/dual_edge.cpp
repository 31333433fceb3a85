// Implementation of dual_edge.h.
#include "frep/contour/dual_edge.h"

#include <algorithm>

#include "frep/base/result.h"

namespace frep::contouring {

namespace {

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

/// Whether the edge passes through the triangle a b c, and at `at` within the span; turns of each two
/// corners.
bool pierces(const Corner& a, const Corner& b, const Corner& c, double ab, double bc, double ca,
             const Span& span, double& at) {
    if (!(ab > 0 && bc > 0 && ca > 0)) return false;
    at = (bc * a.h + ca * b.h + ab * c.h) / (ab + bc + ca);
    return at >= span.low + span.margin && at <= span.high - span.margin;
}

/// Whether the line from c to a passes the half plane of n inside of the triangle of n and the edge, at the
/// part ca / (cn + na) of the way from the edge to n; turns of each two corners.
bool passes(const Corner& c, const Corner& n, const Corner& a, double cn, double na, double ca,
            const Span& span) {
    constexpr double largest = 0.999;  // beyond that a, n and c are nearly on one line
    const double whole = cn + na;
    if (!(cn > 0 && na > 0 && ca > 0 && ca <= largest * whole)) return false;
    // All lengths times `whole`.
    const double h = c.h * whole + cn * (a.h - c.h);
    const double margin = span.margin * (whole - ca);
    return h >= span.low * whole + ca * (n.h - span.low) + margin &&
           h <= span.high * whole + ca * (n.h - span.high) - margin;
}

/// The polygon of four corners, with the turns of neighbours.
struct Quadrilateral {
    std::array<Corner, 4> c;
    std::array<double, 4> turns{};  ///< of corner i and the next

    explicit Quadrilateral(const std::array<Corner, 4>& corners) : c(corners) {
        for (std::size_t i = 0; i < 4; ++i) turns[i] = turn(c[i], c[(i + 1) % 4]);
    }
    /// Whether it may be cut from corner i to the second next; `at`: where the edge passes.
    bool cuts(std::size_t i, const Span& span, double& at) const {
        constexpr double nothing = 1e-12;  // the cut meets the edge itself
        double side = turn(c[(i + 2) % 4], c[i]);
        if (magnitude(side) <= nothing) {
            const Corner &a = c[i], &b = c[(i + 2) % 4];
            const double from_a = magnitude(a.u) + magnitude(a.v), from_b = magnitude(b.u) + magnitude(b.v);
            at = a.h + from_a / (from_a + from_b) * (b.h - a.h);
            return at >= span.low + span.margin && at <= span.high - span.margin;
        }
        // The edge passes through the triangle of i, j, k.
        if (side < 0) i = (i + 2) % 4;
        side = magnitude(side);
        const std::size_t j = (i + 1) % 4, k = (i + 2) % 4, l = (i + 3) % 4;
        return pierces(c[i], c[j], c[k], turns[i], turns[j], side, span, at) &&
               passes(c[k], c[l], c[i], turns[k], turns[l], side, span);
    }
};

double squared_distance(const Corner& a, const Corner& b) {
    return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v) + (a.h - b.h) * (a.h - b.h);
}

}  // namespace

bool EdgeStar::look(std::uint32_t number, double root) {
    const Lattice lower = local_of(number / 3);
    for (std::size_t a = 0; a < 3; ++a) lower_[a] = static_cast<std::int32_t>(lower[a]);
    axis_ = number % 3;
    u_ = axis_ == 2 ? 0 : axis_ + 1;
    v_ = axis_ == 0 ? 2 : axis_ - 1;
    root_ = root;
    const std::uint32_t at = DualRegion::index(lower), du = DualRegion::steps[u_], dv = DualRegion::steps[v_];
    indices_ = {at, at - du, at - du - dv, at - dv};
    is_plain_ = region_.is_plain();
    bool found = false;
    for (std::size_t q = 0; q < 4; ++q) {
        cells_[q] = region_.cell(indices_[q]);
        found = found || cells_[q];
        if (cells_[q]) continue;
        is_plain_ = false;
        if (around_.is_inner || outside_of_box(side(q).corner) == 0) return false;
    }
    return found;
}

EdgeStar::Side EdgeStar::side(std::size_t q) const {
    Side side{cells_[q], lower_, 0};
    side.corner[u_] -= positive_u[q] ? 0 : 1;
    side.corner[v_] -= positive_v[q] ? 0 : 1;
    side.edge = cell_edges_at[axis_][(positive_u[q] ? 0u : 1u << u_) | (positive_v[q] ? 0u : 1u << v_)];
    return side;
}

std::uint32_t EdgeStar::vertex(std::size_t q) const {
    if (!cells_[q]) return no_vertex;
    if (cells_[q]->level > 0 || cells_[q]->sheets == 1) return cells_[q]->vertex;
    return cells_[q]->vertex + patterns_[cells_[q]->signs].sheet_of[side(q).edge];
}

bool EdgeStar::lower_is_inside() const {
    for (std::size_t q = 0; q < 4; ++q) {
        if (cells_[q]) return (cells_[q]->signs >> edge_corners[side(q).edge][0] & 1u) != 0;
    }
    return false;  // look() found one
}

/// Equal for quadrants of one leaf, and for those that are outside of the box by the same sides.
std::uint32_t EdgeStar::key(std::size_t q) const {
    return cells_[q] ? vertex(q) : ~outside_of_box(side(q).corner);  // vertices never get that far
}

/// Bits that tell by which sides of the box a cell is outside of it; 0: it is inside.
std::uint32_t EdgeStar::outside_of_box(const Signed& corner) const {
    std::uint32_t outside = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto whole = static_cast<std::int64_t>(around_.lo[a]) + corner[a];
        const std::int64_t first = around_.cap ? 0 : 1, last = around_.cells[a] + (around_.cap ? 1 : 0);
        if (whole < first) outside += 1u << (2 * a);
        if (whole > last) outside += 2u << (2 * a);
    }
    return outside;
}

EdgeStar::Face EdgeStar::face(std::size_t q) const {
    const std::size_t next = (q + 1) % 4;
    const bool crosses_u = q % 2 == 0;
    return {crosses_u ? u_ : v_, crosses_u ? v_ : u_, q == 0 || q == 3, q < 2 ? next : q, q < 2 ? q : next};
}

/// Bit q: the arc between the quadrant q and the next is turned.
std::uint8_t EdgeStar::turned_arcs() const {
    unsigned turned = 0;
    for (std::size_t q = 0; q < 4; ++q) {
        const std::size_t above = q < 2 ? q : (q + 1) % 4;
        const bool is_turned = region_.is_turned(indices_[above], q % 2 == 0 ? u_ : v_);
        if (is_plain_) {
            turned |= static_cast<unsigned>(is_turned) << q;
        } else if (cells_[q] && cells_[(q + 1) % 4] && !is_one_leaf(q) && is_turned) {
            turned |= 1u << q;
        }
    }
    return static_cast<std::uint8_t>(turned);
}

std::uint8_t EdgeStar::state() const {
    const std::uint8_t turned = turned_arcs();
    std::array<std::size_t, 4> corners{0, 1, 2, 3};
    if (is_plain_) return turned == State::turned ? cut(turned, corners, 4) : turned | State::kept;
    std::size_t count = 0;
    bool is_open = false;
    for (std::size_t q = 0; q < 4; ++q) {
        is_open = is_open || !cells_[q];
        if (is_one_leaf(q)) continue;
        corners[count++] = q;
        is_open = is_open || !(turned >> q & 1);
    }
    if (count < 3) return State::dead;
    return is_open ? turned | State::kept : cut(turned, corners, count);
}

/// The state of an edge all of whose arcs are turned.
std::uint8_t EdgeStar::cut(std::uint8_t turned, const std::array<std::size_t, 4>& quadrants,
                           std::size_t count) const {
    std::array<Corner, 4> c{};
    Span span{-1e9, 1e9, 0.5 * around_.margin};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t q = quadrants[i];
        const Cell& cell = *cells_[q];
        c[i] = {cell.position[u_], cell.position[v_], cell.position[axis_]};
        std::int32_t start = 0;
        if (cell.level == 0) {
            c[i].u -= positive_u[q] ? 0 : 1;
            c[i].v -= positive_v[q] ? 0 : 1;
        } else {
            const Side leaf = side(q);
            start = leaf.leaf_start(axis_) - lower_[axis_];
            c[i].u += leaf.leaf_start(u_) - lower_[u_];
            c[i].v += leaf.leaf_start(v_) - lower_[v_];
            c[i].h += start;
        }
        span.low = std::max(span.low, static_cast<double>(start));
        span.high = std::min(span.high, static_cast<double>(start + (1 << cell.level)));
    }
    double at = 0, other = 0;
    if (count == 3) {
        const bool is_good =
            pierces(c[0], c[1], c[2], turn(c[0], c[1]), turn(c[1], c[2]), turn(c[2], c[0]), span, at) &&
            magnitude(at - root_) <= around_.keep_distance;
        return is_good ? turned : static_cast<std::uint8_t>(turned | State::kept);
    }
    const Quadrilateral polygon(c);
    const bool first = polygon.cuts(0, span, at);
    const bool second = polygon.cuts(1, span, other);
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
    const Cell *below = cells_[f.below], *above = cells_[f.above];
    const bool takes_above = !below || (above && above->level <= below->level);
    const Side small = side(takes_above ? f.above : f.below);
    if (small.cell->level > 0) return crossing_on_sides(f, small);
    const std::size_t number = 2 * f.normal + (takes_above ? 0 : 1);
    const std::uint8_t edge = patterns_[small.cell->signs].partner[number][small.edge];
    FREP_CHECK(edge != no_edge);
    const auto& low = corner_offsets[edge_corners[edge][0]];
    Signed at{};
    for (std::size_t a = 0; a < 3; ++a) at[a] = small.corner[a] + low[a];
    return name_of(at, edge_axes[edge]);
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
    const std::int32_t size = 1 << small.cell->level;
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
