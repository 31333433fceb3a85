// measure_widths: wall thickness and gaps along rays from samples of a surface, in model units; the part of
// print_check.h that needs the tree of boxes. Definitions stand there, at WidthReport.
// Tested by tests/unit/geom/print_check_test.cpp.
#pragma once

#include <cstddef>

#include "frep/base/job.h"
#include "frep/geom/mesh.h"
#include "frep/geom/print_check.h"

namespace frep {

struct WidthOptions {
    double facing_cosine = 0.7;  ///< of the largest angle between facing faces
    double wall_limit = 0, gap_limit = 0;
    std::size_t samples = 100000;  ///< beside one on each triangle
};

/// The members of WidthReport hold model units here, whatever their names say.
struct Widths {
    WidthReport walls, gaps;
    std::size_t samples = 0;
};

/// Measures a valid, merged mesh. A cancelled job leaves the figures incomplete.
Widths measure_widths(const Mesh& mesh, const WidthOptions& options, const Job& job);

}  // namespace frep
