// Implementation of path.h.
#include "frep/shapes/path.h"

#include <algorithm>
#include <optional>

#include "frep/math/functions.h"

namespace frep::shapes {

namespace {

/// Pieces turn by less than this, the cosine of 0.1, and know s to within this.
constexpr double least_cosine = 0.995, most_error = 0.01;
constexpr int most_halvings = 7;
/// A path that turns back on itself has no plane of the mitre.
constexpr double turned_back = -0.99;

Vec3 unit(Vec3 a) { return a / length(a); }
Vec3 mirrored(Vec3 a, Vec3 normal) { return a - normal * (2 * dot(a, normal) / dot(normal, normal)); }

/// p(t) = c0 + t (c1 + t (c2 + t c3)).
using Cubic = std::array<Vec3, 4>;

Vec3 at(const Cubic& c, double t) { return c[0] + (c[1] + (c[2] + c[3] * t) * t) * t; }
Vec3 velocity(const Cubic& c, double t) { return c[1] + (c[2] * 2.0 + c[3] * (3 * t)) * t; }

Cubic line(Vec3 p, Vec3 q) { return {p, q - p, {}, {}}; }
Cubic bezier(Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
    return {p, 3.0 * (q - p), 3.0 * (p - 2.0 * q + r), s - p + 3.0 * (q - r)};
}

/// The part of the curve from t on, h long.
Cubic part(const Cubic& c, double t, double h) {
    return {at(c, t), velocity(c, t) * h, (c[2] + c[3] * (3 * t)) * (h * h), c[3] * (h * h * h)};
}

/// The direction at an end, also where the curve starts there with no speed.
std::optional<Vec3> direction(const Cubic& c, double t) {
    const double size = std::max({length(c[1]), length(c[2]), length(c[3])});
    const double inwards = t < 0.5 ? 1.0 : -1.0;
    for (const Vec3 v : {velocity(c, t), inwards * (at(c, t + 1e-4 * inwards) - at(c, t)) * 1e4})
        if (length(v) > 1e-9 * size) return unit(v);
    return std::nullopt;
}

/// A part with its directions at both ends.
struct Step {
    Cubic curve;
    Vec3 from, to;
    double bend = 0;
    bool straight = false;
};

/// The share of the way from one end's plane to the other's, for a point of the curve.
double share_of_way(const Step& step, Vec3 p) {
    const double a = dot(p - step.curve[0], step.from), b = dot(at(step.curve, 1) - p, step.to);
    return a / (a + b);
}

/// A step that is good enough.
std::optional<Step> step_of(const Cubic& curve) {
    const auto from = direction(curve, 0), to = direction(curve, 1);
    if (!from || !to) return std::nullopt;
    Step step{curve, *from, *to};
    const double v0 = length(velocity(curve, 0)), v1 = length(velocity(curve, 1));
    step.bend = (v1 - v0) / (v1 + v0);
    return step;
}
bool is_fine(const Step& step) {
    if (!(dot(step.from, step.to) >= least_cosine)) return false;
    for (const double s : {0.25, 0.5, 0.75}) {
        const double r = share_of_way(step, at(step.curve, s));
        if (!(math::abs(r + step.bend * r * (1 - r) - s) <= most_error)) return false;
    }
    return true;
}

/// Cuts a curve into steps. False where it stands still.
bool cut(const Cubic& curve, std::vector<Step>& steps) {
    struct Part {
        double t, h;
        int level;
    };
    std::vector<Part> open{{0, 1, 0}};
    while (!open.empty()) {
        const Part p = open.back();
        open.pop_back();
        const auto step = step_of(part(curve, p.t, p.h));
        if (!step && p.level == most_halvings) return false;
        if (step && (p.level == most_halvings || is_fine(*step))) {
            steps.push_back(*step);
            continue;
        }
        open.push_back({p.t + 0.5 * p.h, 0.5 * p.h, p.level + 1});
        open.push_back({p.t, 0.5 * p.h, p.level + 1});
    }
    return true;
}

/// The length of a curve, by Gauss's rule with three places.
double length_of(const Cubic& c) {
    constexpr double place = 0.3872983346207417;  // sqrt(3/5) / 2
    return (5 * (length(velocity(c, 0.5 - place)) + length(velocity(c, 0.5 + place))) +
            8 * length(velocity(c, 0.5))) /
           18;
}

/// `a` along the piece, where it is `b` at the end, of length 1 in the middle as at the ends.
std::array<Vec3, 3> turning(Vec3 a, Vec3 b) {
    const Vec3 sum = a + b;
    const Vec3 lift = sum * (4 / length(sum) - 2);
    return {a, b - a + lift, -lift};
}

/// What of `side` is perpendicular to `along`, of length 1.
std::optional<Vec3> perpendicular(Vec3 side, Vec3 along) {
    const Vec3 rest = side - along * dot(side, along);
    if (!(length(rest) > 1e-6 * length(side))) return std::nullopt;
    return unit(rest);
}

Vec3 turned(Vec3 a, Vec3 axis, double angle) {
    return a * math::cos(angle) + cross(axis, a) * math::sin(angle);
}

Path failed(std::string problem) {
    Path path;
    path.problem = std::move(problem);
    return path;
}

/// The frame's side at both ends of each step. Nothing where the path turns back.
std::optional<std::vector<std::array<Vec3, 2>>> sides_along(const std::vector<Step>& steps, Vec3 side) {
    std::vector<std::array<Vec3, 2>> sides;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (i > 0) {
            const Vec3 before = steps[i - 1].to, after = steps[i].from;
            if (!(dot(before, after) > turned_back)) return std::nullopt;
            const auto carried = perpendicular(mirrored(sides.back()[1], before + after), after);
            if (!carried) return std::nullopt;
            side = *carried;
        }
        const Step& step = steps[i];
        const Vec3 chord = at(step.curve, 1) - step.curve[0];
        const Vec3 way = step.to - mirrored(step.from, chord);
        const auto end = perpendicular(mirrored(mirrored(side, chord), way), step.to);
        if (!end) return std::nullopt;
        sides.push_back({side, *end});
    }
    return sides;
}

Path path_of(const std::vector<Step>& steps, bool closed, Vec3 side) {
    const auto first = perpendicular(side, steps.front().from);
    if (!first) return failed("side must not be parallel to the path where it begins");
    const Vec3 last = steps.back().to, begin = steps.front().from;
    const auto sides = sides_along(steps, *first);
    if (!sides || (closed && !(dot(last, begin) > turned_back)))
        return failed("the path turns back on itself");

    Path path;
    path.closed = closed;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Step& step = steps[i];
        const Vec3 before = i > 0 ? steps[i - 1].to : closed ? last : step.from;
        path.knots.push_back({step.curve[0], unit(before + step.from)});
        PathPiece piece;
        piece.curve = step.curve;
        piece.first_knot = i;
        piece.last_knot = i + 1;
        piece.bend = step.bend;
        piece.straight = step.straight;
        piece.start = path.length;
        piece.length = length_of(step.curve);
        path.length += piece.length;
        path.pieces.push_back(piece);
    }
    if (closed)
        path.pieces.back().last_knot = 0;
    else
        path.knots.push_back({at(steps.back().curve, 1), last});

