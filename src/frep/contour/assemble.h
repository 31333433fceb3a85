// The last step of contouring: the nodes and polygons of all blocks become one mesh. Vertices stand in the
// order of the blocks; vertices in the middle of polygons that have no triangulation of their own come last.
// Tested by tests/unit/contour/contour_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/contour/block.h"
#include "frep/eval/field_pool.h"
#include "frep/geom/mesh.h"

namespace frep::contouring {

struct AssembledMesh {
    Mesh mesh;
    std::size_t edge_vertices = 0;  ///< vertices on edges of cells; the others follow them
    std::vector<std::vector<double>>
        attributes;  ///< one column an attribute, a number a vertex; NaN: undefined
};

/// Joins the blocks' parts: codes[i] is the code of parts[i], ascending; parts may be null, and their nodes
/// carry `attributes` numbers each. A vertex in the middle of a polygon takes the mean of the defined
/// attributes of the polygon's nodes, because F may be < 0 there. The parts are used up. Errors: over_limit
/// for more than 2^32 - 2 vertices, cancelled, invalid_argument when the interval and the point values of the
/// field contradict each other.
Result<AssembledMesh> assemble(const std::vector<std::uint64_t>& codes,
                               std::vector<std::unique_ptr<BlockMesh>> parts, std::size_t attributes,
                               FieldPool& fields, const Job& job);

}  // namespace frep::contouring
