// A model of n coordinates as a function of space: each coordinate is an axis or a number (`--map`). The
// measures of this module work on such fields, whose derivatives by x, y, z are those of the mapped function.
// Tested by tests/unit/measure/space_field_test.cpp.
#pragma once

#include "frep/base/result.h"
#include "frep/eval/sampled_field.h"
#include "frep/field/field.h"

namespace frep {

/// `field` with coordinate i replaced by what map.coordinates[i] says: a field of the three coordinates x, y,
/// z, without attributes, parameters bound to their values. Errors: invalid_argument when the map has not one
/// entry for each coordinate, names an axis other than -1..2, or a number that is not finite; over_limit when
/// the graph grows too large.
Result<Field> field_in_space(const Field& field, const AxisMap& map);

}  // namespace frep
