// explain(): the page of a diagnostic's code, for `frep explain HF012` and for the documentation. Made from
// diagnostics.def. Tested by tests/unit/lang/explain_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "frep/base/result.h"
#include "frep/lang/codes.h"

namespace frep::lang {

/// The explanation of `code` ("HF012"; case and leading zeros do not matter, the short name will do too) as
/// plain text with an example of wrong and of right code. An unknown code is an invalid_argument error.
Result<std::string> explain(std::string_view code);

}  // namespace frep::lang
