// Implementation of region_nodes.h.
#include "frep/eval/region_nodes.h"

#include <algorithm>

namespace frep {

namespace {

std::vector<NodeId> roots_of(const RegionStatement& statement) {
    switch (statement.kind) {
        case RegionStatement::Kind::assign: {
            std::vector<NodeId> roots;
            for (const auto& [cell, node] : statement.assignments) roots.push_back(node);
            return roots;
        }
        case RegionStatement::Kind::store:
            return {statement.index, statement.value};
        case RegionStatement::Kind::search:
            return {statement.value};
        default:
            return {statement.condition};
    }
}

/// The nodes below `roots`, arguments first. Work grows with what the roots need, not with the graph.
std::vector<NodeId> nodes_below(const Graph& graph, std::vector<NodeId> open, std::vector<bool>& seen) {
    std::vector<NodeId> found;
    while (!open.empty()) {
        const NodeId id = open.back();
        open.pop_back();
        if (seen[id]) continue;
        seen[id] = true;
        found.push_back(id);
        for (const NodeId argument : graph.arguments(id)) open.push_back(argument);
    }
    for (const NodeId id : found) seen[id] = false;
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

std::vector<std::vector<NodeId>> nodes_by_statement(const Region& region) {
    std::vector<std::vector<NodeId>> needed;
    std::vector<bool> seen(region.body.size(), false);
    for (const RegionStatement& statement : region.statements)
        needed.push_back(nodes_below(region.body, roots_of(statement), seen));
    return needed;
}

}  // namespace frep
