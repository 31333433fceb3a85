// The page docs/library.md, made from the library table. Tested by tests/unit/shapes/library_page_test.cpp,
// which also rewrites the page when FREP_UPDATE_DOCS is set.
#pragma once

#include <string>

#include "frep/shapes/library.h"

namespace frep::shapes {

/// "hfSphere(x, center, R)"; an array that the function changes in place is marked by &.
std::string signature(const LibraryFunction& function);

/// The reference of all library functions as Markdown.
std::string library_page();

}  // namespace frep::shapes
