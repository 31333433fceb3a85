// Text as strokes: a small vector font for the labels of pictures. Each character is a few lines and
// quadratic curves on a grid where a capital letter is 14 high; the table (stroke_glyphs.cpp) is the
// project's own. ASCII, the letters of Latin-1 with their accents, and the signs of mathematics that labels
// need. Tested by tests/unit/trace/plane_text_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frep/math/vec.h"

namespace frep::drawing {

/// A straight piece of a drawing, in pixels: x to the right, y down, (0, 0) the top left corner.
struct Segment {
    Vec2 a, b;
};

/// How text lies: `height` is that of a capital letter in pixels.
struct TextStyle {
    double height = 10;
    bool upright = true;  ///< false: turned by 90 degrees, read from bottom to top
};

/// Horizontal alignment of a text to its point.
enum class TextAnchor { start, middle, end };

/// The length of the text from the first to the last ink, in pixels, without the width of the pen.
double text_width(std::string_view utf8, double height);

/// True if the font has every character of the text.
bool has_glyphs(std::string_view utf8);

/// Appends the strokes of the text; `at` is on the baseline. A character that the font lacks becomes a box.
void append_text(std::vector<Segment>& out, std::string_view utf8, Vec2 at, TextAnchor anchor,
                 const TextStyle& style);

/// The width of the pen that suits letters of this height.
double text_pen(double height);

/// The text, cut and ended with "..." if it is longer than `width`.
std::string fitted_text(std::string_view utf8, double height, double width);

namespace glyphs {

/// A character: how wide its ink is, and its strokes as "M x y L x y Q cx cy x y ..." (move, line, quadratic
/// curve), y up from the baseline.
struct Glyph {
    char32_t code;
    double width;
    std::string_view path;
};

inline constexpr double cap_height = 14, x_height = 10, spacing = 3, descent = -4.3;

/// The entry of the table, or nullptr.
const Glyph* find(char32_t code);

/// A letter that is drawn as another one with a mark above or below, e.g. e and an acute accent.
struct Composed {
    char32_t code;
    char32_t base;
    char mark;  ///< ' ` ^ ~ " (two dots) o (ring) , (cedilla) v (caron)
};
const Composed* find_composed(char32_t code);

/// The strokes of a mark, centered on x = 0, as over a small letter; empty for an unknown one.
std::string_view mark_path(char mark);

}  // namespace glyphs

}  // namespace frep::drawing
