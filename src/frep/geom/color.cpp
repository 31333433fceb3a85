// Implementation of color.h.
#include "frep/geom/color.h"

#include "frep/math/functions.h"

namespace frep {

namespace {

double clamped(double v) { return !(v > 0) ? 0 : v > 1 ? 1 : v; }

double to_linear(double encoded) {
    const double c = clamped(encoded);
    return c <= 0.04045 ? c / 12.92 : math::pow((c + 0.055) / 1.055, 2.4);
}

double to_srgb(double linear) {
    const double c = clamped(linear);
    return c <= 0.0031308 ? c * 12.92 : 1.055 * math::pow(c, 1 / 2.4) - 0.055;
}

}  // namespace

Color linear_from_srgb(const Color& color) {
    return {to_linear(color.r), to_linear(color.g), to_linear(color.b)};
}

Color srgb_from_linear(const Color& color) { return {to_srgb(color.r), to_srgb(color.g), to_srgb(color.b)}; }

}  // namespace frep
