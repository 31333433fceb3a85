// The colors of a function's values: a diverging scale, blue where it is negative (outside), light at 0,
// orange to brown where it is positive (inside). Lightness falls evenly to both sides in Oklab (B. Ottosson,
// "A perceptual color space for image processing", 2020), and blue against orange is safe for the common
// color blindnesses. Tested by tests/unit/trace/plane_levels_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/geom/color.h"

namespace frep::drawing {

/// The color at `t` from -1 to 1.
Color diverging_color(double t);

/// The colors of the bands that the levels (ascending, not empty) cut the line into, from below the first to
/// above the last: size + 1 of them. A band's color follows its middle, measured by the largest level.
std::vector<Color> band_colors(std::span<const double> levels);

/// The band that a defined value lies in; a value on a level is above it.
std::size_t band_of(std::span<const double> levels, double value);

/// Oklab to sRGB, clamped to what a screen can show.
Color color_from_oklab(double lightness, double a, double b);
/// The lightness of a color in Oklab, 0..1.
double oklab_lightness(const Color& color);

}  // namespace frep::drawing
