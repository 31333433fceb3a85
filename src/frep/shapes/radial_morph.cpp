// Metamorphosis by radial functions and its row. See radial_morph.h.
#include "frep/shapes/radial_morph.h"

#include <fmt/format.h>

#include "frep/math/number.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/radial.h"
#include "frep/shapes/surface_points.h"

namespace frep::shapes {

namespace {

/// How often the step inwards is halved where it leaves the shape again.
constexpr int most_halvings = 4;

/// A place inside and its distance from the boundary; 0 where none was found.
struct InnerPoint {
    Vec3 place;
    double depth = 0;
};

/// The point at the largest step of inset, inset/2, ... that is inside: the nearest boundary point tells.
InnerPoint inner_point(const std::vector<SurfacePoint>& points, const SurfacePoint& from, double inset) {
    double step = inset;
    for (int halving = 0; halving <= most_halvings; ++halving, step *= 0.5) {
        const Vec3 place = from.place + from.inward * step;
        const SurfacePoint* nearest = &from;
        for (const SurfacePoint& other : points)
            if (length(place - other.place) < length(place - nearest->place)) nearest = &other;
        const double depth = dot(place - nearest->place, nearest->inward);
        if (depth > 0) return {place, math::min(depth, step)};
    }
    return {};
}

void add_constraints(RadialProblem& problem, const std::vector<SurfacePoint>& points, double t,
                     double inset) {
    const auto add = [&](const Vec3& p, double value) {
        problem.points.push_back({p.x, p.y, p.z, t});
        problem.values[0].push_back(value);
    };
    for (const SurfacePoint& point : points) {
        add(point.place, 0);
        if (const InnerPoint inner = inner_point(points, point, inset); inner.depth > 0)
            add(inner.place, inner.depth);
    }
}

std::string read_box(Build& build, Array box, SurfaceSearch& search) {
    if (box.size() != 4 && box.size() != 6)
        return "the box must have 4 items for shapes of the plane, 6 in space";
    const std::size_t n = box.size() / 2;
    double corner[2][3] = {};
    for (std::size_t i = 0; i < box.size(); ++i) {
        const auto number = known(build, box[i]);
        if (!number || !(math::abs(*number) < math::infinity)) return "the box must be known numbers";
        corner[i / n][i % n] = *number;
    }
    for (std::size_t i = 0; i < n; ++i)
        if (!(corner[0][i] < corner[1][i])) return "the box must be larger than 0 along each axis";
    search.dimension = static_cast<int>(n);
    search.box = {{corner[0][0], corner[0][1], corner[0][2]}, {corner[1][0], corner[1][1], corner[1][2]}};
    return {};
}

}  // namespace

Expression radial_morph(Build& build, Array x, Expression t, Expression g1, Expression g2, Expression t1,
                        Expression t2, Array box, Expression spacing, Expression inset) {
    SurfaceSearch search;
    if (const std::string problem = read_box(build, box, search); !problem.empty())
        return build.error(problem);
    const bool solid = search.dimension == 3;
    if (x.size() < box.size() / 2) return build.error("x must have as many coordinates as the box");
    const auto from = known(build, t1), to = known(build, t2), gap = known(build, spacing),
               step = known(build, inset);
    if (!from || !to || !gap || !step || !(*from != *to) || !(*gap > 0) || !(*step > 0))
        return build.error("t1 and t2 must be known and different, spacing and inset known and above 0");
    search.spacing = *gap;
    RadialProblem problem{.used = {true, true, solid, true}, .points = {}, .values = {{}}};
    const Expression shapes[2] = {g1, g2};
    for (int i = 0; i < 2; ++i) {
        const SurfacePoints found = surface_points(build, shapes[i], x, search);
        if (!found.problem.empty()) return build.error(fmt::format("g{}: {}", i + 1, found.problem));
        if (found.points.size() > most_radial_points / 2)
            return build.error(
                fmt::format("g{} has {} boundary points: enlarge the spacing", i + 1, found.points.size()));
        add_constraints(problem, found.points, i == 0 ? *from : *to, *step);
    }
    const RadialFit fit = fit_radial(problem);
    if (!fit.problem.empty()) return build.error(fit.problem + ": enlarge the spacing");
    return radial_sum(build, {x[0], x[1], solid ? x[2] : build.constant(0), t}, fit.sums[0]);
}

Rows radial_morph_rows() {
    return {
        row<&radial_morph>(
            "hfRadialMorph", "x, t, g1, g2, t1, t2, box, spacing, inset",
            {"Metamorphosis by radial functions: the smoothest function through both outlines in space-time.",
             "A.(x, t) + b + sum w_i r_i^3: 0 at boundary points of g1 at t1 and of g2 at t2, the depth at "
             "points `inset` inside",
             "turk1999",
             "box: {xmin, ymin, xmax, ymax} or {xmin, ymin, zmin, xmax, ymax, zmax}, where the boundaries "
             "are "
             "looked for at points about `spacing` apart. Time counts as a length. The shapes are met at the "
             "points only; at most 1500 points in all."},
            false),
    };
}

}  // namespace frep::shapes
