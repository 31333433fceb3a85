// TriangleBvh: a binary tree of boxes over the triangles of a mesh, for questions about places: which boxes
// overlap, which point of the surface is nearest, what does a ray hit first.
// The tree splits at the median of the centroids along the longest side of their box, so it is balanced: its
// depth is at most 32 and its shape depends on the mesh only, not on the threads that build it.
// Rays: the watertight test of S. Woop, C. Benthin and I. Wald (2013), in binary64: a ray through a common
// edge hits at least one of the two triangles.
// Tested by tests/unit/geom/bvh_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "frep/base/job.h"
#include "frep/geom/mesh.h"
#include "frep/math/vec.h"

namespace frep {

/// The tree. It keeps a pointer to the mesh, which must be valid, stay alive and stay as it is. Triangles
/// with a coordinate that is not finite are left out. Memory: about 36 bytes a triangle, 60 during the build.
class TriangleBvh {
  public:
    /// Up to `leaf_size` triangles: those at order()[begin] .. order()[end - 1].
    struct Node {
        Box3 box;
        std::uint32_t begin = 0, end = 0;
    };
    static constexpr std::uint32_t leaf_size = 4;

    /// A point of the mesh near another point.
    struct Nearest {
        Vec3 point;
        double distance = 0;         ///< from the point asked for, model units
        std::uint32_t triangle = 0;  ///< index into Mesh::triangles
    };

    struct Ray {
        Vec3 origin, direction;  ///< the direction need not have length 1, but must not be zero
        double t_min = 0, t_max = std::numeric_limits<double>::infinity();
    };

    /// Where a ray meets the mesh: origin + t * direction.
    struct Hit {
        double t = 0;
        std::uint32_t triangle = 0;  ///< index into Mesh::triangles
    };

    /// A cancelled job leaves an incomplete tree: safe to ask, but wrong.
    explicit TriangleBvh(const Mesh& mesh, const Job& job = {});

    const Mesh& mesh() const { return *mesh_; }
    bool empty() const { return order_.empty(); }
    /// The triangles of the tree in the order of its leaves; those of one leaf by rising index.
    const std::vector<std::uint32_t>& order() const { return order_; }
    /// The nodes in preorder; an inner node's children are left_child and right_child.
    const std::vector<Node>& nodes() const { return nodes_; }
    static bool is_leaf(const Node& node) { return node.end - node.begin <= leaf_size; }
    static std::size_t left_child(std::size_t node) { return node + 1; }
    std::size_t right_child(std::size_t node) const;

    /// The box of one triangle.
    Box3 box(std::uint32_t triangle) const;

    /// The point of the mesh nearest to `p`, no farther than `within` (the triangle with the smaller index at
    /// equal distances); nothing when there is none.
    std::optional<Nearest> nearest(const Vec3& p,
                                   double within = std::numeric_limits<double>::infinity()) const;

    /// Tells whether a hit of a triangle counts.
    using Accept = std::function<bool(std::uint32_t triangle)>;
    /// The hit with the smallest t in [t_min, t_max] of a triangle that `accept` lets pass (the smaller index
    /// at equal t). Both sides of a triangle are hit; a triangle seen exactly edge-on is not.
    std::optional<Hit> first_hit(const Ray& ray, const Accept& accept = {}) const;

  private:
    const Mesh* mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

/// The point of the triangle a b c (which may have no area) nearest to `p`.
Vec3 nearest_point_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace frep
