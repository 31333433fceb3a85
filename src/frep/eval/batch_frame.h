// What the inner loop of BatchVm is given: plain data only, so that the files compiled for a wider
// instruction set (batch_avx2.cpp, batch_avx512.cpp) call no inline function that plain code could share
// (math/isa.h). Elements: the loop goes over elements of N lanes; for values an element is N numbers, for
// gradients 4N (the values, then three partial derivatives). Tested by tests/unit/eval/batch_vm_test.cpp.
#pragma once

#include <cstddef>

#include "frep/eval/clause_tape.h"

namespace frep::batch {

/// Where the rows of a tape lie. Real is double or float.
template <class Real>
struct Rows {
    const Real* const* leaves = nullptr;  ///< by row: constants (one element each), then coordinates
    Real* values = nullptr;               ///< row first_value + k begins at k * stride
    std::size_t stride = 0;               ///< numbers from one value row to the next
    RowNumber constants = 0;              ///< rows below this one are constants
    RowNumber first_value = 0;
};

/// One batch: the clauses and the memory to run them on.
template <class Real>
struct Frame {
    Rows<Real> rows;
    const Clause* clauses = nullptr;
    std::size_t clause_count = 0;
    std::size_t numbers = 0;   ///< numbers of a row to compute: whole elements
    Real* last_out = nullptr;  ///< where the last clause writes, when not to its row
    void* owner = nullptr;     ///< argument of `other`
    /// Computes a clause that has no loop of its own, into `out`.
    void (*other)(void* owner, const Clause& clause, Real* out) = nullptr;
};

/// Lanes of an element, and the inner loops, for one instruction set.
template <class Real>
struct Code {
    std::size_t lanes;
    void (*values)(const Frame<Real>&);
    void (*gradients)(const Frame<Real>&);
};

/// The loops compiled for one instruction set. Null function pointers where the build has none.
Code<double> doubles_sse2();
Code<float> floats_sse2();
Code<double> doubles_avx2();
Code<float> floats_avx2();
Code<double> doubles_avx512();
Code<float> floats_avx512();

}  // namespace frep::batch
