// contour_plane: the zero contours of a field in a plane as polylines: the outlines of 2-D models, and slices
// of solids, from the function itself. Marching squares on uniform square cells, the two-dimensional form of
// contour.h with the same rules: a point is inside where F is defined and >= 0; crossings are bisected on the
// edges of the cells; on an ambiguous cell the bilinear interpolant decides. Outlines never touch or cross
// each other or themselves, and the solid lies to the left of the direction of travel. Features smaller than
// a cell may be lost. The same bytes for every number of threads, with and without pruning.
// Tested by tests/unit/contour/contour_2d_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/contour/plane_grid.h"
#include "frep/eval/field_pool.h"
#include "frep/eval/sampled_field.h"
#include "frep/geom/polyline.h"

namespace frep {

struct PlaneContourOptions {
    Box3 bounds = Box3::cube(10);  ///< its sides along the plane's two axes count
    Plane plane = {};
    int cells = 256;         ///< square cells along the longer side
    double cell_length = 0;  ///< > 0: the side of a cell, in place of `cells`
    bool cap = false;        ///< close the outlines where the box cuts them
    bool prune = true;       ///< skip blocks proved empty or full by intervals; changes no byte of the result
    std::size_t memory_limit = std::size_t{8} << 30;  ///< bytes that the run may take, estimated
};

struct PlaneContour {
    /// Points as (right, up). Closed ones begin at their first crossing in rows from the bottom, open ones
    /// (where the box cuts, without the cap) where the travel begins; all in the order of their first points.
    std::vector<Polyline> outlines;
    double cell = 0;                      ///< side of a cell, model units
    Vec2 min, max;                        ///< the rectangle that the cells fill
    std::uint64_t undefined_points = 0;   ///< samples where F is undefined
    std::optional<Vec3> first_undefined;  ///< the first of them, in rows from the bottom
    std::array<bool, 6> touches{};        ///< the shape reaches the side -x +x -y +y -z +z of the rectangle
    std::size_t sampled_blocks = 0;       ///< blocks of 16^2 samples that were evaluated
};

/// Errors: invalid_argument for bad bounds or cell sizes (see make_grid) or a plane whose axes are not two of
/// 0, 1, 2; over_limit for too many cells or points; cancelled.
Result<PlaneContour> contour_plane(FieldPool& fields, const PlaneContourOptions& options, const Job& job);
Result<PlaneContour> contour_plane(const SampledField& field, const PlaneContourOptions& options,
                                   const Job& job);

/// What can be said about outlines.
struct OutlineReport {
    std::size_t outlines = 0, closed = 0, points = 0;
    double area = 0;    ///< of the solid between the closed outlines, model units squared
    double length = 0;  ///< of all outlines
    Vec2 min, max;      ///< of the points; both 0 without any
};
OutlineReport check(const std::vector<Polyline>& outlines);

}  // namespace frep
