// Lowering of expressions: operands from last to first, constants folded by the graph. See lowerer.h.
#include <array>

#include <fmt/format.h>

#include "frep/lang/lowerer.h"
#include "frep/math/number.h"
#include "frep/shapes/set_operations.h"

namespace frep::lang {

std::optional<double> Lowerer::known(NodeId id) {
    const std::optional<double> value = graph().bound_value(id);
    if (value && graph().depends_on_parameters(id)) mark_structural(id);
    return value;
}

void Lowerer::mark_structural(NodeId id) {
    if (in_region()) return;  // parameters come into a region as cells, never as known values
    structural_seen_.resize(graph().size(), false);
    std::vector<NodeId> todo{id};
    while (!todo.empty()) {
        const NodeId n = todo.back();
        todo.pop_back();
        if (structural_seen_[n]) continue;
        structural_seen_[n] = true;
        if (graph().node(n).op == Op::parameter) structural_[graph().node(n).payload] = true;
        for (NodeId argument : graph().arguments(n)) todo.push_back(argument);
    }
}

NodeId Lowerer::unassigned_value(Span span, const std::string& name) {
    report(Severity::warning, "HF108", span, fmt::format("`{}` has no value here", name),
           "read before it is assigned",
           "assign it on every path that leads here; until then the value is undefined");
    return graph().undefined();
}

NodeId Lowerer::evaluate(ExpressionId id) {
    const ExpressionNode& node = program_.expressions[id];
    if (!step()) return graph().constant(0);
    ++operations_;
    if (++depth_ > depth_limit)
        stop("HF103", "the model is nested too deeply", "use fewer levels of calls and parentheses");
    const Span outer = graph().current_origin();
    graph().set_origin(node.span);
    const NodeId value = stopped() ? graph().constant(0) : evaluate_kind(node);
    graph().set_origin(outer);
    --depth_;
    return value;
}

NodeId Lowerer::evaluate_kind(const ExpressionNode& node) {
    switch (node.kind) {
        case ExpressionKind::number:
            return constant(node.value);
        case ExpressionKind::scalar:
            return read_scalar(node);
        case ExpressionKind::item:
            return read_item(node);
        case ExpressionKind::unary:
            return unary(node);
        case ExpressionKind::chain:
            return chain(node);
        case ExpressionKind::builtin:
            return builtin(node);
        case ExpressionKind::library_call:
            return library_call(node);
        case ExpressionKind::object_call:
            return object_call(node);
        case ExpressionKind::array:
        case ExpressionKind::text:
            break;  // only as arguments; the parser lets them stand nowhere else
    }
    return graph().undefined();
}

NodeId Lowerer::read_scalar(const ExpressionNode& node) {
    const NodeId value = frame().scalars[node.symbol];
    return value != unassigned ? value : unassigned_value(node.span, frame().object->scalars[node.symbol]);
}

NodeId Lowerer::read_item(const ExpressionNode& node) {
    const NodeId index = evaluate(node.operands[0]);
    const Items& items = frame().arrays[node.symbol];
    const ArrayInfo& array = frame().object->arrays[node.symbol];
    if (const auto value = known(index)) {
        const double i = math::round_half_up(*value);
        if (i >= 1 && i <= static_cast<double>(items.size())) {
            const NodeId item = items[static_cast<std::size_t>(i) - 1];
            return item != unassigned ? item : unassigned_value(node.span, array.name);
        }
        if (program_.expressions[node.operands[0]].kind != ExpressionKind::number)  // else the parser said so
            report(Severity::warning, "HF104", node.span,
                   fmt::format("index {} is out of range for `{}[{}]`", i, array.name, array.size),
                   "this item does not exist", fmt::format("indexes run from 1 to {}", array.size));
        return graph().undefined();
    }
    if (!step(static_cast<std::int64_t>(items.size() / 8))) return index;
    const std::uint32_t home = in_region() ? frame().array_homes[node.symbol] : no_cell;
    bool clean = home != no_cell;
    for (std::size_t k = 0; clean && k < items.size(); ++k) {
        const Node& n = graph().node(items[k]);
        clean = n.op == Op::cell && n.payload == target_.region->arrays[home].first_cell + k;
    }
    if (clean) return graph().make(Op::load, {index}, home);
    std::vector<NodeId> data(items.all());
    for (NodeId& item : data)
        if (item == unassigned) item = graph().undefined();
    return graph().make_block(Op::pick, std::array{index}, data);
}

std::size_t Lowerer::push_operands(const std::vector<ExpressionId>& operands) {
    const std::size_t base = pending_.size();
    for (std::size_t i = operands.size(); i-- > 0 && !stopped();) pending_.push_back(evaluate(operands[i]));
    pending_.resize(base + operands.size(), 0);
    return base;
}

NodeId Lowerer::unary(const ExpressionNode& node) {
    const NodeId a = evaluate(node.operands[0]);
    switch (node.operators[0]) {
        case Operator::minus:
        case Operator::complement:
            return make(Op::neg, {a});
        case Operator::logical_not:
            return make(Op::logical_not, {a});
        default:
            return a;
    }
}

NodeId Lowerer::chain(const ExpressionNode& node) {
    const std::size_t base = push_operands(node.operands);
    const std::size_t last = base + node.operands.size() - 1;
    NodeId value = pending_[last];
    for (std::size_t i = 0; i < node.operators.size(); ++i)
        value = combine(node.operators[i], value, pending_[last - i - 1]);
    pending_.resize(base);
    return value;
}

NodeId Lowerer::combine(Operator op, NodeId a, NodeId b) {
    switch (op) {
        case Operator::add:
            return make(Op::add, {a, b});
        case Operator::subtract:
            return make(Op::sub, {a, b});
        case Operator::unite:
            return shapes::disjunction(set_system(), expression(a), expression(b)).id();
        case Operator::intersect:
        case Operator::product:
            return shapes::conjunction(set_system(), expression(a), expression(b)).id();
        case Operator::subtract_solid:
            return shapes::subtraction(set_system(), expression(a), expression(b)).id();
        case Operator::multiply:
            return make(Op::mul, {a, b});
        case Operator::divide:
            return make(Op::div, {a, b});
        case Operator::power:
            return make(Op::pow, {a, b});
        case Operator::less:
            return make(Op::less, {a, b});
        case Operator::less_equal:
            return make(Op::less_equal, {a, b});
        case Operator::greater:
            return make(Op::less, {b, a});
        case Operator::greater_equal:
            return make(Op::less_equal, {b, a});
        case Operator::equal:
            return make(Op::equal, {a, b});
        case Operator::not_equal:
            return make(Op::logical_not, {make(Op::equal, {a, b})});
        case Operator::logical_and:
            return make(Op::logical_and, {a, b});
        case Operator::logical_or:
            return make(Op::logical_or, {a, b});
        default:
            return a;  // unary operators stand in no chain
    }
}

NodeId Lowerer::builtin(const ExpressionNode& node) {
    const std::size_t base = push_operands(node.operands);
    const NodeId a = pending_.back();
    const NodeId b = pending_[base];
    pending_.resize(base);
    switch (node.builtin) {
        case Builtin::sqrt:
            return make(Op::sqrt, {a});
        case Builtin::exp:
            return make(Op::exp, {a});
        case Builtin::sin:
            return make(Op::sin, {a});
        case Builtin::cos:
            return make(Op::cos, {a});
        case Builtin::atan:
            return make(Op::atan, {a});
        case Builtin::sinh:
            return make(Op::sinh, {a});
        case Builtin::cosh:
            return make(Op::cosh, {a});
        case Builtin::tanh:
            return make(Op::tanh, {a});
        case Builtin::abs:
            return make(Op::abs, {a});
        case Builtin::log:
            return make(Op::log, {a});
        case Builtin::logd:
            return make(Op::log10, {a});
        case Builtin::tan:
            return make(Op::tan, {a});
        case Builtin::asin:
            return make(Op::asin, {a});
        case Builtin::acos:
            return make(Op::acos, {a});
        case Builtin::sign:
            return make(Op::sign, {a});
        case Builtin::mod:
            return make(Op::remainder, {make(Op::round, {a}), make(Op::round, {b})});
        case Builtin::max:
            return make(Op::max, {a, b});
        case Builtin::min:
            return make(Op::min, {a, b});
        case Builtin::atan2:
            return make(Op::atan2, {a, b});
        case Builtin::ceil:
            return make(Op::ceil, {a});
        case Builtin::floor:
            return make(Op::floor, {a});
        case Builtin::integer:
            return make(Op::trunc, {a});
        case Builtin::frac:
            return make(Op::sub, {a, make(Op::trunc, {a})});
    }
    return a;
}

}  // namespace frep::lang
