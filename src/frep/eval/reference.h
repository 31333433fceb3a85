// Engine reference: walks the graph node by node in arena order with meaning<T>, one point or box at a time,
// and runs regions with a plain interpreter of their statements. Slow and obvious: the oracle for all others.
// Tested by tests/unit/eval/conformance_test.cpp and region_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "frep/eval/evaluator.h"
#include "frep/eval/region_interval.h"

namespace frep {

/// Scalar interpreter of a region, for T = double or math::Dual<double>.
template <class T>
class ScalarRegion {
  public:
    ScalarRegion(const Region& region, std::int64_t max_steps);

    /// Runs on guard and start values; cells() then holds the final contents.
    void run(std::span<const T> arguments);
    const std::vector<T>& cells() const { return cells_; }
    /// The statement whose condition was undefined, whose loop had too many steps or whose search was not
    /// finished in the last run.
    const RegionStatement* failed() const { return failed_; }

  private:
    bool execute(std::span<const std::uint32_t> statements);
    bool execute_loop(const RegionStatement& statement, std::uint32_t number);
    void evaluate(std::uint32_t number);
    void store(const RegionStatement& statement);
    bool search(const RegionStatement& statement, std::uint32_t number);
    T load(const Node& node) const;

    const Region& region_;
    std::int64_t max_steps_, steps_ = 0;
    std::vector<std::vector<NodeId>> needed_;  ///< by statement: nodes of body, ascending
    std::vector<T> cells_, values_, arguments_;
    std::unique_ptr<IntervalRegion> searcher_;  ///< made for the first search
    int searched_ = 0;                          ///< boxes and points that searches looked at
    const RegionStatement* failed_ = nullptr;
};

/// Values of all nodes that some roots need, for T = double, math::Dual<double> or math::Interval.
template <class T>
class GraphWalk {
  public:
    GraphWalk(const Field& field, std::span<const NodeId> roots, std::int64_t max_steps);

    /// Computes every node at one point or box.
    void run(std::span<const T> coordinates);
    const T& value(NodeId id) const { return values_[id]; }
    using RegionRun = std::conditional_t<std::is_same_v<T, math::Interval>, IntervalRegion, ScalarRegion<T>>;
    /// After run(): the region of a node of kind region.
    const RegionRun* region(NodeId id) const;

  private:
    T compute(NodeId id, std::span<const T> coordinates);

    const Field& field_;
    std::vector<NodeId> order_;
    std::vector<T> values_, arguments_;
    std::unordered_map<NodeId, RegionRun> regions_;  ///< looked up, never iterated
};

/// The reference engine for `field`.
std::unique_ptr<Evaluator> make_reference(const Field& field, const EvaluatorOptions& options);

}  // namespace frep
