// Implementation of collide.h: rounds over the undecided cells, most promising ones first.
#include "frep/measure/collide.h"

#include <algorithm>
#include <vector>

#include "frep/field/copy.h"
#include "frep/measure/judge_pool.h"

namespace frep {

namespace {

using measuring::Cell;
using measuring::CellBounds;
using measuring::CellJudge;
using measuring::CellSign;
using measuring::CellSource;
using measuring::JudgePool;
using measuring::MeasuredBox;

/// Rounds that look for a deeper point once one was found.
constexpr int rounds_deeper = 6;
/// Cells that such a round divides.
constexpr std::size_t cells_deeper = 64;

/// An undecided cell and F in its middle.
struct OpenCell {
    Cell cell;
    CellSource source;  ///< for its parts
    double value = 0;
};

class Search {
  public:
    Search(CellJudge judge, std::unique_ptr<Evaluator> values, const CollideOptions& options,
           const MeasuredBox& box, const Job& job)
        : judges_(std::move(judge)),
          values_(std::move(values)),
          options_(options),
          box_(box.cell),
          axes_(box.axes),
          job_(job) {}

    CollideResult run() {
        take({box_}, {{}});
        int deeper = 0;
        while (!open_.empty() && !job_.cancelled()) {
            if (found_ && out_.depth > 0 && ++deeper > rounds_deeper) break;
            std::vector<Cell> children;
            std::vector<CellSource> sources;
            divide(found_ && out_.depth > 0 ? cells_deeper : open_.size(), children, sources);
            if (children.empty()) break;
            take(children, sources);
            if (open_.size() > options_.max_cells) break;
        }
        return result();
    }

  private:
    double longest_side(const Cell& cell) const {
        double longest = 0;
        for (const std::size_t axis : axes_) longest = std::max(longest, cell.high[axis] - cell.low[axis]);
        return longest;
    }

    /// Takes out at most `count` cells, those with the highest values first, and divides their longest sides.
    void divide(std::size_t count, std::vector<Cell>& children, std::vector<CellSource>& sources) {
        std::stable_sort(open_.begin(), open_.end(),
                         [](const OpenCell& a, const OpenCell& b) { return a.value > b.value; });
        std::vector<OpenCell> kept;
        for (const OpenCell& one : open_) {
            const double longest = longest_side(one.cell);
            bool is_divided = false;
            if (longest > options_.tolerance && count > 0) {
                for (const std::size_t axis : axes_) {
                    const double middle = one.cell.middle(axis);
                    if (one.cell.high[axis] - one.cell.low[axis] < longest) continue;
                    if (!(one.cell.low[axis] < middle && middle < one.cell.high[axis])) break;
                    children.push_back(one.cell);
                    children.back().high[axis] = middle;
                    children.push_back(one.cell);
                    children.back().low[axis] = middle;
                    sources.resize(children.size(), one.source);
                    is_divided = true;
                    --count;
                    break;
                }
            }
            if (!is_divided) kept.push_back(one);
        }
        open_ = std::move(kept);
    }

    void take(const std::vector<Cell>& cells, const std::vector<CellSource>& sources) {
        std::vector<CellBounds> bounds(cells.size());
        judges_.judge(job_, cells, sources, bounds);
        out_.evaluated += cells.size();
        std::array<std::vector<double>, 3> columns;
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (bounds[i].sign == CellSign::outside) continue;
            kept.push_back(i);
            for (std::size_t axis = 0; axis < 3; ++axis) columns[axis].push_back(cells[i].middle(axis));
        }
        std::vector<double> values(kept.size());
        const double* points[] = {columns[0].data(), columns[1].data(), columns[2].data()};
        double* outputs[] = {values.data()};
        values_->values(points, kept.size(), outputs);
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const bool is_defined = values[k] == values[k];
            if (is_defined && (!found_ || values[k] > out_.depth)) {
                found_ = true;
                out_.depth = values[k];
                out_.witness = {columns[0][k], columns[1][k], columns[2][k]};
            }
            open_.push_back({cells[kept[k]], std::move(bounds[kept[k]].source),
                             is_defined ? values[k] : -math::infinity});
        }
    }

    CollideResult result() {
        out_.is_cancelled = job_.cancelled();
        if (found_ && out_.depth > 0) {
            out_.kind = Collision::collide;
            return out_;
        }
        if (open_.empty() && !out_.is_cancelled && !(found_ && out_.depth >= 0)) {
            out_.kind = Collision::apart;
            return out_;
        }
        out_.kind = Collision::touching;
        const auto best =
            std::max_element(open_.begin(), open_.end(),
                             [](const OpenCell& a, const OpenCell& b) { return a.value < b.value; });
        if (best != open_.end()) {
            out_.witness = {best->cell.middle(0), best->cell.middle(1), best->cell.middle(2)};
            out_.depth = best->value;
        }
        for (const OpenCell& one : open_) out_.cell = std::max(out_.cell, longest_side(one.cell));
        return out_;
    }

    JudgePool judges_;
    std::unique_ptr<Evaluator> values_;
    const CollideOptions& options_;
    Cell box_;
    std::vector<std::size_t> axes_;
    const Job& job_;
    std::vector<OpenCell> open_;
    bool found_ = false;  ///< depth and witness hold a defined value
    CollideResult out_;
};

}  // namespace

Result<CollideResult> collide(const Field& a, const Field& b, const CollideOptions& options, const Job& job) {
    const auto box = measuring::measured_box(options.bounds, options.axes);
    if (!box) return box.error();
    if (!(options.tolerance > 0))
        return Error{ErrorKind::invalid_argument, "the tolerance must be more than 0"};
    Graph graph;
    const NodeId first = copy_of_root(graph, *a.graph, a.value);
    const NodeId second = copy_of_root(graph, *b.graph, b.value);
    Field both;
    both.value = graph.make(Op::min, {first, second});
    both.coordinates = 3;
    if (graph.over_limit()) return Error{ErrorKind::over_limit, "the two models have too many operations"};
    both.graph = std::make_shared<const Graph>(std::move(graph));
    auto judge = CellJudge::make(both, box->axes, options.evaluator);
    if (!judge) return judge.error();
    auto values = make_evaluator(both, options.evaluator);
    if (!values) return values.error();
    return Search(std::move(*judge), std::move(*values), options, *box, job).run();
}

}  // namespace frep
