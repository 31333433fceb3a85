// Implementation of plane_canvas.h. Coverage of a pen is taken from the distance of the pixel's middle to the
// stroke: a ramp of one pixel across the pen's edge. Colors are mixed as they are encoded (sRGB), which
// keeps thin dark lines on light paper as strong as text renderers make them.
#include "frep/trace/plane_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace frep::drawing {

namespace {

double clamped(double v, double low, double high) { return v < low ? low : v > high ? high : v; }

/// The squared distance of p to the segment.
double distance2(const Segment& s, Vec2 p) {
    const Vec2 d = s.b - s.a, to = p - s.a;
    const double length2 = d.x * d.x + d.y * d.y;
    const double t = length2 > 0 ? clamped((to.x * d.x + to.y * d.y) / length2, 0, 1) : 0;
    const Vec2 off = to - d * t;
    return off.x * off.x + off.y * off.y;
}

/// The pixels whose middles lie from `low` to `high`, cut to 0..count - 1; first > last when there are none.
struct PixelRun {
    int first, last;
};
PixelRun run_of(double low, double high, int count) {
    const double first = clamped(std::ceil(low - 0.5), 0, count), last = std::floor(high - 0.5);
    return {static_cast<int>(first), static_cast<int>(clamped(last, -1, count - 1))};
}

/// How much of pixel i the range from low to high covers.
double overlap(int i, double low, double high) {
    return std::max(0.0, std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)));
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& paper) : image_(Image::sized(width, height)) {
    coverage_.resize(image_.pixels.size() / 4);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) set(x, y, paper);
    }
}

PixelBox Canvas::whole() const {
    return {0, 0, static_cast<double>(image_.width), static_cast<double>(image_.height)};
}

void Canvas::set(int x, int y, const Color& color) {
    std::uint8_t* p =
        &image_.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                            static_cast<std::size_t>(x))];
    p[0] = color_byte(color.r);
    p[1] = color_byte(color.g);
    p[2] = color_byte(color.b);
    p[3] = 255;
}

Color Canvas::get(int x, int y) const {
    const std::uint8_t* p =
        &image_.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                            static_cast<std::size_t>(x))];
    return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0};
}

void Canvas::blend(int x, int y, const Color& color, double share) {
    const Color old = get(x, y);
    set(x, y,
        {old.r + (color.r - old.r) * share, old.g + (color.g - old.g) * share,
         old.b + (color.b - old.b) * share});
}

void Canvas::fill(const PixelBox& box, const Color& color, double opacity) {
    const PixelRun rows = run_of(box.top - 0.5, box.bottom + 0.5, image_.height);
    const PixelRun columns = run_of(box.left - 0.5, box.right + 0.5, image_.width);
    for (int y = rows.first; y <= rows.last; ++y) {
        for (int x = columns.first; x <= columns.last; ++x) {
            const double share = overlap(x, box.left, box.right) * overlap(y, box.top, box.bottom);
            if (share > 0) blend(x, y, color, share * opacity);
        }
    }
}

void Canvas::fill_convex(std::span<const Vec2> corners, const Color& color, double opacity) {
    if (corners.size() < 3) return;
    Vec2 low = corners[0], high = corners[0];
    double turn = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 p = corners[i], q = corners[(i + 1) % corners.size()];
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        turn += p.x * q.y - q.x * p.y;
    }
    const PixelRun rows = run_of(low.y - 1, high.y + 1, image_.height);
    const PixelRun columns = run_of(low.x - 1, high.x + 1, image_.width);
    for (int y = rows.first; y <= rows.last; ++y) {
        for (int x = columns.first; x <= columns.last; ++x) {
            double inside = 1;  // the depth under the nearest side, in pixels, + 1/2
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Vec2 p = corners[i], d = corners[(i + 1) % corners.size()] - p;
                const double length = std::sqrt(d.x * d.x + d.y * d.y);
                if (!(length > 0)) continue;
                const double side = (d.x * (y + 0.5 - p.y) - d.y * (x + 0.5 - p.x)) / length;
                inside = std::min(inside, (turn > 0 ? side : -side) + 0.5);
            }
            if (inside > 0) blend(x, y, color, inside * opacity);
        }
    }
}

void Canvas::cover(const Segment& s, double half_width, const PixelBox& clip) {
    const double reach = half_width + 0.5;
    const PixelRun rows = run_of(std::max(std::min(s.a.y, s.b.y) - reach, clip.top),
                                 std::min(std::max(s.a.y, s.b.y) + reach, clip.bottom), image_.height);
    const PixelRun columns = run_of(std::max(std::min(s.a.x, s.b.x) - reach, clip.left),
                                    std::min(std::max(s.a.x, s.b.x) + reach, clip.right), image_.width);
    // A pen thinner than a pixel covers no more than its width.
    const double most = std::min(1.0, 2 * half_width);
    const double ramp_start = std::max(half_width, 0.5) + 0.5;
    for (int y = rows.first; y <= rows.last; ++y) {
        float* row = &coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width)];
        for (int x = columns.first; x <= columns.last; ++x) {
            const double d2 = distance2(s, {x + 0.5, y + 0.5});
            if (!(d2 < ramp_start * ramp_start)) continue;
            const double share = most * clamped(ramp_start - std::sqrt(d2), 0, 1);
            row[x] = std::max(row[x], static_cast<float>(share));
        }
    }
}

void Canvas::stroke(std::span<const Segment> strokes, double width, const Color& color, double opacity,
                    const PixelBox& clip) {
    Vec2 low{clip.right, clip.bottom}, high{clip.left, clip.top};
    for (const Segment& s : strokes) {
        cover(s, width / 2, clip);
        low = {std::min({low.x, s.a.x, s.b.x}), std::min({low.y, s.a.y, s.b.y})};
        high = {std::max({high.x, s.a.x, s.b.x}), std::max({high.y, s.a.y, s.b.y})};
    }
    const double reach = width + 2;
    const PixelRun rows = run_of(low.y - reach, high.y + reach, image_.height);
    const PixelRun columns = run_of(low.x - reach, high.x + reach, image_.width);
    for (int y = rows.first; y <= rows.last; ++y) {
        float* row = &coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width)];
        for (int x = columns.first; x <= columns.last; ++x) {
            if (row[x] > 0) blend(x, y, color, static_cast<double>(row[x]) * opacity);
            row[x] = 0;
        }
    }
}

void Canvas::stroke(std::span<const Segment> strokes, double width, const Color& color) {
    stroke(strokes, width, color, 1, whole());
}

void Canvas::frame(const PixelBox& box, double width, const Color& color) {
    const Vec2 a{box.left, box.top}, b{box.right, box.top}, c{box.right, box.bottom}, d{box.left, box.bottom};
    const std::array<Segment, 4> sides{{{a, b}, {b, c}, {c, d}, {d, a}}};
    stroke(sides, width, color);
}

void Canvas::text(std::string_view utf8, Vec2 at, TextAnchor anchor, const TextStyle& style,
                  const Color& color) {
    std::vector<Segment> strokes;
    append_text(strokes, utf8, at, anchor, style);
    stroke(strokes, text_pen(style.height), color);
}

}  // namespace frep::drawing
