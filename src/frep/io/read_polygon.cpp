// Implementation of read_polygon.h.
#include "frep/io/read_polygon.h"

namespace frep::reading {

namespace {

/// Twice the area vector of the polygon, from its first corner.
Vec3 newell_normal(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners) {
    Vec3 sum{0, 0, 0};
    const Vec3 origin = vertices[corners[0]];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum = sum + cross(vertices[corners[i]] - origin, vertices[corners[i + 1]] - origin);
    return sum;
}

/// True when no corner turns against the normal, and the outline turns once only.
bool is_convex(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
               const Vec3& normal) {
    const std::size_t n = corners.size();
    const Vec3 origin = vertices[corners[0]];
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 a = vertices[corners[i]], b = vertices[corners[(i + 1) % n]],
                   c = vertices[corners[(i + 2) % n]];
        if (!(dot(cross(b - a, c - b), normal) >= 0)) return false;
        if (!(dot(cross(a - origin, b - origin), normal) >= 0)) return false;
    }
    return true;
}

double turn(double au, double av, double bu, double bv, double cu, double cv) {
    return (bu - au) * (cv - av) - (bv - av) * (cu - au);
}

}  // namespace

void Triangulator::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                std::vector<Triangle>& out) {
    if (a == b || b == c || c == a) {
        ++dropped_triangles_;
    } else {
        out.push_back({a, b, c});
    }
}

void Triangulator::fan(std::span<const std::uint32_t> corners, std::vector<Triangle>& out) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        add_triangle(corners[0], corners[i], corners[i + 1], out);
}

void Triangulator::add(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
                       std::vector<Triangle>& out) {
    if (corners.size() < 3) {
        ++dropped_faces_;
        return;
    }
    if (corners.size() == 3 || corners.size() > clipping_limit) return fan(corners, out);
    const Vec3 normal = newell_normal(vertices, corners);
    const double x = normal.x < 0 ? -normal.x : normal.x, y = normal.y < 0 ? -normal.y : normal.y,
                 z = normal.z < 0 ? -normal.z : normal.z;
    const bool usable = x + y + z > 0 && (x + y + z) - (x + y + z) == 0;
    if (!usable || is_convex(vertices, corners, normal)) return fan(corners, out);
    const int axis = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
    const double steepest = axis == 0 ? normal.x : (axis == 1 ? normal.y : normal.z);
    flat_.clear();
    for (const std::uint32_t corner : corners) {
        const Vec3& p = vertices[corner];
        Flat q = axis == 0 ? Flat{p.y, p.z} : (axis == 1 ? Flat{p.z, p.x} : Flat{p.x, p.y});
        if (steepest < 0) q.u = -q.u;
        flat_.push_back(q);
    }
    clip_ears(corners, out);
}

/// True when the corner turns left and no other remaining corner lies in its triangle.
bool Triangulator::is_ear(std::size_t before, std::size_t corner, std::size_t after) {
    const Flat a = flat_[before], b = flat_[corner], c = flat_[after];
    if (!(turn(a.u, a.v, b.u, b.v, c.u, c.v) > 0)) return false;
    const std::size_t cost = remaining_.size();
    tests_left_ = tests_left_ > cost ? tests_left_ - cost : 0;
    for (const std::size_t other : remaining_) {
        if (other == before || other == corner || other == after) continue;
        const Flat p = flat_[other];
        if ((p.u == a.u && p.v == a.v) || (p.u == b.u && p.v == b.v) || (p.u == c.u && p.v == c.v)) continue;
        if (turn(a.u, a.v, b.u, b.v, p.u, p.v) >= 0 && turn(b.u, b.v, c.u, c.v, p.u, p.v) >= 0 &&
            turn(c.u, c.v, a.u, a.v, p.u, p.v) >= 0)
            return false;
    }
    return true;
}

void Triangulator::clip_ears(std::span<const std::uint32_t> corners, std::vector<Triangle>& out) {
    remaining_.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) remaining_[i] = i;
    std::size_t at = 0, failures = 0;
    while (remaining_.size() > 3 && failures < remaining_.size() && tests_left_ > 0) {
        const std::size_t n = remaining_.size();
        at %= n;
        const std::size_t before = remaining_[(at + n - 1) % n], corner = remaining_[at],
                          after = remaining_[(at + 1) % n];
        if (!is_ear(before, corner, after)) {
            ++failures;
            ++at;
            continue;
        }
        add_triangle(corners[before], corners[corner], corners[after], out);
        remaining_.erase(remaining_.begin() + static_cast<std::ptrdiff_t>(at));
        failures = 0;
    }
    // The last triangle; or, of an outline that crosses itself, whatever is left as a fan.
    for (std::size_t i = 1; i + 1 < remaining_.size(); ++i)
        add_triangle(corners[remaining_[0]], corners[remaining_[i]], corners[remaining_[i + 1]], out);
}

}  // namespace frep::reading
