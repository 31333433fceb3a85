// Operations written as formulas of simpler ones, for those who differentiate a graph or translate it. The
// formulas are the defining ones of the papers (field/ops.def names them), exact in real arithmetic; the
// kernels compute the same with less rounding and no overflow. Tested by
// tests/unit/field/derivative_test.cpp.
#pragma once

#include <optional>

#include "frep/field/expression.h"

namespace frep {

/// The node's formula over its arguments, made in its graph: R_alpha, R_0^m and R_p conjunctions and
/// disjunctions, and all blends. Nothing for other operations.
std::optional<Expression> spelled_out(Graph& graph, NodeId node);

}  // namespace frep
