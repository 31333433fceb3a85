// Contours of curves. See curves.h.
#include "frep/io/curves.h"

#include <algorithm>
#include <cmath>

#include "frep/math/functions.h"
#include "frep/math/number.h"

namespace frep::reading {

namespace {

constexpr double pi = 3.14159265358979323846;

double length(Vec2 v) { return math::hypot(v.x, v.y); }

/// The angle of a vector.
double angle_of(Vec2 v) { return math::atan2(v.y, v.x); }

}  // namespace

Affine Affine::operator*(const Affine& inner) const {
    return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
            b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

double Affine::norm() const { return math::hypot(math::hypot(a, b), math::hypot(c, d)); }

CurveContour mapped(const CurveContour& contour, const Affine& map) {
    CurveContour out{map(contour.start), contour.segments, contour.closed};
    for (Segment& segment : out.segments) {
        segment.c1 = map(segment.c1);
        segment.c2 = map(segment.c2);
        segment.to = map(segment.to);
    }
    return out;
}

void CurveWriter::move(Vec2 p) {
    at_ = start_ = p;
    if (!contours_.empty() && contours_.back().segments.empty()) contours_.pop_back();
    contours_.push_back({map_(p), {}});
}

void CurveWriter::add(const Segment& segment) {
    if (contours_.empty()) contours_.push_back({map_(at_), {}});
    contours_.back().segments.push_back(segment);
}

void CurveWriter::line(Vec2 p) {
    add({true, {}, {}, map_(p)});
    at_ = p;
}

void CurveWriter::quadratic(Vec2 control, Vec2 p) {
    const double third = 1.0 / 3.0;
    cubic(at_ * third + control * (2.0 * third), p * third + control * (2.0 * third), p);
}

void CurveWriter::cubic(Vec2 c1, Vec2 c2, Vec2 p) {
    add({false, map_(c1), map_(c2), map_(p)});
    at_ = p;
}

// The centre is found as in SVG 1.1, F.6.5; the pieces are the usual cubics with handles 4/3 tan(angle/4).
void CurveWriter::arc(const ArcShape& shape, Vec2 p) {
    double rx = std::fabs(shape.rx), ry = std::fabs(shape.ry);
    if (p == at_) return;
    if (!(rx > 0) || !(ry > 0)) return line(p);
    const double phi = std::fmod(shape.turn, 360.0) * (pi / 180.0), c = math::cos(phi), s = math::sin(phi);
    // the chord in the frame of the axes, scaled to a unit circle
    const Vec2 half = (at_ - p) * 0.5;
    const Vec2 u{(c * half.x + s * half.y) / rx, (c * half.y - s * half.x) / ry};
    const double square = u.x * u.x + u.y * u.y;
    if (!(square < 1e300)) return line(p);
    double off = 0;
    if (square >= 1) {
        rx *= std::sqrt(square);
        ry *= std::sqrt(square);
    } else {
        off = std::sqrt((1 - square) / square);
        if (shape.large == shape.sweep) off = -off;
    }
    const double grow = square >= 1 ? std::sqrt(square) : 1;
    const Vec2 start{u.x / grow, u.y / grow}, centre{off * start.y, -off * start.x};
    const double first = angle_of(start - centre), last = angle_of(start * -1.0 - centre);
    double sweep = last - first;
    if (shape.sweep && sweep < 0) sweep += 2 * pi;
    if (!shape.sweep && sweep > 0) sweep -= 2 * pi;
    const Vec2 middle = (at_ + p) * 0.5;
    const auto place = [&](Vec2 q) -> Vec2 {
        const double x = rx * (q.x + centre.x), y = ry * (q.y + centre.y);
        return {middle.x + c * x - s * y, middle.y + s * x + c * y};
    };
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::fabs(sweep) / (pi / 8) - 1e-9)));
    const double step = sweep / pieces, handle = 4.0 / 3.0 * math::tan(step / 4);
    for (int i = 0; i < pieces; ++i) {
        const double from = first + i * step, to = first + (i + 1) * step;
        const Vec2 a{math::cos(from), math::sin(from)}, b{math::cos(to), math::sin(to)};
        cubic(place({a.x - handle * a.y, a.y + handle * a.x}),
              place({b.x + handle * b.y, b.y - handle * b.x}), i + 1 == pieces ? p : place(b));
    }
}

void CurveWriter::close() {
    line(start_);
    contours_.back().closed = true;
}

void CurveWriter::ellipse(Vec2 centre, double rx, double ry) {
    const Vec2 east{centre.x + rx, centre.y}, west{centre.x - rx, centre.y};
    move(east);
    arc({rx, ry, 0, false, true}, west);
    arc({rx, ry, 0, false, true}, east);
    close();
}

std::vector<CurveContour> CurveWriter::take() {
    if (!contours_.empty() && contours_.back().segments.empty()) contours_.pop_back();
    return std::move(contours_);
}

void Box2::add(Vec2 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
}

double Box2::larger_side() const { return is_empty() ? 0 : std::max(max.x - min.x, max.y - min.y); }

Box2 box_of(const std::vector<CurveContour>& contours) {
    Box2 box;
    for (const CurveContour& contour : contours) {
        if (contour.segments.empty()) continue;
        box.add(contour.start);
        for (const Segment& segment : contour.segments) {
            box.add(segment.to);
            if (segment.is_line) continue;
            box.add(segment.c1);
            box.add(segment.c2);
        }
    }
    return box;
}

CurvePoints points_of(const CurveContour& contour, double tolerance, std::size_t most) {
    constexpr double most_pieces = 2000;
    CurvePoints out{{contour.start}, {false}};
    const auto add = [&out](Vec2 p, bool is_smooth) {
        if (out.points.back() == p) return;
        out.points.push_back(p);
        out.is_smooth.push_back(is_smooth);
    };
    Vec2 at = contour.start;
    for (const Segment& s : contour.segments) {
        if (!s.is_line) {
            const double bend = std::max(length(at - s.c1 * 2.0 + s.c2), length(s.c1 - s.c2 * 2.0 + s.to));
            const double wanted = tolerance > 0 ? std::sqrt(0.75 * bend / tolerance) : most_pieces;
            const int pieces = static_cast<int>(std::ceil(std::clamp(wanted, 1.0, most_pieces)));
            for (int i = 1; i < pieces; ++i) {
                const double t = static_cast<double>(i) / pieces, r = 1 - t;
                add(at * (r * r * r) + s.c1 * (3 * r * r * t) + s.c2 * (3 * r * t * t) + s.to * (t * t * t),
                    true);
            }
        }
        add(s.to, false);
        at = s.to;
        if (out.points.size() > most) break;
    }
    return out;
}

std::vector<std::vector<Vec2>> polygons_of(const std::vector<CurveContour>& contours, double tolerance,
                                           std::size_t most) {
    std::vector<std::vector<Vec2>> out;
    std::size_t count = 0;
    for (const CurveContour& contour : contours) {
        std::vector<Vec2> polygon = points_of(contour, tolerance, most - count).points;
        while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
        count += polygon.size();
        if (polygon.size() > 2) out.push_back(std::move(polygon));
        if (count > most) break;
    }
    return out;
}

}  // namespace frep::reading
