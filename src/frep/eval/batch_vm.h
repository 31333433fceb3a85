// BatchVm: runs a clause tape over batches of points, in binary64 or binary32, in the widest registers that
// the machine has (isa.h). In binary64 values and gradients have the bits of every other engine; binary32
// follows the profile of docs/numerics.md, rule 14, with the same bits on every instruction set. Method: rows
// of a batch lie in the second cache at most; one switch a clause, one loop over lanes a case
// (batch_loops.h); what is rare or dear goes through meaning<T> (batch_other.h). Tested by
// tests/unit/eval/batch_vm_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "frep/eval/clause_tape.h"
#include "frep/eval/isa.h"

namespace frep {

/// One object a thread; it keeps its memory, and the constants of the last ClauseData that it saw. Real is
/// double or float.
template <class Real>
class BatchVm {
  public:
    /// For machine_isa().
    BatchVm();
    ~BatchVm();
    BatchVm(BatchVm&&) noexcept;
    BatchVm& operator=(BatchVm&&) noexcept;

    /// F at `count` points: coordinates[i][p] is coordinate i of point p (those that the tape
    /// does not read may be null);
    /// out[p] receives F, NaN where undefined. `out` may not overlap the coordinates. Tapes are taken as they
    /// are, in single assignment or packed; long ones should be packed (pack_rows), for the rows of a batch
    /// to lie in the cache.
    void values(const ClauseTape& tape, std::span<const Real* const> coordinates, std::size_t count,
                Real* out);
    /// F and its partial derivatives, partials[i][p] = dF/dx_i: as many as `partials` has, 0 beyond the
    /// coordinates. Total: finite where F is finite (docs/numerics.md, rule 7).
    void gradients(const ClauseTape& tape, std::span<const Real* const> coordinates, std::size_t count,
                   Real* values, std::span<Real* const> partials);

  private:
    class Machine;
    std::unique_ptr<Machine> machine_;
};

extern template class BatchVm<double>;
extern template class BatchVm<float>;

}  // namespace frep
