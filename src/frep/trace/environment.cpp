// Implementation of environment.h.
#include "frep/trace/environment.h"

#include "frep/trace/camera.h"

namespace frep::tracing {

namespace {

Vec3 unit(Vec3 v) { return v / length(v); }

/// A lamp at right * x + toward the viewer * y + up * z.
Softbox lamp(const ViewFrame& frame, Vec3 place, double width, double height, Rgb radiance) {
    Softbox box;
    const Vec3 world = frame.right * place.x - frame.forward * place.y + Vec3{0, 0, place.z};
    box.direction = unit(world);
    box.across = unit(cross({0, 0, 1}, box.direction));
    box.along = cross(box.direction, box.across);
    box.width = width;
    box.height = height;
    box.radiance = radiance;
    return box;
}

/// The share of an edge of half-width `half` around 0 that a blur of half-width `blur` at x sees.
double covered(double x, double half, double blur) {
    return smooth_step(-blur, blur, x + half) - smooth_step(-blur, blur, x - half);
}

}  // namespace

Studio::Studio(double azimuth) {
    const ViewFrame frame = view_frame({.azimuth = azimuth, .elevation = 0});
    lamps_[0] = lamp(frame, {-0.80, 0.60, 0.95}, 0.33, 0.26, {8.0, 7.85, 7.6});
    lamps_[1] = lamp(frame, {1.0, 0.25, 0.30}, 0.11, 0.55, {4.2, 4.3, 4.5});
    lamps_[2] = lamp(frame, {0.35, -0.9, 0.70}, 0.50, 0.16, {6.0, 6.0, 6.1});
}

Rgb Studio::dome(Vec3 d) const {
    const Rgb zenith{0.54, 0.545, 0.55}, horizon{0.27, 0.265, 0.26}, floor{0.36, 0.35, 0.34};
    if (d.z >= 0) return mix(horizon, zenith, smooth_step(0, 0.9, d.z));
    return mix(horizon, floor, smooth_step(0, 0.5, -d.z));
}

/// The dark room around the lamps, a bright ceiling, the pale table.
Rgb Studio::room(Vec3 d) const {
    const Rgb dark{0.07, 0.068, 0.067}, ceiling{1.25, 1.24, 1.22}, haze{0.26, 0.255, 0.25};
    if (d.z < 0) return mix(haze, table(), smooth_step(0, 0.25, -d.z));
    return mix(mix(haze, dark, smooth_step(0, 0.30, d.z)), ceiling, smooth_step(0.55, 0.98, d.z));
}

Rgb Studio::radiance(Vec3 d, double roughness) const {
    // A rough surface sees the room blurred: nearer to the even dome.
    Rgb sum = mix(room(d), dome(d), smooth_step(0.1, 0.8, roughness));
    const double blur = 0.035 + 1.6 * roughness * roughness;
    for (const Softbox& box : lamps_) {
        const double c = dot(d, box.direction);
        if (c <= 0.02) continue;
        const double x = dot(d, box.across) / c, y = dot(d, box.along) / c;
        // A lamp is brighter in its middle.
        const double u = x / (box.width + blur), v = y / (box.height + blur);
        const double middle = 1.12 - 0.30 * (u * u + v * v);
        sum += box.radiance *
               (covered(x, box.width, blur) * covered(y, box.height, blur) * std::max(middle, 0.3));
    }
    return sum;
}

}  // namespace frep::tracing
