// The vertices of dual contouring: one for each sheet of each crossed cell, or of a cube of cells that became
// one leaf. It is the minimum of the quadratic error (qef.h) of the sheet's crossings, held inside the leaf
// and, where a cell has several sheets, on the sheet's side of the planes between them. So the triangles from
// the vertex to the sheet's line on the boundary of the leaf, a convex body, meet nowhere else.
// Leaves merge bottom-up, within a block, where the signs keep the topology and the vertex lies no farther
// than the tolerance from the tangent planes at all crossings of the fine cells.
// Tested by tests/unit/contour/adaptive_test.cpp.
#pragma once

#include <array>
#include <span>

#include "frep/contour/dual_block.h"
#include "frep/contour/qef.h"

namespace frep::contouring {

/// A block and the next ones: bits of the index are steps in x, y, z; null where there is none.
using NextBlocks = std::array<const DualBlock*, 8>;

class DualVertices {
  public:
    explicit DualVertices(const DualOptions& options) : options_(options) {}

    /// Fills cells[].vertex, cells[].level, vertices and vertex_attributes of `block` from the crossings of
    /// it and the next blocks. False when a crossing is missing: the field contradicts itself.
    bool make(DualBlock& block, const NextBlocks& next);

  private:
    /// A crossing of a cell's edge.
    struct Crossing {
        Vec3 point;  ///< in cells from the block's first sample
        Vec3 normal;
        const double* attributes = nullptr;
    };
    /// A cube of cells in one piece.
    struct Leaf {
        QuadraticError error;
        Vec3 position;
        bool exists = false;  ///< it is one leaf; without a surface it has no vertex
        bool is_empty = true;
    };

    bool collect(const DualBlock& block, const NextBlocks& next);
    void make_sheet(DualBlock& block, const DualCell& cell, std::size_t sheet, std::span<const Crossing> all);
    void merge(DualBlock& block);
    void merge_cube(const DualBlock& block, std::size_t level, const Lattice& cube);
    void number_vertices(DualBlock& block);
    void append_attributes(DualBlock& block, std::span<const Crossing> all,
                           std::span<const std::size_t> members);

    DualOptions options_;
    std::vector<Crossing> crossings_;      ///< cell after cell
    std::vector<std::uint32_t> first_of_;  ///< by rank of the cell, and an end
    std::vector<std::uint8_t> edge_of_;    ///< number of the crossing's edge in its cell
    std::array<std::vector<Leaf>, 4> leaves_;
};

}  // namespace frep::contouring
