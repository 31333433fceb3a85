// QuadraticError: the point that is nearest to a set of planes, for the vertex of a sheet. The sum of squared
// distances to the tangent planes at the points where the surface crosses the edges (Ju, Losasso, Schaefer,
// Warren 2002, "Dual contouring of Hermite data"), solved about the mean of these points with small
// eigenvalues damped (Lindstrom 2000; Schaefer and Warren 2002, "The secret sauce") by iterated Tikhonov
// regularization (Hanke and Groetsch 1998), which needs no eigenvectors. It is held inside a box: where the
// free minimum lies outside, the least sum on the box's sides, edges and corners is taken.
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
    /// That of one point of the surface; `normal` has length 1, or is zero where nothing is known of it.
    static QuadraticError of(const Vec3& point, const Vec3& normal) {
        const Vec3 &n = normal, &p = point;
        const double d = dot(n, p);
        QuadraticError e;
        e.sums_ = {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z, n.x * d, n.y * d,
                   n.z * d,   p.x,       p.y,       p.z,       n.x,       n.y,       n.z,     1};
        return e;
    }
    void add(const Vec3& point, const Vec3& normal) { add(of(point, normal)); }
    void add(const QuadraticError& other) {
        for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
    }

    /// The mean of the points; there must be one.
    Vec3 mean() const { return Vec3{sums_[9], sums_[10], sums_[11]} * (1 / sums_[15]); }
    /// The sum of the normals.
    Vec3 normal_sum() const { return {sums_[12], sums_[13], sums_[14]}; }
    /// The minimum in the closed box, as said above.
    Vec3 minimum(const Box3& box) const { return minimum(box, nullptr); }
    /// The same, and the minimum without the box.
    struct Free {
        Vec3 point;
        Vec3 along;  ///< the direction of the planes' common line where they make a sharp edge, unit; else
                     ///< zero
    };
    Vec3 minimum(const Box3& box, Free* free) const;

  private:
    Vec3 held(const Box3& box, const Vec3& middle, const Vec3& force) const;

    /// Sum of n n^T (xx, xy, xz, yy, yz, zz), of n (n . p), of p, of n, and how many.
    std::array<double, 16> sums_{};
};

}  // namespace frep::contouring
