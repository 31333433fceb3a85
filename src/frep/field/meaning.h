// The meaning of every operation, once, as a template over the number type: double (reference), lanes (vm),
// intervals and duals. Constant folding and all engines come through here, so they cannot differ.
// The dispatch is made from field/ops.def; kernels stand in field/kernels/. Leaves have no meaning of their
// own.
#pragma once

#include <span>

#include "frep/base/result.h"
#include "frep/field/kernels/data.h"
#include "frep/field/op.h"
#include "frep/math/number.h"

namespace frep {

/// Value of `op` (kind plain or block) on `arguments`. `block`: the data of a block op when they are
/// constants; otherwise the data items follow the leading arguments. Instantiated in field/meaning_*.cpp for
/// double, math::Lanes, math::Interval, math::Dual<double> and math::Dual<math::Lanes>.
template <class T>
T meaning(Op op, std::span<const T> arguments, std::span<const double> block);

}  // namespace frep
