// A region: a loop that depends on the point, as one node of the graph. Its program is structured (assign,
// store, branch, loop) over a memory of cells, and it runs under a lane mask, so that a branch not taken need
// not end. Expressions of the program are nodes of the region's own graph `body`, whose leaves are constants,
// `cell` (the present content of a cell) and `load` (item of an array of cells). Each statement evaluates its
// expressions against the memory as it stands when the statement starts.
//
// Meaning of the region node, point by point: if the guard (argument 0) is false or undefined, nothing runs
// and all cells are undefined. Else cells start as `inputs` say (others undefined) and the statements run. An
// undefined condition, or more than max_steps loop steps (counted over all loops of the region at this
// point), makes every cell undefined. Tested by tests/unit/eval/region_test.cpp.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "frep/field/graph.h"

namespace frep {

/// A run of cells that `load` and store address by a rounded 1-based index; out of range: load gives
/// undefined, a store makes every item of the array undefined (which item was meant is unknown). Undefined
/// index: the same.
struct RegionArray {
    std::uint32_t first_cell = 0;
    std::uint32_t size = 0;
};

struct RegionStatement {
    enum class Kind : std::uint8_t {
        assign,  ///< all right sides first, then the cells are written
        store,   ///< array[index] = value
        branch,  ///< if condition: first, else: second
        loop,    ///< while condition: first
    };
    Kind kind = Kind::assign;
    std::vector<std::pair<std::uint32_t, NodeId>> assignments;  ///< cell, node of body
    std::uint32_t array = 0;
    NodeId index = 0;
    NodeId value = 0;
    NodeId condition = 0;
    std::vector<std::uint32_t> first;   ///< statement numbers, in order
    std::vector<std::uint32_t> second;  ///< statement numbers, in order
    Span origin;
};

struct Region {
    /// Levels of branch and loop inside one another; deeper ones are refused when the region is made.
    static constexpr int nesting_limit = 256;

    Graph body;
    std::uint32_t cell_count = 0;
    std::vector<std::uint32_t>
        inputs;  ///< argument i + 1 of the region node is the start value of cell inputs[i]
    std::vector<RegionArray> arrays;
    std::vector<RegionStatement> statements;  ///< pool; no statement contains itself
    std::vector<std::uint32_t> program;       ///< numbers of the outermost statements, in order
    Span origin;
};

}  // namespace frep
