// Registers in order of last use, as a doubly linked list; see registers.h.
#include "frep/eval/registers.h"

#include <algorithm>

namespace frep {

Registers::Registers(std::size_t nodes, std::size_t limit)
    : limit_(limit), register_of_(nodes, nowhere), slot_of_(nodes, nowhere) {}

void Registers::start(Tape& tape) {
    tape_ = &tape;
    registers_.clear();
    free_registers_.clear();
    free_slots_.clear();
    oldest_ = newest_ = nowhere;
}

void Registers::unlink(std::uint32_t reg) {
    Register& r = registers_[reg];
    (r.older == nowhere ? oldest_ : registers_[r.older].newer) = r.newer;
    (r.newer == nowhere ? newest_ : registers_[r.newer].older) = r.older;
}

void Registers::hold(std::uint32_t reg, NodeId id) {
    registers_[reg] = {id, newest_, nowhere};
    (newest_ == nowhere ? oldest_ : registers_[newest_].newer) = reg;
    newest_ = reg;
    register_of_[id] = reg;
}

void Registers::touch(std::uint32_t reg) {
    if (newest_ == reg) return;
    unlink(reg);
    hold(reg, registers_[reg].holds);
}

void Registers::copy(Operand to, Operand from) {
    Instruction step;
    step.kind = Instruction::Kind::copy;
    step.out = to;
    step.first = static_cast<std::uint32_t>(tape_->operands.size());
    step.count = 1;
    tape_->operands.push_back(from);
    tape_->instructions.push_back(step);
}

std::uint32_t Registers::take_slot() {
    if (free_slots_.empty()) return static_cast<std::uint32_t>(tape_->slots++);
    const std::uint32_t slot = free_slots_.back();
    free_slots_.pop_back();
    return slot;
}

std::uint32_t Registers::take() {
    if (!free_registers_.empty()) {
        const std::uint32_t reg = free_registers_.back();
        free_registers_.pop_back();
        return reg;
    }
    if (registers_.size() < limit_) {
        registers_.emplace_back();
        tape_->registers = registers_.size();
        return static_cast<std::uint32_t>(registers_.size() - 1);
    }
    const std::uint32_t reg = oldest_;
    const NodeId id = registers_[reg].holds;
    unlink(reg);
    if (slot_of_[id] == nowhere) {
        slot_of_[id] = take_slot();
        copy(Operand(Operand::Kind::slot, slot_of_[id]), Operand(Operand::Kind::reg, reg));
    }
    register_of_[id] = nowhere;
    return reg;
}

Operand Registers::in_register(NodeId id) {
    if (register_of_[id] == nowhere) {
        const std::uint32_t reg = take();
        copy(Operand(Operand::Kind::reg, reg), Operand(Operand::Kind::slot, slot_of_[id]));
        hold(reg, id);
    } else {
        touch(register_of_[id]);
    }
    return Operand(Operand::Kind::reg, register_of_[id]);
}

Operand Registers::anywhere(NodeId id) const {
    if (register_of_[id] != nowhere) return Operand(Operand::Kind::reg, register_of_[id]);
    return Operand(Operand::Kind::slot, slot_of_[id]);
}

void Registers::release(NodeId id) {
    if (register_of_[id] != nowhere) {
        unlink(register_of_[id]);
        free_registers_.push_back(register_of_[id]);
    }
    if (slot_of_[id] != nowhere) free_slots_.push_back(slot_of_[id]);
    forget(id);
}

Operand Registers::make(NodeId id) {
    const std::uint32_t reg = take();
    hold(reg, id);
    return Operand(Operand::Kind::reg, reg);
}

Operand Registers::make_anywhere(NodeId id) {
    if (!free_registers_.empty() || registers_.size() < limit_) return make(id);
    slot_of_[id] = take_slot();
    return Operand(Operand::Kind::slot, slot_of_[id]);
}

}  // namespace frep
