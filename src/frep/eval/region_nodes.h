// What the statements of a region compute: for each of them the nodes of the region's body that its
// expressions need. Shared by the executors that walk the body node by node. Tested through
// tests/unit/eval/region_test.cpp.
#pragma once

#include <vector>

#include "frep/field/region.h"

namespace frep {

/// By statement number: the nodes of `region.body` below its expressions, arguments first (ascending). Work
/// grows with what the statements need, not with the graph.
std::vector<std::vector<NodeId>> nodes_by_statement(const Region& region);

}  // namespace frep
