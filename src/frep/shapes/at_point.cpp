// Implementation of at_point.h.
#include "frep/shapes/at_point.h"

#include <algorithm>

#include "frep/field/meaning.h"
#include "frep/field/search.h"

namespace frep::shapes {

namespace {

/// The number of the item of x that is this node.
std::optional<std::size_t> item_of(Array x, NodeId id) {
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i].id() == id) return i;
    return std::nullopt;
}

/// The nodes below `roots` down to the items of x, which stand for themselves; by NodeId.
std::vector<bool> nodes_above(const Graph& graph, Array roots, Array x) {
    NodeId last = 0;
    for (const Expression& root : roots) last = std::max(last, root.id());
    std::vector<bool> needed(last + 1, false);
    for (const Expression& root : roots) needed[root.id()] = true;
    for (NodeId id = last + 1; id-- > 0;) {
        if (!needed[id]) continue;
        if (item_of(x, id)) continue;
        for (const NodeId argument : graph.arguments(id)) needed[argument] = true;
    }
    return needed;
}

/// True for leaves that mean another value at another point. A variable of a search is the same at all.
bool moves(const Node& node) {
    return node.op == Op::cell || node.op == Op::load ||
           (node.op == Op::coordinate && !is_search_variable(node));
}

/// True for a loop or a search, which has no value of its own before it runs.
bool runs(const Node& node) {
    return node.op == Op::region || node.op == Op::output || node.op == Op::coordinate;
}

}  // namespace

std::optional<Expression> at_point(Build& build, Expression f, Array x, Array p) {
    Graph& graph = build.graph;
    if (x.size() != p.size()) return std::nullopt;
    const std::vector<bool> needed = nodes_above(graph, Array(&f, 1), x);
    std::vector<NodeId> made(f.id() + 1, 0);
    std::vector<NodeId> arguments;
    std::vector<std::uint32_t> block_names;
    for (NodeId id = 0; id <= f.id(); ++id) {
        if (!needed[id]) continue;
        if (const auto item = item_of(x, id)) {
            made[id] = p[*item].id();
            continue;
        }
        if (moves(graph.node(id))) return std::nullopt;
        arguments.clear();
        for (const NodeId argument : graph.arguments(id)) arguments.push_back(made[argument]);
        const bool same = std::ranges::equal(arguments, graph.arguments(id));
        made[id] = same ? id : graph.make_as(graph, id, arguments, block_names);
    }
    return Expression(graph, made[f.id()]);
}

std::optional<std::vector<LocalValue>> values_at(Build& build, Array functions, Array x, const Vec3& p) {
    using Dual = math::Dual<double>;
    const Graph& graph = build.graph;
    const std::vector<bool> needed = nodes_above(graph, functions, x);
    const std::array<double, 3> at{p.x, p.y, p.z};
    std::vector<Dual> values(needed.size());
    std::vector<Dual> arguments;
    for (NodeId id = 0; id < needed.size(); ++id) {
        if (!needed[id]) continue;
        if (const auto item = item_of(x, id)) {
            values[id] = *item < 3 ? Dual::variable(at[*item], static_cast<int>(*item)) : Dual(0.0);
            continue;
        }
        const Node& node = graph.node(id);
        if (moves(node) || runs(node)) return std::nullopt;
        if (info(node.op).kind == OpKind::leaf) {
            const auto number = graph.bound_value(id);
            if (!number) return std::nullopt;
            values[id] = Dual(*number);
            if (node.op == Op::parameter && build.decides) build.decides({build.graph, id});
            continue;
        }
        arguments.clear();
        for (const NodeId argument : graph.arguments(id)) arguments.push_back(values[argument]);
        const auto block =
            info(node.op).kind == OpKind::block ? graph.block_of(id) : std::span<const double>();
        values[id] = meaning<Dual>(node.op, arguments, block);
    }
    std::vector<LocalValue> out;
    for (const Expression& f : functions) {
        const Dual& root = values[f.id()];
        if (root.value != root.value) return std::nullopt;
        out.push_back({root.value, {root.d[0], root.d[1], root.d[2]}});
    }
    return out;
}

std::optional<LocalValue> value_at(Build& build, Expression f, Array x, const Vec3& p) {
    const auto values = values_at(build, Array(&f, 1), x, p);
    return values ? std::optional(values->front()) : std::nullopt;
}

}  // namespace frep::shapes
