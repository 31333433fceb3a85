// Implementation of shape_measure.h: rounds in which the cells that are known worst are divided.
#include "frep/measure/shape_measure.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "frep/measure/cell_sums.h"
#include "frep/measure/judge_pool.h"

namespace frep {

namespace {

using math::Interval;
using measuring::Cell;
using measuring::CellBounds;
using measuring::CellJudge;
using measuring::CellPart;
using measuring::CellSign;
using measuring::CellSource;
using measuring::JudgePool;
using measuring::MeasuredBox;
using measuring::MomentSums;

/// Sides shorter than this share of the longest one are not divided.
constexpr double short_side = 0.7;
/// Where planes are known, axes are divided that add this share of what the worst one adds to their gap.
constexpr double large_gap = 0.4;
/// The share of the missing certainty that the cells divided in a round stand for.
constexpr double share_a_round = 0.6;

/// A cell that is not settled.
struct Leaf {
    CellPart part;
    CellSource source;         ///< for its parts
    double width = 0;          ///< of the cell's contribution to the size, about
    std::uint8_t divided = 0;  ///< bit k: the k-th measured axis is divided next; none: it is small enough
    bool maybe_undefined = false;
};

class Measuring {
  public:
    Measuring(CellJudge judge, const ShapeMeasureOptions& options, const MeasuredBox& box,
              std::size_t max_cells, const Job& job)
        : judges_(std::move(judge)),
          options_(options),
          axes_(box.axes),
          max_cells_(max_cells),
          job_(job),
          box_(box.cell) {
        for (const std::size_t axis : axes_) whole_.origin[axis] = box_.middle(axis);
    }

    ShapeMeasure run() {
        take({box_}, {{}});
        while (!job_.cancelled()) {
            const double missing = uncertain();
            const double allowed = 2 * options_.relative_error * (settled() + 0.5 * missing);
            if (job_.on_progress) job_.report(missing > 0 ? std::min(1.0, allowed / missing) : 1.0);
            if (missing <= 0.999 * allowed) break;
            if (!divide(missing - allowed, missing)) break;
        }
        return result();
    }

  private:
    /// The widths of all leaves, and the rest of the size.
    double uncertain() const {
        double sum = 0;
        for (const Leaf& leaf : leaves_) sum += leaf.width;
        return sum;
    }
    double settled() const {
        double sum = whole_.size.lo;
        for (const Leaf& leaf : leaves_)
            sum += leaf.part.sure.share * measuring::cell_size(leaf.part.cell, axes_).lo;
        return sum;
    }

    /// Divides the worst leaves; false when nothing can be divided any more.
    bool divide(double excess, double missing) {
        std::vector<std::size_t> order(leaves_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::erase_if(order,
                      [&](std::size_t i) { return leaves_[i].divided == 0 || !(leaves_[i].width > 0); });
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return leaves_[a].width > leaves_[b].width; });
        const double wanted = std::min(share_a_round * missing, 1.5 * excess);
        const std::size_t fan = std::size_t{1} << axes_.size();
        std::vector<bool> is_taken(leaves_.size(), false);
        std::vector<Cell> children;
        std::vector<CellSource> sources;
        double taken = 0;
        std::size_t count = 0;
        for (const std::size_t i : order) {
            if (taken >= wanted || leaves_.size() + (count + 1) * (fan - 1) > max_cells_) break;
            is_taken[i] = true;
            taken += leaves_[i].width;
            ++count;
        }
        if (count == 0) return false;
        std::vector<Leaf> kept;
        for (std::size_t i = 0; i < leaves_.size(); ++i) {
            if (is_taken[i]) {
                append_children(leaves_[i], children);
                sources.resize(children.size(), leaves_[i].source);
            } else {
                kept.push_back(std::move(leaves_[i]));
            }
        }
        leaves_ = std::move(kept);
        take(children, sources);
        return true;
    }

    /// The axes across which a cell is divided: those that add most to the gap between its bounds, else the
    /// long ones.
    std::uint8_t divided_axes(const Cell& cell, const CellBounds& bounds) const {
        double longest = 0, widest = 0;
        for (std::size_t k = 0; k < axes_.size(); ++k) {
            longest = std::max(longest, cell.high[axes_[k]] - cell.low[axes_[k]]);
            widest = std::max(widest, bounds.gap[k]);
        }
        const bool by_gap = bounds.has_planes && widest > 0;
        unsigned out = 0;
        for (std::size_t k = 0; k < axes_.size(); ++k) {
            const double side = cell.high[axes_[k]] - cell.low[axes_[k]], middle = cell.middle(axes_[k]);
            if (!(cell.low[axes_[k]] < middle && middle < cell.high[axes_[k]])) continue;
            if (by_gap ? bounds.gap[k] >= large_gap * widest : side >= short_side * longest) out |= 1u << k;
        }
        return static_cast<std::uint8_t>(out);
    }

    void append_children(const Leaf& leaf, std::vector<Cell>& out) const {
        std::vector<std::size_t> divided;
        for (std::size_t k = 0; k < axes_.size(); ++k)
            if (leaf.divided >> k & 1u) divided.push_back(axes_[k]);
        for (std::size_t child = 0; child < std::size_t{1} << divided.size(); ++child) {
            Cell part = leaf.part.cell;
            for (std::size_t k = 0; k < divided.size(); ++k)
                (child >> k & 1u ? part.low : part.high)[divided[k]] = leaf.part.cell.middle(divided[k]);
            out.push_back(part);
        }
    }

