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
    lamps_[0] = lamp(frame, {-0.75, 0.62, 0.95}, 0.42, 0.34, {3.5, 3.42, 3.3});
    lamps_[1] = lamp(frame, {1.0, 0.30, 0.35}, 0.16, 0.60, {1.9, 1.95, 2.05});
    lamps_[2] = lamp(frame, {0.35, -0.9, 0.75}, 0.55, 0.22, {2.6, 2.6, 2.65});
}

Rgb Studio::dome(Vec3 d) const {
    const Rgb zenith{0.50, 0.51, 0.53}, horizon{0.34, 0.335, 0.33}, floor{0.42, 0.41, 0.395};
    if (d.z >= 0) return mix(horizon, zenith, smooth_step(0, 0.9, d.z));
    return mix(horizon, floor, smooth_step(0, 0.5, -d.z));
}

Rgb Studio::radiance(Vec3 d, double roughness) const {
    Rgb sum = dome(d);
    const double blur = 0.05 + 1.6 * roughness * roughness;
    for (const Softbox& box : lamps_) {
        const double c = dot(d, box.direction);
        if (c <= 0.02) continue;
        const double x = dot(d, box.across) / c, y = dot(d, box.along) / c;
        sum += box.radiance * (covered(x, box.width, blur) * covered(y, box.height, blur));
    }
    return sum;
}

}  // namespace frep::tracing
