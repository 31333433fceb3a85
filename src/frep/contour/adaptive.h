// contour_adaptive: the surface F = 0 of a field as a triangle mesh that keeps sharp edges and corners, by
// dual contouring (Ju, Losasso, Schaefer, Warren 2002) on the lattice of contour.h: a vertex for each sheet
// of the surface in each cell (dual_vertices.h), triangles between them (dual_mesh.h). The mesh is closed and
// manifold, except where the box cuts it, and does not intersect itself. Where --tolerance allows, cells
// merge. The same bytes for every number of threads, with and without pruning. Tested by
// tests/unit/contour/adaptive_test.cpp, adaptive_topology_test.cpp, adaptive_random_test.cpp.
#pragma once

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/contour/contour.h"
#include "frep/eval/sampled_field.h"

namespace frep {

/// Attributes are taken at the crossings of the lattice's edges, a hair inside the surface; vertices inside
/// of cells have the mean of those around them. These come first: result.edge_vertices is 0. With the cap the
/// closing sides lie outside of the box, by a small part of a cell. Errors: invalid_argument for bad bounds,
/// cell sizes (see make_grid) or a tolerance that is negative or not finite, over_limit for too many cells or
/// vertices, or more memory than the limit; cancelled.
Result<ContourResult> contour_adaptive(const SampledField& field, const ContourOptions& options,
                                       const Job& job);

/// By the method of the options. Errors: as those of the two; invalid_argument for a tolerance with cells.
Result<ContourResult> contour_solid(const SampledField& field, const ContourOptions& options, const Job& job);

}  // namespace frep
