// Implementation of polyline.h.
#include "frep/geom/polyline.h"

#include <cstddef>

namespace frep {

double signed_area(const Polyline& line) {
    const std::size_t n = line.points.size();
    if (!line.closed || n < 3) return 0;
    const Vec2 origin = line.points[0];  // differences keep far-away outlines exact
    double twice = 0;
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const Vec2 a = line.points[i] - origin, b = line.points[i + 1] - origin;
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

double length(const Polyline& line) {
    const std::size_t n = line.points.size();
    double sum = 0;
    for (std::size_t i = 0; i + 1 < n + (line.closed && n > 1); ++i) {
        const Vec2 d = line.points[(i + 1) % n] - line.points[i];
        sum += __builtin_sqrt(d.x * d.x + d.y * d.y);
    }
    return sum;
}

}  // namespace frep
