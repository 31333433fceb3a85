// Depth-first order with an explicit stack; see order.h.
#include "frep/eval/order.h"

#include <algorithm>

namespace frep {

Scheduler::Scheduler(const Graph& graph) : graph_(graph), need_(graph.size(), 0), placed_(graph.size(), 0) {}

const std::vector<NodeId>& Scheduler::schedule(std::span<const NodeId> roots) {
    collect(roots);
    label();
    walk(roots);
    for (NodeId id : nodes_) need_[id] = placed_[id] = 0;
    return order_;
}

void Scheduler::collect(std::span<const NodeId> roots) {
    nodes_.clear();
    std::vector<NodeId>& open = sorted_;
    open.assign(roots.begin(), roots.end());
    while (!open.empty()) {
        const NodeId id = open.back();
        open.pop_back();
        if (need_[id]) continue;
        need_[id] = 1;
        nodes_.push_back(id);
        for (NodeId argument : graph_.arguments(id))
            if (!need_[argument]) open.push_back(argument);
    }
    if (nodes_.size() < need_.size() / 16) {
        std::sort(nodes_.begin(), nodes_.end());
        return;
    }
    nodes_.clear();
    for (NodeId id = 0; id < need_.size(); ++id)
        if (need_[id]) nodes_.push_back(id);
}

/// The label of a node whose arguments are computed in order of falling labels: the i-th one needs its own
/// label while i results wait.
void Scheduler::label() {
    for (NodeId id : nodes_) {
        const auto arguments = graph_.arguments(id);
        if (arguments.size() < 2) {
            need_[id] = arguments.empty() ? 1 : need_[arguments[0]];
            continue;
        }
        if (arguments.size() == 2) {
            const std::uint32_t a = need_[arguments[0]], b = need_[arguments[1]];
            need_[id] = a == b ? a + 1 : std::max(a, b);
            continue;
        }
        sorted_.assign(arguments.begin(), arguments.end());
        std::sort(sorted_.begin(), sorted_.end(), [&](NodeId a, NodeId b) { return need_[a] > need_[b]; });
        std::uint32_t need = 1;
        for (std::uint32_t i = 0; i < sorted_.size(); ++i) need = std::max(need, need_[sorted_[i]] + i);
        need_[id] = need;
    }
}

void Scheduler::walk(std::span<const NodeId> roots) {
    constexpr std::uint64_t leave = std::uint64_t{1} << 32;
    order_.clear();
    order_.reserve(nodes_.size());
    for (NodeId root : roots) {
        stack_.assign(1, root);
        while (!stack_.empty()) {
            const std::uint64_t top = stack_.back();
            const auto id = static_cast<NodeId>(top);
            stack_.pop_back();
            if (top & leave) {
                order_.push_back(id);
                continue;
            }
            if (placed_[id]) continue;
            placed_[id] = 1;
            stack_.push_back(id | leave);
            const auto arguments = graph_.arguments(id);
            sorted_.assign(arguments.begin(), arguments.end());
            if (sorted_.size() == 2) {
                if (need_[sorted_[1]] < need_[sorted_[0]]) std::swap(sorted_[0], sorted_[1]);
            } else if (sorted_.size() > 2) {
                std::stable_sort(sorted_.begin(), sorted_.end(),
                                 [&](NodeId a, NodeId b) { return need_[a] < need_[b]; });
            }
            for (NodeId argument : sorted_)  // the last one pushed is computed first
                if (!placed_[argument]) stack_.push_back(argument);
        }
    }
}

}  // namespace frep