    /// Judges cells and adds them to the sums or to the leaves, in their order.
    void take(const std::vector<Cell>& cells, const std::vector<CellSource>& sources) {
        std::vector<CellBounds> bounds(cells.size());
        std::vector<CellPart> parts(cells.size());
        const int dimension = static_cast<int>(axes_.size());
        judges_.judge(job_, cells, sources, bounds, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (bounds[i].sign == CellSign::open) parts[i] = cell_part(cells[i], bounds[i], dimension);
        });
        // Cells that a cancelled job left out are open, with nothing known of them.
        out_.evaluated += cells.size();
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (bounds[i].sign == CellSign::outside) continue;
            if (bounds[i].sign == CellSign::inside) {
                whole_.add_whole(cells[i], axes_);
                note_cut(cells[i]);
                continue;
            }
            Leaf leaf;
            leaf.part = parts[i];
            leaf.part.cell = cells[i];
            leaf.width = leaf.part.rest * measuring::cell_size(cells[i], axes_).hi;
            leaf.divided = divided_axes(cells[i], bounds[i]);
            leaf.maybe_undefined = bounds[i].maybe_undefined;
            leaf.source = std::move(bounds[i].source);
            out_.has_planes = out_.has_planes || bounds[i].has_planes;
            if (bounds[i].has_planes) note_cut(cells[i], bounds[i]);
            leaves_.push_back(leaf);
        }
    }

    /// Notes the sides of the box that a cell inside reaches.
    void note_cut(const Cell& cell) {
        for (const std::size_t axis : axes_) {
            if (cell.low[axis] == box_.low[axis]) out_.cut[2 * axis] = true;
            if (cell.high[axis] == box_.high[axis]) out_.cut[2 * axis + 1] = true;
        }
    }

    /// The same for an open cell: the sides where a point of its lattice is surely inside.
    void note_cut(const Cell& cell, const CellBounds& bounds) {
        const std::size_t points = axes_.size() == 2 ? 9 : 27;
        for (std::size_t point = 0; point < points; ++point) {
            if (!(bounds.lower[point] > 0)) continue;
            for (std::size_t k = 0, digits = point; k < axes_.size(); ++k, digits /= 3) {
                const std::size_t axis = axes_[k];
                if (digits % 3 == 0 && cell.low[axis] == box_.low[axis]) out_.cut[2 * axis] = true;
                if (digits % 3 == 2 && cell.high[axis] == box_.high[axis]) out_.cut[2 * axis + 1] = true;
            }
        }
    }

    /// Sums of everything about a point.
    MomentSums sums_about(const std::array<double, 3>& point) const {
        MomentSums sums = whole_.about(point);
        for (const Leaf& leaf : leaves_) sums.add(leaf.part, axes_);
        return sums;
    }

    ShapeMeasure result() {
        // moments about a point near the centroid: there the least is lost
        const MomentSums rough = sums_about(whole_.origin);
        std::array<double, 3> near = whole_.origin;
        for (const std::size_t axis : axes_) {
            const auto middle = [](const Interval& v) { return v.lo + 0.5 * (v.hi - v.lo); };
            const double at = whole_.origin[axis] + middle(rough.first[axis]) / middle(rough.size);
            if (at >= box_.low[axis] && at <= box_.high[axis]) near[axis] = at;
        }
        const MomentSums sums = sums_about(near);
        const measuring::CentralMoments central = central_moments(sums, box_, axes_);
        out_.size = sums.size;
        out_.size.lo = std::max(out_.size.lo, 0.0);
        out_.centroid = central.centroid;
        out_.inertia = central.inertia;
        const double width = out_.size.hi - out_.size.lo;
        out_.is_reached = width <= options_.relative_error * (out_.size.lo + out_.size.hi);
        out_.is_cancelled = job_.cancelled();
        out_.open = leaves_.size();
        for (const Leaf& leaf : leaves_) out_.maybe_undefined = out_.maybe_undefined || leaf.maybe_undefined;
        return out_;
    }

    JudgePool judges_;
    const ShapeMeasureOptions& options_;
    std::vector<std::size_t> axes_;
    std::size_t max_cells_;
    const Job& job_;
    Cell box_;
    MomentSums whole_;  ///< of the cells inside
    std::vector<Leaf> leaves_;
    ShapeMeasure out_;
};

}  // namespace

std::size_t most_cells(const Field& field) { return has_regions(field) ? 20'000 : 1'000'000; }

Result<ShapeMeasure> measure_shape(const Field& field, const ShapeMeasureOptions& options, const Job& job) {
    const auto box = measuring::measured_box(options.bounds, options.axes, 2);
    if (!box) return box.error();
    if (!(options.relative_error > 0))
        return Error{ErrorKind::invalid_argument, "the relative error must be more than 0"};
    auto judge = CellJudge::make(field, box->axes, options.evaluator);
    if (!judge) return judge.error();
    const std::size_t max_cells = options.max_cells > 0 ? options.max_cells : most_cells(field);
    return Measuring(std::move(*judge), options, *box, max_cells, job).run();
}

}  // namespace frep
