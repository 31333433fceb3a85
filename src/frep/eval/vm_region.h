// Regions in the vm: the program of a region for a batch of elements under a lane mask. A loop goes on while
// some lane is in it; lanes with an undefined condition or too many steps drop out and end undefined.
// Semantics: field/region.h. Tested by tests/unit/eval/region_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "frep/eval/vm.h"

namespace frep {

/// Bytes for the cells of one region in one engine; wide regions run in narrow batches, at least one element.
inline constexpr std::size_t region_memory = std::size_t{64} << 20;

template <class T>
class RegionMachine {
  public:
    using Mask = math::mask_t<T>;

    RegionMachine(const RegionCall& call, std::int64_t max_steps);

    /// Runs the region on rows of `count` elements: guard and start values in, cells out.
    void run(std::span<const Row<T>> arguments, std::span<T* const> outputs, std::size_t count);

  private:
    struct Range {
        std::size_t first = 0, count = 0;
    };

    void start(std::span<const Row<T>> arguments, std::size_t offset, std::size_t count);
    void execute(std::span<const std::uint32_t> statements, std::size_t level);
    void assign(const RegionStatement& statement, std::uint32_t number, Range range, const Mask* active);
    void store(const RegionStatement& statement, std::uint32_t number, Range range, const Mask* active);
    void branch(const RegionStatement& statement, std::uint32_t number, std::size_t level);
    void loop(const RegionStatement& statement, std::uint32_t number, std::size_t level);
    void search(const RegionStatement& statement, std::uint32_t number, std::size_t level);
    bool search_lane(const RegionStatement& statement, std::uint32_t number, std::size_t at, int lane);
    Frame<T> run_tape(std::uint32_t number, Range range);
    void decide(std::uint32_t number, Range range, Mask* holds, Mask* fails);
    void count_steps(Range range, Mask* active);
    Range active_range(const Mask* mask) const;
    void drop_dead(Mask* mask);
    Mask* masks(std::size_t level);
    Mask* spare_masks(std::size_t level);

    const RegionCall* call_;
    const Region* region_;
    std::int64_t max_steps_;
    std::size_t width_;
    std::size_t count_ = 0;                     ///< elements of the present batch
    std::vector<Interpreter<T>> interpreters_;  ///< by statement
    std::vector<T> cells_, registers_, pending_;
    std::vector<Mask> alive_;
    std::vector<math::Lanes> steps_;
    std::vector<int> searched_;                 ///< by lane: boxes and points that searches looked at
    std::unique_ptr<IntervalRegion> searcher_;  ///< made for the first search
    std::vector<std::vector<Mask>> rows_;       ///< two a level: active lanes; lanes that wait for `else`
};

}  // namespace frep
