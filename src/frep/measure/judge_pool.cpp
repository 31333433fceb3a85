// Implementation of judge_pool.h.
#include "frep/measure/judge_pool.h"

#include <algorithm>

#include "frep/base/parallel.h"

namespace frep::measuring {

namespace {

constexpr std::size_t cells_a_task = 64;

}  // namespace

std::unique_ptr<CellJudge> JudgePool::borrow() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<CellJudge>(first_.clone());
    std::unique_ptr<CellJudge> judge = std::move(free_.back());
    free_.pop_back();
    return judge;
}

void JudgePool::judge(const Job& job, std::span<const Cell> cells, std::span<const CellSource> sources,
                      std::span<CellBounds> out, const std::function<void(std::size_t, std::size_t)>& done) {
    parallel_for(job, (cells.size() + cells_a_task - 1) / cells_a_task, [&](std::size_t task) {
        const std::size_t begin = task * cells_a_task;
        const std::size_t count = std::min(cells_a_task, cells.size() - begin);
        std::unique_ptr<CellJudge> judge = borrow();
        judge->judge(cells.subspan(begin, count), sources.subspan(begin, count), out.subspan(begin, count));
        if (done) done(begin, begin + count);
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(judge));
    });
}

}  // namespace frep::measuring
