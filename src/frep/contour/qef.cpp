// Implementation of qef.h.
#include "frep/contour/qef.h"

#include <utility>

namespace frep::contouring {

namespace {

/// Normals that differ by less than this angle, radians, make one plane.
constexpr double plane_angle = 0.03;
/// Eigenvalues below this part of the largest are dropped: the square of the angle.
constexpr double least_eigenvalue = plane_angle * plane_angle;
/// Of the free minimum's way from the mean, along the eigenvector of the eigenvalue l (as a part of the sum
/// of all three), 1 - (damping / (damping + l))^4 is kept: a half at l = 2e-4, all but 1e-8 at l = 0.1.
constexpr double damping = 1e-3;
/// Normals whose mean is shorter than the root of this make an edge whose line is worth knowing: of two
/// planes, those with an angle of 0.14 between them or more.
constexpr double smooth_square = 1 - 0.005;
/// Pull towards the mean of the points along dropped directions, as a part of the largest eigenvalue.
constexpr double pull = 1e-6;

double magnitude(double v) { return v < 0 ? -v : v; }
double clamped(double v, double low, double high) { return v < low ? low : v > high ? high : v; }
Vec3 clamped(const Vec3& p, const Box3& box) {
    return {clamped(p.x, box.min.x, box.max.x), clamped(p.y, box.min.y, box.max.y),
            clamped(p.z, box.min.z, box.max.z)};
}

using Matrix = std::array<std::array<double, 3>, 3>;
using Triple = std::array<double, 3>;

Triple triple(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

/// x^T m x - 2 b^T x.
double energy(const Matrix& m, const Triple& b, const Triple& x) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        sum += x[i] * (m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2] - 2 * b[i]);
    }
    return sum;
}

/// Sets the free coordinates of x to the minimum with the others as they are. False if that is no number.
bool minimize(const Matrix& m, const Triple& b, const std::array<std::size_t, 2>& free, std::size_t count,
              Triple& x) {
    const auto rest = [&](std::size_t i) {
        double r = b[i];
        for (std::size_t j = 0; j < 3; ++j) {
            const bool is_free = j == free[0] || (count == 2 && j == free[1]);
            if (!is_free) r -= m[i][j] * x[j];
        }
        return r;
    };
    const std::size_t i = free[0], j = free[1];
    if (count == 1) {
        x[i] = rest(i) / m[i][i];
        return x[i] == x[i];
    }
    const double ri = rest(i), rj = rest(j);
    const double determinant = m[i][i] * m[j][j] - m[i][j] * m[i][j];
    if (!(determinant > 0)) return false;
    x[i] = (ri * m[j][j] - rj * m[i][j]) / determinant;
    x[j] = (rj * m[i][i] - ri * m[i][j]) / determinant;
    return true;
}

/// The minimum of the energy over the boundary of the box low..high: of its sides, edges and corners (m is
/// positive definite, and the free minimum lies outside).
Triple minimum_on_boundary(const Matrix& m, const Triple& b, const Triple& low, const Triple& high) {
    Triple best{};
    double least = 0;
    bool found = false;
    for (int code = 0; code < 26; ++code) {
        // Digit a of 0..26 without the middle: 0 low, 1 free, 2 high.
        const int digits = code < 13 ? code : code + 1;
        const std::array<int, 3> state{digits % 3, digits / 3 % 3, digits / 9};
        Triple x{};
        std::array<std::size_t, 2> free{3, 3};
        std::size_t count = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            if (state[a] == 1) {
                free[count++] = a;
            } else {
                x[a] = state[a] == 0 ? low[a] : high[a];
            }
        }
        if (count > 0 && !minimize(m, b, free, count, x)) continue;
        bool is_in = true;
        for (std::size_t a = 0; a < 3; ++a) is_in = is_in && x[a] >= low[a] && x[a] <= high[a];
        if (!is_in) continue;
        const double e = energy(m, b, x);
        if (!found || e < least) {
            found = true;
            least = e;
            best = x;
        }
    }
    return best;
}

}  // namespace

SymmetricEigen eigen_of(const std::array<double, 6>& given) {
    Matrix m{
        {{given[0], given[1], given[2]}, {given[1], given[3], given[4]}, {given[2], given[4], given[5]}}};
    Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < 12; ++sweep) {
        const double off = magnitude(m[0][1]) + magnitude(m[0][2]) + magnitude(m[1][2]);
        const double on = magnitude(m[0][0]) + magnitude(m[1][1]) + magnitude(m[2][2]);
        if (!(off > 1e-15 * on)) break;
        for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
            if (m[p][q] == 0) continue;
            const double theta = 0.5 * (m[q][q] - m[p][p]) / m[p][q];
            const double root = __builtin_sqrt(theta * theta + 1);
            const double t = theta >= 0 ? 1 / (theta + root) : 1 / (theta - root);
            const double c = 1 / __builtin_sqrt(t * t + 1), s = t * c;
            for (std::size_t k = 0; k < 3; ++k) {
                const double a = m[k][p], b = m[k][q];
                m[k][p] = c * a - s * b;
                m[k][q] = s * a + c * b;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const double a = m[p][k], b = m[q][k];
                m[p][k] = c * a - s * b;
                m[q][k] = s * a + c * b;
                const double d = v[k][p], e = v[k][q];
                v[k][p] = c * d - s * e;
                v[k][q] = s * d + c * e;
            }
        }
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    if (m[order[0]][order[0]] < m[order[1]][order[1]]) std::swap(order[0], order[1]);
    if (m[order[1]][order[1]] < m[order[2]][order[2]]) std::swap(order[1], order[2]);
    if (m[order[0]][order[0]] < m[order[1]][order[1]]) std::swap(order[0], order[1]);
    SymmetricEigen eigen;
    for (std::size_t k = 0; k < 3; ++k) {
        eigen.values[k] = m[order[k]][order[k]];
        eigen.vectors[k] = {v[0][order[k]], v[1][order[k]], v[2][order[k]]};
    }
    return eigen;
}

