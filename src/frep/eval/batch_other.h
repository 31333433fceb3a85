// The operations that BatchVm has no loop for: through meaning<T>, four points at a time, always in double;
// operands of binary32 are widened and the result is rounded once. Tested by
// tests/unit/eval/batch_vm_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frep/field/op.h"
#include "frep/math/number.h"

namespace frep::batch {

/// An operand row: where it begins, and 0 as mask when it is one element for all (batch_frame.h).
template <class Real>
struct Operand {
    const Real* at;
    std::size_t mask;
};

/// One operation on rows of `numbers` numbers in elements of `lanes` lanes (a multiple of 4).
template <class Real>
struct OtherCall {
    Op op;
    std::span<const Operand<Real>> operands;
    std::span<const double> block;
    std::size_t numbers;
    std::size_t lanes;
    Real* out;
};

/// Computes such operations; keeps its memory between calls.
template <class Real>
class OtherOperations {
  public:
    /// Elements of `lanes` values.
    void values(const OtherCall<Real>& call);
    /// Elements of `lanes` values and three times as many derivatives.
    void gradients(const OtherCall<Real>& call);

  private:
    std::vector<math::Lanes> values_;
    std::vector<math::Dual<math::Lanes>> duals_;
};

}  // namespace frep::batch
