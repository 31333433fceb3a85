// Implementation of connected.h: a union of neighbors among the sorted blocks.
#include "frep/measure/connected.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

namespace frep::measuring {

namespace {

/// A block's place in one number; the blocks next to it differ by one in a digit.
constexpr std::uint64_t digit = 1u << 20;

std::uint64_t block_of(const std::array<std::uint16_t, 3>& s) {
    const auto k = [&](std::size_t axis) { return static_cast<std::uint64_t>(s[axis] / 2) + 1; };
    return (k(2) * digit + k(1)) * digit + k(0);
}

/// Sets that are joined (Tarjan 1975); the first member stands for a set.
class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t of(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<std::vector<std::array<std::uint16_t, 3>>> connected_parts(
    const std::vector<std::array<std::uint16_t, 3>>& samples) {
    std::vector<std::uint64_t> blocks;
    for (const auto& sample : samples) blocks.push_back(block_of(sample));
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    const auto number_of = [&](std::uint64_t block) {
        return static_cast<std::size_t>(std::lower_bound(blocks.begin(), blocks.end(), block) -
                                        blocks.begin());
    };
    Sets sets(blocks.size());
    // rows of blocks along x: the neighbors above are at most three in each of four rows
    constexpr std::uint64_t up[] = {digit, digit * digit - digit, digit * digit, digit * digit + digit};
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (i + 1 < blocks.size() && blocks[i + 1] == blocks[i] + 1) sets.join(i, i + 1);
        for (const std::uint64_t step : up)
            for (std::size_t n = number_of(blocks[i] + step - 1);
                 n < blocks.size() && blocks[n] <= blocks[i] + step + 1; ++n)
                sets.join(i, n);
    }
    std::vector<std::vector<std::array<std::uint16_t, 3>>> parts;
    std::vector<std::size_t> part_of(blocks.size(), blocks.size());
    for (const auto& sample : samples) {
        std::size_t& part = part_of[sets.of(number_of(block_of(sample)))];
        if (part == blocks.size()) {
            part = parts.size();
            parts.emplace_back();
        }
        parts[part].push_back(sample);
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return parts;
}

}  // namespace frep::measuring
