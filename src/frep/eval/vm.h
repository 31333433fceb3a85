// Engine vm: runs a tape over batches. One interpreter for all number types: math::Lanes (values),
// math::Dual<math::Lanes> (values and derivatives) and math::Interval (enclosures). An instruction is
// dispatched once for a batch; cheap operations are loops written out for each of them, the others go through
// meaning<T> element by element. Tested by tests/unit/eval/conformance_test.cpp, random_test.cpp and
// region_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "frep/eval/region_interval.h"
#include "frep/eval/tape.h"
#include "frep/math/number.h"

namespace frep {

/// A row of elements: a register, an input, or (step 0) one constant for all elements.
template <class T>
struct Row {
    const T* at = nullptr;
    std::size_t step = 1;
    const T& operator[](std::size_t i) const { return at[i * step]; }
};

/// The memory that a tape runs on: `stride` elements a row; elements first .. first + count - 1 are computed.
template <class T>
struct Frame {
    T* inputs = nullptr;
    T* registers = nullptr;  ///< slots follow the registers
    std::size_t stride = 0;
    std::size_t first = 0;
    std::size_t count = 0;
};

template <class T>
class RegionMachine;

/// What runs a region: intervals have an executor of their own, which serves all engines.
template <class T>
using RegionRunner = std::conditional_t<std::is_same_v<T, math::Interval>, IntervalRegion, RegionMachine<T>>;

/// Runs tapes; holds what is kept between instructions.
template <class T>
class Interpreter {
  public:
    /// For `tape` and no other.
    Interpreter(const Tape& tape, std::int64_t max_steps);
    ~Interpreter();
    Interpreter(Interpreter&&) noexcept;

    /// Runs every instruction. `arrays`: those of the region that the tape belongs to.
    void run(const Frame<T>& frame, const std::vector<RegionArray>* arrays = nullptr);
    /// The row of root k after run(), from element frame.first on.
    Row<T> output(const Frame<T>& frame, std::size_t k);

  private:
    Row<T> source(const Frame<T>& frame, Operand operand, T& scratch) const;
    T* target(const Frame<T>& frame, Operand operand) const;
    void apply(const Frame<T>& frame, const Instruction& step);
    void apply_long(const Frame<T>& frame, const Instruction& step);
    void load(const Frame<T>& frame, const Instruction& step, const RegionArray& array);
    void call_region(const Frame<T>& frame, const Instruction& step);

    const Tape* tape_;
    std::vector<std::unique_ptr<RegionRunner<T>>> regions_;
    std::vector<Row<T>> sources_;  ///< operands of the instruction under way
    std::vector<T> scratch_;       ///< its constants
    std::vector<T> arguments_;     ///< one element's operands
    T output_scratch_{};
};

/// A tape with the memory to run it.
template <class T>
class Machine {
  public:
    Machine(const Tape& tape, std::int64_t max_steps);

    /// Elements (of T) of a full batch.
    std::size_t width() const { return width_; }
    /// Row of input i; only inputs that the tape reads need values.
    T* input(std::size_t i) { return inputs_.data() + i * width_; }
    /// Computes the first `count` elements.
    void run(std::size_t count);
    /// The row of root k after run().
    Row<T> output(std::size_t k) { return interpreter_.output(frame_, k); }

  private:
    std::size_t width_;
    std::vector<T> inputs_, registers_;
    Interpreter<T> interpreter_;
    Frame<T> frame_;
};

}  // namespace frep
