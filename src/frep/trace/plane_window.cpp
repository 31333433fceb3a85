// Implementation of plane_window.h.
#include "frep/trace/plane_window.h"

#include <algorithm>
#include <cmath>

namespace frep {

Result<Window> Window::around(const Rectangle& r, int columns, int rows, double margin) {
    FREP_CHECK(columns >= 1 && rows >= 1 && margin >= 0 && margin < 0.5);
    const double width = r.width(), height = r.height();
    const auto is_finite = [](double v) { return v - v == 0; };
    if (!(width > 0 && height > 0) || !is_finite(width) || !is_finite(height))
        return Error{ErrorKind::invalid_argument, "the part of the plane to show is empty or not finite"};
    Window w;
    w.columns = columns;
    w.rows = rows;
    w.step = std::max(width / columns, height / rows) / (1 - 2 * margin);
    w.left = r.min.x + width / 2 - w.step * (columns / 2.0);
    w.top = r.min.y + height / 2 + w.step * (rows / 2.0);
    const Rectangle seen = w.rectangle();
    const double largest = std::max(
        {std::fabs(seen.min.x), std::fabs(seen.max.x), std::fabs(seen.min.y), std::fabs(seen.max.y)});
    if (!is_finite(largest) || !(w.step > largest * 0x1p-48))
        return Error{ErrorKind::invalid_argument,
                     "the part of the plane to show is too small for its distance from the origin"};
    return w;
}

}  // namespace frep
