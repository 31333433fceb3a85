// The vertices of dual contouring: one for each sheet of each crossed cell, or of a cube of cells that became
// one leaf. It is the minimum of the quadratic error (qef.h) of the sheet's crossings, held inside the leaf
// and, where a cell has several sheets, on the sheet's side of the planes between them. So the triangles from
// the vertex to the sheet's line on the boundary of the leaf, a convex body, meet nowhere else.
// A sharp edge may reach through a face of a cell without crossing an edge of the lattice there. Then the
// vertex belongs behind that face, and may lie there if the cell behind it has no surface and no other cell
// wants it: the two cells are taken as one leaf, whose boundary holds the same line (grant_wishes).
// Leaves merge bottom-up, within a block, where the signs keep the topology and the vertex lies no farther
// than the tolerance from the tangent planes at all crossings of the fine cells.
// Tested by tests/unit/contour/adaptive_test.cpp.
#pragma once

#include <array>
#include <span>

#include "frep/contour/dual_block.h"
#include "frep/contour/dual_cell.h"
#include "frep/contour/qef.h"

namespace frep::contouring {

/// A block and the next ones: bits of the index are steps in x, y, z; null where there is none.
using NextBlocks = std::array<const DualBlock*, 8>;

class DualVertices {
  public:
    explicit DualVertices(const DualOptions& options) : options_(options) {}

    /// Numbers the sheets of the cells of `block` in cells[].vertex and returns how many there are.
    static std::uint32_t number_sheets(DualBlock& block);
    /// Fills vertices, vertex_normals and vertex_attributes of `block`, the spans as long as there are
    /// sheets, from the crossings of it and the next blocks. Where leaves merge the spans become shorter.
    /// False when a crossing is missing: the field contradicts itself.
    bool make(DualBlock& block, const NextBlocks& next);

    /// Grants the wishes of `block` where that is allowed. `around`: the block and those around
    /// it, entry (dx + 1) + 3 (dy + 1) + 9 (dz + 1), all with their vertices made; null: no surface there.
    void grant_wishes(DualBlock& block, const std::array<const DualBlock*, 27>& around,
                      const Lattice& cells) const;

  private:
    /// A crossing of a cell's edge.
    struct Crossing {
        Vec3 point;  ///< in cells from the block's first sample
        Vec3 normal;
        const double* attributes = nullptr;
        std::uint8_t edge = 0;  ///< number in the cell
    };
    /// A cube of cells in one piece.
    struct Leaf {
        QuadraticError error;
        Vec3 position;        ///< in cells from the leaf's lower corner
        bool exists = false;  ///< it is one leaf; without a surface it has no vertex
        bool is_empty = true;
    };

    bool keeps_crossings() const { return options_.attributes > 0 || options_.tolerance > 0; }
    bool sum_errors(const DualBlock& block, const NextBlocks& next);
    void add_crossing(const DualBlock& block, const Lattice& lower, std::size_t axis, double root,
                      const Vec3& normal);
    void collect(const DualBlock& block, const NextBlocks& next, const DualCell& cell);
    std::span<const Crossing> crossings_of(const DualBlock& block, const NextBlocks& next, std::size_t rank);
    void make_sheet(DualBlock& block, const NextBlocks& next, std::size_t rank, std::size_t sheet);
    Vec3 anchor(const Vec3& corner, std::span<const Crossing> members) const;
    Vec3 fitted(const DualCell& cell, std::span<const Crossing> members) const;
    void merge(DualBlock& block);
    void merge_cube(DualBlock& block, std::size_t level, const Lattice& cube);
    void number_vertices(DualBlock& block);
    void note_wish(DualBlock& block, std::size_t rank, const Vec3& corner,
                   const QuadraticError::Free& free) const;
    void append_attributes(DualBlock& block, std::span<const Crossing> members) const;

    const std::array<CellPattern, 256>& patterns_ = cell_patterns();
    DualOptions options_;
    std::array<std::uint16_t, 512> rank_of_{};  ///< of the crossed cells, by number
    std::vector<QuadraticError> errors_;        ///< by vertex
    std::vector<std::uint16_t> seen_;           ///< by rank of the cell: bits, edges with a crossing
    std::vector<Crossing> crossings_;           ///< cell after cell if they are kept, else of one cell
    std::vector<std::uint32_t> first_of_;       ///< if they are kept: by rank of the cell, and an end
    std::vector<Crossing> members_;
    std::array<std::vector<Leaf>, 4> leaves_;
};

}  // namespace frep::contouring
