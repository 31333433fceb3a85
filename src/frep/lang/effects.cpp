#include "frep/lang/effects.h"

namespace frep::lang {

void Effects::merge(const Effects& other) {
    scalars_read.insert(other.scalars_read.begin(), other.scalars_read.end());
    scalars_written.insert(other.scalars_written.begin(), other.scalars_written.end());
    arrays_read.insert(other.arrays_read.begin(), other.arrays_read.end());
    arrays_written.insert(other.arrays_written.begin(), other.arrays_written.end());
    has_loop |= other.has_loop;
    has_computed_store |= other.has_computed_store;
    has_computed_load |= other.has_computed_load;
}

void EffectsTable::add_library_call(const ExpressionNode& call, Effects& out) {
    for (std::size_t i = 0; i < call.operands.size(); ++i)
        if (call.function->arguments[i].kind == shapes::ArgumentKind::array_in_out)
            out.arrays_written.insert(program_.expressions[call.operands[i]].symbol);
}

void EffectsTable::add_object_call(const Object& caller, const ExpressionNode& call, Effects& out) {
    if (call.operands.size() == 3)
        out.arrays_written.insert(program_.expressions[call.operands[2]].symbol);
    else if (caller.attributes() == 1)
        out.arrays_written.insert(array_s);
    const Effects& callee = of_object(call.symbol);
    out.has_loop |= callee.has_loop;
    out.has_computed_store |= callee.has_computed_store;
}

void EffectsTable::add_expression(const Object& object, ExpressionId id, Effects& out) {
    const ExpressionNode& node = program_.expressions[id];
    switch (node.kind) {
        case ExpressionKind::scalar:
            out.scalars_read.insert(node.symbol);
            break;
        case ExpressionKind::array:
            out.arrays_read.insert(node.symbol);
            break;
        case ExpressionKind::item:
            out.arrays_read.insert(node.symbol);
            out.has_computed_load |= program_.expressions[node.operands[0]].kind != ExpressionKind::number;
            break;
        case ExpressionKind::library_call:
            add_library_call(node, out);
            break;
        case ExpressionKind::object_call:
            add_object_call(object, node, out);
            break;
        default:
            break;
    }
    for (ExpressionId operand : node.operands) add_expression(object, operand, out);
}

Effects EffectsTable::of_expression(const Object& object, ExpressionId id) {
    Effects out;
    add_expression(object, id, out);
    return out;
}

const Effects& EffectsTable::of_statement(const Object& object, StatementId id) {
    if (statements_.size() <= id) statements_.resize(program_.statements.size());
    if (statements_[id]) return *statements_[id];
    const StatementNode& s = program_.statements[id];
    Effects out;
    for (ExpressionId item : s.list) add_expression(object, item, out);
    if (s.kind != StatementKind::assign_list) add_expression(object, s.value, out);
    switch (s.kind) {
        case StatementKind::assign:
            out.scalars_written.insert(s.symbol);
            break;
        case StatementKind::assign_item:
            add_expression(object, s.index, out);
            out.arrays_written.insert(s.symbol);
            out.has_computed_store |= program_.expressions[s.index].kind != ExpressionKind::number;
            break;
        case StatementKind::assign_list:
            out.arrays_written.insert(s.symbol);
            break;
        case StatementKind::branch:
        case StatementKind::loop:
            out.has_loop |= s.kind == StatementKind::loop;
            for (StatementId inner : s.first) out.merge(of_statement(object, inner));
            for (StatementId inner : s.second) out.merge(of_statement(object, inner));
            break;
        case StatementKind::result:
            break;
    }
    statements_[id] = std::move(out);
    return *statements_[id];
}

Effects EffectsTable::of_statements(const Object& object, const std::vector<StatementId>& ids) {
    Effects out;
    for (StatementId id : ids) out.merge(of_statement(object, id));
    return out;
}

const Effects& EffectsTable::of_object(std::uint32_t index) {
    if (objects_.empty()) objects_.resize(program_.objects.size());
    // Callees stand earlier in the file; filling from the first object on keeps the recursion one call deep.
    for (std::uint32_t i = 0; i <= index; ++i)
        if (!objects_[i]) objects_[i] = of_statements(program_.objects[i], program_.objects[i].body);
    return *objects_[index];
}

}  // namespace frep::lang
