// Implementation of cell_bounds.h.
#include "frep/measure/cell_bounds.h"

#include <algorithm>
#include <utility>

#include "frep/measure/quadratic.h"

namespace frep::measuring {

namespace {

using math::Interval;

/// Tapes of no more clauses are not pruned: their jets are found as soon.
constexpr std::size_t short_tape = 6;

/// The parts of a cell take their bounds from the cell's where the rest is this share of the gap at most.
bool serves_parts(const QuadraticGap& gap) { return gap.rest <= 0.2 * (gap.rest + gap.bend); }

CellSign sign_of(const Interval& f) {
    if (f.is_empty() || f.hi < 0) return CellSign::outside;
    return f.surely_not_negative() ? CellSign::inside : CellSign::open;
}

}  // namespace

Result<CellJudge> CellJudge::make(const Field& field, std::vector<std::size_t> axes,
                                  const EvaluatorOptions& options) {
    CellJudge judge;
    judge.axes_ = std::move(axes);
    if (auto tape = make_clause_tape(field)) {
        judge.tape_ = std::make_shared<const ClauseTape>(std::move(*tape));
        return judge;
    }
    auto value = make_evaluator(field, options);
    if (!value) return value.error();
    judge.value_ = std::move(*value);
    return judge;
}

CellJudge CellJudge::clone() const {
    CellJudge copy;
    copy.axes_ = axes_;
    copy.tape_ = tape_;
    if (value_) copy.value_ = value_->clone();
    return copy;
}

void CellJudge::judge(std::span<const Cell> cells, std::span<const CellSource> sources,
                      std::span<CellBounds> out) {
    if (!tape_) return judge_by_ranges(cells, out);
    for (std::size_t first = 0, last = 0; first < cells.size(); first = last) {
        last = first + 1;
        if (sources[first].quadratic) {
            out[first] = {};
            out[first].source = sources[first];
            const Quadratic& q = *sources[first].quadratic;
            set_quadratic_bounds(q, cells[first], axes_, out[first]);
            if (!serves_parts(gap_of(q, cells[first], axes_))) out[first].source.quadratic = nullptr;
            continue;
        }
        while (last < cells.size() && last - first < tile_lanes && !sources[last].quadratic &&
               sources[last].tape == sources[first].tape)
            ++last;
        judge_by_tape(cells.subspan(first, last - first), sources[first].tape ? sources[first].tape : tape_,
                      out.subspan(first, last - first));
    }
}

void CellJudge::judge_by_ranges(std::span<const Cell> cells, std::span<CellBounds> out) {
    std::array<std::vector<Interval>, 3> boxes;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const Cell& cell : cells) boxes[axis].emplace_back(cell.low[axis], cell.high[axis]);
    const Interval* columns[] = {boxes[0].data(), boxes[1].data(), boxes[2].data()};
    std::vector<Interval> found(cells.size());
    value_->intervals(columns, found.size(), found.data());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        out[i] = {};
        out[i].sign = sign_of(found[i]);
        out[i].maybe_undefined = found[i].maybe_undefined;
    }
}

void CellJudge::judge_by_tape(std::span<const Cell> cells, std::shared_ptr<const ClauseTape> tape,
                              std::span<CellBounds> out) {
    for (CellBounds& one : out) {
        one = {};
        one.source.tape = tape;
    }
    if (tape->clauses.size() > short_tape) {
        BoxLanes boxes;
        boxes.count = static_cast<int>(cells.size());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < cells.size(); ++i) {
                boxes.lo[axis][i] = cells[i].low[axis];
                boxes.hi[axis][i] = cells[i].high[axis];
            }
        }
        pruner_.cut(*tape, boxes, Purpose::occupancy, cut_);
        std::array<std::shared_ptr<const ClauseTape>, tile_lanes> made;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const unsigned lane = 1u << i;
            if ((cut_.ranges.can_be_inside & lane) == 0) out[i].sign = CellSign::outside;
            if ((cut_.ranges.can_be_outside & lane) == 0) out[i].sign = CellSign::inside;
            const int number = cut_.tape_of[i];
            if (number < 0) continue;
            auto& cut = made[static_cast<std::size_t>(number)];
            if (!cut) cut = std::make_shared<const ClauseTape>(cut_.tapes[static_cast<std::size_t>(number)]);
            out[i].source.tape = cut;
        }
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (out[i].sign == CellSign::open) add_bounds(cells[i], out[i]);
}

void CellJudge::add_bounds(const Cell& cell, CellBounds& out) {
    std::array<Interval, 3> box, point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis] = {cell.low[axis], cell.high[axis]};
        point[axis] = cell.middle(axis);
    }
    const ClauseTape& tape = *out.source.tape;
    const Jet whole = jets_.run(tape, box, axes_, true);
    out.sign = sign_of(whole.value);
    out.maybe_undefined = out.sign == CellSign::open && whole.value.maybe_undefined;
    if (out.sign != CellSign::open || out.maybe_undefined) return;
    const double mean_value = mean_value_gap(cell, axes_, whole);
    const Jet middle = jets_.run(tape, point, axes_, false);
    const std::optional<Quadratic> q = quadratic_of(cell, axes_, whole, middle);
    const QuadraticGap gap = q ? gap_of(*q, cell, axes_) : QuadraticGap{math::infinity, 0};
    if (gap.rest + gap.bend <= mean_value && q) {
        set_quadratic_bounds(*q, cell, axes_, out);
        if (serves_parts(gap)) out.source.quadratic = std::make_shared<const Quadratic>(*q);
    } else if (mean_value < math::infinity) {
        set_mean_value_bounds(cell, axes_, whole, middle, out);
    }
}

}  // namespace frep::measuring
