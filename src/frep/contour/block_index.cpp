// Implementation of block_index.h.
#include "frep/contour/block_index.h"

#include <bit>

namespace frep::contouring {

namespace {

std::uint64_t mixed(std::uint64_t code) {
    code *= 0x9e3779b97f4a7c15u;
    return code ^ code >> 32;
}

}  // namespace

BlockIndex::BlockIndex(const std::vector<StoredBlock>& blocks) {
    table_.assign(std::bit_ceil(2 * blocks.size() + 1), none);
    codes_.reserve(blocks.size());
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        codes_.push_back(blocks[i]->code);
        std::size_t at = mixed(codes_[i]) & (table_.size() - 1);
        while (table_[at] != none) at = (at + 1) & (table_.size() - 1);
        table_[at] = i;
    }
}

std::uint32_t BlockIndex::find(std::uint64_t code) const {
    std::size_t at = mixed(code) & (table_.size() - 1);
    while (table_[at] != none && codes_[table_[at]] != code) at = (at + 1) & (table_.size() - 1);
    return table_[at];
}

std::array<std::uint32_t, 27> BlockIndex::around(std::uint32_t i) const {
    // Coordinates are steps of 1 in every third bit of a code.
    constexpr std::uint64_t every_third = 0x1249249249249249u;
    const std::uint64_t code = codes_[i];
    std::array<std::array<std::uint64_t, 3>, 3>
        parts{};  // [axis][step]; the last bit of all: beyond the lattice
    constexpr std::uint64_t beyond = std::uint64_t{1} << 63;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint64_t mask = every_third << a, own = code & mask;
        parts[a] = {own == 0 ? beyond : (own - (std::uint64_t{1} << a)) & mask, own,
                    ((own | ~mask) + (std::uint64_t{1} << a)) & mask};
    }
    std::array<std::uint32_t, 27> found{};
    for (std::uint32_t n = 0; n < 27; ++n) {
        const std::uint64_t at = parts[0][n % 3] | parts[1][n / 3 % 3] | parts[2][n / 9];
        found[n] = n == 13 ? i : (at & beyond) != 0 ? none : find(at);
    }
    return found;
}

}  // namespace frep::contouring