namespace {

/// A symmetric matrix: xx, xy, xz, yy, yz, zz.
struct Symmetric {
    double xx, xy, xz, yy, yz, zz;
    Vec3 operator*(const Vec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
    Symmetric scaled(double s) const { return {xx * s, xy * s, xz * s, yy * s, yz * s, zz * s}; }
    double trace() const { return xx + yy + zz; }
    /// Its inverse times the determinant.
    Symmetric adjugate() const {
        return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
                xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
    }
    double determinant(const Symmetric& adjugate) const {
        return xx * adjugate.xx + xy * adjugate.xy + xz * adjugate.xz;
    }
};

/// The direction that two of the eigenvalues of m do not see, if the third is as good as nothing; else zero.
Vec3 line_of(const Symmetric& m) {
    const Symmetric a = m.adjugate();  // of rank 1: the product of the two eigenvalues, times v v^T
    const double squares = a.trace();
    if (!(m.determinant(a) <= least_eigenvalue * m.trace() * squares)) return {0, 0, 0};
    const Vec3 x{a.xx, a.xy, a.xz}, y{a.xy, a.yy, a.yz}, z{a.xz, a.yz, a.zz};
    const Vec3 column = a.xx >= a.yy && a.xx >= a.zz ? x : a.yy >= a.zz ? y : z;
    const double l = length(column);
    return l > 0 ? column * (1 / l) : Vec3{0, 0, 0};
}

}  // namespace

Vec3 QuadraticError::minimum(const Box3& box, Free* without) const {
    const Vec3 middle = mean();
    const Symmetric m{sums_[0], sums_[1], sums_[2], sums_[3], sums_[4], sums_[5]};
    const double planes = m.trace();
    if (!(planes > 0)) {
        if (without) *without = {middle, {0, 0, 0}};
        return clamped(middle, box);
    }
    // The pull of the planes at the mean: sum of n (n . (p - mean)).
    const Vec3 force = Vec3{sums_[6], sums_[7], sums_[8]} - m * middle;
    const double more = damping * planes;
    const Symmetric damped{m.xx + more, m.xy, m.xz, m.yy + more, m.yz, m.zz + more};
    const Symmetric adjugate = damped.adjugate();
    const Symmetric inverse = adjugate.scaled(1 / damped.determinant(adjugate));
    const Vec3 first = inverse * force;
    const Symmetric missing = inverse.scaled(more);
    const Vec3 step = first + missing * (first + missing * (first + missing * first));
    const Vec3 free = middle + step;
    if (without) {
        const Vec3 sum = normal_sum();
        const bool is_sharp = dot(sum, sum) < smooth_square * planes * planes;
        *without = {free, is_sharp ? line_of(m) : Vec3{0, 0, 0}};
    }
    return box.contains(free) ? free : held(box, middle, force);
}

/// The minimum in the box, with eigenvalues below the least dropped.
Vec3 QuadraticError::held(const Box3& box, const Vec3& middle, const Vec3& force) const {
    const SymmetricEigen eigen = eigen_of({sums_[0], sums_[1], sums_[2], sums_[3], sums_[4], sums_[5]});
    // The kept part of the matrix, with a small pull to the mean.
    Matrix kept{};
    Triple b{};
    Vec3 free = middle;
    for (std::size_t k = 0; k < 3 && eigen.values[k] > least_eigenvalue * eigen.values[0]; ++k) {
        const Triple v = triple(eigen.vectors[k]);
        const double f = dot(eigen.vectors[k], force);
        free = free + eigen.vectors[k] * (f / eigen.values[k]);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) kept[i][j] += eigen.values[k] * v[i] * v[j];
            b[i] += f * v[i];
        }
    }
    if (box.contains(free)) return free;
    for (std::size_t i = 0; i < 3; ++i) kept[i][i] += pull * eigen.values[0];
    const Vec3 moved =
        middle + vector(minimum_on_boundary(kept, b, triple(box.min - middle), triple(box.max - middle)));
    return clamped(moved, box);
}

}  // namespace frep::contouring
