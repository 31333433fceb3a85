// Annotations: the `--@ key value` comments of a file (title, author, units, bounds, parameters, color,
// dialect). Old tools see only comments, so a mistake is a warning, never an error. cli.md, "Annotations
// inside a HyperFun file". Tested by tests/unit/lang/annotation_test.cpp.
#pragma once

#include <vector>

#include "frep/lang/ast.h"
#include "frep/lang/report.h"

namespace frep::lang {

/// Reads the comments at `places` (from their dashes to the end of line) into program.annotations; the
/// objects of `program` are read already. Mistakes are reported as warnings.
void read_annotations(const Source& source, const std::vector<Span>& places, Program& program,
                      Reporter& report);

}  // namespace frep::lang
