// The window through which a picture looks at a plane. Tested by tests/unit/trace/plane_window_test.cpp.
#pragma once

#include "frep/base/result.h"
#include "frep/eval/plane.h"

namespace frep {

/// Where the pixels of a picture of the plane lie: the middle of the pixel in column i and row j is at
/// x(i + 1/2), y(j + 1/2). One step for both axes: circles stay circles. Rows run from top to bottom.
struct Window {
    double left = 0, top = 0, step = 1;  ///< model units; step > 0
    int columns = 1, rows = 1;

    double x(double column) const { return left + column * step; }
    double y(double row) const { return top - row * step; }
    Rectangle rectangle() const { return {{left, y(rows)}, {x(columns), top}}; }

    /// The window of columns x rows pixels (at least 1) around the middle of `r` that just holds it, with
    /// `margin` free on every side (a share of the picture's sides, below 1/2). Errors: invalid_argument for
    /// a rectangle that is empty or not finite, or whose pixels would coincide in double.
    static Result<Window> around(const Rectangle& r, int columns, int rows, double margin = 0);
};

}  // namespace frep
