// Set operations by systems of R-functions, two operands at a time and on whole lists. Which system the
// operators | & \ @ of a file mean is the file's choice (`--@ set-operations`, default r0); the functions
// here name theirs. A solid is where its function is >= 0, so a union is a disjunction, an intersection and a
// Cartesian product are conjunctions, the complement is the negated function and a subtraction the
// conjunction with it. Sources: Rvachev 1982; Pasko, Adzhiev, Sourin and Savchenko 1995 (thesis 1.3.2);
// Shapiro 2007. Tested by tests/unit/shapes/set_operations_test.cpp; kernels: field/kernels/rsystems.h.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// The disjunction of two functions: >= 0 where one of them is. min_max is R_alpha with alpha = 1, the only
/// one of these systems that is associative.
Expression disjunction(const SetSystem& system, Expression f1, Expression f2);
/// The conjunction: >= 0 where both are.
Expression conjunction(const SetSystem& system, Expression f1, Expression f2);
/// The conjunction of f1 with the complement of f2.
Expression subtraction(const SetSystem& system, Expression f1, Expression f2);

/// All of a list of at least one function, by a balanced tree: neighbours first, so that depth and growth of
/// values away from the surface are logarithmic in their number.
Expression disjunction(const SetSystem& system, Array functions);
Expression conjunction(const SetSystem& system, Array functions);

/// The symmetric functions of a whole list (Rvachev; Shapiro 2007), the same for every order, C^m where all
/// arguments are smooth: the conjunction is prod x^m (x + |x|) where all x > 0, else the sum of
/// |x|^m (x - |x|); the disjunction is its mirror image. The degree grows with the number of operands.
Expression symmetric_conjunction(Array functions, Expression m);
Expression symmetric_disjunction(Array functions, Expression m);

}  // namespace frep::shapes
