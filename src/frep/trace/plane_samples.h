// Values of a field at the pixels of a window, several to a pixel, and lines of equal value through them by
// marching squares. Tested by tests/unit/trace/plane_samples_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/field_pool.h"
#include "frep/trace/plane_window.h"
#include "frep/trace/stroke_font.h"

namespace frep::drawing {

/// A lattice over a window: `factor` x `factor` samples a pixel, at the middles of the parts of the pixel.
struct Lattice {
    Plane plane;
    Window window;
    int factor = 1;

    std::size_t columns() const {
        return static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(factor);
    }
    std::size_t rows() const {
        return static_cast<std::size_t>(window.rows) * static_cast<std::size_t>(factor);
    }
    /// Where column (or row) c lies, in pixels from the window's upper left corner.
    double pixel(double c) const { return (c + 0.5) / factor; }
    /// The point of space at a place given in pixels.
    Vec3 point(Vec2 pixels) const { return plane.point({window.x(pixels.x), window.y(pixels.y)}); }
};

/// The values, row after row from the top; NaN where undefined. Errors: cancelled.
Result<std::vector<double>> sample(FieldPool& fields, const Lattice& lattice, const Job& job);

/// The border between values >= level and values below it as line pieces in pixels. Cells with an undefined
/// corner have none; at a saddle the mean of the corners decides. `field`: the crossings on the lattice are
/// bisected with it to 1/256 of a step; nullptr: they are interpolated linearly.
std::vector<Segment> isoline(const Lattice& lattice, const std::vector<double>& values, double level,
                             SampledField* field);

}  // namespace frep::drawing
