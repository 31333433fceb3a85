// Graph to tape: nodes in the order of order.h, registers by registers.h; regions become code of their own.
#include "frep/eval/tape.h"

#include <algorithm>

#include "frep/eval/order.h"
#include "frep/eval/registers.h"

namespace frep {
namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::uint32_t>::max();

/// Builds any number of tapes for one graph.
class Builder {
  public:
    Builder(const Graph& graph, std::span<const double> parameters, const TapeOptions& options,
            std::size_t& budget)
        : graph_(graph),
          parameters_(parameters),
          options_(options),
          budget_(budget),
          scheduler_(graph),
          registers_(graph.size(),
                     options.registers ? static_cast<std::size_t>(options.registers) : unlimited),
          uses_(graph.size(), 0),
          direct_(graph.size()),
          is_direct_(graph.size(), false) {}

    Status build(std::span<const NodeId> roots, Tape& tape);

  private:
    void count_uses(const std::vector<NodeId>& order, std::span<const NodeId> roots);
    bool place_leaf(NodeId id);
    Status place(NodeId id);
    void place_short(NodeId id, Instruction step);
    void place_long(NodeId id, Instruction step);
    Status place_region(NodeId id);
    Operand any_operand(NodeId id) const { return is_direct_[id] ? direct_[id] : registers_.anywhere(id); }
    void gather(NodeId id);
    void emit(Instruction step);
    void used(NodeId id);

