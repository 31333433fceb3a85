// Implementation of triangle_overlap.h, from the bottom up: points of one line, segments in a plane, a
// segment and a triangle, then the cases by the number of common corners.
#include "frep/geom/triangle_overlap.h"

#include <algorithm>
#include <utility>

#include "frep/geom/predicates.h"

namespace frep {

namespace {

using Found = std::optional<Vec3>;

struct Segment {
    Vec3 p, q;  ///< not the same point
};

double coordinate(const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// The point seen along an axis.
Vec2 seen(const Vec3& p, int axis) {
    return axis == 0 ? Vec2{p.y, p.z} : axis == 1 ? Vec2{p.z, p.x} : Vec2{p.x, p.y};
}

/// The side of c from the line a b, seen along an axis.
int side(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
    return orient2d(seen(a, axis), seen(b, axis), seen(c, axis));
}

/// An axis along which the three points are not seen on one line; -1 when they lie on one line.
int viewing_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const int axis : {2, 0, 1}) {
        if (side(a, b, c, axis) != 0) return axis;
    }
    return -1;
}

bool has_area(const Corners& t) { return viewing_axis(t[0], t[1], t[2]) >= 0; }

/// An axis along which two points differ.
int moving_axis(const Vec3& p, const Vec3& q) { return p.x != q.x ? 0 : p.y != q.y ? 1 : 2; }

/// The segment that the corners of a triangle without area cover.
Segment span(const Corners& t) {
    const int axis = moving_axis(t[0], t[1]);
    const auto before = [axis](const Vec3& a, const Vec3& b) {
        return coordinate(a, axis) < coordinate(b, axis);
    };
    const auto ends = std::minmax_element(t.begin(), t.end(), before);
    return {*ends.first, *ends.second};
}

/// Two segments on one line.
Found meet_on_line(const Segment& s, const Segment& t) {
    const int axis = moving_axis(s.p, s.q);
    const auto sorted = [axis](const Segment& u) {
        return coordinate(u.p, axis) < coordinate(u.q, axis) ? u : Segment{u.q, u.p};
    };
    const Segment a = sorted(s), b = sorted(t);
    const Vec3& begin = coordinate(a.p, axis) < coordinate(b.p, axis) ? b.p : a.p;
    const Vec3& end = coordinate(a.q, axis) < coordinate(b.q, axis) ? a.q : b.q;
    if (coordinate(begin, axis) > coordinate(end, axis)) return std::nullopt;
    return begin;
}

/// Twice the signed area of the triangle a b c seen along an axis, rounded.
double rounded_area(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
    const Vec2 p = seen(a, axis) - seen(c, axis), q = seen(b, axis) - seen(c, axis);
    return p.x * q.y - p.y * q.x;
}

/// The point that divides s as `from` to `to`, both from 0 and of the same sign or both 0.
Vec3 divided(const Segment& s, double from, double to) {
    const double whole = from + to;
    const double t = whole != 0 ? std::clamp(from / whole, 0.0, 1.0) : 0.5;
    return s.p + (s.q - s.p) * t;
}

/// Two segments in one plane that is not seen edge-on along `axis`.
Found meet_in_plane(const Segment& s, const Segment& t, int axis) {
    const int sp = side(t.p, t.q, s.p, axis), sq = side(t.p, t.q, s.q, axis);
    const int tp = side(s.p, s.q, t.p, axis), tq = side(s.p, s.q, t.q, axis);
    if (sp == 0 && sq == 0 && tp == 0 && tq == 0) return meet_on_line(s, t);
    if (sp * sq > 0 || tp * tq > 0) return std::nullopt;
    if (sp == 0) return s.p;
    if (sq == 0) return s.q;
    return divided(s, rounded_area(t.p, t.q, s.p, axis), -rounded_area(t.p, t.q, s.q, axis));
}

/// Two segments anywhere.
Found meet(const Segment& s, const Segment& t) {
    if (orient3d(s.p, s.q, t.p, t.q) != 0) return std::nullopt;
    int axis = viewing_axis(s.p, s.q, t.p);
    if (axis < 0) axis = viewing_axis(s.p, s.q, t.q);
    return axis < 0 ? meet_on_line(s, t) : meet_in_plane(s, t, axis);
}

/// True when the closed triangle, which has an area seen along `axis`, holds a point of its plane.
bool holds(const Corners& t, const Vec3& p, int axis) {
    const int a = side(t[0], t[1], p, axis), b = side(t[1], t[2], p, axis), c = side(t[2], t[0], p, axis);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// A segment in the plane of a triangle, or any segment and a triangle without area.
Found meet_flat(const Segment& s, const Corners& t) {
    const int axis = viewing_axis(t[0], t[1], t[2]);
    if (axis < 0) return meet(s, span(t));
    if (holds(t, s.p, axis)) return s.p;
    if (holds(t, s.q, axis)) return s.q;
    for (std::size_t i = 0; i < 3; ++i) {
        if (const Found found = meet_in_plane(s, {t[i], t[(i + 1) % 3]}, axis)) return found;
    }
    return std::nullopt;
}

double rounded_volume(const Corners& t, const Vec3& p) { return dot(t[0] - p, cross(t[1] - p, t[2] - p)); }

/// A segment and a triangle; `sp` and `sq` are the sides of the ends from the triangle's plane (orient3d).
Found meet(const Segment& s, int sp, int sq, const Corners& t) {
    if (sp * sq > 0) return std::nullopt;
    if (sp == 0 && sq == 0) return meet_flat(s, t);
    const int a = orient3d(s.p, s.q, t[0], t[1]), b = orient3d(s.p, s.q, t[1], t[2]);
    if (a * b < 0) return std::nullopt;
    const int c = orient3d(s.p, s.q, t[2], t[0]);
    if (a * c < 0 || b * c < 0) return std::nullopt;
    if (sp == 0) return s.p;
    if (sq == 0) return s.q;
    return divided(s, rounded_volume(t, s.p), -rounded_volume(t, s.q));
}

/// The sides of the corners of `b` from the plane of `a`.
std::array<int, 3> sides(const Corners& a, const Corners& b) {
    return {orient3d(a[0], a[1], a[2], b[0]), orient3d(a[0], a[1], a[2], b[1]),
            orient3d(a[0], a[1], a[2], b[2])};
}

/// The first edge of `a` that meets `b`; `s` are the sides of its corners from b's plane.
Found edges_meet(const Corners& a, const std::array<int, 3>& s, const Corners& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (const Found found = meet({a[i], a[j]}, s[i], s[j], b)) return found;
    }
    return std::nullopt;
}

Found apart(const Corners& a, const Corners& b) {
    const std::array<int, 3> sa = sides(b, a);
    if (sa[0] * sa[1] > 0 && sa[0] * sa[2] > 0) return std::nullopt;
    const std::array<int, 3> sb = sides(a, b);
    if (sb[0] * sb[1] > 0 && sb[0] * sb[2] > 0) return std::nullopt;
    if (const Found found = edges_meet(a, sa, b)) return found;
    return edges_meet(b, sb, a);
}

/// The segments from corner 0 that cover a triangle without area: one, or two in opposite directions.
std::array<Segment, 2> arms(const Corners& t) {
    const Segment whole = span(t);
    if (whole.p == t[0]) return {{{t[0], whole.q}, {t[0], whole.q}}};
    if (whole.q == t[0]) return {{{t[0], whole.p}, {t[0], whole.p}}};
    return {{{t[0], t[1]}, {t[0], t[2]}}};
}

/// Two segments from one point: the nearer end when they run in the same direction.
Found arms_meet(const Segment& s, const Segment& t) {
    if (viewing_axis(s.p, s.q, t.q) >= 0) return std::nullopt;
    const int axis = moving_axis(s.p, s.q);
    const double v = coordinate(s.p, axis), a = coordinate(s.q, axis), b = coordinate(t.q, axis);
    if ((a < v) != (b < v)) return std::nullopt;
    return (a < b) == (v < a) ? s.q : t.q;
}

/// A segment from corner 0 of a triangle and the triangle.
Found arm_meets(const Segment& s, const Corners& t) {
    const int axis = viewing_axis(t[0], t[1], t[2]);
    if (axis < 0) {
        for (const Segment& arm : arms(t)) {
            if (const Found found = arms_meet(s, arm)) return found;
        }
        return std::nullopt;
    }
    if (orient3d(t[0], t[1], t[2], s.q) != 0) return std::nullopt;
    if (holds(t, s.q, axis)) return s.q;
    return meet_in_plane(s, {t[1], t[2]}, axis);
}

Found at_corner(const Corners& a, const Corners& b) {
    const int a1 = orient3d(b[0], b[1], b[2], a[1]), a2 = orient3d(b[0], b[1], b[2], a[2]);
    if (a1 * a2 > 0) return std::nullopt;
    const int b1 = orient3d(a[0], a[1], a[2], b[1]), b2 = orient3d(a[0], a[1], a[2], b[2]);
    if (b1 * b2 > 0) return std::nullopt;
    for (const auto& [flat, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
        if (has_area(*flat)) continue;
        for (const Segment& arm : arms(*flat)) {
            if (const Found found = arm_meets(arm, *other)) return found;
        }
        return std::nullopt;
    }
    if (const Found found = meet({a[1], a[2]}, a1, a2, b)) return found;
    return meet({b[1], b[2]}, b1, b2, a);
}

/// Both triangles lie on one line and share two corners: they overlap when both reach out on the same side.
Found on_line_at_edge(const Corners& a, const Corners& b) {
    const int axis = moving_axis(a[0], a[1]);
    const double u = coordinate(a[0], axis), v = coordinate(a[1], axis);
    const double pa = coordinate(a[2], axis), pb = coordinate(b[2], axis);
    const double lo = std::min(u, v), hi = std::max(u, v);
    if (pa < lo && pb < lo) return pa < pb ? b[2] : a[2];
    if (pa > hi && pb > hi) return pa < pb ? a[2] : b[2];
    return std::nullopt;
}

Found at_edge(const Corners& a, const Corners& b) {
    if (orient3d(a[0], a[1], a[2], b[2]) != 0) return std::nullopt;
    const int axis = viewing_axis(a[0], a[1], a[2]);
    if (axis < 0) return has_area(b) ? std::nullopt : on_line_at_edge(a, b);
    const int sa = side(a[0], a[1], a[2], axis), sb = side(a[0], a[1], b[2], axis);
    if (sa * sb <= 0) return std::nullopt;
    if (holds(a, b[2], axis)) return b[2];
    if (holds(b, a[2], axis)) return a[2];
    const Found found = meet_in_plane({a[0], a[2]}, {b[1], b[2]}, axis);
    return found ? found : meet_in_plane({a[1], a[2]}, {b[0], b[2]}, axis);
}

}  // namespace

std::optional<Vec3> common_point(const Corners& a, const Corners& b, int shared) {
    switch (shared) {
        case 0:
            return apart(a, b);
        case 1:
            return at_corner(a, b);
        case 2:
            return at_edge(a, b);
        default:
            return has_area(a) ? Found((a[0] + a[1] + a[2]) / 3) : std::nullopt;
    }
}

}  // namespace frep
