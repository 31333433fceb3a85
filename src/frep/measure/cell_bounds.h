// What is known of a function in a box cell: its sign, or two piecewise linear functions that it lies
// between. They come from the jet of the function over the cell (jet.h), of two forms the nearer one:
//   to the second order (Taylor's theorem), f(c) + g(c) t + t'Mt/2 with t = x - c, M the middles of the
//   enclosures of the second derivatives, and a rest of the third order in the size of the cell;
//   the mean value form (Moore 1966), f(c) + sum G_i t_i with G_i an enclosure of the derivative, where there
//   are creases.
// The first serves the parts of the cell too, without the function, as long as the rest is small. Signs come
// from tapes that are pruned for the cell (prune.h), 16 cells at a time. Tested by
// tests/unit/measure/cell_bounds_test.cpp.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "frep/base/result.h"
#include "frep/eval/evaluator.h"
#include "frep/eval/prune.h"
#include "frep/measure/jet.h"
#include "frep/measure/measured_box.h"

namespace frep::measuring {

enum class CellSign {
    outside,  ///< nowhere in the cell defined and >= 0
    inside,   ///< everywhere
    open,
};

/// A function between two quadratic ones: value + slope t + t'Mt/2 and up to sum R_ij |t_i| |t_j| / 2 more or
/// less, with t = x - center by measured axis.
struct Quadratic {
    std::array<double, 3> center{};
    math::Interval value;
    std::array<math::Interval, 3> slope;
    std::array<double, 6> second{};  ///< M, by pairs
    std::array<double, 6> rest{};    ///< R, by pairs; an off-diagonal one counts twice in the sum
};

/// What stands for F in a cell and its parts.
struct CellSource {
    std::shared_ptr<const ClauseTape> tape;      ///< has the sign of F; null: the field that was asked first
    std::shared_ptr<const Quadratic> quadratic;  ///< bounds of the tape's function; null: ask the tape
};

struct CellBounds {
    CellSign sign = CellSign::open;
    bool maybe_undefined = false;  ///< of an open cell
    bool has_planes = false;       ///< of an open cell: the bounds below hold
    /// Bounds, from below and above, of a function with the sign of F, on the lattice of the cell's low,
    /// middle and high coordinates, linear in each Kuhn simplex (clip.h) of the 2^D parts between them; digit
    /// k of a number to the base 3 is the place along the k-th measured axis. Finite, below 1e150.
    std::array<double, 27> lower{}, upper{};
    /// By measured axis: what it adds to the gap between the bounds. A cell is best divided across the
    /// largest.
    std::array<double, 3> gap{};
    CellSource source;  ///< for the parts of an open cell
};

/// Serves one thread; clone() makes one for another.
class CellJudge {
  public:
    /// `field` has the coordinates x, y, z (field_in_space()); `axes` are those that are measured. Errors:
    /// those of make_evaluator().
    static Result<CellJudge> make(const Field& field, std::vector<std::size_t> axes,
                                  const EvaluatorOptions& options);
    CellJudge clone() const;

    /// out[i] = what is known of cells[i], whose parent left sources[i]. Cells that follow each other with
    /// one tape are judged together.
    void judge(std::span<const Cell> cells, std::span<const CellSource> sources, std::span<CellBounds> out);

  private:
    void judge_by_ranges(std::span<const Cell> cells, std::span<CellBounds> out);
    void judge_by_tape(std::span<const Cell> cells, std::shared_ptr<const ClauseTape> tape,
                       std::span<CellBounds> out);
    void add_bounds(const Cell& cell, CellBounds& out);

    std::vector<std::size_t> axes_;
    std::unique_ptr<Evaluator> value_;
    std::shared_ptr<const ClauseTape> tape_;  ///< of the field; null where it has none: signs alone are found
    Pruner pruner_;
    CutResult cut_;
    JetMachine jets_;
};

}  // namespace frep::measuring
