// The blocks that the surface may cross, found by subdividing the lattice like an octree with the interval
// evaluator (after Duff 1992, "Interval arithmetic and recursive subdivision for implicit functions"): a part
// where F is surely of one sign is not looked at again, so that the cost follows the surface.
// Tested by tests/unit/contour/contour_test.cpp (same bytes with and without pruning).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/base/job.h"
#include "frep/contour/grid.h"
#include "frep/eval/field_pool.h"

namespace frep::contouring {

/// Places seen (undefined samples, tight cells): how many, and the key of the first: block code, then
/// position in the block.
struct PlaceTally {
    std::uint64_t count = 0;
    std::uint64_t block = ~std::uint64_t{0};
    std::uint32_t local = ~std::uint32_t{0};

    void add(std::uint64_t samples, std::uint64_t at_block, std::uint32_t at_local);
    void add(const PlaceTally& other);
};

struct OctreeOptions {
    bool cap = false;
    bool prune = true;                        ///< false: every block of the lattice
    std::size_t max_nodes = ~std::size_t{0};  ///< undecided parts held at a time
};

struct OctreeResult {
    std::vector<std::uint64_t> blocks;  ///< codes, ascending
    PlaceTally undefined;               ///< samples of parts that are undefined as a whole
    std::array<bool, 6> touches{};      ///< sides -x +x -y +y -z +z reached by parts inside
};

/// The undecided blocks. Errors: over_limit when there are more than max_nodes, cancelled.
Result<OctreeResult> find_blocks(const Grid& grid, FieldPool& fields, const OctreeOptions& options,
                                 const Job& job);

}  // namespace frep::contouring
