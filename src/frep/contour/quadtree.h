// The blocks of a plane that the outline may cross: octree.h in two dimensions.
// Tested by tests/unit/contour/contour_2d_test.cpp (the same outlines with and without pruning).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/base/job.h"
#include "frep/contour/plane_grid.h"
#include "frep/eval/field_pool.h"

namespace frep::contouring {

/// Block coordinates along right and up.
using PlaneBlock = std::array<std::uint32_t, 2>;

struct QuadtreeOptions {
    bool cap = false;
    bool prune = true;                        ///< false: every block of the lattice
    std::size_t max_nodes = ~std::size_t{0};  ///< undecided parts held at a time
};

struct QuadtreeResult {
    std::vector<PlaneBlock> blocks;  ///< in the order of a quadtree's leaves
    PlaneTally undefined;            ///< samples of parts that are undefined as a whole
    std::array<bool, 4> touches{};   ///< sides left, right, bottom, top reached by parts inside
};

/// The undecided blocks. Errors: over_limit when there are more than max_nodes, cancelled.
Result<QuadtreeResult> find_plane_blocks(const PlaneGrid& grid, FieldPool& fields,
                                         const QuadtreeOptions& options, const Job& job);

}  // namespace frep::contouring
