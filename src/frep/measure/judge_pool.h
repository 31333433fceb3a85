// Judges of cells for worker threads: results do not depend on which one is borrowed. Tested through
// tests/unit/measure/shape_measure_test.cpp and collide_test.cpp.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "frep/base/job.h"
#include "frep/measure/cell_bounds.h"

namespace frep::measuring {

class JudgePool {
  public:
    explicit JudgePool(CellJudge first) : first_(std::move(first)) {}

    /// CellJudge::judge() in parallel, then done(begin, end) for each run of cells that were judged, on the
    /// worker's thread. A cancelled job leaves cells open, with nothing known of them.
    void judge(const Job& job, std::span<const Cell> cells, std::span<const CellSource> sources,
               std::span<CellBounds> out, const std::function<void(std::size_t, std::size_t)>& done = {});

  private:
    std::unique_ptr<CellJudge> borrow();

    CellJudge first_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<CellJudge>> free_;
};

}  // namespace frep::measuring
