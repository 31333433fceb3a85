// print_check: what a printer or a caster asks about a solid: size, thinnest wall, narrowest gap,
// overhangs, loose small parts, and whether it stands. The terms are those of design for manufacturing (DFM).
// Walls and gaps are measured along rays from samples of the surface, so a reported minimum is the smallest
// that was found, never smaller than the true one by more than rounding. The mesh must be closed and point
// outward (mesh_check.h says so); on others the figures mean little, but nothing fails.
// Tested by tests/unit/geom/print_check_test.cpp.
#pragma once

#include <cstddef>
#include <optional>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/geom/mesh.h"
#include "frep/geom/scene.h"
#include "frep/math/vec.h"

namespace frep {

struct PrintCheckOptions {
    LengthUnit unit{"mm", 0.001};  ///< of the model's numbers
    Vec3 up{0, 0, 1};              ///< away from the build plate; any length but 0
    double overhang_angle = 45;    ///< degrees from the vertical, 0..90; steeper faces overhang
    double facing_angle = 45;      ///< degrees, 0..90; two faces that are farther from parallel are no wall
    double min_wall_mm = 0;        ///< the area of thinner walls is summed
    double min_gap_mm = 0;         ///< the area at narrower gaps is summed
    /// What is at most this high above the lowest point rests on the plate: a tenth of a usual first layer.
    double plate_tolerance_mm = 0.02;
    std::size_t samples = 100000;  ///< on the whole surface, beside one on each triangle
    bool as_float32 = true;        ///< judge the coordinates rounded to binary32
};

/// The shortest way from face to face that was found.
struct MeasuredWidth {
    double length_mm = 0;
    Vec3 from, to;  ///< its ends, in model units
};

/// Walls (ways through the material) or gaps (ways through the empty space, holes and cavities included).
/// At each sample a ray starts along the face's normal, into the material for walls and out of it for gaps,
/// and ends at the first face that it leaves (or enters) through. The way counts when that face is within
/// facing_angle of parallel to the first, so that the neighborhood of a blunt edge is no thin wall; an edge
/// sharper than that is one. Samples: the centroid of each triangle, and further ones on large triangles in
/// proportion to area (a Kronecker sequence, no randomness).
struct WidthReport {
    std::optional<MeasuredWidth> smallest;  ///< nothing when no way counts
    double p01_mm = 0;                      ///< 1 % of the measured area has a smaller width; 0 without any
    double median_mm = 0;                   ///< 50 % of the measured area
    double measured_area_mm2 = 0;           ///< area of the surface whose samples have a width
    double below_limit_area_mm2 = 0;        ///< of it where the width is less than min_wall_mm or min_gap_mm
};

/// Faces that look down and rest on nothing: their slope from the vertical (0 for a wall, 90 for a ceiling)
/// is more than overhang_angle by over half a degree, and they do not rest on the plate. What the model
/// itself holds up from below is not looked at.
struct OverhangReport {
    double area_mm2 = 0;
    double share = 0;           ///< of the whole surface, 0..1
    double steepest = 0;        ///< the largest slope, degrees from the vertical; 0 without overhang
    std::optional<Vec3> worst;  ///< centroid of the largest triangle within a degree of the steepest slope
};

/// How the solid stands on the plate.
struct StandReport {
    double contact_area_mm2 = 0;  ///< of the faces that rest on the plate with all corners
    /// How far the centroid's foot point lies inside the convex hull of the resting vertices, from its
    /// nearest side; negative outside, and when they have no area (a solid that rests on an edge or a
    /// point). Nothing without a centroid (mesh not closed, no volume).
    std::optional<double> margin_mm;
    bool stable = false;  ///< margin_mm > 0: it does not tip over by its own weight, of uniform density
};

/// The component whose box has the shortest longest side: a crumb, if it is small.
struct SmallestComponent {
    double size_mm = 0;  ///< that longest side
    Box3 bounds;         ///< model units
};

/// What print_check() finds. Lengths in millimetres, places in model units.
struct PrintReport {
    double mm_per_unit = 1;
    Vec3 size_mm;          ///< of the bounding box, along x, y and z
    double height_mm = 0;  ///< extent along `up`
    WidthReport walls, gaps;
    OverhangReport overhang;
    StandReport stand;
    std::optional<SmallestComponent> smallest_component;
    std::size_t components = 0;
    std::size_t samples = 0;  ///< used for walls and gaps
};

/// Measures `mesh`, which must be valid; an empty one gives zeros. About 4 microseconds a sample; memory
/// about 200 bytes a triangle and 40 a sample.
/// Errors: invalid_argument (a unit or angle out of range, no direction up); cancelled.
Result<PrintReport> print_check(const Mesh& mesh, const PrintCheckOptions& options = {}, const Job& job = {});

}  // namespace frep
