// find_undefined: from an undefined root back along undefined arguments that were used, to the nodes where
// the undefined value begins. Method: one scalar walk for the values, then one backward pass over the arena.
// Tested by tests/unit/eval/undefined_test.cpp.

#include "frep/eval/float_control.h"
#include "frep/eval/reference.h"
#include "frep/field/kernels/basic.h"

namespace frep {
namespace {

/// Goes from node to node towards the causes.
class Search {
  public:
    Search(const Field& field, const GraphWalk<double>& walk)
        : graph_(*field.graph), walk_(walk), marked_(graph_.size(), false) {}

    std::vector<UndefinedCause> run(NodeId root) {
        std::vector<UndefinedCause> causes;
        mark(root);
        for (NodeId id = root + 1; id-- > 0;) {
            if (!marked_[id]) continue;
            if (graph_.node(id).op == Op::region) {
                if (!mark_arguments(graph_.arguments(id))) causes.push_back(cause_in_region(id));
            } else if (!follow(id)) {
                causes.push_back({id, graph_.origin(id)});
            }
        }
        return causes;
    }

  private:
    bool undefined(NodeId id) const { return math::is_nan(walk_.value(id)); }

    bool mark(NodeId id) {
        marked_[id] = marked_[id] || undefined(id);
        return undefined(id);
    }

    bool mark_arguments(std::span<const NodeId> arguments) {
        bool found = false;
        for (const NodeId argument : arguments) found = mark(argument) || found;
        return found;
    }

    /// Marks the undefined arguments that the node used; false when there are none.
    bool follow(NodeId id) {
        const Node& node = graph_.node(id);
        const auto arguments = graph_.arguments(id);
        if (node.op == Op::output) {
            marked_[arguments[0]] = true;
            return true;
        }
        if (node.op == Op::select) {
            if (mark(arguments[0])) return true;
            return mark(arguments[kernels::is_true(walk_.value(arguments[0])) ? 1 : 2]);
        }
        if (node.op == Op::pick && node.payload == 0) {
            if (mark(arguments[0])) return true;
            const double index = math::round_half_up(walk_.value(arguments[0]));
            if (!(index >= 1.0 && index < static_cast<double>(arguments.size()))) return false;
            return mark(arguments[static_cast<std::size_t>(index)]);
        }
        return mark_arguments(arguments);
    }

    /// A region with defined arguments: the condition that was undefined or the loop with too many steps, or
    /// the region as a whole.
    UndefinedCause cause_in_region(NodeId id) const {
        const ScalarRegion<double>* region = walk_.region(id);
        const RegionStatement* failed = region ? region->failed() : nullptr;
        return {id, failed ? failed->origin : graph_.origin(id)};
    }

    const Graph& graph_;
    const GraphWalk<double>& walk_;
    std::vector<bool> marked_;
};

}  // namespace

std::vector<UndefinedCause> find_undefined(const Field& field, NodeId root, std::span<const double> point,
                                           std::int64_t max_steps) {
    const FloatControl control;
    GraphWalk<double> walk(field, {&root, 1}, max_steps);
    walk.run(point);
    if (!math::is_nan(walk.value(root))) return {};
    return Search(field, walk).run(root);
}

}  // namespace frep
