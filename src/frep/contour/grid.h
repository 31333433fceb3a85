// The sample lattice of a contouring run and its blocks. Cells are cubes; samples lie at origin + i * cell
// from the integer i (docs/numerics.md, rule 9). Around the lattice lies one further layer of samples that
// are outside by decree: they close the shape at the box (cap). Indices "with layer" count it: sample e = i
// + 1. Blocks of 8^3 samples (with layer) are named by the Morton code of their block coordinates, so that
// the order of codes is the order of an octree's leaves. Tested by tests/unit/contour/grid_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "frep/base/result.h"
#include "frep/math/vec.h"

namespace frep {

/// Cubic cells over a box. Sample (i, j, k), 0 <= i <= cells[0] and so on, lies at origin + (i, j, k) * cell.
struct Grid {
    Vec3 origin;
    double cell = 1;                       ///< side of a cell, model units
    std::array<std::uint32_t, 3> cells{};  ///< number of cells along x, y, z, at least 1

    double coordinate(int axis, std::uint32_t i) const {
        const double start = axis == 0 ? origin.x : axis == 1 ? origin.y : origin.z;
        return start + static_cast<double>(i) * cell;
    }
    Vec3 point(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return {coordinate(0, i), coordinate(1, j), coordinate(2, k)};
    }
    /// The box that the cells fill.
    Box3 bounds() const { return {origin, point(cells[0], cells[1], cells[2])}; }
};

/// The largest number of cells along a side.
inline constexpr std::uint32_t max_grid_cells = 1'000'000;

/// `count` cubic cells along the longest side of `bounds` (or cells of side `cell_length` if that is > 0);
/// the other sides are widened symmetrically to whole cells. Errors: invalid_argument for a box that is
/// empty, flat in all directions or not finite, a count < 1, or cells so small that neighbouring samples
/// coincide; over_limit for more than max_grid_cells.
Result<Grid> make_grid(const Box3& bounds, int count, double cell_length = 0);

namespace contouring {

inline constexpr std::uint32_t block_side = 8;

/// The Morton code of block coordinates below 2^21, and back.
std::uint64_t morton_code(const std::array<std::uint32_t, 3>& block);
std::array<std::uint32_t, 3> morton_decode(std::uint64_t code);

}  // namespace contouring
}  // namespace frep
