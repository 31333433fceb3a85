// Nodes of one graph made in another one, with some of them replaced on the way: how functions are joined,
// bound, mapped and varied. One loop, arguments first. Tested by tests/unit/field/copy_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "frep/field/graph.h"

namespace frep {

/// What stands for node `id` of the graph that is copied, a node of the new one; `arguments` are what stands
/// for its arguments. Nothing: the node itself is copied.
using NodeReplacement = std::function<std::optional<NodeId>(NodeId id, std::span<const NodeId> arguments)>;

/// Makes the nodes of `from` that are marked in `needed` (closed under arguments) in `to`, with their places
/// in the text; made[id] receives what stands for node `id`. Both have from.size() items. Equal nodes that
/// `to` has are used again, and what is constant is folded.
void copy_nodes(Graph& to, const Graph& from, const std::vector<bool>& needed, std::span<NodeId> made,
                const NodeReplacement& replacement = {});

/// The same for what `root` needs; gives what stands for it.
NodeId copy_of_root(Graph& to, const Graph& from, NodeId root, const NodeReplacement& replacement = {});

}  // namespace frep
