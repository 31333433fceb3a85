// The expression graph: hash-consed nodes in an arena, arguments before users, so that every pass over a
// graph is one loop and graphs may be a million levels deep (docs/numerics.md, rule 13). A graph under
// construction grows by make(); finished graphs are held by a Field and never change. Tested by
// tests/unit/field/graph_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "frep/base/source.h"
#include "frep/field/op.h"

namespace frep {

using NodeId = std::uint32_t;

/// One operation. `payload`: constant table index (constant), input index (coordinate, parameter), cell
/// number (cell, output), array number (load), region number (region), or data block number + 1 (kind block;
/// 0 = the data items are arguments).
struct Node {
    Op op;
    std::uint32_t payload;
    std::uint32_t first_argument;
    std::uint32_t argument_count;
};

struct Region;

class Graph {
  public:
    /// Nodes that a graph may have; make() beyond it sets over_limit() and answers an arbitrary node.
    static constexpr std::size_t node_limit = 1'000'000;

    Graph();
    ~Graph();
    Graph(const Graph&) = delete;
    Graph& operator=(const Graph&) = delete;
    Graph(Graph&&) noexcept;
    Graph& operator=(Graph&&) noexcept;

    NodeId constant(double value);
    NodeId coordinate(int index);
    NodeId parameter(int index);
    /// A value that exists nowhere; every call for another place makes another node.
    NodeId undefined();
    /// The node for `op` on `arguments`: an existing equal one, a simpler equivalent (bit for bit, NaN
    /// included), or a new one. Foldable operations on constants give a constant.
    NodeId make(Op op, std::span<const NodeId> arguments, std::uint32_t payload = 0);
    NodeId make(Op op, std::initializer_list<NodeId> arguments, std::uint32_t payload = 0) {
        return make(op, std::span<const NodeId>(arguments.begin(), arguments.size()), payload);
    }
    /// An op of kind block: `lead` arguments, then data. All-constant data go into a block of the graph.
    NodeId make_block(Op op, std::span<const NodeId> lead, std::span<const NodeId> data);
    /// The same for data that are numbers: no nodes are made of them.
    NodeId make_block(Op op, std::span<const NodeId> lead, std::vector<double> data);
    /// A region with its arguments (guard first); the graph shares ownership.
    NodeId make_region(std::shared_ptr<const Region> region, std::span<const NodeId> arguments);

    /// Node `id` of graph `from`, made here on `arguments`: nodes of this graph, one for each of its own.
    /// `block_names` remembers the blocks that came along: empty at first, one for all calls with `from`.
    NodeId make_as(const Graph& from, NodeId id, std::span<const NodeId> arguments,
                   std::vector<std::uint32_t>& block_names);

    /// Room for `nodes` nodes with two arguments each, so that making them moves nothing.
    void reserve(std::size_t nodes);

    std::size_t size() const { return nodes_.size(); }
    const Node& node(NodeId id) const { return nodes_[id]; }
    std::span<const NodeId> arguments(NodeId id) const {
        return {arguments_.data() + nodes_[id].first_argument, nodes_[id].argument_count};
    }
    /// The number of a constant node.
    double constant_of(NodeId id) const { return constants_[nodes_[id].payload]; }
    /// The data block of a node of kind block; empty when its data items are arguments.
    std::span<const double> block_of(NodeId id) const;
    const Region& region_of(NodeId id) const { return *regions_[nodes_[id].payload]; }

    /// The value where it is the same at all points and for all parameters (NaN included).
    std::optional<double> constant_value(NodeId id) const;
    /// The value where it is the same at all points, for the present parameters.
    std::optional<double> bound_value(NodeId id) const;
    /// True when the node's value changes with a parameter.
    bool depends_on_parameters(NodeId id) const { return (flags_[id] & parameter_flag) != 0; }
    bool depends_on_point(NodeId id) const { return (flags_[id] & point_flag) != 0; }

    /// Present parameter values, used by bound_value(); set before the first node is made.
    void set_parameters(std::vector<double> values) { parameters_ = std::move(values); }
    const std::vector<double>& parameters() const { return parameters_; }

    /// Place in the model's text given to nodes made from now on, and the place a node was first made for.
    void set_origin(Span origin) { origin_ = origin; }
    Span current_origin() const { return origin_; }
    Span origin(NodeId id) const { return origins_[id]; }

    bool over_limit() const { return over_limit_; }

    /// Forgets every node made since the graph had `size` nodes.
    void truncate(std::size_t size);

    /// A graph with the nodes marked in `needed` (closed under arguments), in the same order; `renamed`
    /// receives their new numbers.
    Graph copy_of(const std::vector<bool>& needed, std::span<NodeId> renamed) const;

    /// As copy_of(), with parameter i replaced by the constant parameters[i] and what then is constant
    /// folded.
    Graph bound_copy(const std::vector<bool>& needed, std::span<const double> parameters,
                     std::span<NodeId> renamed) const;

  private:
    static constexpr std::uint8_t point_flag = 1, parameter_flag = 2;

    NodeId insert(Op op, std::span<const NodeId> arguments, std::uint32_t payload, std::uint8_t flags);
    std::optional<NodeId> simplified(Op op, std::span<const NodeId> arguments, std::uint32_t payload);
    double evaluate(Op op, std::span<const NodeId> arguments, std::uint32_t payload) const;
    std::size_t hash(Op op, std::span<const NodeId> arguments, std::uint32_t payload) const;
    bool same(NodeId id, Op op, std::span<const NodeId> arguments, std::uint32_t payload) const;
    void build_table(std::size_t slots);
    double known_value(NodeId id) const;
    void know(NodeId id, double value);
    NodeId append(Op op, std::span<const NodeId> arguments, std::uint32_t payload, std::uint8_t flags);
    using Block = std::shared_ptr<const std::vector<double>>;

    std::uint32_t intern_block(Block values);

    std::vector<Node> nodes_;
    std::vector<NodeId> arguments_;
    std::vector<std::uint8_t> flags_;
    std::vector<Span> origins_;
    std::vector<double> bound_;  ///< by node, as far as it goes: value of an operation or parameter that does
                                 ///< not depend on the point
    std::vector<double> constants_;
    std::vector<Block> blocks_;  ///< shared with the graphs that were made of this one
    std::unordered_multimap<std::uint64_t, std::uint32_t> block_index_;  ///< hash of a block -> its number
    std::vector<std::shared_ptr<const Region>> regions_;
    std::vector<NodeId> table_;  ///< open addressing, free = no_node; made when a node is looked up
    std::vector<double> parameters_;
    Span origin_;
    bool over_limit_ = false;
};

/// The nodes that `roots` need, marked by true; index = NodeId.
std::vector<bool> reachable(const Graph& graph, std::span<const NodeId> roots);

/// A graph with only the nodes that `roots` need, in the same order; `roots` are renumbered.
Graph compact(const Graph& graph, std::span<NodeId> roots);

/// Sum of the costs of the operations that `roots` need, leaves excluded; and their number.
struct OperationCount {
    std::size_t operations = 0;
    std::size_t cost = 0;
};
OperationCount count_operations(const Graph& graph, std::span<const NodeId> roots);

}  // namespace frep
