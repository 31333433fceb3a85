// Choice of an engine, and the checks that every engine relies on; see evaluator.h.
#include "frep/eval/evaluator.h"

#include <array>
#include <string>

#include "frep/eval/jit_evaluator.h"
#include "frep/eval/reference.h"
#include "frep/eval/vm_evaluator.h"
#include "frep/field/search.h"

namespace frep {
namespace {

constexpr std::array<EngineInfo, 3> engine_table = {{
    {Engine::reference, "reference", "node by node in double precision: slow, the oracle of all others"},
    {Engine::vm, "vm", "tapes over batches of lanes, in the widest registers of the machine"},
    {Engine::jit, "jit", "the vm, and machine code for values where many points are asked for"},
}};

/// Cells of one region; more need too much memory for a single point.
constexpr std::uint32_t cell_limit = 1u << 23;

Status check_region(const Region& region) {
    if (region.cell_count > cell_limit)
        return Error{ErrorKind::over_limit,
                     "a loop needs more than " + std::to_string(cell_limit) + " variables and array items"};
    for (NodeId id = 0; id < region.body.size(); ++id) {
        const Op op = region.body.node(id).op;
        const bool leaf = info(op).kind == OpKind::leaf;
        if (leaf && op != Op::constant && op != Op::cell && op != Op::load && op != Op::undefined)
            return Error{ErrorKind::invalid_argument,
                         "a loop contains the operation '" + std::string(info(op).name) + "'"};
    }
    return {};
}

Status check_field(const Field& field, std::span<const NodeId> roots) {
    const Graph& graph = *field.graph;
    const std::vector<bool> needed = reachable(graph, roots);
    for (NodeId id = 0; id < needed.size(); ++id) {
        if (!needed[id]) continue;
        const Node& node = graph.node(id);
        if (is_search_variable(node))
            return Error{ErrorKind::invalid_argument, "the model uses a variable of a search outside of it"};
        if (node.op == Op::coordinate && node.payload >= static_cast<std::uint32_t>(field.coordinates))
            return Error{ErrorKind::invalid_argument, "the model uses coordinate " +
                                                          std::to_string(node.payload + 1) + " of " +
                                                          std::to_string(field.coordinates)};
        if (node.op == Op::parameter && node.payload >= field.parameters.size())
            return Error{ErrorKind::invalid_argument, "the model uses parameter " +
                                                          std::to_string(node.payload + 1) + " of " +
                                                          std::to_string(field.parameters.size())};
        if (node.op == Op::cell || node.op == Op::load)
            return Error{ErrorKind::invalid_argument, "the model reads a loop's variable outside the loop"};
        if (node.op == Op::region)
            if (Status status = check_region(graph.region_of(id)); !status) return status;
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<Evaluator>> make_evaluator(const Field& field, const EvaluatorOptions& options) {
    if (Status status = check_field(field, field.roots()); !status) return status.error();
    if (options.registers != 0 && options.registers < 3)
        return Error{ErrorKind::invalid_argument, "the vm needs at least 3 registers"};
    const Field bound = bind_parameters(field);
    switch (options.engine) {
        case Engine::reference:
            return make_reference(bound, options);
        case Engine::vm:
            return make_vm(bound, options);
        case Engine::jit:
            return make_jit(bound, options);
    }
    FREP_CHECK(false);
}

std::span<const EngineInfo> engines() { return std::span(engine_table).first(has_jit() ? 3 : 2); }

}  // namespace frep
