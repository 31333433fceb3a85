// BlockIndex: which block has a code, and which lie around one. Tested by
// tests/unit/contour/block_arena_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/contour/dual_block.h"

namespace frep::contouring {

/// Blocks by their codes.
class BlockIndex {
  public:
    /// `blocks` must stay alive and keep their order, that of their codes.
    explicit BlockIndex(const std::vector<StoredBlock>& blocks);

    static constexpr std::uint32_t none = 0xffffffffu;
    /// The position of the block with this code; none.
    std::uint32_t find(std::uint64_t code) const;
    /// The blocks around block i, and itself: entry (dx + 1) + 3 (dy + 1) + 9 (dz + 1).
    std::array<std::uint32_t, 27> around(std::uint32_t i) const;

  private:
    std::vector<std::uint64_t> codes_;
    std::vector<std::uint32_t> table_;  ///< open addressing
};

}  // namespace frep::contouring
