// The photographer's studio: a light dome above a pale table, with softboxes: a large key light from the
// upper left, a tall strip from the right, a rim light from behind. The studio turns with the camera, so that
// an object on a turntable turns under the same lights. Tested by tests/unit/trace/shading_test.cpp.
#pragma once

#include <array>
#include <span>

#include "frep/math/vec.h"
#include "frep/trace/rgb.h"

namespace frep::tracing {

/// A rectangular lamp, far away.
struct Softbox {
    Vec3 direction;        ///< towards its middle, unit length
    Vec3 across, along;    ///< unit vectors of its sides
    double width, height;  ///< half of its sides at distance 1
    Rgb radiance;

    double spread() const { return 0.5 * (width + height); }
    double solid_angle() const { return 4 * width * height; }
};

class Studio {
  public:
    /// Lights for a camera at `azimuth` degrees.
    explicit Studio(double azimuth);

    /// The light from direction `d` (unit length), blurred as a surface of `roughness` 0..1 sees it.
    Rgb radiance(Vec3 d, double roughness) const;
    /// The even light without the softboxes, for diffuse surfaces; and what a mirror sees between them.
    Rgb dome(Vec3 d) const;
    Rgb room(Vec3 d) const;
    /// The light that the table gives back where nothing shades it.
    Rgb table() const { return {0.62, 0.61, 0.60}; }
    std::span<const Softbox> lamps() const { return lamps_; }

  private:
    std::array<Softbox, 3> lamps_;
};

}  // namespace frep::tracing