    // A closed path may bring the frame back turned: the rest is spread along it.
    double rest = 0;
    if (closed) {
        const Vec3 end = mirrored(sides->back()[1], last + begin);
        rest = -math::atan2(dot(cross(*first, end), begin), dot(*first, end));
        if (math::abs(rest) < 1e-12) rest = 0;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
        PathPiece& piece = path.pieces[i];
        const Step& step = steps[i];
        const std::array<Vec3, 2> ways{step.from, step.to};
        std::array<Vec3, 2> side_at = (*sides)[i], up_at;
        for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
            const double way = piece.start + (end == 0 ? 0.0 : piece.length);
            if (rest != 0) side_at[end] = turned(side_at[end], ways[end], rest * way / path.length);
            up_at[end] = cross(ways[end], side_at[end]);
            const PathKnot& knot = path.knots[end == 0 ? piece.first_knot : piece.last_knot];
            piece.slant[end] = 1 / dot(ways[end], knot.normal);
        }
        piece.straight = piece.straight && rest == 0;
        piece.axes = {turning(side_at[0], side_at[1]), turning(up_at[0], up_at[1])};
    }
    return path;
}

}  // namespace

Path polygon_path(const std::vector<Vec3>& points, Vec3 side) {
    std::vector<Step> steps;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Cubic curve = line(points[i], points[i + 1]);
        if (!(length(curve[1]) > 0)) return failed("two points in a row are the same");
        const Vec3 along = unit(curve[1]);
        steps.push_back({curve, along, along, 0, true});
    }
    return path_of(steps, points.front() == points.back(), side);
}

Path bezier_path(const std::vector<Vec3>& points, Vec3 side) {
    std::vector<Step> steps;
    for (std::size_t i = 0; i + 3 < points.size(); i += 3)
        if (!cut(bezier(points[i], points[i + 1], points[i + 2], points[i + 3]), steps))
            return failed("the curve stands still");
    return path_of(steps, points.front() == points.back(), side);
}

}  // namespace frep::shapes
