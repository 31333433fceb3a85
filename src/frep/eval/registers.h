// Register allocation for a tape, one instruction after the other: values get registers as they are made;
// when none is free the one that was used longest ago is written to a slot. Values never change, so a value
// is written at most once. Tested by tests/unit/eval/tape_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "frep/eval/tape.h"

namespace frep {

/// Places of the values of one graph while a tape is built. Constant time for each call.
class Registers {
  public:
    static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

    /// For `nodes` values over `limit` registers.
    Registers(std::size_t nodes, std::size_t limit);

    /// Starts a new tape; places of earlier ones must have been forgotten.
    void start(Tape& tape);
    /// The register of a value, copied from its slot if need be; the instruction under way keeps it.
    Operand in_register(NodeId id);
    /// The register or slot of a value.
    Operand anywhere(NodeId id) const;
    /// The value is needed no more: its places are free.
    void release(NodeId id);
    /// A register for a new value. Operands of the instruction under way are the last to be written to slots.
    Operand make(NodeId id);
    /// A register for a new value if one is free, else a slot.
    Operand make_anywhere(NodeId id);
    /// Forgets a value's places without freeing them, after the tape is done.
    void forget(NodeId id) { register_of_[id] = slot_of_[id] = nowhere; }

  private:
    struct Register {
        NodeId holds = nowhere;
        std::uint32_t older = nowhere, newer = nowhere;  ///< order of last use
    };

    std::uint32_t take();
    std::uint32_t take_slot();
    void touch(std::uint32_t reg);
    void unlink(std::uint32_t reg);
    void hold(std::uint32_t reg, NodeId id);
    void copy(Operand to, Operand from);

    std::size_t limit_;
    Tape* tape_ = nullptr;
    std::vector<std::uint32_t> register_of_, slot_of_;  ///< by node
    std::vector<Register> registers_;
    std::uint32_t oldest_ = nowhere, newest_ = nowhere;
    std::vector<std::uint32_t> free_registers_, free_slots_;
};

}  // namespace frep
