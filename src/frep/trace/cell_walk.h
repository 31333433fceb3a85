// The cells of a grid along a ray, front to back (after Amanatides and Woo 1987, "A fast voxel traversal
// algorithm for ray tracing"), as runs of cells that may hold some of the solid. Tested through
// tests/unit/trace/first_hit_test.cpp.
#pragma once

#include <algorithm>
#include <array>

#include "frep/trace/camera.h"
#include "frep/trace/distance_grid.h"

namespace frep::tracing {

/// A part of a ray.
struct Stretch {
    double begin = 0, end = 0;
};

/// Where a ray is in a box; `side` is the side that it comes in by (0..5: -x +x -y +y -z +z), -1 when it
/// begins inside. False when it misses.
bool clip_to_box(const Ray& ray, const Box3& box, Stretch& stretch, int& side);

class CellWalk {
  public:
    CellWalk() = default;
    /// Along `ray` within `within`, which lies in the lattice.
    CellWalk(const DistanceGrid& grid, const Ray& ray, const Stretch& within);

    /// The next run of at most `most` cells that are not surely empty; false when there is none. Runs that
    /// touch share an end.
    bool next(const DistanceGrid& grid, int most, Stretch& run);

  private:
    void advance();
    double exit() const { return std::min({next_[0], next_[1], next_[2]}); }

    std::array<int, 3> cell_{}, step_{}, last_{};
    std::array<double, 3> next_{}, delta_{};
    double at_ = 0, end_ = -1;
    bool done_ = true;
};

}  // namespace frep::tracing
