// What a condition says about the cells it reads: the points of a box that take one side of a branch or stay
// in a loop have contents for which the condition holds (or fails). Backward propagation through the
// expression, as in HC4 (F. Benhamou et al., ICLP 1999), one pass. Tested by
// tests/unit/eval/region_interval_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "frep/field/graph.h"
#include "frep/math/interval.h"

namespace frep {

/// Narrows `cells` to contents for which the node `condition` of `body` is defined and true (or false, as
/// `truth` says). `values`: enclosures of the nodes below it. `assigned`: the assignments that were made
/// since these were computed, all of nodes with such values; empty when `cells` are what they were computed
/// from. False when no point can have such cells, which are then not meant. Work is bounded by a small
/// constant and the number of cells.
bool narrow(const Graph& body, std::span<const math::Interval> values, NodeId condition, bool truth,
            std::span<const std::pair<std::uint32_t, NodeId>> assigned, std::span<math::Interval> cells);

}  // namespace frep
