// What is known of a function in a box cell: its sign, or two piecewise linear functions that it lies
// between. They come from the mean value form (Moore 1966; the partial derivatives one after the other,
// Hansen 1968): f(x) is in f(c) + sum G_i (x_i - c_i) with G_i an enclosure of the derivative, so that f is
// within e = sum rad G_i |x_i - c_i| of the plane with the slopes mid G_i: linear in each of the 2^D parts
// around the middle c. e shrinks with the square of the cell. Tested by
// tests/unit/measure/cell_bounds_test.cpp.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "frep/base/result.h"
#include "frep/eval/evaluator.h"

namespace frep::measuring {

/// A box; along an axis that is not measured both ends are 0.
struct Cell {
    std::array<double, 3> low{}, high{};

    /// A point of the cell: the middle of each side, rounded.
    double middle(std::size_t axis) const { return low[axis] + 0.5 * (high[axis] - low[axis]); }
};

enum class CellSign {
    outside,  ///< nowhere in the cell defined and >= 0
    inside,   ///< everywhere
    open,
};

struct CellBounds {
    CellSign sign = CellSign::open;
    bool maybe_undefined = false;  ///< of an open cell
    bool has_planes = false;       ///< of an open cell: the bounds below hold
    /// Bounds of f from below and above on the lattice of the cell's low, middle and high coordinates, linear
    /// in each Kuhn simplex (clip.h) of the 2^D parts between them; digit k of a number to the base 3 is the
    /// place along the k-th measured axis. Finite, below 1e150.
    std::array<double, 27> lower{}, upper{};
    /// By measured axis: what the derivative along it adds to the gap. A cell is best divided across the
    /// largest.
    std::array<double, 3> gap{};
};

/// Serves one thread; clone() makes one for another.
class CellJudge {
  public:
    /// `field` has the coordinates x, y, z (field_in_space()); `axes` are those that are measured. Where the
    /// field has an operation without derivatives, only signs are found. Errors: those of make_evaluator().
    static Result<CellJudge> make(const Field& field, std::vector<std::size_t> axes,
                                  const EvaluatorOptions& options);
    CellJudge clone() const;

    /// out[i] = what is known of cells[i].
    void judge(std::span<const Cell> cells, std::span<CellBounds> out);
    /// True when linear bounds can be had.
    bool has_derivatives() const { return !slopes_.empty(); }

  private:
    /// Intervals of one function over `count` boxes, given by columns.
    using Columns = std::array<std::vector<math::Interval>, 3>;
    static std::vector<math::Interval> ranges(Evaluator& evaluator, const Columns& boxes);
    void add_planes(std::span<const Cell> cells, std::span<const std::size_t> open,
                    std::span<CellBounds> out);

    std::vector<std::size_t> axes_;
    std::unique_ptr<Evaluator> value_;
    std::vector<std::unique_ptr<Evaluator>> slopes_;  ///< by measured axis
};

}  // namespace frep::measuring
