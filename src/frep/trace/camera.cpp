// Implementation of camera.h.
#include "frep/trace/camera.h"

#include <algorithm>

#include "frep/math/functions.h"

namespace frep::tracing {

namespace {

constexpr double radians = 3.14159265358979323846 / 180;
/// The share of the picture that the object may fill.
constexpr double fill = 0.84;

struct Range {
    double lo = 1e300, hi = -1e300;
    void add(double v) {
        lo = std::min(lo, v);
        hi = std::max(hi, v);
    }
    double middle() const { return lo + 0.5 * (hi - lo); }
    double half() const { return 0.5 * (hi - lo); }
};

/// Sine and cosine of degrees, exact at multiples of 90.
double sine(double degrees) {
    const double turn = degrees - 360 * __builtin_floor(degrees / 360);
    if (turn == 0 || turn == 180) return 0;
    if (turn == 90) return 1;
    if (turn == 270) return -1;
    return math::sin(turn * radians);
}
double cosine(double degrees) { return sine(degrees + 90); }

}  // namespace

ViewFrame view_frame(const View& view) {
    const double sa = sine(view.azimuth), ca = cosine(view.azimuth);
    const double se = sine(view.elevation), ce = cosine(view.elevation);
    return {{ca, sa, 0}, {-sa * se, ca * se, ce}, {-sa * ce, ca * ce, -se}};
}

Camera::Camera(const View& view, std::span<const Vec3> points, int width, int height)
    : frame_(view_frame(view)),
      half_width_(0.5 * width),
      half_height_(0.5 * height),
      parallel_(!(view.field_of_view > 0)) {
    Range u, v, w;
    for (const Vec3& p : points) {
        u.add(dot(p, frame_.right));
        v.add(dot(p, frame_.up));
        w.add(dot(p, frame_.forward));
    }
    const double longer = std::max(half_width_, half_height_);
    const double size = std::max({u.half(), v.half(), w.half(), 1e-300});
    double mu = u.middle(), mv = v.middle();
    if (parallel_) {
        scale_ = std::max(u.half() / half_width_, v.half() / half_height_) / fill / view.zoom;
        if (!(scale_ > 0)) scale_ = size / longer;
        pixel_ = scale_;
        origin_ = frame_.right * mu + frame_.up * mv + frame_.forward * (w.lo - 2 * size);
        return;
    }
    const double tangent = math::tan(0.5 * view.field_of_view * radians);
    scale_ = tangent / longer;
    // The eye stands at w0; it goes back until every point fits, then sideways until they are in the middle.
    const auto step_back = [&] {
        double place = w.lo - 0.05 * size;
        for (const Vec3& p : points) {
            const double pu = __builtin_fabs(dot(p, frame_.right) - mu) / (scale_ * half_width_ * fill);
            const double pv = __builtin_fabs(dot(p, frame_.up) - mv) / (scale_ * half_height_ * fill);
            place = std::min(place, dot(p, frame_.forward) - std::max(pu, pv));
        }
        return place;
    };
    double w0 = step_back();
    for (int round = 0; round < 6; ++round) {
        Range x, y;
        for (const Vec3& p : points) {
            const double depth = dot(p, frame_.forward) - w0;
            x.add((dot(p, frame_.right) - mu) / depth);
            y.add((dot(p, frame_.up) - mv) / depth);
        }
        const double depth = w.middle() - w0;
        mu += x.middle() * depth;
        mv += y.middle() * depth;
        w0 = step_back();
    }
    scale_ /= view.zoom;
    pixel_ = scale_ * (w.middle() - w0);
    origin_ = frame_.right * mu + frame_.up * mv + frame_.forward * w0;
}

Ray Camera::ray(double x, double y) const {
    const Vec3 across =
        frame_.right * ((x - half_width_) * scale_) + frame_.up * ((half_height_ - y) * scale_);
    if (parallel_) return {origin_ + across, frame_.forward};
    const Vec3 direction = frame_.forward + across;
    return {origin_, direction / length(direction)};
}

}  // namespace frep::tracing
