// Implementation of dual_region.h.
#include "frep/contour/dual_region.h"

#include <bit>

namespace frep::contouring {

namespace {

/// The cells of word `w` of a set that are the last along each axis of `steps` (bits).
constexpr std::uint64_t last_cells(unsigned steps, std::size_t w) {
    std::uint64_t set = ~std::uint64_t{0};
    if (steps & 1) set &= 0x8080808080808080u;
    if (steps & 2) set &= 0xff00000000000000u;
    if ((steps & 4) && w != 7) set = 0;
    return set;
}

}  // namespace

void DualRegion::fill(const Surroundings& around) {
    slots_.fill(0);
    cells_.assign(1, {});
    indices_.assign(1, 0);
    is_plain_ = true;
    const DualBlock& own = *around.blocks[13];
    for (std::size_t i = 0; i < own.cells.size(); ++i)
        add(own, i, around.first_vertex[13], index(local_of(own.cells[i].number)));
    std::array<std::size_t, 8> ends{};
    ends[0] = cells_.size();
    for (unsigned n = 1; n < 7; ++n) {
        const std::size_t which = 13 - (n & 1) - 3 * (n >> 1 & 1) - 9 * (n >> 2);
        if (const DualBlock* block = around.blocks[which]) {
            for (std::size_t w = 0; w < block->cell_set.bits.size(); ++w) {
                const std::uint64_t all = block->cell_set.bits[w];
                for (std::uint64_t left = all & last_cells(n, w); left != 0; left &= left - 1) {
                    Lattice at = local_of(static_cast<std::uint32_t>(w * 64) +
                                          static_cast<std::uint32_t>(std::countr_zero(left)));
                    for (std::size_t a = 0; a < 3; ++a) at[a] -= (n >> a & 1) * block_side;
                    const std::uint64_t smaller = all & ((left & -left) - 1);
                    add(*block, block->cell_set.before[w] + bit_count(smaller), around.first_vertex[which],
                        index(at));
                }
            }
        }
        ends[n] = cells_.size();
    }
    // The faces around own edges: all before own cells, and across the layers.
    const double margin = 0.5 * around.margin;
    std::size_t k = 1;
    for (; k < ends[0]; ++k) find_turned(indices_[k], 7, margin);
    for (const unsigned n : {1u, 2u, 3u, 4u}) {
        for (; k < ends[n]; ++k) {
            if (n != 3) find_turned(indices_[k], 7 & ~n, margin);
        }
    }
}

void DualRegion::add(const DualBlock& block, std::size_t rank, std::uint32_t first_vertex,
                     std::uint32_t index) {
    const DualCell& from = block.cells[rank];
    const Vec3& p = block.vertices[from.vertex];
    slots_[index] = static_cast<std::uint16_t>(cells_.size());
    indices_.push_back(static_cast<std::uint16_t>(index));
    cells_.push_back({{p.x, p.y, p.z},
                      first_vertex + from.vertex,
                      from.signs,
                      from.level,
                      from.granted,
                      patterns_[from.signs].sheets});
    is_plain_ = is_plain_ && from.level == 0;
}

/// Finds which arcs are turned in the faces before a cell along some axes (bits).
void DualRegion::find_turned(std::uint32_t index, unsigned axes, double margin) {
    const Cell& above = cells_[slots_[index]];
    turned_[index] = 0;
    if (above.sheets != 1) return;
    unsigned turned = 0;
    const unsigned ambiguous = patterns_[above.signs].ambiguous_faces;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(axes >> axis & 1) || (ambiguous >> (2 * axis) & 1)) continue;
        const Cell& below = cells_[slots_[index - steps[axis]]];
        if (below.sheets == 1 && passes(below, above, index, axis, margin)) turned |= 1u << axis;
    }
    turned_[index] = static_cast<std::uint8_t>(turned);
}

/// Whether the line between the vertices passes through the inside of the face that the leaves share. The
/// blocks at the face get the same answer, since all numbers count from the smaller leaf's lower corner.
bool DualRegion::passes(const Cell& below, const Cell& above, std::uint32_t index, std::size_t axis,
                        double margin) const {
    std::array<double, 3> low{0, 0, 0}, high{1, 1, 1}, b = below.position, a = above.position;
    double to_above = a[axis], to_below = 1 - b[axis];  // from the face
    if (below.level > 0 || above.level > 0) {
        const bool takes_below = below.level <= above.level;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<std::int32_t>(index / steps[k] % side) - 1;
            const std::int32_t from_below = below.leaf_start(k == axis ? corner - 1 : corner);
            const std::int32_t from_above = above.leaf_start(corner);
            if (k == axis) {
                to_above = a[k] - (corner - from_above);
                to_below = (corner - from_below) - b[k];
            } else {
                const std::int32_t start = takes_below ? from_below : from_above;
                b[k] += from_below - start;
                a[k] += from_above - start;
                high[k] = 1 << (takes_below ? below.level : above.level);
            }
        }
    }
    // Both leaves may go on behind faces side by side (dual_vertices.h); then so does their common face.
    if (below.granted == above.granted && below.granted != no_wish)
        (below.granted % 2 == 0 ? low : high)[below.granted / 2] += below.granted % 2 == 0 ? -1 : 1;
    const double whole = to_above + to_below;
    for (const std::size_t k : {axis == 0 ? std::size_t{1} : 0, axis == 2 ? std::size_t{1} : 2}) {
        const double at = a[k] * to_below + b[k] * to_above;
        if (!(at >= (low[k] + margin) * whole && at <= (high[k] - margin) * whole)) return false;
    }
    return true;
}

}  // namespace frep::contouring
