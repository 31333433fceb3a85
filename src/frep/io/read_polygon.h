// Polygons of mesh files as triangles (private to io). A polygon that is convex about its Newell normal
// (M. Newell; Sutherland, Evans and others 1974) becomes a fan from its first corner; another one is cut by
// ear clipping in the plane that its normal is steepest on (Meisters 1975), which covers any simple polygon.
// Polygons of more than 1000 corners, ones without a normal, and everything after 50 million tests of ears in
// one file become fans, so that a file cannot buy more than linear time.
// Tested by tests/unit/io/read_polygon_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frep/geom/mesh.h"

namespace frep::reading {

class Triangulator {
  public:
    static constexpr std::size_t clipping_limit = 1000;

    /// Appends the triangles of the polygon with these corners (indices into `vertices`), in its own
    /// orientation: two fewer than corners, less those that name a vertex twice.
    void add(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
             std::vector<Triangle>& out);

    /// Faces with fewer than three corners, and triangles that name a vertex twice: not added.
    std::size_t dropped_faces() const { return dropped_faces_; }
    std::size_t dropped_triangles() const { return dropped_triangles_; }

  private:
    struct Flat {
        double u, v;
    };
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::vector<Triangle>& out);
    void fan(std::span<const std::uint32_t> corners, std::vector<Triangle>& out);
    void clip_ears(std::span<const std::uint32_t> corners, std::vector<Triangle>& out);
    bool is_ear(std::size_t before, std::size_t corner, std::size_t after);

    std::vector<Flat> flat_;              ///< the corners in the plane, counter-clockwise
    std::vector<std::size_t> remaining_;  ///< corners not cut off yet
    std::size_t tests_left_ = 50'000'000;
    std::size_t dropped_faces_ = 0, dropped_triangles_ = 0;
};

}  // namespace frep::reading
