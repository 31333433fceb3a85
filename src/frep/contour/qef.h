// QuadraticError: the point that is nearest to a set of planes, for the vertex of a sheet. The sum of squared
// distances to the tangent planes at the points where the surface crosses the edges (Ju, Losasso, Schaefer,
// Warren 2002, "Dual contouring of Hermite data"), solved about the mean of these points with small
// eigenvalues dropped (Lindstrom 2000; Schaefer and Warren 2002, "The secret sauce"), and held inside a box:
// where the free minimum lies outside, the least sum on the box's sides, edges and corners is taken.
// Tested by tests/unit/contour/adaptive_qef_test.cpp.
#pragma once

#include <array>

#include "frep/math/vec.h"

namespace frep::contouring {

/// Eigenvalues and unit eigenvectors of a symmetric matrix, falling.
struct SymmetricEigen {
    std::array<double, 3> values{};
    std::array<Vec3, 3> vectors;
};

/// By cyclic Jacobi rotations; `m` = xx, xy, xz, yy, yz, zz, finite.
SymmetricEigen eigen_of(const std::array<double, 6>& m);

/// Sums over planes and points. Coordinates are those of the caller, about a common origin near the points.
class QuadraticError {
  public:
    /// A point of the surface; `normal` has length 1, or is zero where nothing is known of it.
    void add(const Vec3& point, const Vec3& normal);
    void add(const QuadraticError& other);

    /// The mean of the points; there must be one.
    Vec3 mean() const { return points_ / count_; }
    /// The sum of the normals.
    Vec3 normal_sum() const { return normals_; }
    /// The minimum in the closed box, as said above.
    Vec3 minimum(const Box3& box) const { return minimum(box, nullptr); }
    /// The same, and the minimum without the box.
    struct Free {
        Vec3 point;
        Vec3 along;  ///< the direction of the planes' common line if they have one, unit; else zero
    };
    Vec3 minimum(const Box3& box, Free* free) const;

  private:
    std::array<double, 6> matrix_{};  ///< sum of n n^T: xx, xy, xz, yy, yz, zz
    Vec3 right_;                      ///< sum of n (n . p)
    Vec3 points_, normals_;
    double count_ = 0, planes_ = 0;
};

}  // namespace frep::contouring
