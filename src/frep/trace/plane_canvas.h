// Canvas: flat drawing into a picture: filled rectangles and polygons, and lines of a pen, all anti-aliased.
// A set of strokes covers a pixel once, however many of them meet there, so that joints and letters are even.
// Tested by tests/unit/trace/plane_canvas_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/geom/color.h"
#include "frep/geom/image.h"
#include "frep/trace/stroke_font.h"

namespace frep::drawing {

/// A part of a picture, in pixels: x to the right, y down. Empty unless min < max.
struct PixelBox {
    double left = 0, top = 0, right = 0, bottom = 0;
    double width() const { return right - left; }
    double height() const { return bottom - top; }
};

class Canvas {
  public:
    /// A canvas of one opaque color. Sizes are at least 1.
    Canvas(int width, int height, const Color& paper);

    const Image& image() const& { return image_; }
    Image image() && { return std::move(image_); }
    PixelBox whole() const;

    /// Replaces the pixel in column x and row y.
    void set(int x, int y, const Color& color);
    Color get(int x, int y) const;

    /// Fills a rectangle; its sides may lie between pixels.
    void fill(const PixelBox& box, const Color& color, double opacity = 1);
    /// Fills a convex polygon given by its corners in either direction.
    void fill_convex(std::span<const Vec2> corners, const Color& color, double opacity = 1);
    /// Draws the strokes with a round pen of `width` pixels, inside `clip` only.
    void stroke(std::span<const Segment> strokes, double width, const Color& color, double opacity,
                const PixelBox& clip);
    void stroke(std::span<const Segment> strokes, double width, const Color& color);
    /// The outline of a box, the pen's middle on its sides.
    void frame(const PixelBox& box, double width, const Color& color);
    /// Text with the pen that suits it.
    void text(std::string_view utf8, Vec2 at, TextAnchor anchor, const TextStyle& style, const Color& color);

  private:
    void blend(int x, int y, const Color& color, double share);
    void cover(const Segment& s, double half_width, const PixelBox& clip);

    Image image_;
    std::vector<float> coverage_;  ///< of the strokes being drawn; 0 between calls
};

}  // namespace frep::drawing
