// The `.vm` text form of a model, which other systems read too (it comes from the Prospero challenge of
// M. Keeter): a line an operation, `name operation operands`, in single assignment; the last line is the
// result; inside where it is negative, so that the field is its negation. `#` begins a comment line.
// Tested by tests/unit/lang/vm_text_test.cpp.
#pragma once

#include <optional>

#include "frep/field/field.h"
#include "frep/lang/report.h"

namespace frep::lang {

/// The operations: const, var-x var-y var-z, neg abs recip sqrt square floor ceil round sin cos tan asin acos
/// atan exp ln, add sub mul div min max mod pow atan2. `mod` is a - b floor(a/b). The field has two
/// coordinates when no line is var-z, else three. Nothing when a line is wrong; `report` then has the errors.
std::optional<Field> parse_vm_text(const Source& source, Reporter& report);

}  // namespace frep::lang
