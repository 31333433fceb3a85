// Implementation of copy.h.
#include "frep/field/copy.h"

namespace frep {

void copy_nodes(Graph& to, const Graph& from, const std::vector<bool>& needed, std::span<NodeId> made,
                const NodeReplacement& replacement) {
    std::vector<std::uint32_t> block_names;
    std::vector<NodeId> arguments;
    for (NodeId id = 0; id < from.size(); ++id) {
        if (!needed[id]) continue;
        arguments.clear();
        for (const NodeId argument : from.arguments(id)) arguments.push_back(made[argument]);
        to.set_origin(from.origin(id));
        std::optional<NodeId> other;
        if (replacement) other = replacement(id, arguments);
        made[id] = other ? *other : to.make_as(from, id, arguments, block_names);
    }
}

NodeId copy_of_root(Graph& to, const Graph& from, NodeId root, const NodeReplacement& replacement) {
    std::vector<NodeId> made(from.size(), 0);
    copy_nodes(to, from, reachable(from, {&root, 1}), made, replacement);
    return made[root];
}

}  // namespace frep