    const Graph& graph_;
    std::span<const double> parameters_;
    const TapeOptions& options_;
    std::size_t& budget_;
    Scheduler scheduler_;
    Registers registers_;
    std::vector<std::uint32_t> uses_;  ///< by node: operands and roots still to come
    std::vector<Operand> direct_;      ///< by node: input or constant
    std::vector<bool> is_direct_;
    std::vector<std::vector<NodeId>> region_outputs_;  ///< by number of the call in the tape
    std::vector<Operand> gathered_;
    Tape* tape_ = nullptr;
};

Result<std::shared_ptr<const RegionCode>> compile_region(const Region& region, const TapeOptions& options,
                                                         std::size_t& budget) {
    auto code = std::make_shared<RegionCode>();
    code->region = &region;
    code->tapes.resize(region.statements.size());
    Builder builder(region.body, {}, options, budget);
    std::vector<NodeId> roots;
    for (std::size_t i = 0; i < region.statements.size(); ++i) {
        const RegionStatement& s = region.statements[i];
        roots.clear();
        switch (s.kind) {
            case RegionStatement::Kind::assign:
                for (const auto& [cell, node] : s.assignments) roots.push_back(node);
                break;
            case RegionStatement::Kind::store:
                roots = {s.index, s.value};
                break;
            case RegionStatement::Kind::search:
                roots = {s.value};
                break;
            case RegionStatement::Kind::branch:
            case RegionStatement::Kind::loop:
                roots = {s.condition};
                break;
        }
        Tape& tape = code->tapes[i];
        if (Status status = builder.build(roots, tape); !status) return status.error();
        code->registers = std::max(code->registers, tape.registers + tape.slots);
        code->outputs = std::max(code->outputs, tape.outputs.size());
    }
    return std::shared_ptr<const RegionCode>(std::move(code));
}

Status Builder::build(std::span<const NodeId> roots, Tape& tape) {
    tape_ = &tape;
    const std::vector<NodeId>& order = scheduler_.schedule(roots);
    registers_.start(tape);
    count_uses(order, roots);
    Status status;
    for (NodeId id : order) {
        status = place(id);
        if (!status) break;
    }
    if (status)
        for (NodeId root : roots) tape.outputs.push_back(any_operand(root));
    std::sort(tape.inputs.begin(), tape.inputs.end());
    tape.inputs.erase(std::unique(tape.inputs.begin(), tape.inputs.end()), tape.inputs.end());
    for (NodeId id : order) {
        registers_.forget(id);
        uses_[id] = 0;
        is_direct_[id] = false;
    }
    return status;
}

void Builder::count_uses(const std::vector<NodeId>& order, std::span<const NodeId> roots) {
    region_outputs_.clear();
    for (NodeId id : order) {
        const Node& node = graph_.node(id);
        if (node.op == Op::region) {
            // As an operand a region has no value of its own; its number is found through direct_.
            direct_[id] = Operand(Operand::Kind::constant, region_outputs_.size());
            region_outputs_.emplace_back();
        }
        if (node.op == Op::output)
            region_outputs_[direct_[graph_.arguments(id)[0]].index()].push_back(id);
        else
            for (NodeId argument : graph_.arguments(id)) ++uses_[argument];
    }
    for (NodeId root : roots) ++uses_[root];
}

/// Inputs and constants are operands as they are.
bool Builder::place_leaf(NodeId id) {
    const Node& node = graph_.node(id);
    double value = std::numeric_limits<double>::quiet_NaN();
    switch (node.op) {
        case Op::coordinate:
        case Op::cell:
            direct_[id] = Operand(Operand::Kind::input, node.payload);
            is_direct_[id] = true;
            tape_->inputs.push_back(node.payload);
            return true;
        case Op::constant:
            value = graph_.constant_of(id);
            break;
        case Op::parameter:
            value = parameters_[node.payload];
            break;
        case Op::undefined:
        case Op::region:
            break;
        default:
            return false;
    }
    direct_[id] = Operand(Operand::Kind::constant, tape_->constants.size());
    is_direct_[id] = true;
    tape_->constants.push_back(value);
    return true;
}

Status Builder::place(NodeId id) {
    const Node& node = graph_.node(id);
    if (node.op == Op::region) return place_region(id);
    if (node.op == Op::output || place_leaf(id)) return {};
    Instruction step;
    step.op = node.op;
    if (node.op == Op::load) {
        step.kind = Instruction::Kind::load;
        step.number = node.payload;
    } else if (info(node.op).kind == OpKind::block) {
        const auto block = graph_.block_of(id);
        if (!block.empty()) {
            tape_->blocks.push_back(block);
            step.number = static_cast<std::uint32_t>(tape_->blocks.size());
        }
    }
    if (node.argument_count <= 3)
        place_short(id, step);
    else
        place_long(id, step);
    if (budget_ == 0)
        return Error{ErrorKind::over_limit, "the model needs more instructions than an engine may hold"};
    --budget_;
    return {};
}

void Builder::used(NodeId id) {
    if (--uses_[id] == 0 && !is_direct_[id]) registers_.release(id);
}

void Builder::emit(Instruction step) {
    step.first = static_cast<std::uint32_t>(tape_->operands.size());
    step.count = static_cast<std::uint32_t>(gathered_.size());
    tape_->operands.insert(tape_->operands.end(), gathered_.begin(), gathered_.end());
    tape_->instructions.push_back(step);
}

void Builder::place_short(NodeId id, Instruction step) {
    gathered_.clear();
    for (NodeId argument : graph_.arguments(id))
        gathered_.push_back(is_direct_[argument] ? direct_[argument] : registers_.in_register(argument));
    for (NodeId argument : graph_.arguments(id)) used(argument);
    step.out = registers_.make(id);
    emit(step);
}

void Builder::gather(NodeId id) {
    gathered_.clear();
    for (NodeId argument : graph_.arguments(id)) gathered_.push_back(any_operand(argument));
}

/// The place of the result is chosen before those of the operands are free: a spill that makes room must not
/// overwrite an operand that lies in a slot.
void Builder::place_long(NodeId id, Instruction step) {
    gather(id);
    step.out = registers_.make(id);
    emit(step);
    for (NodeId argument : graph_.arguments(id)) used(argument);
}

Status Builder::place_region(NodeId id) {
    const std::uint32_t number = direct_[id].index();
    const Region& region = graph_.region_of(id);
    auto code = compile_region(region, options_, budget_);
    if (!code) return code.error();
    RegionCall call{*code, {}};
    gather(id);
    for (NodeId output : region_outputs_[number])
        call.outputs.emplace_back(graph_.node(output).payload, registers_.make_anywhere(output));
    Instruction step;
    step.kind = Instruction::Kind::region;
    step.op = Op::region;
    step.number = static_cast<std::uint32_t>(tape_->regions.size());
    tape_->regions.push_back(std::move(call));
    emit(step);
    for (NodeId argument : graph_.arguments(id)) used(argument);
    place_leaf(id);  // a region that is read as a value is undefined
    return {};
}

}  // namespace

Result<Tape> make_tape(const Field& field, std::span<const NodeId> roots, const TapeOptions& options) {
    std::size_t budget = options.instruction_limit;
    Builder builder(*field.graph, field.parameters, options, budget);
    Tape tape;
    if (Status status = builder.build(roots, tape); !status) return status.error();
    return tape;
}

}  // namespace frep
