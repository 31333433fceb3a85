// The passes of the pruner over the lanes of a tile row, compiled once for each instruction set: bare
// pointers and plain data, so that nothing of a wider set can slip into the rest of the program
// (docs/numerics.md, rule 2). Used by prune.cpp alone. Tested by tests/unit/eval/prune_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace frep::tile {

/// One row of a tape over 16 boxes: the range of its value in each. Bounds are never NaN, lo is never +inf,
/// hi never -inf.
struct alignas(64) Row {
    float lo[16];
    float hi[16];
};

/// What the pass from the root down found out about a clause that some box needs. Masks of boxes.
struct Record {
    std::uint32_t clause;
    std::uint16_t live;    ///< boxes that need the clause
    std::uint16_t value;   ///< those that need its value, not only its sign
    std::uint16_t first;   ///< boxes where its first choice stands for it: operand 0 (select: 1)
    std::uint16_t second;  ///< boxes where its second choice does: operand 1 (select: 2)
    std::uint16_t base;    ///< boxes where a simpler operation does (a blend at rest: its set operation)
    std::uint16_t notes;   ///< sums of the following
};
/// Boxes may share a tape although these choices differ.
inline constexpr std::uint16_t optional_choice = 1;
/// The clause is, or becomes, an R-function.
inline constexpr std::uint16_t r_function_note = 2;

/// What the users of a row want of it, while the pass from the root down goes. Masks of boxes.
struct Wanted {
    std::uint16_t live = 0;   ///< boxes that need the row
    std::uint16_t value = 0;  ///< those of them that need its value everywhere in the box
    std::uint16_t inner = 0;  ///< boxes that need it as part of a smooth set operation (tile_smooth.h)
    std::uint16_t stage = 0;  ///< which part
    float margin = 0;         ///< the others of `live` need its sign, and its value where |value| <= margin
    float inner_margin = 0;   ///< the same for the operands of the smooth set operation
    float gain = 0;  ///< what an error of the row may come to at the root, at most; infinite: not known
};

/// A data block of constants.
struct Block {
    const double* items;
    std::size_t count;
};

/// The table of lattice noise (field/kernels/noise.h): 256 numbers, and 256 gradients of three.
struct NoiseLattice {
    const std::uint8_t* permutation;
    const float* gradient;
};

/// A pass over a tape. Flags of a row: bit k = box k may be undefined, bit 16 + k = surely is (its bounds
/// then say nothing).
struct Job {
    const void* clauses;  ///< Clause, see clause_tape.h
    std::uint32_t clause_count;
    const std::uint32_t* operands;  ///< of the clauses that list them
    const Block* blocks;            ///< a clause of kind block has the number of its own + 1, or 0, in in[1]
    NoiseLattice lattice;
    std::uint32_t constants;    ///< rows below are constants
    std::uint32_t first_value;  ///< clause i writes row first_value + i
    Row* rows;
    std::uint32_t* flags;
    /// Computes the range of clause number `clause` in the boxes of `lanes`, flags included.
    void (*general)(void* self, std::uint32_t clause, unsigned lanes);
    void* self;
    /// By row. Before the pass from the root down nothing is wanted of values but the root; after it, of
    /// none.
    Wanted* wanted;
    Record* records;  ///< room for clause_count of them
    /// A term of a sum is dropped where that changes F by no more than this; 0: never.
    float tolerance;
    /// What rounding may add to that: grows by what it may make of all clauses below which terms may go. To
    /// be set to 0 before.
    float* rounding;
};

/// The passes.
struct Kernels {
    /// Ranges of all clauses, in their order.
    void (*forward)(const Job&);
    /// Demands from the root down; writes the records of the clauses that are needed, last clause first, and
    /// returns their number.
    std::size_t (*reverse)(const Job&);
    /// same[k] = the boxes of `lanes` whose choices are those of box k; left[k] = the clauses that box k
    /// needs and that do not become simpler, where R-functions become min and max if `set_operations`.
    void (*agree)(const Record* records, std::size_t count, unsigned lanes, bool set_operations,
                  std::uint16_t* same, std::uint32_t* left);
};

namespace sse2 {
const Kernels& kernels();
}
namespace avx2 {
const Kernels& kernels();
}
namespace avx512 {
const Kernels& kernels();
}

}  // namespace frep::tile
