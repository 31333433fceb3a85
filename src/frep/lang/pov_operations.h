// The operations of the op table in POV-Ray's function language (private to lang): text for a node from the
// text of its arguments. Tested by tests/unit/lang/pov_isosurface_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "frep/field/op.h"

namespace frep::lang {

/// Declarations of the functions Frep_... that the texts call.
std::string_view pov_prelude();

/// A finite number, with parentheses if negative.
std::string pov_number(double value);

/// The text of a plain operation on its arguments; nothing for an operation that POV-Ray cannot do.
std::optional<std::string> pov_operation(Op op, std::span<const std::string> arguments);

/// The sum of a block operation as an expression of px, py, pz (and ps, the fourth leading argument); nothing
/// for one that POV-Ray cannot do.
std::optional<std::string> pov_block(Op op, std::span<const double> data);

}  // namespace frep::lang
