// Jets: a function of up to three variables over a box, with enclosures of its value, its gradient and its
// second derivatives. Forward mode to the second order (Griewank and Walther, Evaluating Derivatives, 2008,
// chapter 13) in intervals, a rule an operation; what has no rule is "anything". At a crease (min, max, abs,
// the edge of a set operation) the gradient holds those of all sides, in the sense of F. H. Clarke
// (Optimization and Nonsmooth Analysis, 1983), and the second derivatives are "anything". Tested by
// tests/unit/measure/jet_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "frep/eval/clause_tape.h"
#include "frep/math/interval.h"
#include "frep/measure/pairs.h"

namespace frep::measuring {

struct Jet {
    math::Interval value;
    /// Hold (f(q) - f(p)) / |q - p| along each axis, for p and q in the box, wherever f is defined in the
    /// whole box. Flags of these intervals mean nothing.
    std::array<math::Interval, 3> first{};
    /// The second derivatives by the variables of pairs[i].
    std::array<math::Interval, 6> second{};
    std::uint8_t moves = 0;  ///< bit k: may change with variable k; derivatives by the others are 0
};

/// Runs clause tapes on jets. Serves one thread.
class JetMachine {
  public:
    /// F over a box, for the tape of F or one that was cut for the box. variables[k] = the coordinate that is
    /// variable k; at most three. Other coordinates are 0. `with_second` false: second derivatives are left
    /// out.
    Jet run(const ClauseTape& tape, std::span<const math::Interval> box,
            std::span<const std::size_t> variables, bool with_second);

  private:
    /// The same for coordinates_ that are set.
    Jet run_loaded(const ClauseTape& tape, bool with_second);
    void load(const ClauseData& data);
    Jet apply(const ClauseTape& tape, const Clause& clause);
    Jet run_formula(const ClauseTape& formula, std::span<const Jet* const> operands);
    /// A blend by points or extents is the plain set operation but where both operands are within their
    /// extents; there its displacement begins with derivatives of 0.
    Jet run_point_blend(Op op, const ClauseTape& formula, std::span<const Jet* const> operands);
    const ClauseTape* formula_of(Op op, std::size_t operands);
    const Jet& row(RowNumber number) const;

    std::shared_ptr<const ClauseData> data_;  ///< whose constants are loaded
    std::vector<Jet> constants_;
    std::array<Jet, max_coordinates> coordinates_;
    std::vector<Jet> rows_;  ///< of values
    RowNumber first_coordinate_ = 0, first_value_ = 0;
    bool with_second_ = true;
    /// Of operations that are defined by formulas, over their operands as coordinates; null: it has none.
    std::map<Op, std::unique_ptr<ClauseTape>> formulas_;
    std::unique_ptr<JetMachine> inner_;  ///< runs formulas
};

}  // namespace frep::measuring
