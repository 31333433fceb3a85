// Implementation of value_folds.h: demands from the root down, sizes of folds from the leaves up.
#include "frep/field/value_folds.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace frep {
namespace {

constexpr std::size_t most_operands = 1'000'000'000;

bool is_r_function(Op op) { return op == Op::r_and || op == Op::r_or; }

/// True when the sign of the node depends on the signs of its operands alone.
bool keeps_sign_demand(const Graph& graph, NodeId id) {
    const Op op = graph.node(id).op;
    if (info(op).context == OpContext::same) return true;
    if (op != Op::mul && op != Op::div) return false;
    const auto arguments = graph.arguments(id);
    const auto is_factor = [&](NodeId a) {
        const auto value = graph.constant_value(a);
        return value && *value != 0 && *value == *value;
    };
    return is_factor(arguments[1]) || (op == Op::mul && is_factor(arguments[0]));
}

}  // namespace

std::vector<ValueFold> value_folds(const Field& field, std::size_t least_operands) {
    const Graph& graph = *field.graph;
    enum : std::uint8_t { sign = 1, value = 2, in_fold = 4 };
    std::vector<std::uint8_t> demand(graph.size(), 0);
    demand[field.value] = sign;
    for (NodeId id = field.value + 1; id-- > 0;) {
        if ((demand[id] & (sign | value)) == 0) continue;
        const bool keeps = keeps_sign_demand(graph, id);
        const Op op = graph.node(id).op;
        const bool folds = is_r_function(op) || (op == Op::neg && (demand[id] & in_fold) != 0);
        for (const NodeId argument : graph.arguments(id)) {
            demand[argument] |= keeps ? static_cast<std::uint8_t>(demand[id] & (sign | value)) : value;
            if (folds) demand[argument] |= in_fold;
        }
    }
    std::vector<ValueFold> found;
    std::vector<std::size_t> operands(field.value + std::size_t{1}, 1);
    for (NodeId id = 0; id <= field.value; ++id) {
        const Op op = graph.node(id).op;
        if (demand[id] == 0) continue;
        if (op == Op::neg) operands[id] = operands[graph.arguments(id)[0]];
        if (!is_r_function(op)) continue;
        operands[id] = 0;
        for (const NodeId argument : graph.arguments(id))
            operands[id] = std::min(most_operands, operands[id] + operands[argument]);
        const bool is_last = (demand[id] & in_fold) == 0;
        if ((demand[id] & value) != 0 && is_last && operands[id] >= least_operands)
            found.push_back({id, operands[id]});
    }
    return found;
}

}  // namespace frep
