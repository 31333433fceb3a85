// Folds of R-functions whose values matter, not only their signs. The system R0 is a distance to first order
// near the surface only: each operand of a fold bends the values elsewhere, so that a blend or an offset of a
// long fold changes its shape with every part that is added, however far away; and no operand can be dropped
// where its value is needed. Tested by tests/unit/field/value_folds_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

#include "frep/field/field.h"

namespace frep {

struct ValueFold {
    NodeId node = 0;           ///< the last r_and or r_or of the fold
    std::size_t operands = 0;  ///< joined by it, parts of the same fold opened; at most 1e9
};

/// The folds of at least `least_operands` operands of r_and and r_or below F that are used by an operation
/// which needs their values: anything but set operations, min, max, negation and products with constants.
/// In the order of the nodes.
std::vector<ValueFold> value_folds(const Field& field, std::size_t least_operands);

}  // namespace frep
