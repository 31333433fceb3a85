// DualRegion: the cells that the surface crosses in a block and in the layer of cells before it along each
// axis, which are all around the edges that the block owns, with their vertices; and for each face between
// two of them whether the arc in it is turned (dual_mesh.h). Tested by tests/unit/contour/adaptive_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/contour/dual_block.h"
#include "frep/contour/dual_cell.h"

namespace frep::contouring {

/// A block with its neighbours and the numbers of their first leaf vertices in the mesh.
struct Surroundings {
    std::array<const DualBlock*, 27> blocks{};  ///< entry (dx + 1) + 3 (dy + 1) + 9 (dz + 1); null: none
    std::array<std::uint32_t, 27> ranks{};      ///< position in the list of blocks
    std::array<std::uint32_t, 27> first_vertex{};
    Lattice lo{};     ///< first sample of the block in the middle, with layer
    Lattice cells{};  ///< of the grid
    bool cap = false;
    bool is_inner = false;  ///< all cells at edges of the block lie in the box
    double margin = 0;
    double keep_distance = 0;  ///< crossings farther than that from the cut polygon stay vertices, in cells
};

/// Lattice coordinates from the first sample of the block in the middle.
using Signed = std::array<std::int32_t, 3>;

class DualRegion {
  public:
    /// A cell and its leaf.
    struct Cell {
        std::array<double, 3> position{};  ///< of the leaf's first vertex, from the leaf's lower corner
        std::uint32_t vertex = 0;          ///< its number in the mesh
        std::uint8_t signs = 0, level = 0, granted = no_wish, sheets = 0;

        /// The leaf's lower corner along an axis; `corner` is that of the cell.
        std::int32_t leaf_start(std::int32_t corner) const { return corner >> level << level; }
    };

    /// Fills it for the block in the middle.
    void fill(const Surroundings& around);

    /// The number of the cell with its lower corner at `corner`, -1 to 7; those of the next cells are larger
    /// by the steps.
    static constexpr std::uint32_t side = block_side + 1;
    static constexpr std::array<std::uint32_t, 3> steps{1, side, side* side};
    static constexpr std::uint32_t index(const Lattice& own) {
        return (own[0] + 1) * steps[0] + (own[1] + 1) * steps[1] + (own[2] + 1) * steps[2];
    }
    /// Null where no crossed cell is.
    const Cell* cell(std::uint32_t index) const {
        return slots_[index] == 0 ? nullptr : &cells_[slots_[index]];
    }
    /// Whether the arc in the face before this cell along the axis is turned; both cells are there.
    bool is_turned(std::uint32_t index, std::size_t axis) const { return (turned_[index] >> axis & 1) != 0; }
    /// No leaf is larger than a cell.
    bool is_plain() const { return is_plain_; }

  private:
    void add(const DualBlock& block, std::size_t rank, std::uint32_t first_vertex, std::uint32_t index);
    void find_turned(std::uint32_t index, unsigned axes, double margin);
    bool passes(const Cell& below, const Cell& above, std::uint32_t index, std::size_t axis,
                double margin) const;

    const std::array<CellPattern, 256>& patterns_ = cell_patterns();
    std::array<std::uint16_t, side * side * side> slots_{};
    std::array<std::uint8_t, side * side * side> turned_{};
    std::vector<Cell> cells_;
    std::vector<std::uint16_t> indices_;  ///< of the cells
    bool is_plain_ = true;
};

}  // namespace frep::contouring
