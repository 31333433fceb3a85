// contour_cells: the surface F = 0 of a field as a triangle mesh, by the basic polygonization algorithm on
// uniform cubic cells (Pasko, Pilyugin, Pokrovskiy 1986/1988; thesis 1.5.3). A point is inside where F is
// defined and >= 0. The mesh is a closed, oriented manifold except where the box cuts it; with the cap it is
// closed there too. Features smaller than a cell may be lost. The same bytes for every number of threads,
// with and without pruning. Tested by tests/unit/contour/contour_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/contour/grid.h"
#include "frep/eval/sampled_field.h"
#include "frep/geom/mesh.h"

namespace frep {

enum class ContourMethod {
    adaptive,  ///< dual contouring: keeps sharp edges, no self-intersections (adaptive.h)
    cells,     ///< polygons in uniform cells (below)
};

struct ContourOptions {
    Box3 bounds = Box3::cube(10);
    int cells = 96;          ///< cubic cells along the longest side
    double cell_length = 0;  ///< > 0: the side of a cell, in place of `cells`
    double tolerance = 0;    ///< of contour_adaptive: cells may merge where the mesh stays about this near
    ContourMethod method = ContourMethod::adaptive;  ///< of contour_solid and contour
    bool cap = false;                                ///< close the shape where the box cuts it
    /// Attributes s[1], s[2], ... to take at the vertices, as many as the field has of them. They are taken
    /// at the inside end of the edge's bracket, a hair inside the surface.
    std::size_t attributes = 0;
    bool prune = true;  ///< skip blocks proved empty or full by intervals; changes no byte of the result
    std::size_t memory_limit = std::size_t{8} << 30;  ///< bytes that the run may take, estimated
};

struct ContourResult {
    Mesh mesh;                      ///< with outward unit normals
    std::size_t edge_vertices = 0;  ///< the first vertices lie on edges of cells, the others inside of cells
    std::vector<std::vector<double>> attributes;  ///< a column for each, a number a vertex; NaN: undefined
    Grid grid;
    std::uint64_t undefined_points = 0;   ///< samples of the lattice where F is undefined
    std::optional<Vec3> first_undefined;  ///< the first of them, in block order
    /// Cells that the surface passes more than once, or through a face whose corners alternate (adaptive
    /// method only): the solid or a gap is about as thin as a cell there, and whether its parts hang together
    /// is not known from the samples.
    std::uint64_t tight_cells = 0;
    std::optional<Vec3> first_tight;  ///< the lower corner of the first of them, in block order
    /// Cells with a part of the solid, or a gap, that none of the samples around them meets (adaptive method
    /// only): the mesh lacks it. At least so many; see thin_parts.h for what may be overlooked.
    std::uint64_t hidden_cells = 0;
    std::optional<Vec3> first_hidden;  ///< the lower corner of the first of them, in block order
    std::array<bool, 6> touches{};     ///< the shape reaches the side -x +x -y +y -z +z of the grid
    std::size_t sampled_blocks = 0;    ///< blocks of 8^3 samples that were evaluated
};

/// Errors: invalid_argument for bad bounds or cell sizes (see make_grid), over_limit for too many cells or
/// vertices, or more memory than the limit; cancelled.
Result<ContourResult> contour_cells(const SampledField& field, const ContourOptions& options, const Job& job);

/// The colors of the vertices from attributes 0, 1, 2 as R, G, B, clamped to 0..1; `undefined` where one of
/// the three has no value. Empty when there are fewer than three columns.
std::vector<Color> vertex_colors(const ContourResult& result, const Color& undefined);

/// The side names in the order of ContourResult::touches: "-x", "+x", ...
std::array<const char*, 6> side_names();

}  // namespace frep
