// Partial derivatives of a function as nodes of its graph, so that they have values, enclosures over boxes
// and gradients of their own like everything else: normals inside a formula, mean-value forms, tests of
// monotonicity. Method: forward differentiation by the chain rule (Griewank and Walther, Evaluating
// Derivatives, 2008), set operations and blends through the formulas that define them. Tested by
// tests/unit/field/derivative_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/base/result.h"
#include "frep/field/expression.h"

namespace frep {

/// What a derivative is where the function jumps (steps, comparisons, conditions whose sides differ).
enum class AtJumps {
    undefined,  ///< no value exactly there, and a flagged enclosure over boxes that hold such a place: an
                ///< enclosure without the flag bounds all difference quotients in the box
    ignored,    ///< the derivative of the side that the point belongs to
};

/// The partial derivatives of f with respect to `variables`, nodes of its graph that stand for themselves
/// (coordinates, or any others: what is below them does not count). At creases (min, max, abs, the edge of a
/// set operation) the value is that of one side, and enclosures hold both. At 0 the root has derivative 0, as
/// in gradients (docs/numerics.md, rule 7). Error invalid_argument for operations without a formula that
/// could be differentiated (noise, sums over skeletons, tables, loops that depend on the point), by name.
Result<std::vector<Expression>> derivatives(Expression f, std::span<const Expression> variables,
                                            AtJumps at_jumps = AtJumps::undefined);

}  // namespace frep
