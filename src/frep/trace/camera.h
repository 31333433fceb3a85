// The camera of a picture: where it stands, and the ray of every point of the picture. Space is right-handed
// with Z up; the camera at azimuth 0 and elevation 0 looks along +Y, with X to the right ("front").
// Tested by tests/unit/trace/camera_test.cpp.
#pragma once

#include <span>

#include "frep/math/vec.h"

namespace frep {

/// The direction that a picture is taken from. Angles in degrees.
struct View {
    double azimuth = 30;        ///< around Z from the front towards the right
    double elevation = 20;      ///< above the horizon, -90..90
    double field_of_view = 20;  ///< across the picture's longer side; 0 = parallel rays (orthographic)
    double zoom = 1;            ///< > 1 comes closer
};

namespace tracing {

/// A ray; `direction` has unit length.
struct Ray {
    Vec3 origin, direction;
};

/// The frame of a view: unit vectors to the right, up and forward (away from the viewer).
struct ViewFrame {
    Vec3 right, up, forward;
};
ViewFrame view_frame(const View& view);

class Camera {
  public:
    /// A camera that sees all of `points` (at least one), centered, with a margin, at zoom 1.
    Camera(const View& view, std::span<const Vec3> points, int width, int height);

    /// The ray through the point (x, y) of the picture, in pixels from the upper left corner.
    Ray ray(double x, double y) const;
    const ViewFrame& frame() const { return frame_; }
    /// The side of a pixel in model units at the distance of the object.
    double pixel_size() const { return pixel_; }

  private:
    ViewFrame frame_;
    Vec3 origin_;       ///< the eye, or the middle of the picture's plane for parallel rays
    double scale_ = 0;  ///< pixels to plane coordinates (at distance 1 for perspective)
    double pixel_ = 0;
    double half_width_, half_height_;
    bool parallel_;
};

}  // namespace tracing
}  // namespace frep
