// The order in which a tape computes the nodes of a graph: depth first from the roots, at each node the
// argument that keeps more values alive first (Sethi and Ullman 1970), so that few registers live at a time.
// Tested by tests/unit/eval/tape_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frep/field/graph.h"

namespace frep {

/// Finds orders in one graph. Work and memory of a call are linear in the nodes and arguments that its roots
/// need (times a logarithm), so that many small calls on one large graph stay cheap.
class Scheduler {
  public:
    explicit Scheduler(const Graph& graph);

    /// The nodes that `roots` need, arguments before users.
    const std::vector<NodeId>& schedule(std::span<const NodeId> roots);

  private:
    void collect(std::span<const NodeId> roots);
    void label();
    void walk(std::span<const NodeId> roots);

    const Graph& graph_;
    std::vector<std::uint32_t> need_;   ///< by node: values alive at once, 0 = not collected
    std::vector<std::uint8_t> placed_;  ///< by node: 1 = entered
    std::vector<NodeId> nodes_;         ///< collected, ascending
    std::vector<NodeId> order_;
    std::vector<NodeId> sorted_;
    std::vector<std::uint64_t> stack_;
};

}  // namespace frep
