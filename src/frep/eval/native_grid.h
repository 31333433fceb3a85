// Native code for samples of a grid: what depends on some axes only is computed once for these and kept in
// tables; the innermost loop goes along x and reads them. Method: the values are divided by the set of axes
// that they depend on, a function for each set (loops hoisted by axis); the grid is cut into parts whose
// tables fit the cache. Private to the native engine. Tested by tests/unit/eval/native_grid_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "frep/eval/native_code.h"
#include "frep/eval/native_memory.h"
#include "frep/eval/native_translate.h"
#include "frep/eval/native_writer.h"

namespace frep::native {

/// Helpers for the calls of a translation, which must stay where they are.
template <class Real>
Helpers helpers_for(const std::vector<CallContext>& calls);

extern template Helpers helpers_for<double>(const std::vector<CallContext>&);
extern template Helpers helpers_for<float>(const std::vector<CallContext>&);

/// Sets of axes are bits: x 1, y 2, z 4.
inline constexpr std::size_t axis_sets = 8;

template <class Real>
class GridCode {
  public:
    /// False where the system gives no memory. The tape has at most three coordinates.
    bool build(const ClauseTape& tape, Isa isa, std::span<const math::Interval> domain);
    /// All coordinates must lie in the domain.
    void run(const NativeGrid<Real>& grid) const;

  private:
    struct Part;

    std::vector<std::uint8_t> sets_of(const StepList& list, const std::vector<ValueId>& coordinates) const;
    void choose_tables(const Translation& made, const std::vector<std::uint8_t>& sets);
    FunctionPlan plan_for(const Translation& made, std::uint32_t set) const;
    void run_part(const NativeGrid<Real>& grid, Part& part) const;
    void fill_tables(Part& part) const;
    void choose_part(Part& part) const;
    std::size_t vectors_of(const Part& part, std::size_t set) const;
    std::size_t table_vectors(const Part& part) const;
    void place_part(Part& part, const NativeGrid<Real>& grid, Real* next) const;
    void point_at(Part& part, std::size_t set, std::size_t y, std::size_t z) const;
    void call(std::size_t set, Part& part, std::size_t vectors) const;

    std::size_t lanes_ = 0;
    unsigned lane_bits_ = 0;
    std::vector<CallContext> calls_;
    CodeMemory memory_;
    std::size_t workspace_ = 0;
    std::array<NativeFunction, axis_sets> functions_{};
    std::array<std::vector<ValueId>, axis_sets> tables_;  ///< the values kept, by set
};

extern template class GridCode<double>;
extern template class GridCode<float>;

}  // namespace frep::native
