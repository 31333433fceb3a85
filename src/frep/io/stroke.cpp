// Lines with a width. See stroke.h.
#include "frep/io/stroke.h"

#include <algorithm>
#include <cmath>

#include "frep/math/functions.h"
#include "frep/math/number.h"

namespace frep::reading {

namespace {

constexpr double pi = 3.14159265358979323846;

double cross_of(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double dot_of(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
Vec2 left_of(Vec2 v) { return {-v.y, v.x}; }

/// An edge of the line: its direction, a unit vector, and its length.
struct Edge {
    Vec2 along;
    double length;

    Edge reversed() const { return {along * -1.0, length}; }
};

class Stroker {
  public:
    Stroker(const CurvePoints& line, bool closed, const Pen& pen, double tolerance)
        : points_(line.points), is_smooth_(line.is_smooth), pen_(pen), half_(0.5 * pen.width) {
        if (closed && points_.size() > 1 && points_.front() == points_.back()) points_.pop_back();
        closed_ = closed && points_.size() > 1;
        const std::size_t edges = points_.size() - (closed_ ? 0 : 1);
        for (std::size_t i = 0; i < edges; ++i) {
            const Vec2 way = points_[(i + 1) % points_.size()] - points_[i];
            const double length = math::hypot(way.x, way.y);
            edges_.push_back({{way.x / length, way.y / length}, length});
        }
        // a chord of this angle leaves the circle by the tolerance
        const double part = tolerance / half_;
        step_ = std::clamp(part < 1 ? std::sqrt(8 * part) : pi, 0.005, pi / 4);
    }

    std::vector<std::vector<Vec2>> contours() {
        if (edges_.empty()) {
            dot();
        } else if (closed_) {
            side(false);
            end_contour();
            side(true);
        } else {
            side(false);
            cap(points_.back(), edges_.back());
            side(true);
            cap(points_.front(), edges_.front().reversed());
        }
        end_contour();
        return std::move(out_);
    }

  private:
    void end_contour() {
        if (contour_.size() > 2) out_.push_back(std::move(contour_));
        contour_.clear();
    }

    /// A line without length shows the ends of its pen.
    void dot() {
        if (pen_.cap == Pen::Cap::butt) return;
        const Edge east{{1, 0}, 0};
        cap(points_[0], east);
        cap(points_[0], east.reversed());
    }

    /// The left side of the line, or of the reversed line.
    void side(bool reversed) {
        const std::size_t n = edges_.size(), m = points_.size();
        const auto edge = [&](std::size_t i) { return reversed ? edges_[n - 1 - i].reversed() : edges_[i]; };
        for (std::size_t i = closed_ ? 0 : 1; i < n; ++i) {
            const std::size_t at = reversed ? (n - i) % m : i;
            join(points_[at], edge((i + n - 1) % n), edge(i), is_smooth_[at]);
        }
    }

    void join(Vec2 p, const Edge& in, const Edge& out, bool is_smooth) {
        const Vec2 from = left_of(in.along) * half_, to = left_of(out.along) * half_;
        const double sine = cross_of(in.along, out.along), cosine = dot_of(in.along, out.along);
        contour_.push_back(p + from);
        if (sine > 0) {
            // The short cut takes a triangle away that both edges' rectangles cover, if they are long enough.
            const double reach = half_ * sine;
            if (cosine < 0 || in.length < reach || out.length < reach) contour_.push_back(p);
        } else if (is_smooth || pen_.join == Pen::Join::round) {
            turn(p, from, math::atan2(-sine, cosine));
        } else if (pen_.join == Pen::Join::miter && 2 <= pen_.miter_limit * pen_.miter_limit * (1 + cosine)) {
            contour_.push_back(p + (from + to) * (1 / (1 + cosine)));
        }
        contour_.push_back(p + to);
    }

    /// From the left side at the end of an edge to its right side.
    void cap(Vec2 p, const Edge& edge) {
        const Vec2 side = left_of(edge.along) * half_;
        Vec2 end = p;
        if (pen_.cap == Pen::Cap::square) end = p + edge.along * half_;
        contour_.push_back(end + side);
        if (pen_.cap == Pen::Cap::round) turn(p, side, pi);
        contour_.push_back(end - side);
    }

    /// Points between p + from and what an angle clockwise makes of it.
    void turn(Vec2 p, Vec2 from, double angle) {
        const int pieces = static_cast<int>(std::ceil(angle / step_));
        for (int i = 1; i < pieces; ++i) {
            const double a = angle * i / pieces, c = math::cos(a), s = math::sin(a);
            contour_.push_back(p + Vec2{c * from.x + s * from.y, c * from.y - s * from.x});
        }
    }

    std::vector<Vec2> points_;
    const std::vector<bool>& is_smooth_;
    const Pen& pen_;
    double half_, step_ = 1;
    bool closed_ = false;
    std::vector<Edge> edges_;
    std::vector<Vec2> contour_;
    std::vector<std::vector<Vec2>> out_;
};

}  // namespace

void append_stroke(const CurvePoints& line, bool closed, const Pen& pen, double tolerance, std::size_t most,
                   std::size_t& count, std::vector<std::vector<Vec2>>& out) {
    if (!(pen.width > 0) || count > most) return;
    for (auto& contour : Stroker(line, closed, pen, tolerance).contours()) {
        count += contour.size();
        out.push_back(std::move(contour));
    }
}

}  // namespace frep::reading
