// Color: R, G, B of a surface as people write them, in sRGB (IEC 61966-2-1). Renderers and glTF calculate
// with linear light; the two functions convert. Tested by tests/unit/geom/color_test.cpp.
#pragma once

#include <cstdint>

namespace frep {

/// A color with components 0..1, sRGB-encoded unless a name says linear.
struct Color {
    double r = 0, g = 0, b = 0;
    friend constexpr bool operator==(const Color&, const Color&) = default;
};

/// The linear light of an sRGB color, and back; components are clamped to 0..1 (NaN gives 0). The curve of
/// IEC 61966-2-1: a line near black, then the power 2.4.
Color linear_from_srgb(const Color& color);
Color srgb_from_linear(const Color& color);

/// A component 0..1 as 0..255, rounded to nearest, clamped; NaN gives 0.
constexpr std::uint8_t color_byte(double component) {
    if (!(component > 0)) return 0;
    return component >= 1 ? std::uint8_t{255} : static_cast<std::uint8_t>(component * 255 + 0.5);
}

}  // namespace frep
