// Writing the tape that stands for another one in some boxes, from what the pass from the root down recorded.
// Used by prune.cpp. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/eval/clause_tape.h"
#include "frep/eval/tile_kernels.h"

namespace frep {

/// Workspace of emit_cut_tape(), kept between calls.
struct CutEmitter {
    std::vector<RowNumber> row_of;  ///< by row of the parent: the row in the cut tape
    RowNumber own_rows = 0;       ///< rows below are constants and coordinates: row_of gives the same number
    std::vector<Clause> clauses;  ///< room for the longest tape
    std::vector<double> operands;
};

/// Overwrites `out` by the clauses that the boxes `group` need, whose choices agree. `records`: last clause
/// first. `set_operations`: R-functions become min and max where no box needs their value. Time linear in the
/// number of records; no allocation once the vectors have grown.
void emit_cut_tape(const ClauseTape& tape, std::span<const tile::Record> records, unsigned group,
                   bool set_operations, CutEmitter& emitter, ClauseTape& out);

}  // namespace frep
