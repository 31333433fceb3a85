// Structured execution under masks; see vm_region.h. Recursion is over the nesting of statements, which is
// at most Region::nesting_limit deep.
#include "frep/eval/vm_region.h"

#include <algorithm>

#include "frep/eval/vm_lane.h"
#include "frep/field/kernels/basic.h"

namespace frep {

template <class T>
RegionMachine<T>::RegionMachine(const RegionCall& call, std::int64_t max_steps)
    : call_(&call), region_(call.code->region), max_steps_(max_steps) {
    constexpr std::size_t most = 16;
    const std::size_t row = sizeof(T) * std::max<std::size_t>(region_->cell_count, 1);
    width_ = std::clamp<std::size_t>(region_memory / row, 1, most);
    for (const Tape& tape : call.code->tapes) interpreters_.emplace_back(tape, max_steps);
    cells_.resize(width_ * region_->cell_count);
    registers_.resize(width_ * call.code->registers);
    pending_.resize(width_ * call.code->outputs);
    alive_.resize(width_);
    steps_.resize(width_);
    searched_.resize(width_ * math::Lanes::size);
}

template <class T>
void RegionMachine<T>::run(std::span<const Row<T>> arguments, std::span<T* const> outputs,
                           std::size_t count) {
    const T undefined = math::constant<T>(math::quiet_nan);
    for (std::size_t offset = 0; offset < count; offset += width_) {
        count_ = std::min(width_, count - offset);
        start(arguments, offset, count_);
        Mask* active = masks(0);
        std::copy_n(alive_.data(), count_, active);
        execute(region_->program, 0);
        for (std::size_t k = 0; k < outputs.size(); ++k) {
            const T* cell = cells_.data() + call_->outputs[k].first * width_;
            for (std::size_t i = 0; i < count_; ++i)
                outputs[k][offset + i] = math::select(alive_[i], cell[i], undefined);
        }
    }
}

/// Lanes whose guard is true start alive, with the start values in their cells.
template <class T>
void RegionMachine<T>::start(std::span<const Row<T>> arguments, std::size_t offset, std::size_t count) {
    std::fill(cells_.begin(), cells_.end(), math::constant<T>(math::quiet_nan));
    std::fill(steps_.begin(), steps_.end(), math::Lanes(0.0));
    std::fill(searched_.begin(), searched_.end(), 0);
    for (std::size_t i = 0; i < count; ++i)
        alive_[i] = kernels::is_true(lane_values(arguments[0][offset + i]));  // false for NaN
    for (std::size_t k = 0; k < region_->inputs.size(); ++k)
        for (std::size_t i = 0; i < count; ++i)
            cells_[region_->inputs[k] * width_ + i] = arguments[k + 1][offset + i];
}

/// Rows of masks stay where they are when more levels are added.
template <class T>
auto RegionMachine<T>::masks(std::size_t level) -> Mask* {
    while (rows_.size() <= 2 * level + 1) rows_.emplace_back(width_);
    return rows_[2 * level].data();
}

template <class T>
auto RegionMachine<T>::spare_masks(std::size_t level) -> Mask* {
    masks(level);
    return rows_[2 * level + 1].data();
}

template <class T>
auto RegionMachine<T>::active_range(const Mask* mask) const -> Range {
    std::size_t first = 0, last = count_;
    while (first < last && !math::any(mask[first])) ++first;
    while (last > first && !math::any(mask[last - 1])) --last;
    return {first, last - first};
}

template <class T>
void RegionMachine<T>::execute(std::span<const std::uint32_t> statements, std::size_t level) {
    for (const std::uint32_t number : statements) {
        const Mask* active = masks(level);
        const Range range = active_range(active);
        if (range.count == 0) return;
        const RegionStatement& statement = region_->statements[number];
        switch (statement.kind) {
            case RegionStatement::Kind::assign:
                assign(statement, number, range, active);
                break;
            case RegionStatement::Kind::store:
                store(statement, number, range, active);
                break;
            case RegionStatement::Kind::branch:
                branch(statement, number, level);
                break;
            case RegionStatement::Kind::loop:
                loop(statement, number, level);
                break;
            case RegionStatement::Kind::search:
                search(statement, number, level);
                break;
        }
    }
}

template <class T>
Frame<T> RegionMachine<T>::run_tape(std::uint32_t number, Range range) {
    const Frame<T> frame{cells_.data(), registers_.data(), width_, range.first, range.count};
    interpreters_[number].run(frame, &region_->arrays);
    return frame;
}

/// All right sides stand in `pending_` before a cell is written: one may be the present content of another.
template <class T>
void RegionMachine<T>::assign(const RegionStatement& statement, std::uint32_t number, Range range,
                              const Mask* active) {
    const Frame<T> frame = run_tape(number, range);
    const std::size_t count = statement.assignments.size();
    for (std::size_t k = 0; k < count; ++k) {
        const Row<T> value = interpreters_[number].output(frame, k);
        for (std::size_t i = 0; i < range.count; ++i) pending_[k * width_ + i] = value[i];
    }
    for (std::size_t k = 0; k < count; ++k) {
        T* cell = cells_.data() + statement.assignments[k].first * width_ + range.first;
        for (std::size_t i = 0; i < range.count; ++i)
            cell[i] = math::select(active[range.first + i], pending_[k * width_ + i], cell[i]);
    }
}

template <class T>
void RegionMachine<T>::store(const RegionStatement& statement, std::uint32_t number, Range range,
                             const Mask* active) {
    const Frame<T> frame = run_tape(number, range);
    const RegionArray& array = region_->arrays[statement.array];
    const T undefined = math::constant<T>(math::quiet_nan);
    for (std::size_t i = 0; i < range.count; ++i) {
        const std::size_t at = range.first + i;
        const math::Lanes index = lane_values(interpreters_[number].output(frame, 0)[i]);
        const T value = interpreters_[number].output(frame, 1)[i];
        for (int lane = 0; lane < math::Lanes::size; ++lane) {
            if (!active[at][lane]) continue;
            const std::size_t n = item_number(index[lane], array.size);
            if (n != no_item) {
                copy_lane(cells_[(array.first_cell + n) * width_ + at], value, lane);
                continue;
            }
            for (std::size_t item = 0; item < array.size; ++item)
                copy_lane(cells_[(array.first_cell + item) * width_ + at], undefined, lane);
        }
    }
}

/// Runs the condition; on return `holds` has the lanes of `holds` where it is true, `fails` (if any) those
/// where it is false. Lanes where it is undefined are dead.
template <class T>
void RegionMachine<T>::decide(std::uint32_t number, Range range, Mask* holds, Mask* fails) {
    const Frame<T> frame = run_tape(number, range);
    const Row<T> condition = interpreters_[number].output(frame, 0);
    for (std::size_t i = 0; i < range.count; ++i) {
        const std::size_t at = range.first + i;
        const math::Lanes value = lane_values(condition[i]);
        alive_[at] = alive_[at] & !(holds[at] & math::is_nan(value));
        const Mask truth = kernels::is_true(value);
        if (fails) fails[at] = holds[at] & !truth & alive_[at];
        holds[at] = holds[at] & truth & alive_[at];
    }
}

template <class T>
void RegionMachine<T>::branch(const RegionStatement& statement, std::uint32_t number, std::size_t level) {
    Mask* active = masks(level);
    Mask* inner = masks(level + 1);
    Mask* otherwise = spare_masks(level);
    std::copy_n(active, count_, inner);
    std::fill_n(otherwise, count_, active[0] & !active[0]);
    decide(number, active_range(active), inner, otherwise);
    execute(statement.first, level + 1);
    std::copy_n(otherwise, count_, inner);
    execute(statement.second, level + 1);
    drop_dead(active);
}

template <class T>
void RegionMachine<T>::loop(const RegionStatement& statement, std::uint32_t number, std::size_t level) {
    Mask* inside = masks(level + 1);
    std::copy_n(masks(level), count_, inside);
    for (Range range = active_range(inside); range.count != 0; range = active_range(inside)) {
        decide(number, range, inside, nullptr);
        count_steps(range, inside);
        execute(statement.first, level + 1);
        drop_dead(inside);
    }
    drop_dead(masks(level));
}

/// Every lane searches for itself; then all take the values at what they found.
template <class T>
void RegionMachine<T>::search(const RegionStatement& statement, std::uint32_t number, std::size_t level) {
    if (!searcher_) searcher_ = std::make_unique<IntervalRegion>(*region_, max_steps_);
    Mask* inner = masks(level + 1);
    std::copy_n(masks(level), count_, inner);
    for (std::size_t at = 0; at < count_; ++at) {
        for (int lane = 0; lane < math::Lanes::size; ++lane)
            if (inner[at][lane] && !search_lane(statement, number, at, lane)) alive_[at].set(lane, false);
    }
    drop_dead(inner);
    execute(statement.first, level + 1);
    drop_dead(inner);
    const Range range = active_range(inner);
    if (range.count != 0) {
        const Frame<T> frame = run_tape(number, range);
        const Row<T> value = interpreters_[number].output(frame, 0);
        T* const cell = cells_.data() + statement.result * width_ + range.first;
        for (std::size_t i = 0; i < range.count; ++i)
            cell[i] = math::select(inner[range.first + i], value[i], cell[i]);
    }
    drop_dead(masks(level));
}

/// Puts the best place into the variables of one lane; false when the search was not finished.
template <class T>
bool RegionMachine<T>::search_lane(const RegionStatement& statement, std::uint32_t number, std::size_t at,
                                   int lane) {
    const auto content = [&](std::uint32_t cell) { return lane_values(cells_[cell * width_ + at])[lane]; };
    int& spent = searched_[at * math::Lanes::size + static_cast<std::size_t>(lane)];
    const BoxSearchResult found = searcher_->search_at(number, content, spent);
    for (std::size_t i = 0; i < statement.variables.size(); ++i)
        copy_lane(cells_[statement.variables[i] * width_ + at], math::constant<T>(found.place[i]), lane);
    return found.finished;
}

template <class T>
void RegionMachine<T>::drop_dead(Mask* mask) {
    for (std::size_t i = 0; i < count_; ++i) mask[i] = mask[i] & alive_[i];
}

template <class T>
void RegionMachine<T>::count_steps(Range range, Mask* active) {
    const math::Lanes most(static_cast<double>(max_steps_));
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        steps_[i] = math::select(active[i], steps_[i] + math::Lanes(1.0), steps_[i]);
        const Mask within = math::less_equal(steps_[i], most);
        alive_[i] = alive_[i] & (within | !active[i]);
        active[i] = active[i] & alive_[i];
    }
}

template class RegionMachine<math::Lanes>;
template class RegionMachine<math::Dual<math::Lanes>>;

}  // namespace frep
