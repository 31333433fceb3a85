// Raising spelled-out set operations to operations: p + q + sqrt(p^2 + q^2) and its relatives are the
// R-functions of the system R0 (Rvachev 1987), and (p + q + |p - q|) / 2 is the larger of p and q (his system
// R1). As one operation they have exact enclosures and a sign that follows from the operands, so that parts
// of space can be pruned as for minimum and maximum. Tested by tests/unit/field/lift_test.cpp.
#pragma once

#include <cstddef>

#include "frep/field/field.h"

namespace frep {

/// What lift_r_functions() found.
struct LiftReport {
    std::size_t r_functions = 0;  ///< sums with a root that became r_and or r_or
    std::size_t min_max = 0;      ///< sums with an absolute value that became min or max

    std::size_t total() const { return r_functions + min_max; }
};

/// `field` with these patterns replaced, in any association, order and sign of the three terms:
///   p + q - sqrt(p^2 + q^2) = r_and(p, q)        p + q + sqrt(p^2 + q^2) = r_or(p, q)
///   (p + q - |p - q|) / 2   = min(p, q)          (p + q + |p - q|) / 2   = max(p, q)
/// where the root may be sqrt, hypot or a power 1/2, the squares square(p), p*p or p^2, the half a division
/// by 2 or a product with 1/2, of the sum or of its two parts. The same function in real numbers; the values
/// differ in their last digits, and the sign of an R-function is then right where the sum cancels. Nodes
/// inside of regions stay. The field itself when there is nothing to replace. Linear in the graph.
Field lift_r_functions(const Field& field, LiftReport* report = nullptr);

}  // namespace frep
