// Implementation of colored_union.h.
#include "frep/field/colored_union.h"

#include "frep/base/result.h"
#include "frep/field/copy.h"
#include "frep/field/expression.h"

namespace frep {

namespace {

/// The part's function as nodes of `graph`.
Expression copied(Graph& graph, const ColoredPart& part) {
    const Graph& from = *part.field.graph;
    const NodeId root = copy_of_root(graph, from, part.field.value,
                                     [&](NodeId id, std::span<const NodeId>) -> std::optional<NodeId> {
                                         const Node& node = from.node(id);
                                         if (node.op == Op::parameter)
                                             return graph.constant(part.field.parameters[node.payload]);
                                         if (node.op != Op::coordinate) return std::nullopt;
                                         for (const auto& [coordinate, value] : part.frozen)
                                             if (static_cast<std::uint32_t>(coordinate) == node.payload)
                                                 return graph.constant(value);
                                         return std::nullopt;
                                     });
    return {graph, root};
}

}  // namespace

Field colored_union(std::span<const ColoredPart> parts) {
    FREP_CHECK(!parts.empty());
    auto graph = std::make_shared<Graph>();
    Expression whole = copied(*graph, parts[0]);
    std::array<Expression, 3> color;
    for (std::size_t k = 0; k < 3; ++k) color[k] = {*graph, graph->constant(parts[0].color[k])};
    for (const ColoredPart& part : parts.subspan(1)) {
        FREP_CHECK(part.field.coordinates == parts[0].field.coordinates);
        const Expression f = copied(*graph, part), is_larger = less(whole, f);
        for (std::size_t k = 0; k < 3; ++k)
            color[k] = select(is_larger, Expression::constant(f, part.color[k]), color[k]);
        whole = max(whole, f);
    }
    Field out;
    out.value = whole.id();
    for (const Expression& channel : color) out.attributes.push_back(channel.id());
    out.coordinates = parts[0].field.coordinates;
    out.graph = std::move(graph);
    return out;
}

}  // namespace frep
