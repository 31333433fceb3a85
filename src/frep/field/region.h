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
//
// A search looks for the largest value that an expression takes over a box of one to three variables
// (field/search.h makes such regions). It leaves the variables at a place t* of the box and the value there
// in the cell `result`: nowhere in the box is the expression larger by more than tolerance * max(1, |value|)
// and the rounding of the expression itself, which is proved by intervals (eval/box_search.h). Where the
// expression is undefined it counts as smaller than any number. A search that needs more than
// Region::search_limit boxes is not finished, and every cell is undefined. The variables at t* do not change
// with the point, so that derivatives of the result are those of the expression at t*, which by the envelope
// theorem are those of the maximum (P. Milgrom, I. Segal, Econometrica 70, 2002).
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
        search,  ///< the largest `value`, computed after `first`, over the box [0, 1]^n of `variables`
    };
    Kind kind = Kind::assign;
    std::vector<std::pair<std::uint32_t, NodeId>> assignments;  ///< cell, node of body
    std::uint32_t array = 0;
    NodeId index = 0;
    NodeId value = 0;
    NodeId condition = 0;
    std::vector<std::uint32_t> first;      ///< statement numbers, in order
    std::vector<std::uint32_t> second;     ///< statement numbers, in order
    std::vector<std::uint32_t> variables;  ///< of a search: one to three cells
    bool in_ball = false;                  ///< only in the ball within the box: |t - 1/2| <= 1/2
    double tolerance = 0;                  ///< above 0
    std::uint32_t result = 0;              ///< of a search: cell of the largest value
    Span origin;
};

struct Region {
    /// Levels of branch and loop inside one another; deeper ones are refused when the region is made.
    static constexpr int nesting_limit = 256;
    /// Boxes and points that the searches of a region may look at for one point, inner ones included.
    static constexpr int search_limit = 1 << 15;

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
