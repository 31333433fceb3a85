// Sweeps and their rows. See sweeps.h.
#include "frep/shapes/sweeps.h"

#include <vector>

#include "frep/shapes/binding.h"
#include "frep/shapes/contour_sweep.h"
#include "frep/shapes/searching.h"

namespace frep::shapes {

namespace {

/// The largest value of f while its origin is at path(t), t in [0, 1].
template <class Path>
std::optional<Expression> sweep(Build& build, Array x, Expression f, Path path, Expression tolerance) {
    const Expression t = unit_variable(build);
    std::vector<Expression> p;
    for (std::size_t i = 0; i < x.size(); ++i) p.push_back(x[i] - path(i, t));
    const auto there = moved(build, f, x, p);
    if (!there) return std::nullopt;
    return search(build, *there, {&t, 1}, tolerance);
}

/// a + t (b - a).
Expression between(Expression a, Expression b, Expression t) { return a + t * (b - a); }

}  // namespace

Expression sweep_polygon(Build& build, Array x, Expression f, Array points, Expression tolerance) {
    const std::size_t n = x.size();
    if (n == 0 || points.size() < 2 * n || points.size() % n != 0)
        return build.error("points must have as many items as x for each of two or more points");
    std::optional<Expression> all;
    for (std::size_t k = 0; k + 2 * n <= points.size(); k += n) {
        const auto side = [&](std::size_t i, Expression t) {
            return between(points[k + i], points[k + n + i], t);
        };
        const auto part = sweep(build, x, f, side, tolerance);
        if (!part) return build.constant(error_value);
        all = all ? max(*all, *part) : *part;
    }
    return *all;
}

Expression sweep_bezier(Build& build, Array x, Expression f, Array points, Expression tolerance) {
    const std::size_t n = x.size();
    if (n == 0 || points.size() != 4 * n)
        return build.error("points must have as many items as x for each of four points");
    const auto curve = [&](std::size_t i, Expression t) {
        // c0 + t (c1 + t (c2 + t c3))
        const Expression p = points[i], q = points[n + i], r = points[2 * n + i], s = points[3 * n + i];
        const Expression c1 = 3.0 * (q - p), c2 = 3.0 * (p - 2.0 * q + r), c3 = s - p + 3.0 * (q - r);
        return p + t * (c1 + t * (c2 + t * c3));
    };
    const auto value = sweep(build, x, f, curve, tolerance);
    return value ? *value : build.constant(error_value);
}

Rows sweep_rows() {
    constexpr std::string_view cite = "sourin1996";
    constexpr std::string_view promise =
        "f stands as it is at the origin. Proved to the tolerance as hfMaximum. For other motions write "
        "hfVariable and hfMaximum: the moved point goes into the function of the solid.";
    constexpr std::string_view contour = "pasko1996";
    constexpr std::string_view frame =
        "f is written in the items of x: x[1] is u, x[2] is v, x[3] is t, by which it may change along the "
        "path. u points along side where the path begins and is then turned as little as possible "
        "(wang2008); v is perpendicular to the path and to u. A path that ends where it begins is closed. "
        "points and side may not depend on the point. No search.";
    return {
        row<&sweep_polygon>("hfSweepPolygon", "x, f, points, tolerance",
                            {"Sweep of the solid f along the polygon of points, whose items are those of x.",
                             "max over t of f(x - p(t)), p(t) on the polygon", cite, promise},
                            false),
        row<&sweep_bezier>("hfSweepBezier", "x, f, points, tolerance",
                           {"Sweep of the solid f along the cubic Bezier curve of four control points.",
                            "max over t of f(x - p(t)), p(t) = sum of B_i(t) p_i", cite, promise},
                           false),
        row<&sweep_contour_polygon>(
            "hfSweepContourPolygon", "x, f, points, side",
            {"Sweep of the contour f along a polygon in space: bars and frames with mitred corners.",
             "f(u, v, t): from the path of the point u to the side, v upwards; t = 0..1 along the path",
             contour, frame},
            false),
        row<&sweep_contour_bezier>(
            "hfSweepContourBezier", "x, f, points, side",
            {"Sweep of the contour f along cubic Bezier curves in space, of 4, 7, 10, ... control points.",
             "f(u, v, t): from the path of the point u to the side, v upwards; t = 0..1 along the path",
             contour, frame},
            false),
    };
}

}  // namespace frep::shapes
