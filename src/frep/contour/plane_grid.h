// The sample lattice of a plane section and its blocks: the two-dimensional sibling of grid.h. Cells are
// squares; around the lattice lies one further layer of samples that are outside by decree, for the cap.
// Indices "with layer" count it: sample e = i + 1. Blocks hold plane_block_side^2 samples (with layer).
// Tested through tests/unit/contour/contour_2d_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "frep/base/result.h"
#include "frep/contour/grid.h"
#include "frep/eval/plane.h"
#include "frep/math/vec.h"

namespace frep {

namespace contouring {

inline constexpr std::uint32_t plane_block_side = 16;

/// Square cells over a rectangle of a plane.
struct PlaneGrid {
    Plane plane;
    Vec2 origin;
    double cell = 1;                       ///< side of a cell, model units
    std::array<std::uint32_t, 2> cells{};  ///< number of cells along right and up, at least 1

    double coordinate(std::size_t axis, std::uint32_t i) const {
        return (axis == 0 ? origin.x : origin.y) + static_cast<double>(i) * cell;
    }
    Vec2 point(std::uint32_t i, std::uint32_t j) const { return {coordinate(0, i), coordinate(1, j)}; }
    /// The point of space at a point of the plane.
    Vec3 in_space(Vec2 p) const {
        std::array<double, 3> axes{plane.at, plane.at, plane.at};
        axes[static_cast<std::size_t>(plane.right)] = p.x;
        axes[static_cast<std::size_t>(plane.up)] = p.y;
        return {axes[0], axes[1], axes[2]};
    }
    /// The number of a sample with layer, row after row.
    std::uint64_t number(std::uint32_t e, std::uint32_t f) const {
        return std::uint64_t{f} * (std::uint64_t{cells[0]} + 3) + e;
    }
    /// The place of the sample with this number.
    Vec2 place(std::uint64_t number) const {
        const std::uint64_t row = std::uint64_t{cells[0]} + 3;
        return point(static_cast<std::uint32_t>(number % row) - 1,
                     static_cast<std::uint32_t>(number / row) - 1);
    }
};

/// The grid over the sides of `bounds` that the plane shows; see make_grid(). Errors: as make_grid().
Result<PlaneGrid> make_plane_grid(const Box3& bounds, const Plane& plane, int count, double cell_length);

/// Undefined samples seen: how many, and the number of the first.
struct PlaneTally {
    std::uint64_t count = 0;
    std::uint64_t first = ~std::uint64_t{0};

    void add(std::uint64_t samples, std::uint64_t number) {
        count += samples;
        first = number < first ? number : first;
    }
    void add(const PlaneTally& other) {
        if (other.count > 0) add(other.count, other.first);
    }
};

}  // namespace contouring
}  // namespace frep
