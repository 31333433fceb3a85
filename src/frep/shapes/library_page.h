// The page docs/library.md, made from the library table. Tested by tests/unit/shapes/library_page_test.cpp,
// which also rewrites the page when FREP_UPDATE_DOCS is set.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "frep/shapes/library.h"

namespace frep::shapes {

/// "hfSphere(x, center, R)"; an array that the function changes in place is marked by &.
std::string signature(const LibraryFunction& function);

/// The reference of all library functions as Markdown, for the folder docs/. `example` gives the HyperFun
/// text of the function's example, or nothing; where there is one, the page shows it beside the picture
/// library/NAME.png.
std::string library_page(const std::function<std::string(std::string_view name)>& example);

}  // namespace frep::shapes
