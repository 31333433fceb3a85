// Implementation of qef.h.
#include "frep/contour/qef.h"

#include <utility>

namespace frep::contouring {

namespace {

/// Normals that differ by less than this angle, radians, make one plane.
constexpr double plane_angle = 0.03;
/// Eigenvalues below this part of the largest are dropped: the square of the angle.
constexpr double least_eigenvalue = plane_angle * plane_angle;
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

void QuadraticError::add(const Vec3& p, const Vec3& n) {
    points_ = points_ + p;
    count_ += 1;
    if (n == Vec3{0, 0, 0}) return;
    planes_ += 1;
    normals_ = normals_ + n;
    matrix_[0] += n.x * n.x;
    matrix_[1] += n.x * n.y;
    matrix_[2] += n.x * n.z;
    matrix_[3] += n.y * n.y;
    matrix_[4] += n.y * n.z;
    matrix_[5] += n.z * n.z;
    right_ = right_ + n * dot(n, p);
}

void QuadraticError::add(const QuadraticError& other) {
    for (std::size_t i = 0; i < 6; ++i) matrix_[i] += other.matrix_[i];
    right_ = right_ + other.right_;
    points_ = points_ + other.points_;
    normals_ = normals_ + other.normals_;
    count_ += other.count_;
    planes_ += other.planes_;
}

Vec3 QuadraticError::minimum(const Box3& box, Free* without) const {
    const Vec3 middle = mean();
    if (without) *without = {middle, {0, 0, 0}};
    if (planes_ == 0) return clamped(middle, box);
    const std::array<double, 6>& m = matrix_;
    // The pull of the planes at the mean: sum of n (n . (p - mean)).
    const Vec3 force{right_.x - (m[0] * middle.x + m[1] * middle.y + m[2] * middle.z),
                     right_.y - (m[1] * middle.x + m[3] * middle.y + m[4] * middle.z),
                     right_.z - (m[2] * middle.x + m[4] * middle.y + m[5] * middle.z)};
    Vec3 step;
    const double sum = length(normals_);
    SymmetricEigen eigen;
    std::size_t rank = 1;
    if (sum > planes_ * (1 - 0.25 * least_eigenvalue)) {
        // One plane, up to the angle.
        eigen.vectors[0] = normals_ / sum;
        eigen.values[0] = planes_;
        step = eigen.vectors[0] * (dot(eigen.vectors[0], force) / planes_);
    } else {
        eigen = eigen_of(m);
        rank = 0;
        for (; rank < 3 && eigen.values[rank] > least_eigenvalue * eigen.values[0]; ++rank) {
            const Vec3& v = eigen.vectors[rank];
            step = step + v * (dot(v, force) / eigen.values[rank]);
        }
    }
    const Vec3 free = middle + step;
    if (without) *without = {free, rank == 2 ? eigen.vectors[2] : Vec3{0, 0, 0}};
    if (box.contains(free)) return free;
    // The kept part of the matrix, with a small pull to the mean.
    Matrix kept{};
    Triple b{};
    for (std::size_t k = 0; k < rank; ++k) {
        const Triple v = triple(eigen.vectors[k]);
        const double f = dot(eigen.vectors[k], force);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) kept[i][j] += eigen.values[k] * v[i] * v[j];
            b[i] += f * v[i];
        }
    }
    for (std::size_t i = 0; i < 3; ++i) kept[i][i] += pull * eigen.values[0];
    const Vec3 moved =
        middle + vector(minimum_on_boundary(kept, b, triple(box.min - middle), triple(box.max - middle)));
    return clamped(moved, box);
}

}  // namespace frep::contouring
