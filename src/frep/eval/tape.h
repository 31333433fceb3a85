// Tape: the program that the register engines run. A graph becomes a list of instructions over registers,
// spill slots, inputs (coordinates; in a region its cells) and constants. Made by tape.cpp (order and
// register allocation) and run by vm.h. Tested by tests/unit/eval/tape_test.cpp and depth_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "frep/base/result.h"
#include "frep/field/field.h"

namespace frep {

/// Where an instruction reads or writes: two bits of kind, thirty bits of index.
class Operand {
  public:
    enum class Kind : std::uint32_t { reg, slot, input, constant };

    Operand() = default;
    Operand(Kind kind, std::size_t index)
        : bits_((static_cast<std::uint32_t>(kind) << 30) | static_cast<std::uint32_t>(index)) {}
    Kind kind() const { return static_cast<Kind>(bits_ >> 30); }
    std::uint32_t index() const { return bits_ & 0x3fffffffu; }
    bool operator==(const Operand&) const = default;

  private:
    std::uint32_t bits_ = 0;
};

/// One step of a tape. Operands of up to three-ary operations are registers, inputs or constants; longer
/// operand lists, and those of regions, may also name spill slots.
struct Instruction {
    enum class Kind : std::uint8_t {
        apply,   ///< out = op(operands); number = block + 1, or 0
        copy,    ///< out = operand (spill and reload)
        load,    ///< out = item of array `number` of the region by the operand
        region,  ///< runs region `number` of the tape on guard and start values
    };
    Kind kind = Kind::apply;
    Op op = Op::constant;
    Operand out;
    std::uint32_t first = 0;  ///< first of its operands in Tape::operands
    std::uint32_t count = 0;  ///< operands
    std::uint32_t number = 0;
};

struct RegionCode;

/// A region at its place in a tape: the code and where the final contents of cells go.
struct RegionCall {
    std::shared_ptr<const RegionCode> code;
    std::vector<std::pair<std::uint32_t, Operand>> outputs;  ///< cell, destination
};

struct Tape {
    std::vector<Instruction> instructions;
    std::vector<Operand> operands;
    std::vector<double> constants;
    std::vector<std::span<const double>> blocks;  ///< memory of the graph
    std::vector<RegionCall> regions;
    std::vector<std::uint32_t> inputs;  ///< the inputs that are read, ascending
    std::vector<Operand> outputs;       ///< one a root
    std::size_t registers = 0;
    std::size_t slots = 0;

    std::span<const Operand> operands_of(const Instruction& step) const {
        return {operands.data() + step.first, step.count};
    }
};

/// A region ready to run: for each statement the tape of its expressions, in the order right sides (assign),
/// index and value (store), condition (branch, loop).
struct RegionCode {
    const Region* region = nullptr;
    std::vector<Tape> tapes;    ///< by statement number
    std::size_t registers = 0;  ///< most registers and slots of one tape
    std::size_t outputs = 0;    ///< most outputs of one tape
};

struct TapeOptions {
    /// Registers to use, at least 3; 0 = as many as values live at one time.
    int registers = 0;
    /// Instructions that a tape and the regions below it may have together.
    std::size_t instruction_limit = 1u << 24;
};

/// The tape that computes `roots` of `field`; parameters are bound to their present values. The tape refers
/// to memory of the field's graph, which must outlive it. Errors: over_limit.
Result<Tape> make_tape(const Field& field, std::span<const NodeId> roots, const TapeOptions& options = {});

}  // namespace frep
