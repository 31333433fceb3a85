// measure_mesh_error: how far a mesh and the surface F = 0 are from each other, by samples, both ways.
// From mesh to surface: from points of the triangles along the gradient of F to the first change of its sign,
// found by doubling steps and then bisection. A zero lies at the end of each such way, so the way of a sample
// is never shorter than its true distance. Where the gradient does not point to the nearest zero (sharp
// edges) it is longer; so the farthest samples are searched in all directions too. From surface to mesh: from
// points of the surface on the edges of a finer lattice, shifted against that of the mesh so that it sees
// features that the mesh has missed, to the nearest point of the mesh (bvh.h). These are true distances; a
// feature that the finer lattice misses too is not noticed. So the result is the largest distance that was
// found, not a bound. Tested by tests/unit/contour/mesh_error_test.cpp.
#pragma once

#include <cstddef>
#include <optional>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/contour/grid.h"
#include "frep/eval/sampled_field.h"
#include "frep/geom/mesh.h"

namespace frep {

struct MeshErrorOptions {
    Grid grid;                     ///< that the mesh was made on
    std::size_t samples = 100000;  ///< about so many each way, at most
    bool prune = true;             ///< use the intervals of the field
    std::size_t memory_limit = std::size_t{8} << 30;
};

/// Lengths in model units.
struct MeshError {
    /// Nothing when no sample had a way; triangles in the sides of the box (the cap) have no samples.
    std::optional<double> mesh_to_surface;
    /// Nothing when the finer lattice meets no surface, or the mesh is empty.
    std::optional<double> surface_to_mesh;
    Vec3 mesh_place, surface_place;  ///< the samples with these distances
    std::size_t samples_on_mesh = 0, samples_on_surface = 0;
    std::size_t unresolved = 0;  ///< samples of the mesh that found no surface within four cells

    /// The larger of the two, and its place.
    std::optional<double> largest() const;
    Vec3 place() const;
    /// Joins the figures of another mesh of the same scene.
    void add(const MeshError& other);
};

/// Errors: over_limit from the finer lattice, cancelled.
Result<MeshError> measure_mesh_error(const SampledField& field, const Mesh& mesh,
                                     const MeshErrorOptions& options, const Job& job);

}  // namespace frep
