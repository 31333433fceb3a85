// Lowering of loops that depend on the point: one region a loop, with structured statements over cells. See
// lowerer.h for the invariant that flush() keeps.
#include <algorithm>

#include <fmt/format.h>

#include "frep/lang/lowerer.h"

namespace frep::lang {

bool Lowerer::is_steady(NodeId id) const {
    const Node& node = target_.graph->node(id);
    return node.op == Op::constant || node.op == Op::undefined ||
           (node.op == Op::cell && steady_cells_.contains(node.payload));
}

std::uint32_t Lowerer::new_steady_cell() {
    const std::uint32_t cell = new_cell();
    steady_cells_.insert(cell);
    return cell;
}

NodeId Lowerer::import_node(NodeId outer, std::vector<NodeId>& inputs) {
    if (outer == unassigned) return unassigned;
    const Graph& model = *outer_graph_;
    if (model.node(outer).op == Op::constant) return constant(model.constant_of(outer));
    const auto [entry, fresh] = imports_.try_emplace(outer, 0);
    if (fresh) {
        entry->second = new_steady_cell();
        target_.region->inputs.push_back(entry->second);
        inputs.push_back(outer);
    }
    return graph().make(Op::cell, {}, entry->second);
}

void Lowerer::import_frame(const Frame& outer, const Effects& effects, Frame& inner,
                           std::vector<NodeId>& inputs) {
    for (const auto* set : {&effects.scalars_read, &effects.scalars_written})
        for (std::uint32_t i : *set) inner.scalars[i] = import_node(outer.scalars[i], inputs);
    for (const auto* set : {&effects.arrays_read, &effects.arrays_written})
        for (std::uint32_t i : *set) {
            if (!step(static_cast<std::int64_t>(outer.arrays[i].size()))) return;
            std::vector<NodeId> items;
            for (NodeId id : outer.arrays[i].all()) items.push_back(import_node(id, inputs));
            inner.arrays[i] = Items(std::move(items));
        }
}

void Lowerer::region(const StatementNode& statement, StatementId id) {
    ++guarded_uses_;
    report(
        Severity::note, "HF110", program_.expressions[statement.value].span,
        "this loop runs a different number of steps from point to point", "depends on the point",
        "the model works; where the steps differ much within a small part of space, nothing is known about "
        "the part as a whole, and every point of it is looked at");
    const Effects effects = effects_.of_statement(*frame().object, id);
    const auto region = std::make_shared<Region>();
    region->origin = statement.span;
    const Target outer = target_;
    const int selecting = std::exchange(selecting_, 0);
    auto memo = std::exchange(memo_, {});
    auto imports = std::exchange(imports_, {});
    auto steady = std::exchange(steady_cells_, {});
    const Graph* const model = std::exchange(outer_graph_, target_.graph);
    std::vector<NodeId> inputs;
    Frame inner = make_frame(*frame().object);
    target_ = {&region->body, region.get(), &region->program, frames_.size(), pending_.size(), 0};
    graph().set_origin(statement.span);
    import_frame(frames_.back(), effects, inner, inputs);
    frames_.push_back(std::move(inner));
    if (!stopped()) region_loop(statement, id);
    inner = std::move(frames_.back());
    frames_.pop_back();
    target_ = outer;
    selecting_ = selecting;
    memo_ = std::move(memo);
    imports_ = std::move(imports);
    steady_cells_ = std::move(steady);
    outer_graph_ = model;
    if (stopped()) return;
    inputs.insert(inputs.begin(), guard_);
    const Graph& body = region->body;
    const NodeId node = graph().make_region(region, inputs);
    auto exported = [&](NodeId value) {
        const Node& n = body.node(value);
        return n.op == Op::constant ? constant(body.constant_of(value))
                                    : graph().make(Op::output, {node}, n.payload);
    };
    for (std::uint32_t i : effects.scalars_written)
        if (inner.scalars[i] != unassigned) frame().scalars[i] = exported(inner.scalars[i]);
    for (std::uint32_t i : effects.arrays_written) {
        std::vector<NodeId> items(inner.arrays[i].all());
        for (NodeId& item : items)
            if (item != unassigned) item = exported(item);
        frame().arrays[i] = Items(std::move(items));
    }
}

void Lowerer::add_statement(RegionStatement statement) {
    statement.origin = graph().current_origin();
    target_.statements->push_back(static_cast<std::uint32_t>(target_.region->statements.size()));
    target_.region->statements.push_back(std::move(statement));
    step();
}

void Lowerer::flush_scalars(Frame& f, const Effects* forced, Moves& moves) {
    for (std::uint32_t i = 0; i < f.scalars.size(); ++i) {
        NodeId& value = f.scalars[i];
        std::uint32_t& home = f.scalar_cells[i];
        const bool must = forced && forced->scalars_written.contains(i);
        if (!must && (value == unassigned || is_steady(value))) continue;
        const bool at_home = value != unassigned && home != no_cell && graph().node(value).op == Op::cell &&
                             graph().node(value).payload == home;
        if (at_home) continue;
        if (home == no_cell) home = new_cell();
        if (value != unassigned) moves.emplace_back(home, value);
        value = graph().make(Op::cell, {}, home);
    }
}

std::uint32_t Lowerer::home_of_array(Frame& f, std::size_t array) {
    std::uint32_t& home = f.array_homes[array];
    if (home == no_cell) {
        Region& region = *target_.region;
        const auto size = static_cast<std::uint32_t>(f.arrays[array].size());
        home = static_cast<std::uint32_t>(region.arrays.size());
        region.arrays.push_back({region.cell_count, size});
        region.cell_count += size;
    }
    return home;
}

void Lowerer::flush_array(Frame& f, std::uint32_t array, bool forced, Moves& moves) {
    const std::vector<NodeId>& items = f.arrays[array].all();
    const bool has_home = f.array_homes[array] != no_cell;
    const bool steady =
        std::all_of(items.begin(), items.end(), [&](NodeId id) { return id == unassigned || is_steady(id); });
    if (!has_home && !forced && steady) return;
    if (!step(static_cast<std::int64_t>(items.size() / 8))) return;
    const RegionArray home = target_.region->arrays[home_of_array(f, array)];
    std::vector<NodeId> cells(items.size());
    bool changed = false;
    for (std::uint32_t k = 0; k < items.size(); ++k) {
        cells[k] = graph().make(Op::cell, {}, home.first_cell + k);
        if (items[k] == cells[k]) continue;
        changed = true;
        if (items[k] != unassigned) moves.emplace_back(home.first_cell + k, items[k]);
    }
    if (changed) f.arrays[array] = Items(std::move(cells));
}

void Lowerer::flush(const Effects* forced, Moves moves) {
    for (std::size_t i = target_.first_frame; i < frames_.size(); ++i) {
        Frame& f = frames_[i];
        const Effects* const own = i + 1 == frames_.size() ? forced : nullptr;
        if (!step(static_cast<std::int64_t>(f.scalars.size() / 8 + f.arrays.size()))) return;
        flush_scalars(f, own, moves);
        for (std::uint32_t a = 0; a < f.arrays.size(); ++a)
            flush_array(f, a, own && own->arrays_written.contains(a), moves);
    }
    for (std::size_t i = target_.first_pending; i < pending_.size(); ++i) {
        if (is_steady(pending_[i])) continue;
        const std::uint32_t cell = new_steady_cell();
        moves.emplace_back(cell, pending_[i]);
        pending_[i] = graph().make(Op::cell, {}, cell);
    }
    if (moves.empty()) return;
    step(static_cast<std::int64_t>(moves.size()));
    RegionStatement statement;
    statement.assignments = std::move(moves);
    add_statement(std::move(statement));
}

bool Lowerer::may_nest() {
    if (target_.nesting < Region::nesting_limit) return true;
    stop("HF103", fmt::format("more than {} loops and branches inside one another", Region::nesting_limit),
         "use fewer levels of loops and calls");
    return false;
}

void Lowerer::region_loop(const StatementNode& statement, StatementId id) {
    if (!may_nest()) return;
    const Effects effects = effects_.of_statement(*frame().object, id);
    flush(&effects);
    const NodeId first = evaluate(statement.value);
    const std::uint32_t condition = new_cell();
    flush(&effects, {{condition, first}});
    if (stopped()) return;
    RegionStatement out;
    out.kind = RegionStatement::Kind::loop;
    out.condition = graph().make(Op::cell, {}, condition);
    auto* const list = std::exchange(target_.statements, &out.first);
    ++target_.nesting;
    ++uncertain_;
    execute(statement.first);
    if (!stopped()) {
        const NodeId again = evaluate(statement.value);
        flush(&effects, {{condition, again}});
    }
    --uncertain_;
    --target_.nesting;
    target_.statements = list;
    add_statement(std::move(out));
}

std::vector<Frame> Lowerer::region_frames() const {
    return {frames_.begin() + static_cast<std::ptrdiff_t>(target_.first_frame), frames_.end()};
}

void Lowerer::restore_frames(std::vector<Frame> frames) {
    frames_.resize(target_.first_frame);
    std::move(frames.begin(), frames.end(), std::back_inserter(frames_));
}

void Lowerer::region_branch(const StatementNode& statement, NodeId condition) {
    if (!may_nest()) return;
    Effects effects = effects_.of_statements(*frame().object, statement.first);
    effects.merge(effects_.of_statements(*frame().object, statement.second));
    const std::uint32_t cell = new_cell();
    flush(&effects, {{cell, condition}});
    RegionStatement out;
    out.kind = RegionStatement::Kind::branch;
    out.condition = graph().make(Op::cell, {}, cell);
    const std::vector<Frame> before = region_frames();
    auto* const list = target_.statements;
    ++target_.nesting;
    ++uncertain_;
    for (auto [statements, side] :
         {std::pair{&statement.first, &out.first}, {&statement.second, &out.second}}) {
        target_.statements = side;
        execute(*statements);
        if (stopped()) break;
        flush(&effects);
        restore_frames(before);
    }
    --uncertain_;
    --target_.nesting;
    target_.statements = list;
    add_statement(std::move(out));
}

void Lowerer::region_store(const StatementNode& statement, NodeId value, NodeId index) {
    Effects written;
    written.arrays_written.insert(statement.symbol);
    const std::uint32_t value_cell = new_cell();
    const std::uint32_t index_cell = new_cell();
    flush(&written, {{value_cell, value}, {index_cell, index}});
    if (stopped()) return;
    RegionStatement out;
    out.kind = RegionStatement::Kind::store;
    out.array = frame().array_homes[statement.symbol];
    out.value = graph().make(Op::cell, {}, value_cell);
    out.index = graph().make(Op::cell, {}, index_cell);
    add_statement(std::move(out));
}

}  // namespace frep::lang
