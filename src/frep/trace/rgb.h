// Linear light as three numbers, and the small functions that shading is made of. Tested by
// tests/unit/trace/shading_test.cpp.
#pragma once

#include <algorithm>

#include "frep/geom/color.h"
#include "frep/math/vec.h"

namespace frep::tracing {

/// Linear R, G, B; 1 is the light of a white surface under the studio's lamps, highlights are brighter.
struct Rgb {
    double r = 0, g = 0, b = 0;

    friend constexpr Rgb operator+(Rgb x, Rgb y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
    friend constexpr Rgb operator-(Rgb x, Rgb y) { return {x.r - y.r, x.g - y.g, x.b - y.b}; }
    friend constexpr Rgb operator*(Rgb x, Rgb y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
    friend constexpr Rgb operator*(Rgb x, double s) { return {x.r * s, x.g * s, x.b * s}; }
    friend constexpr Rgb operator*(double s, Rgb x) { return x * s; }
    Rgb& operator+=(Rgb x) { return *this = *this + x; }
};

inline Rgb linear(const Color& color) {
    const Color c = linear_from_srgb(color);
    return {c.r, c.g, c.b};
}

constexpr double mix(double a, double b, double share) { return a + (b - a) * share; }
constexpr Rgb mix(Rgb a, Rgb b, double share) { return a + (b - a) * share; }
constexpr double clamped(double x) { return x < 0 ? 0 : (x > 1 ? 1 : x); }
/// 0 below `lo`, 1 above `hi`, a cubic without corners between.
constexpr double smooth_step(double lo, double hi, double x) {
    const double t = clamped((x - lo) / (hi - lo));
    return t * t * (3 - 2 * t);
}
/// Schlick 1994: the share 0..1 that grows to 1 at grazing angles; `cosine` of the angle to the normal.
constexpr double schlick(double cosine) {
    const double m = clamped(1 - cosine);
    return m * m * m * m * m;
}
/// The luminance of linear Rec. 709 light.
constexpr double luminance(Rgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

}  // namespace frep::tracing
