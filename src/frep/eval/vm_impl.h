// Definitions of Interpreter and Machine; included by the files that instantiate them (vm_lanes.cpp,
// vm_dual.cpp, vm_interval.cpp), one number type each.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "frep/eval/vm.h"
#include "frep/eval/vm_lane.h"
#include "frep/eval/vm_region.h"
#include "frep/field/kernels/all.h"
#include "frep/field/meaning.h"

namespace frep {
namespace vm_detail {

/// Operations of at most this cost (ops.def) have a loop of their own. Interval operations are functions of
/// module math anyway.
template <class T>
inline constexpr int loop_cost = std::is_same_v<T, math::Interval> ? 0 : 5;

template <int arity, class T, class Kernel>
void loop(Kernel kernel, T* out, const Row<T>* in, std::size_t count) {
    static_assert(arity >= 1 && arity <= 3);
    if constexpr (arity == 1) {
        const Row<T> a = in[0];
        for (std::size_t i = 0; i < count; ++i) out[i] = kernel(a[i]);
    } else if constexpr (arity == 2) {
        const Row<T> a = in[0], b = in[1];
        for (std::size_t i = 0; i < count; ++i) out[i] = kernel(a[i], b[i]);
    } else {
        const Row<T> a = in[0], b = in[1], c = in[2];
        for (std::size_t i = 0; i < count; ++i) out[i] = kernel(a[i], b[i], c[i]);
    }
}

/// True when `op` was computed by a loop of its own.
template <class T>
bool apply_loop(Op op, T* out, const Row<T>* in, std::size_t count) {
    switch (op) {
#define FREP_LOOP_leaf(name, arity, cost)
#define FREP_LOOP_block(name, arity, cost)
#define FREP_LOOP_plain(name, arity, cost)                                                     \
    case Op::name:                                                                             \
        if constexpr (cost <= loop_cost<T> && arity <= 3) {                                    \
            loop<arity>([](const auto&... v) { return kernels::name(v...); }, out, in, count); \
            return true;                                                                       \
        }                                                                                      \
        return false;
#define FREP_OP(name, kind, arity, cost, context, doc) FREP_LOOP_##kind(name, arity, cost)
#include "frep/field/ops.def"
#undef FREP_OP
#undef FREP_LOOP_leaf
#undef FREP_LOOP_block
#undef FREP_LOOP_plain
        default:
            return false;
    }
}

/// Elements of a batch: rows that lie in the first cache, or at least in the second; always one.
template <class T>
std::size_t batch_width(std::size_t rows) {
    constexpr std::size_t first_cache = 24 << 10, second_cache = 512 << 10;
    constexpr std::size_t most = 64, enough = 16;
    const std::size_t row = sizeof(T) * std::max<std::size_t>(rows, 1);
    std::size_t width = most;
    while (width > enough && width * row > first_cache) width /= 2;
    while (width > 1 && width * row > second_cache) width /= 2;
    return width;
}

}  // namespace vm_detail

template <class T>
Interpreter<T>::Interpreter(const Tape& tape, std::int64_t max_steps) : tape_(&tape) {
    std::size_t most = 1;
    for (const Instruction& step : tape.instructions) most = std::max<std::size_t>(most, step.count);
    sources_.resize(most);
    scratch_.resize(most);
    arguments_.resize(most);
    for (const RegionCall& call : tape.regions) {
        if constexpr (std::is_same_v<T, math::Interval>)
            regions_.push_back(std::make_unique<IntervalRegion>(*call.code->region, max_steps));
        else
            regions_.push_back(std::make_unique<RegionMachine<T>>(call, max_steps));
    }
}

template <class T>
Interpreter<T>::~Interpreter() = default;
template <class T>
Interpreter<T>::Interpreter(Interpreter&&) noexcept = default;

template <class T>
Row<T> Interpreter<T>::source(const Frame<T>& frame, Operand operand, T& scratch) const {
    const std::size_t index = operand.index();
    switch (operand.kind()) {
        case Operand::Kind::reg:
            return {frame.registers + index * frame.stride + frame.first, 1};
        case Operand::Kind::slot:
            return {frame.registers + (tape_->registers + index) * frame.stride + frame.first, 1};
        case Operand::Kind::input:
            return {frame.inputs + index * frame.stride + frame.first, 1};
        case Operand::Kind::constant:
            break;
    }
    scratch = math::constant<T>(tape_->constants[index]);
    return {&scratch, 0};
}

template <class T>
T* Interpreter<T>::target(const Frame<T>& frame, Operand operand) const {
    const std::size_t row = operand.index() + (operand.kind() == Operand::Kind::slot ? tape_->registers : 0);
    return frame.registers + row * frame.stride + frame.first;
}

template <class T>
Row<T> Interpreter<T>::output(const Frame<T>& frame, std::size_t k) {
    return source(frame, tape_->outputs[k], output_scratch_);
}

template <class T>
void Interpreter<T>::run(const Frame<T>& frame, const std::vector<RegionArray>* arrays) {
    for (const Instruction& step : tape_->instructions) {
        const auto operands = tape_->operands_of(step);
        for (std::size_t i = 0; i < operands.size(); ++i)
            sources_[i] = source(frame, operands[i], scratch_[i]);
        switch (step.kind) {
            case Instruction::Kind::apply:
                apply(frame, step);
                break;
            case Instruction::Kind::copy: {
                T* out = target(frame, step.out);
                for (std::size_t i = 0; i < frame.count; ++i) out[i] = sources_[0][i];
                break;
            }
            case Instruction::Kind::load:
                load(frame, step, (*arrays)[step.number]);
                break;
            case Instruction::Kind::region:
                call_region(frame, step);
                break;
        }
    }
}

template <class T>
void Interpreter<T>::apply(const Frame<T>& frame, const Instruction& step) {
    T* out = target(frame, step.out);
    if (vm_detail::apply_loop(step.op, out, sources_.data(), frame.count)) return;
    const std::span<const double> block = step.number && info(step.op).kind == OpKind::block
                                              ? tape_->blocks[step.number - 1]
                                              : std::span<const double>();
    const std::span<const T> arguments(arguments_.data(), step.count);
    for (std::size_t i = 0; i < frame.count; ++i) {
        for (std::size_t k = 0; k < step.count; ++k) arguments_[k] = sources_[k][i];
        out[i] = meaning<T>(step.op, arguments, block);
    }
}

template <class T>
void Interpreter<T>::load(const Frame<T>& frame, const Instruction& step, const RegionArray& array) {
    if constexpr (!std::is_same_v<T, math::Interval>) {
        T* out = target(frame, step.out);
        const T undefined = math::constant<T>(math::quiet_nan);
        for (std::size_t i = 0; i < frame.count; ++i) {
            const math::Lanes index = lane_values(sources_[0][i]);
            T item = undefined;
            for (int lane = 0; lane < math::Lanes::size; ++lane) {
                const std::size_t n = item_number(index[lane], array.size);
                if (n == no_item) continue;
                copy_lane(item, frame.inputs[(array.first_cell + n) * frame.stride + frame.first + i], lane);
            }
            out[i] = item;
        }
    }
}

/// Intervals run box by box, lanes as a batch.
template <class T>
void Interpreter<T>::call_region(const Frame<T>& frame, const Instruction& step) {
    const RegionCall& call = tape_->regions[step.number];
    std::vector<T*> outputs;
    for (const auto& [cell, place] : call.outputs) outputs.push_back(target(frame, place));
    if constexpr (std::is_same_v<T, math::Interval>) {
        for (std::size_t i = 0; i < frame.count; ++i) {
            for (std::size_t k = 0; k < step.count; ++k) arguments_[k] = sources_[k][i];
            regions_[step.number]->run({arguments_.data(), step.count});
            for (std::size_t k = 0; k < outputs.size(); ++k)
                outputs[k][i] = regions_[step.number]->cells()[call.outputs[k].first];
        }
    } else {
        regions_[step.number]->run({sources_.data(), step.count}, outputs, frame.count);
    }
}

template <class T>
Machine<T>::Machine(const Tape& tape, std::int64_t max_steps)
    : width_(vm_detail::batch_width<T>(tape.registers + tape.slots)),
      inputs_(tape.inputs.empty() ? 0 : width_ * (tape.inputs.back() + 1)),
      registers_(width_ * (tape.registers + tape.slots)),
      interpreter_(tape, max_steps) {
    frame_.inputs = inputs_.data();
    frame_.registers = registers_.data();
    frame_.stride = width_;
}

template <class T>
void Machine<T>::run(std::size_t count) {
    frame_.count = count;
    interpreter_.run(frame_);
}

}  // namespace frep
