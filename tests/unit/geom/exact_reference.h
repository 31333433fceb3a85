// An oracle for intersections of triangles with small integer coordinates, written unlike the code under
// test: rational arithmetic over 128-bit integers; one triangle is clipped by the half-spaces whose
// intersection is the other, which gives all corners of the common part.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/math/vec.h"

namespace frep::test {

__extension__ typedef __int128 Wide;

inline Wide wide_gcd(Wide a, Wide b) {
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b != 0) {
        const Wide r = a % b;
        a = b;
        b = r;
    }
    return a;
}

/// The point (x, y, z) / w with w > 0, in lowest terms.
struct RationalPoint {
    Wide x, y, z, w;
    bool operator==(const RationalPoint&) const = default;
};

inline RationalPoint reduced(RationalPoint p) {
    Wide g = wide_gcd(wide_gcd(p.x, p.y), wide_gcd(p.z, p.w));
    if (p.w < 0) g = -g;
    return {p.x / g, p.y / g, p.z / g, p.w / g};
}

struct IntegerPoint {
    int x, y, z;
};

inline IntegerPoint operator-(IntegerPoint a, IntegerPoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline IntegerPoint cross(IntegerPoint a, IntegerPoint b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline int dot(IntegerPoint a, IntegerPoint b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline bool is_zero(IntegerPoint a) { return a.x == 0 && a.y == 0 && a.z == 0; }
inline IntegerPoint integer_point(Vec3 p) {
    return {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
}

/// The points x with dot(normal, x) <= offset.
struct HalfSpace {
    IntegerPoint normal;
    int offset;
    /// w times the excess of the point.
    Wide excess(const RationalPoint& p) const {
        return normal.x * p.x + normal.y * p.y + normal.z * p.z - offset * p.w;
    }
};

using IntegerTriangle = std::array<IntegerPoint, 3>;

/// Half-spaces whose intersection is the triangle, or the segment that one without area covers.
inline std::vector<HalfSpace> half_spaces(const IntegerTriangle& t) {
    std::vector<HalfSpace> all;
    const auto add = [&](IntegerPoint n, IntegerPoint through) { all.push_back({n, dot(n, through)}); };
    const auto add_both = [&](IntegerPoint n, IntegerPoint through) {
        add(n, through);
        add(IntegerPoint{0, 0, 0} - n, through);
    };
    const IntegerPoint n = cross(t[1] - t[0], t[2] - t[0]);
    if (!is_zero(n)) {
        add_both(n, t[0]);
        for (std::size_t i = 0; i < 3; ++i) add(cross(t[(i + 1) % 3] - t[i], n), t[i]);
        return all;
    }
    const IntegerPoint d = !is_zero(t[1] - t[0]) ? t[1] - t[0] : t[2] - t[0];
    for (const IntegerPoint axis : {IntegerPoint{1, 0, 0}, IntegerPoint{0, 1, 0}, IntegerPoint{0, 0, 1}})
        add_both(cross(d, axis), t[0]);
    IntegerPoint first = t[0], last = t[0];
    for (const IntegerPoint p : t) {
        if (dot(d, p) < dot(d, first)) first = p;
        if (dot(d, p) > dot(d, last)) last = p;
    }
    add(d, last);
    add(IntegerPoint{0, 0, 0} - d, first);
    return all;
}

/// Points whose convex hull is the common part of two closed triangles.
inline std::vector<RationalPoint> common_part(const IntegerTriangle& a, const IntegerTriangle& b) {
    std::vector<RationalPoint> part;
    for (const IntegerPoint p : a) part.push_back({p.x, p.y, p.z, 1});
    for (const HalfSpace& h : half_spaces(b)) {
        std::vector<RationalPoint> kept;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const RationalPoint &p = part[i], &q = part[(i + 1) % part.size()];
            const Wide ep = h.excess(p), eq = h.excess(q);
            if (ep <= 0) kept.push_back(p);
            if ((ep < 0 && eq > 0) || (ep > 0 && eq < 0)) {
                // (eq p - ep q) / (eq - ep), in homogeneous coordinates.
                kept.push_back(reduced(
                    {eq * p.x - ep * q.x, eq * p.y - ep * q.y, eq * p.z - ep * q.z, eq * p.w - ep * q.w}));
            }
        }
        part = kept;
    }
    return part;
}

/// True when two triangles meet outside of the corners, edge or edges that they share.
inline bool meet_outside_shared(const IntegerTriangle& a, const IntegerTriangle& b) {
    std::vector<IntegerPoint> shared;
    for (const IntegerPoint p : a) {
        for (const IntegerPoint q : b) {
            if (is_zero(p - q)) shared.push_back(p);
        }
    }
    const std::vector<RationalPoint> part = common_part(a, b);
    if (shared.size() == 3) return !is_zero(cross(a[1] - a[0], a[2] - a[0]));
    for (const RationalPoint& p : part) {
        if (shared.empty()) return true;
        const IntegerPoint u = shared[0], v = shared.back();
        const RationalPoint pu{p.x - u.x * p.w, p.y - u.y * p.w, p.z - u.z * p.w, p.w};
        const IntegerPoint d = v - u;
        const Wide along = d.x * pu.x + d.y * pu.y + d.z * pu.z;
        const bool on_line = d.y * pu.z == d.z * pu.y && d.z * pu.x == d.x * pu.z && d.x * pu.y == d.y * pu.x;
        const bool on_segment = is_zero(d) ? pu.x == 0 && pu.y == 0 && pu.z == 0
                                           : on_line && along >= 0 && along <= dot(d, d) * p.w;
        if (!on_segment) return true;
    }
    return false;
}

/// Random numbers from a counter: SplitMix64 (Steele, Lea, Flood 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  private:
    std::uint64_t state_;
};

}  // namespace frep::test
