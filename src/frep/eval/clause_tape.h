// ClauseTape: a field as a straight list of clauses (operations on rows of numbers), the form that is pruned
// for a part of space, run in batches, and translated to native code. A row holds one value for every element
// of a batch; the constants of the model and the coordinates have rows of their own, so that every operand of
// a clause is a row and nothing else. A fresh tape is in single assignment (a clause, a row of its own); what
// is cut from it shares its ClauseData and therefore the numbers of its constant and coordinate rows.
// Regions (loops that depend on the point) have no clauses: the register tape (tape.h) runs them.
// Tested by tests/unit/eval/clause_tape_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "frep/field/field.h"

namespace frep {

using RowNumber = std::uint32_t;

/// One operation. Plain operations of at most three operands have them in `in`; all others (more operands,
/// and operations of kind block) have in[0] = first of their operands in ClauseTape::operands, in[1] = data
/// block
/// + 1 or 0.
struct Clause {
    Op op = Op::constant;
    std::uint8_t listed = 0;  ///< 1: the operands are listed in ClauseTape::operands
    std::uint16_t spare = 0;
    std::uint32_t count = 0;  ///< operands
    RowNumber out = 0;
    std::array<std::uint32_t, 3> in{};
};

/// What a tape and all tapes cut from it have in common.
struct ClauseData {
    std::shared_ptr<const Graph> graph;  ///< owns the blocks
    std::vector<double> constants;       ///< NaN for a value that exists nowhere
    std::vector<std::span<const double>> blocks;
    int coordinates = 0;

    /// Rows 0, 1, ... are the constants, then the coordinates, then values.
    RowNumber coordinate_row(int i) const {
        return static_cast<RowNumber>(constants.size()) + static_cast<RowNumber>(i);
    }
    RowNumber first_value_row() const { return coordinate_row(coordinates); }
};

struct ClauseTape {
    std::shared_ptr<const ClauseData> data;
    std::vector<Clause> clauses;      ///< operands before users
    std::vector<RowNumber> operands;  ///< of the clauses that list them
    RowNumber root = 0;               ///< the row of F; may be that of a constant or a coordinate
    RowNumber rows = 0;               ///< all rows: constants, coordinates, values

    /// The rows that a clause reads.
    std::span<const RowNumber> operands_of(const Clause& clause) const {
        return {clause.listed ? operands.data() + clause.in[0] : clause.in.data(), clause.count};
    }
    /// The data block of a clause of kind block; empty when its data are operands.
    std::span<const double> block_of(const Clause& clause) const {
        if (!clause.listed || clause.in[1] == 0) return {};
        return data->blocks[clause.in[1] - 1];
    }
};

/// The tape of F, in single assignment: clause i writes row first_value_row() + i. Nothing where F needs a
/// region. field.parameters must be bound (bind_parameters) or present.
std::optional<ClauseTape> make_clause_tape(const Field& field);

/// The tape of F - iso for the tape of F; with ClauseData of its own where iso is not 0.
ClauseTape shifted(const ClauseTape& tape, double iso);

/// The same clauses over as few value rows as live at one time: a row is used again once its last reader is
/// done, and never by the clause that reads it last (so a clause never writes a row that it reads). `tape`
/// must be in single assignment or already packed.
void pack_rows(ClauseTape& tape);

/// The cost of a clause of `tape` by the op table (an addition at one point is 1), and of all its clauses.
double cost_of(const ClauseTape& tape, const Clause& clause);
double cost_of(const ClauseTape& tape);

}  // namespace frep
