// Implementation of native_writer.h: the places of values while a function is written.
#if defined(FREP_HAS_JIT)

#include "frep/eval/native_writer.h"

#include <algorithm>

#include "frep/base/result.h"
#include "frep/eval/native_order.h"

namespace frep::native {

namespace x86 = asmjit::x86;

FunctionWriter::FunctionWriter(CodeWriter& code, const FunctionPlan& plan)
    : code_(code), list_(code.list_), plan_(plan), wide_(code.wide_), single_(code.single_) {
    for (auto& bank : held_) bank.fill(no_value);
    free_[vectors] = wide_ ? 0xffffffffu : 0xffffu;
    free_[masks] = wide_ ? 0xfeu : 0u;  // k0 cannot select lanes
    homes_.resize(list_.steps().size());
    for (std::uint32_t i = 0; i < plan.sources.size(); ++i) {
        homes_[plan.sources[i].value].given = true;
        homes_[plan.sources[i].value].source = i;
    }
}

FunctionWriter::Class FunctionWriter::class_of(ValueId v) const {
    return wide_ && is_mask(list_.steps()[v].op) ? masks : vectors;
}

bool FunctionWriter::is_constant(ValueId v) const { return list_.steps()[v].op == StepOp::constant; }

/// What the targets need, in the order in which it will be written.
void FunctionWriter::find_order() {
    const auto& steps = list_.steps();
    const auto count = static_cast<std::uint32_t>(steps.size());
    std::vector<bool> live(count, false);
    for (const Target& target : plan_.targets) live[target.value] = true;
    std::size_t hard = 0;
    bool calls = false;
    for (std::uint32_t i = count; i-- > 0;) {
        if (is_constant(i)) homes_[i].given = true;
        if (!live[i] || homes_[i].given) continue;
        order_.push_back(i);
        for (const ValueId v : list_.operands_of(steps[i])) live[v] = true;
        calls = calls || steps[i].op == StepOp::call;
        hard += steps[i].op >= StepOp::scale && steps[i].op <= StepOp::low_bit ? 1 : 0;
    }
    std::reverse(order_.begin(), order_.end());
    // Kernels of functions are long chains, and have bit operations and comparisons; minima and sums of short
    // terms are none, and a call leaves no registers.
    if (calls || hard * 40 < order_.size()) return;
    order_ = interleaved(list_, order_, wide_ ? 26 : 12, wide_ ? 6 : 0);
}

/// Backward: for every operand the place of the next step that reads it.
void FunctionWriter::find_uses() {
    const auto& steps = list_.steps();
    const auto count = static_cast<std::uint32_t>(order_.size());
    first_following_.assign(steps.size(), 0);
    for (const Target& target : plan_.targets) homes_[target.value].next_use = count;
    for (std::uint32_t place = count; place-- > 0;) {
        const ValueId i = order_[place];
        const auto in = list_.operands_of(steps[i]);
        first_following_[i] = static_cast<std::uint32_t>(following_.size());
        for (const ValueId v : in) following_.push_back(homes_[v].next_use);
        for (const ValueId v : in) homes_[v].next_use = place;
        if (steps[i].op == StepOp::call)
            call_area_ = std::max(call_area_, std::max<std::size_t>(in.size(), 1));
    }
}

std::uint32_t FunctionWriter::take(Class c) {
    if (free_[c] != 0) {
        const auto reg = static_cast<std::uint32_t>(__builtin_ctz(free_[c]));
        free_[c] &= free_[c] - 1;
        return reg;
    }
    std::uint32_t best = 32, furthest = 0;
    for (std::uint32_t r = 0; r < 32; ++r) {
        const ValueId v = held_[c][r];
        if (v == no_value || ((locked_[c] | (c == vectors ? pinned_ : 0)) >> r & 1) != 0) continue;
        // What need not be written back may go a little earlier.
        const std::uint32_t use = homes_[v].next_use;
        const std::uint32_t rank = homes_[v].given || homes_[v].slot != no_slot ? use + use / 16 : use;
        if (best == 32 || rank > furthest) {
            best = r;
            furthest = rank;
        }
    }
    FREP_CHECK(best < 32);
    evict(c, best);
    free_[c] &= ~(1u << best);
    return best;
}

void FunctionWriter::evict(Class c, std::uint32_t reg) {
    const ValueId v = held_[c][reg];
    if (homes_[v].next_use != never) write_slot(v);
    homes_[v].reg = nowhere;
    held_[c][reg] = no_value;
    free_[c] |= 1u << reg;
}

void FunctionWriter::write_slot(ValueId v) {
    Home& home = homes_[v];
    if (home.given || home.slot != no_slot) return;
    if (free_slots_.empty()) {
        home.slot = slots_++;
    } else {
        home.slot = free_slots_.back();
        free_slots_.pop_back();
    }
    const Class c = class_of(v);
    const auto reg = static_cast<std::uint32_t>(home.reg);
    move(c, memory_of(v),
         c == masks ? static_cast<asmjit::Operand>(x86::k(reg)) : static_cast<asmjit::Operand>(vector(reg)));
}

void FunctionWriter::hold(Class c, std::uint32_t reg, ValueId v) {
    held_[c][reg] = v;
    free_[c] &= ~(1u << reg);
    homes_[v].reg = static_cast<std::int8_t>(reg);
}

void FunctionWriter::release(ValueId v) {
    Home& home = homes_[v];
    if (home.reg != nowhere && is_constant(v) && (pinned_ >> home.reg & 1) != 0) return;
    if (home.reg != nowhere) {
        const Class c = class_of(v);
        held_[c][static_cast<std::size_t>(home.reg)] = no_value;
        free_[c] |= 1u << home.reg;
        home.reg = nowhere;
    }
    if (home.slot != no_slot) {
        leaving_slots_.push_back(home.slot);
        home.slot = no_slot;
    }
}

/// The register of a value, loaded if need be and kept until the step under way is written.
std::uint32_t FunctionWriter::in_register(ValueId v) {
    const Class c = class_of(v);
    if (homes_[v].reg == nowhere) {
        const std::uint32_t reg = take(c);
        load(c, reg, v);
        hold(c, reg, v);
    }
    const auto reg = static_cast<std::uint32_t>(homes_[v].reg);
    locked_[c] |= 1u << reg;
    return reg;
}

/// A register, or memory where the value is there and a register would not pay.
asmjit::Operand FunctionWriter::anywhere(ValueId v, std::uint32_t following) {
    const Home& home = homes_[v];
    if (home.reg != nowhere) return vector(in_register(v));
    const bool scalar = home.given && !is_constant(v) && plan_.sources[home.source].scalar;
    constexpr std::uint32_t near = 64;
    const bool again = following != never && free_[vectors] != 0 && !is_constant(v) &&
                       (home.given || following - current_ < near);
    if ((scalar && !wide_) || again) return vector(in_register(v));
    return memory_of(v);
}

/// Where a value that is not in a register lies; for a single number, with the broadcast that AVX-512 has.
x86::Mem FunctionWriter::memory_of(ValueId v) {
    const Home& home = homes_[v];
    if (is_constant(v)) return code_.constant_at(v);
    if (!home.given) return work(first_slot_ + static_cast<std::size_t>(home.slot) * 64);
    const Source& source = plan_.sources[home.source];
    x86::Mem at = x86::ptr(pointer(source.pointer), source.offset);
    if (source.scalar && wide_) at = single_ ? at._1to16() : at._1to8();
    return at;
}

/// Operands whose last reader this step is give their places back.
void FunctionWriter::after_operands(std::uint32_t index, const Step& step) {
    locked_ = {};
    const auto in = list_.operands_of(step);
    for (std::size_t k = 0; k < in.size(); ++k) {
        homes_[in[k]].next_use = following(index, static_cast<int>(k));
        if (homes_[in[k]].next_use == never) release(in[k]);
    }
}

/// Before a call in the open: no register survives it.
void FunctionWriter::spill_everything() {
    for (const Class c : {vectors, masks})
        for (std::uint32_t r = 0; r < 32; ++r)
            if (held_[c][r] != no_value) evict(c, r);
}

/// Vectors that live at one time, constants aside.
std::uint32_t FunctionWriter::most_alive() const {
    const auto& steps = list_.steps();
    auto alive = static_cast<std::uint32_t>(std::min<std::size_t>(plan_.sources.size(), 3));
    std::uint32_t most = alive;
    for (const ValueId i : order_) {
        if (class_of(i) == vectors) most = std::max(most, ++alive);
        const auto in = list_.operands_of(steps[i]);
        for (std::size_t k = 0; k < in.size(); ++k) {
            // the last of several uses of one value by this step
            const bool again =
                std::find(in.begin() + static_cast<std::ptrdiff_t>(k) + 1, in.end(), in[k]) != in.end();
            if (following(i, static_cast<int>(k)) == never && !again && !homes_[in[k]].given &&
                class_of(in[k]) == vectors)
                --alive;
        }
    }
    return most;
}

/// Registers that would stand idle get constants which instructions cannot read from memory.
void FunctionWriter::pin_constants() {
    const auto& steps = list_.steps();
    std::vector<std::pair<std::uint32_t, ValueId>> uses;  // count, constant
    std::vector<std::uint32_t> count_of(steps.size(), 0);
    for (const ValueId i : order_) {
        if (steps[i].op == StepOp::call) return;  // no register survives it
        const Step& step = steps[i];
        if (step.op == StepOp::choose && is_constant(step.in[2])) ++count_of[step.in[2]];
        const bool ordered = step.op == StepOp::subtract || step.op == StepOp::divide ||
                             step.op == StepOp::lesser || step.op == StepOp::greater;
        if (ordered && is_constant(step.in[0])) ++count_of[step.in[0]];
    }
    for (ValueId v = 0; v < steps.size(); ++v)
        if (count_of[v] != 0) uses.emplace_back(count_of[v], v);
    std::sort(uses.begin(), uses.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    constexpr std::uint32_t spare = 1;
    const std::uint32_t all = wide_ ? 32 : 16, taken = most_alive() + spare;
    for (std::size_t k = 0; k < uses.size() && taken + k < all; ++k) {
        const std::uint32_t reg = in_register(uses[k].second);
        pinned_ |= 1u << reg;
    }
    locked_ = {};
}

void FunctionWriter::write() {
    find_order();
    find_uses();
    enter();
    check_domain();
    for (current_ = 0; current_ < order_.size(); ++current_) {
        write_step(order_[current_]);
        free_slots_.insert(free_slots_.end(), leaving_slots_.begin(), leaving_slots_.end());
        leaving_slots_.clear();
    }
    store_targets();
    advance();
    leave();
}

}  // namespace frep::native

#endif  // FREP_HAS_JIT
