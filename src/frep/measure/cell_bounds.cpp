// Implementation of cell_bounds.h.
#include "frep/measure/cell_bounds.h"

#include <algorithm>
#include <utility>

#include "frep/field/derivative.h"

namespace frep::measuring {

namespace {

using math::Interval;

/// Larger values and slopes give no planes.
constexpr double largest = 1e150;

bool is_usable(const Interval& v) {
    return !v.is_empty() && !v.maybe_undefined && v.lo > -largest && v.hi < largest;
}

/// The derivatives of F by the measured axes, each as a field; nothing where one cannot be had.
std::vector<Field> slope_fields(const Field& field, const std::vector<std::size_t>& axes) {
    std::vector<bool> all(field.graph->size(), true);
    std::vector<NodeId> renamed(field.graph->size());
    Graph graph = field.graph->copy_of(all, renamed);
    std::vector<Expression> variables;
    for (const std::size_t axis : axes)
        variables.emplace_back(graph, graph.coordinate(static_cast<int>(axis)));
    const auto slopes = derivatives(Expression(graph, renamed[field.value]), variables);
    if (!slopes || graph.over_limit()) return {};
    std::vector<Field> out;
    for (const Expression& slope : *slopes) {
        NodeId root = slope.id();
        Field one = field;
        one.graph = std::make_shared<const Graph>(compact(graph, {&root, 1}));
        one.value = root;
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace

Result<CellJudge> CellJudge::make(const Field& field, std::vector<std::size_t> axes,
                                  const EvaluatorOptions& options) {
    CellJudge judge;
    auto value = make_evaluator(field, options);
    if (!value) return value.error();
    judge.value_ = std::move(*value);
    for (const Field& slope : slope_fields(field, axes)) {
        auto evaluator = make_evaluator(slope, options);
        if (!evaluator) return evaluator.error();
        judge.slopes_.push_back(std::move(*evaluator));
    }
    judge.axes_ = std::move(axes);
    return judge;
}

CellJudge CellJudge::clone() const {
    CellJudge copy;
    copy.axes_ = axes_;
    copy.value_ = value_->clone();
    for (const auto& slope : slopes_) copy.slopes_.push_back(slope->clone());
    return copy;
}

std::vector<Interval> CellJudge::ranges(Evaluator& evaluator, const Columns& boxes) {
    std::array<const Interval*, 3> columns{};
    for (std::size_t axis = 0; axis < 3; ++axis) columns[axis] = boxes[axis].data();
    std::vector<Interval> out(boxes[0].size());
    evaluator.intervals(columns, out.size(), out.data());
    return out;
}

void CellJudge::judge(std::span<const Cell> cells, std::span<CellBounds> out) {
    Columns boxes;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const Cell& cell : cells) boxes[axis].emplace_back(cell.low[axis], cell.high[axis]);
    const std::vector<Interval> found = ranges(*value_, boxes);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        out[i] = {};
        const Interval& f = found[i];
        if (f.is_empty() || f.hi < 0) {
            out[i].sign = CellSign::outside;
        } else if (f.surely_not_negative()) {
            out[i].sign = CellSign::inside;
        } else {
            out[i].maybe_undefined = f.maybe_undefined;
            if (is_usable(f)) open.push_back(i);
        }
    }
    if (has_derivatives() && !open.empty()) add_planes(cells, open, out);
}

void CellJudge::add_planes(std::span<const Cell> cells, std::span<const std::size_t> open,
                           std::span<CellBounds> out) {
    // The box of the k-th derivative: the cell along the axes up to the k-th, its middle along the others.
    Columns boxes;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const std::size_t i : open) boxes[axis].emplace_back(cells[i].middle(axis));
    const std::vector<Interval> middles = ranges(*value_, boxes);
    std::vector<std::vector<Interval>> slopes;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        const std::size_t axis = axes_[k];
        for (std::size_t n = 0; n < open.size(); ++n)
            boxes[axis][n] = {cells[open[n]].low[axis], cells[open[n]].high[axis]};
        slopes.push_back(ranges(*slopes_[k], boxes));
    }
    for (std::size_t n = 0; n < open.size(); ++n) {
        bool usable = is_usable(middles[n]);
        for (const auto& column : slopes) usable = usable && is_usable(column[n]);
        if (!usable) continue;
        const Cell& cell = cells[open[n]];
        CellBounds& bounds = out[open[n]];
        std::array<std::array<Interval, 3>, 3> rise{};  // of the plane, from the middle to low, middle, high
        std::array<std::array<double, 3>, 3> error{};   // at most, on the way
        for (std::size_t k = 0; k < axes_.size(); ++k) {
            const Interval slope = slopes[k][n], c = cell.middle(axes_[k]);
            const double plane = slope.lo + 0.5 * (slope.hi - slope.lo);
            const Interval spread = math::abs(slope - Interval(plane));
            for (const std::size_t place : {std::size_t{0}, std::size_t{2}}) {
                const Interval way = Interval(place == 0 ? cell.low[axes_[k]] : cell.high[axes_[k]]) - c;
                rise[k][place] = Interval(plane) * way;
                error[k][place] = (spread * math::abs(way)).hi;
                bounds.gap[k] = std::max(bounds.gap[k], error[k][place]);
            }
        }
        bool all_inside = true, all_outside = true;
        bounds.has_planes = true;
        const std::size_t points = axes_.size() == 2 ? 9 : 27;
        for (std::size_t point = 0; point < points; ++point) {
            Interval change = 0, gap = 0;
            for (std::size_t k = 0, digits = point; k < axes_.size(); ++k, digits /= 3) {
                change += rise[k][digits % 3];
                gap += Interval(error[k][digits % 3]);
            }
            const double low = (middles[n] + change - Interval(gap.hi)).lo;
            const double high = (middles[n] + change + Interval(gap.hi)).hi;
            bounds.lower[point] = low;
            bounds.upper[point] = high;
            all_inside = all_inside && low >= 0;
            all_outside = all_outside && high < 0;
            bounds.has_planes = bounds.has_planes && is_usable({low, high});
        }
        if (!bounds.has_planes) continue;
        if (all_inside) bounds.sign = CellSign::inside;
        if (all_outside) bounds.sign = CellSign::outside;
    }
}

}  // namespace frep::measuring
