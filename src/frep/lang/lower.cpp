#include "frep/lang/lower.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/base/stack.h"
#include "frep/field/search.h"
#include "frep/lang/limits.h"
#include "frep/lang/lowerer.h"

namespace frep::lang {

void Lowerer::report(Severity severity, const char* code, Span span, const std::string& message,
                     const std::string& label, const std::string& help) {
    if (!reported_.emplace(code, span.begin).second || reported_.size() > diagnostic_limit) return;
    diagnostics_.add({severity, code, message, span, label, help});
}

void Lowerer::stop(const char* code, const std::string& message, const std::string& help) {
    if (stopped_) return;
    stopped_ = true;
    diagnostics_.add(
        {Severity::error, code, message, graph().current_origin(), "while evaluating this", help});
}

bool Lowerer::step(std::int64_t count) {
    steps_ += count;
    if (stopped_) return false;
    if (graph().over_limit())
        stop("HF101", fmt::format("the model needs more than {} operations", Graph::node_limit),
             "make loops shorter, or let them depend on the point so that they stay loops");
    else if (steps_ > options_.step_limit)
        stop("HF102", fmt::format("reading the model takes more than {} steps", options_.step_limit),
             "make loops shorter and calls fewer");
    return !stopped_;
}

Frame Lowerer::make_frame(const Object& object) {
    Frame out;
    out.object = &object;
    out.scalars.assign(object.scalars.size(), unassigned);
    out.scalar_cells.assign(object.scalars.size(), no_cell);
    out.array_homes.assign(object.arrays.size(), no_cell);
    for (const ArrayInfo& array : object.arrays) {
        step(1 + array.size / 8);
        out.arrays.emplace_back(std::vector<NodeId>(array.size, unassigned));
    }
    return out;
}

Lowerer::Snapshot Lowerer::take_snapshot() {
    Snapshot s{};
    s.graph_size = graph().size();
    if (in_region()) {
        s.statement_count = target_.region->statements.size();
        s.list_size = target_.statements->size();
        s.array_count = target_.region->arrays.size();
        s.cell_count = target_.region->cell_count;
    }
    s.frames = region_frames();
    s.pending = pending_;
    for (const Frame& f : s.frames) step(static_cast<std::int64_t>((f.scalars.size() + f.arrays.size()) / 8));
    return s;
}

void Lowerer::restore(const Snapshot& s) {
    forget_memo_from(s.graph_size);
    graph().truncate(s.graph_size);
    structural_seen_.resize(std::min(structural_seen_.size(), s.graph_size));
    if (in_region()) {
        target_.region->statements.resize(s.statement_count);
        target_.statements->resize(s.list_size);
        target_.region->arrays.resize(s.array_count);
        target_.region->cell_count = s.cell_count;
        std::erase_if(steady_cells_, [&](std::uint32_t cell) { return cell >= s.cell_count; });
    }
    restore_frames(s.frames);
    pending_ = s.pending;
}

void Lowerer::forget_memo_from(std::size_t graph_size) {
    std::erase_if(memo_, [&](const auto& entry) { return entry.second.newest >= graph_size; });
}

bool Lowerer::drop_constants_since(std::size_t size) {
    for (std::size_t id = size; id < graph().size(); ++id)
        if (graph().node(static_cast<NodeId>(id)).op != Op::constant) return false;
    std::vector<std::pair<NodeId*, double>> kept;
    auto keep = [&](NodeId& id) {
        if (id != unassigned && id >= size) kept.emplace_back(&id, graph().constant_of(id));
    };
    for (std::size_t i = target_.first_frame; i < frames_.size(); ++i) {
        for (NodeId& id : frames_[i].scalars) keep(id);
        for (Items& items : frames_[i].arrays) {
            if (!step(static_cast<std::int64_t>(items.size() / 8))) return true;
            const bool fresh = std::any_of(items.all().begin(), items.all().end(),
                                           [&](NodeId id) { return id != unassigned && id >= size; });
            if (!fresh) continue;
            for (NodeId& id : items.writable()) keep(id);
        }
    }
    for (std::size_t i = target_.first_pending; i < pending_.size(); ++i) keep(pending_[i]);
    forget_memo_from(size);
    graph().truncate(size);
    structural_seen_.resize(std::min(structural_seen_.size(), size));
    for (auto& [place, value] : kept) *place = graph().constant(value);
    return true;
}

void Lowerer::report_variables(const Graph& model, std::span<const NodeId> roots) {
    const auto refuse = [&](Span span, const std::string& message) {
        report(Severity::error, "HF112", span, message, "made here",
               "a variable has a meaning inside hfMaximum and the like alone");
    };
    const std::vector<bool> needed = reachable(model, roots);
    for (NodeId id = 0; id < needed.size(); ++id) {
        if (!needed[id]) continue;
        const Node& node = model.node(id);
        if (is_search_variable(node))
            refuse(model.origin(id), "a variable of a search is used outside of every search");
        if (node.op != Op::region) continue;
        const Graph& body = model.region_of(id).body;
        for (NodeId inner = 0; inner < body.size(); ++inner)
            if (is_search_variable(body.node(inner)))
                refuse(body.origin(inner),
                       "a loop whose number of steps depends on the point has a variable");
    }
}

std::optional<Lowered> Lowerer::run(std::size_t index) {
    const Object& object = program_.objects[index];
    Graph model;
    std::vector<double> parameters(options_.parameters);
    parameters.resize(static_cast<std::size_t>(object.parameters()), 0.0);
    model.set_parameters(parameters);
    structural_.assign(parameters.size(), false);
    target_ = {&model, nullptr, nullptr, 0, 0, 0};
    guard_ = model.constant(1);
    Frame top = make_frame(object);
    for (int i = 0; i < object.coordinates(); ++i)
        top.arrays[array_x].writable()[static_cast<std::size_t>(i)] = model.coordinate(i);
    for (int i = 0; i < object.parameters(); ++i)
        top.arrays[array_a].writable()[static_cast<std::size_t>(i)] = model.parameter(i);
    for (NodeId& item : top.arrays[array_s].writable()) item = model.constant(0);
    frames_.push_back(std::move(top));
    execute(object.body);
    step(0);  // a limit reached by the last operation
    if (stopped_ || frame().result == unassigned || diagnostics_.has_errors()) return std::nullopt;

    Lowered out;
    std::vector<NodeId> roots{frame().result};
    for (NodeId id : frame().arrays[array_s].all())
        roots.push_back(id == unassigned ? model.undefined() : id);
    report_variables(model, roots);
    if (diagnostics_.has_errors()) return std::nullopt;
    if (const auto value = model.constant_value(roots[0]); value && *value != *value) {
        const StatementNode& last = program_.statements[object.body.back()];
        report(Severity::warning, "HF106", last.target_span,
               fmt::format("`{}` has no value at any point", object.written_name), "always undefined", "");
    }
    Graph compacted = compact(model, roots);
    out.field.graph = std::make_shared<const Graph>(std::move(compacted));
    out.field.value = roots[0];
    out.field.attributes.assign(roots.begin() + 1, roots.end());
    out.field.coordinates = object.coordinates();
    out.field.parameters = std::move(parameters);
    out.structural = structural_;
    out.functions.assign(functions_.begin(), functions_.end());
    out.operations_before = operations_;
    out.has_regions = has_regions(out.field);
    return out;
}

std::optional<Lowered> lower(const Program& program, std::size_t object, const LowerOptions& options,
                             Diagnostics& diagnostics) {
    constexpr std::size_t stack_bytes = 64u << 20;  // depth_limit levels of at most 8 KiB each
    std::optional<Lowered> out;
    run_on_stack(stack_bytes, [&] { out = Lowerer(program, options, diagnostics).run(object); });
    return out;
}

}  // namespace frep::lang
