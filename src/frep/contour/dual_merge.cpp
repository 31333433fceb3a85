// Of DualVertices: leaves that merge, and the vertices that are left. See dual_vertices.h.
#include "frep/contour/dual_vertices.h"

namespace frep::contouring {

namespace {

double magnitude(double v) { return v < 0 ? -v : v; }

Vec3 unit(const Vec3& v) {
    const double l = length(v);
    return l > 0 ? v / l : Vec3{0, 0, 0};
}

}  // namespace

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
        const double low = options_.margin, high = static_cast<double>(side) - low;
        const Vec3 corner{static_cast<double>(lower[0]), static_cast<double>(lower[1]),
                          static_cast<double>(lower[2])};
        const Vec3 vertex =
            merged.error.minimum({corner + Vec3{low, low, low}, corner + Vec3{high, high, high}});
        merged.position = vertex - corner;
        for (std::size_t i = 0; i < block.cells.size(); ++i) {
            const Lattice at = local_of(block.cells[i].number);
            if (at[0] / side != cube[0] || at[1] / side != cube[1] || at[2] / side != cube[2]) continue;
            for (std::uint32_t k = first_of_[i]; k < first_of_[i + 1]; ++k) {
                const Crossing& c = crossings_[k];
                // Where the normal is unknown nothing may merge.
                if (c.normal == Vec3{0, 0, 0}) return;
                if (!(magnitude(dot(c.normal, vertex - c.point)) <= options_.tolerance)) return;
            }
        }
    }
    target = merged;
    if (!merged.is_empty)
        block.merged[level - 1] |= std::uint64_t{1} << ((cube[2] * count + cube[1]) * count + cube[0]);
}

/// The vertices of the leaves that are left, in the order of their first cells, move to the front.
void DualVertices::number_vertices(DualBlock& block) {
    std::array<std::vector<std::uint32_t>, 4> vertex_of;
    for (std::size_t level = 1; level < 4; ++level) vertex_of[level].assign(leaves_[level].size(), ~0u);
    const std::size_t wanted = options_.attributes;
    std::uint32_t count = 0;
    for (DualCell& cell : block.cells) {
        const Lattice at = local_of(cell.number);
        const std::uint32_t old = cell.vertex;
        cell.level = 0;
        std::size_t leaf = 0;
        for (std::uint8_t level = 1; level < 4; ++level) {
            const std::uint32_t side = block_side >> level;
            const std::size_t i = ((at[2] >> level) * side + (at[1] >> level)) * side + (at[0] >> level);
            if (!leaves_[level][i].exists) break;
            cell.level = level;
            leaf = i;
        }
        std::size_t sheets = patterns_[cell.signs].sheets;
        if (cell.level > 0) {
            std::uint32_t& known = vertex_of[cell.level][leaf];
            if (known != ~0u) {
                cell.vertex = known;
                continue;
            }
            known = count;
            sheets = 1;
            const Leaf& merged = leaves_[cell.level][leaf];
            block.vertices[old] = merged.position;
            block.vertex_normals[old] = unit(merged.error.normal_sum());
        }
        cell.vertex = count;
        for (std::size_t s = 0; s < sheets; ++s, ++count) {
            block.vertices[count] = block.vertices[old + s];
            block.vertex_normals[count] = block.vertex_normals[old + s];
            for (std::size_t k = 0; k < wanted; ++k)
                block.vertex_attributes[count * wanted + k] = block.vertex_attributes[(old + s) * wanted + k];
        }
    }
    block.vertices = block.vertices.first(count);
    block.vertex_normals = block.vertex_normals.first(count);
    block.vertex_attributes.resize(count * wanted);
}

}  // namespace frep::contouring
