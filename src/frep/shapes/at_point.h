// A function of the model taken at one fixed point, for operations that are set up by points: the node with
// the items of x replaced by numbers, and, where only numbers are left, its value and gradient. Tested by
// tests/unit/shapes/control_points_test.cpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "frep/math/vec.h"
#include "frep/shapes/library.h"

namespace frep::shapes {

/// `f` as a function of the items of `x`, at `p`: each node that is an item of x is replaced by the item of
/// p. Nothing when f depends on the point in another way too (other coordinates, or the memory of a loop that
/// the call stands in), or when the sizes differ.
std::optional<Expression> at_point(Build& build, Expression f, Array x, Array p);

/// The value and the gradient with respect to the first three items of x.
struct LocalValue {
    double value = 0;
    Vec3 gradient;
};

/// The same in numbers, for the present parameters. Nothing as of at_point(), where f is undefined, and where
/// it needs a loop that depends on the point or a search.
std::optional<LocalValue> value_at(Build& build, Expression f, Array x, const Vec3& p);

/// The same for several functions in one pass over the graph; nothing when one of them has no value.
std::optional<std::vector<LocalValue>> values_at(Build& build, Array functions, Array x, const Vec3& p);

}  // namespace frep::shapes
