// What check_blends() found, as diagnostics of the model's text: HF120 to HF123 (lang/diagnostics.def).
// Tested by tests/unit/measure/blend_diagnostics_test.cpp.
#pragma once

#include <array>
#include <optional>

#include "frep/base/diagnostic.h"
#include "frep/measure/blend_check.h"

namespace frep {

/// The diagnostic of a finding, with points of space in the coordinates of the measured `axes`. Nothing for a
/// fillet or a blend by extents that acts at a second place: these are meant for every edge that two solids
/// share, blends between control points for one.
std::optional<Diagnostic> blend_diagnostic(const BlendFinding& found, const Source& source,
                                           const std::array<bool, 3>& axes);

}  // namespace frep
