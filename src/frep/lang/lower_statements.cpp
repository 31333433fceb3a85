// Lowering of statements outside regions, and of those inside that need no region statement. See lowerer.h.
#include <algorithm>

#include <fmt/format.h>

#include "frep/lang/lowerer.h"
#include "frep/math/number.h"

namespace frep::lang {

void Lowerer::execute(const std::vector<StatementId>& statements) {
    for (StatementId id : statements) {
        if (stopped()) return;
        execute(program_.statements[id], id);
    }
}

void Lowerer::execute(const StatementNode& statement, StatementId id) {
    if (!step()) return;
    ++depth_;
    const Span outer = graph().current_origin();
    graph().set_origin(statement.span);
    // An item read by a computed index comes from memory: bring what was assigned since there.
    if (in_region() && selecting_ == 0 && effects_.of_statement(*frame().object, id).has_computed_load)
        flush(nullptr);
    switch (statement.kind) {
        case StatementKind::assign: {
            const NodeId value = evaluate(statement.value);
            frame().scalars[statement.symbol] = value;
            break;
        }
        case StatementKind::assign_item:
            assign_item(statement);
            break;
        case StatementKind::assign_list: {
            const std::size_t base = push_operands(statement.list);
            std::vector<NodeId> items(pending_.rbegin(), pending_.rend() - static_cast<std::ptrdiff_t>(base));
            pending_.resize(base);
            frame().arrays[statement.symbol] = Items(std::move(items));
            break;
        }
        case StatementKind::branch:
            branch(statement);
            break;
        case StatementKind::loop:
            loop(statement, id);
            break;
        case StatementKind::result: {
            const NodeId value = evaluate(statement.value);
            frame().result = value;
            break;
        }
    }
    graph().set_origin(outer);
    --depth_;
}

void Lowerer::assign_item(const StatementNode& statement) {
    pending_.push_back(evaluate(statement.value));
    const NodeId index = evaluate(statement.index);
    const NodeId value = pending_.back();
    pending_.pop_back();
    if (stopped()) return;
    const auto fixed = known(index);
    if (!fixed) {
        if (in_region() && selecting_ == 0)
            region_store(statement, value, index);
        else
            assign_computed_item(statement, value, index);
        return;
    }
    Items& items = frame().arrays[statement.symbol];
    const double i = math::round_half_up(*fixed);
    if (i >= 1 && i <= static_cast<double>(items.size())) {
        items.writable()[static_cast<std::size_t>(i) - 1] = value;
        return;
    }
    const ArrayInfo& array = frame().object->arrays[statement.symbol];
    const bool certain = uncertain_ == 0 && !graph().depends_on_parameters(index);
    const bool said = program_.expressions[statement.index].kind == ExpressionKind::number;  // by the parser
    if (certain || !said)
        report(certain ? Severity::error : Severity::warning, "HF104", statement.target_span,
               fmt::format("index {} is out of range for `{}[{}]`", i, array.name, array.size),
               "this item does not exist", fmt::format("indexes run from 1 to {}", array.size));
    poison(items);
}

void Lowerer::assign_computed_item(const StatementNode& statement, NodeId value, NodeId index) {
    Items& items = frame().arrays[statement.symbol];
    const auto size = static_cast<double>(items.size());
    if (!step(2 * static_cast<std::int64_t>(items.size()))) return;
    const NodeId rounded = make(Op::round, {index});
    const NodeId in_range = make(Op::logical_and, {make(Op::less_equal, {constant(1), rounded}),
                                                   make(Op::less_equal, {rounded, constant(size)})});
    const NodeId nothing = graph().undefined();
    std::vector<NodeId>& out = items.writable();
    for (std::size_t k = 0; k < out.size() && !graph().over_limit(); ++k) {
        const NodeId hit = make(Op::equal, {rounded, constant(static_cast<double>(k + 1))});
        const NodeId kept = out[k] == unassigned ? nothing : make(Op::select, {in_range, out[k], nothing});
        out[k] = make(Op::select, {hit, value, kept});
    }
}

void Lowerer::branch(const StatementNode& statement) {
    const NodeId condition = evaluate(statement.value);
    if (stopped()) return;
    Effects inside = effects_.of_statements(*frame().object, statement.first);
    inside.merge(effects_.of_statements(*frame().object, statement.second));
    auto value = graph().constant_value(condition);
    if (!value && inside.needs_statements()) value = known(condition);
    if (value && *value == *value) {
        const double tolerance = 1e-6;
        execute(math::abs(*value) >= tolerance ? statement.first : statement.second);
    } else if (in_region() && selecting_ == 0 && inside.needs_statements()) {
        region_branch(statement, condition);
    } else {
        branch_select(statement, condition);
    }
}

void Lowerer::branch_select(const StatementNode& statement, NodeId condition) {
    const NodeId taken = make(Op::truth, {condition});
    const Frame before = frame();
    const NodeId guard = guard_;
    step(static_cast<std::int64_t>(before.scalars.size() / 4 + before.arrays.size()));
    ++uncertain_;
    ++selecting_;
    if (!in_region()) guard_ = make(Op::logical_and, {guard, taken});
    execute(statement.first);
    const Frame first = std::move(frame());
    frame() = before;
    if (!in_region()) guard_ = make(Op::logical_and, {guard, make(Op::logical_not, {taken})});
    execute(statement.second);
    const Frame second = std::move(frame());
    frame() = before;
    guard_ = guard;
    --selecting_;
    --uncertain_;
    if (!stopped()) merge_frames(frame(), first, second, taken);
}

NodeId Lowerer::merge(NodeId condition, NodeId a, NodeId b) {
    if (a == b) return a;
    const NodeId first = a == unassigned ? graph().undefined() : a;
    const NodeId second = b == unassigned ? graph().undefined() : b;
    return make(Op::select, {condition, first, second});
}

void Lowerer::merge_frames(Frame& out, const Frame& first, const Frame& second, NodeId condition) {
    for (std::size_t i = 0; i < out.scalars.size(); ++i)
        out.scalars[i] = merge(condition, first.scalars[i], second.scalars[i]);
    for (std::size_t i = 0; i < out.arrays.size(); ++i) {
        if (first.arrays[i].shares(second.arrays[i])) {
            out.arrays[i] = first.arrays[i];
            continue;
        }
        if (!step(static_cast<std::int64_t>(first.arrays[i].size()))) return;
        std::vector<NodeId>& items = out.arrays[i].writable();
        for (std::size_t k = 0; k < items.size(); ++k)
            items[k] = merge(condition, first.arrays[i][k], second.arrays[i][k]);
    }
}

void Lowerer::loop(const StatementNode& statement, StatementId id) {
    if (!never_unroll_.contains(id)) {
        const Snapshot before = take_snapshot();
        const Unrolled outcome = unroll(statement, id);
        if (outcome == Unrolled::done || outcome == Unrolled::stopped) return;
        restore(before);
        never_unroll_.insert(id);
    }
    if (in_region())
        region_loop(statement, id);
    else
        region(statement, id);
}

bool Lowerer::never_ends(const StatementNode& statement, StatementId id) {
    const Effects condition = effects_.of_expression(*frame().object, statement.value);
    const Effects& body = effects_.of_statement(*frame().object, id);
    auto meet = [](const std::set<std::uint32_t>& a, const std::set<std::uint32_t>& b) {
        return std::any_of(a.begin(), a.end(), [&](std::uint32_t i) { return b.contains(i); });
    };
    return !meet(condition.scalars_read, body.scalars_written) &&
           !meet(condition.arrays_read, body.arrays_written);
}

void Lowerer::forget_written(StatementId id) {
    const Effects& written = effects_.of_statement(*frame().object, id);
    for (std::uint32_t i : written.scalars_written) frame().scalars[i] = graph().undefined();
    for (std::uint32_t i : written.arrays_written) poison(frame().arrays[i]);
}

void Lowerer::refuse_loop(const StatementNode& statement, NodeId condition, std::int64_t steps) {
    const bool certain = uncertain_ == 0 && !graph().depends_on_parameters(condition);
    const Severity severity = certain ? Severity::error : Severity::warning;
    const Span place = program_.expressions[statement.value].span;
    if (steps == 0)
        report(severity, "HF107", place, "this loop never ends", "always true",
               "change a variable of the condition in the loop");
    else
        report(severity, "HF102", place, fmt::format("this loop takes more than {} steps", steps),
               "still true", "make the loop shorter; until then the values that it computes are undefined");
}

Lowerer::Unrolled Lowerer::unroll(const StatementNode& statement, StatementId id) {
    constexpr std::int64_t endless = 1'000'000;
    const std::size_t start = graph().size();
    for (std::int64_t count = 0;; ++count) {
        const NodeId condition = evaluate(statement.value);
        if (stopped()) return Unrolled::stopped;
        const auto value = known(condition);
        if (!value) return Unrolled::depends_on_point;
        const bool undefined = *value != *value;
        if (undefined) forget_written(id);
        if (undefined || math::abs(*value) < 1e-6) return Unrolled::done;
        if (count == endless || (count == 0 && never_ends(statement, id))) {
            refuse_loop(statement, condition, count);
            forget_written(id);
            return Unrolled::done;
        }
        execute(statement.first);
        if (stopped()) return Unrolled::stopped;
        const bool check = count + 1 == unroll_limit || graph().size() - start > unroll_node_limit ||
                           (count >= unroll_limit && count % unroll_limit == 0);
        if (check && !drop_constants_since(start)) return Unrolled::too_long;
    }
}

}  // namespace frep::lang
