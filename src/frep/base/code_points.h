// The characters of a text. Tested by tests/unit/base/source_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace frep {

/// The code points of UTF-8 text; every ill-formed sequence becomes U+FFFD.
std::u32string code_points(std::string_view bytes);

}  // namespace frep
