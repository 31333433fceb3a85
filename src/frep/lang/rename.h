// The text of a model with its objects renamed, to be put into one file with others. Tested by
// tests/unit/lang/rename_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "frep/lang/ast.h"

namespace frep::lang {

/// The text of `source`, of which `program` was parsed without errors: every name of an object gets `prefix`
/// in front of it, and annotations become plain comments. All else stays, byte for byte.
std::string with_renamed_objects(const Source& source, const Program& program, std::string_view prefix);

}  // namespace frep::lang
