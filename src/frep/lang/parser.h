// parse(): HyperFun text -> syntax tree, with all diagnostics that need no evaluation: syntax, names,
// arities, array sizes, warnings for the known surprises (hyperfun.md a.5). Recovers and goes on after an
// error.
#pragma once

#include "frep/base/diagnostic.h"
#include "frep/lang/ast.h"

namespace frep::lang {

/// The program of `source`. Errors are added to `diagnostics`; the program is fit for lowering only if none
/// of them is an error.
Program parse(const Source& source, Diagnostics& diagnostics);

}  // namespace frep::lang
