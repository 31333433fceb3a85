// Ranges of clauses that have no lane form: box by box through math::Interval. Used by prune.cpp. Tested by
// tests/unit/eval/prune_test.cpp.
#pragma once

#include <vector>

#include "frep/eval/clause_tape.h"
#include "frep/eval/tile_kernels.h"
#include "frep/math/interval.h"

namespace frep {

/// The largest binary32 <= x that is not +inf, the smallest >= x that is not -inf.
float rounded_down(double x);
float rounded_up(double x);

/// Workspace of general_range().
struct GeneralRange {
    std::vector<math::Interval> operands;
};

/// The range of clause number `clause` of `tape` in the boxes of `lanes`, and its flags there. Encloses what
/// binary64 computes, and binary32 as Pruner asks of it.
void general_range(const ClauseTape& tape, std::uint32_t clause, unsigned lanes, tile::Row* rows,
                   std::uint32_t* flags, GeneralRange& workspace);

}  // namespace frep
