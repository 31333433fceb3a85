// Deformations and their rows. See deformations.h.
#include "frep/shapes/deformations.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "frep/math/number.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/radial.h"

namespace frep::shapes {

namespace {

constexpr const char* needs_point = "the array to transform must have 3 items";
constexpr std::size_t largest_net = 21;  ///< control points along an axis, as for Bezier volumes
constexpr int most_steps = 64;

Expression done(Build& build) { return build.constant(1.0); }

std::optional<double> constant_of(Build& build, Expression value) {
    return build.graph.constant_value(value.id());
}

void warn(Build& build, const std::string& message) {
    if (build.warn) build.warn(message);
}

}  // namespace

// The arc in a frame at the middle of its spine, u along and v towards the side that it bends to, curvature
// K. A point's polar coordinates about the arc's centre (0, 1/K) are the angle phi = atan2(K u, 1 - K v) and
// the radius h/K, h = hypot(K u, 1 - K v). The straight point lies at s = phi/K along and (1 - h)/K across.
// Beyond the ends, with e the angle past the end: (h/K) sin e further along, (1 - h cos e)/K across. Written
// without a difference of numbers of the size 1/K, so that K may go to 0.
template <int axis>
Expression bend(Build& build, ArrayInOut point, Expression p1, Expression p2, Expression p0,
                Expression angle) {
    if (point.size() != 3) return build.error(needs_point);
    constexpr double full_turn = 2 * math::pi, straight = 1e-100;
    const Expression length = p2 - p1;
    if (const auto number = constant_of(build, length); number && !(*number > 0))
        return build.error("the bend must end after it begins");
    if (const auto number = constant_of(build, angle); number && math::abs(*number) > full_turn * 1.000001)
        warn(build, "a bend by more than a full turn covers itself");
    constexpr std::size_t beside = (axis + 1) % 3;
    const Expression rate = angle / length;
    const Expression k = select(less(abs(rate), straight), build.constant(straight), rate);
    const Expression half = 0.5 * length, middle = 0.5 * (p1 + p2) - p0;
    // into the frame at the middle of the spine, which lies on the arc through p0
    const Expression turn = k * middle, c = cos(turn), s = sin(turn);
    const Expression a = point[axis] - p0 - s / k, b = point[beside] - 2.0 * square(sin(0.5 * turn)) / k;
    const Expression u = c * a + s * b, v = c * b - s * a;
    // along the arc, cut to its ends
    const Expression along = k * u, inward = 1.0 - k * v;
    const Expression phi = atan2(along, inward), h = hypot(along, inward), end = abs(k) * half;
    const Expression past = max(phi - end, 0.0) + min(phi + end, 0.0);
    const Expression on_arc = max(min(phi / k, half), -half);
    point[axis] = p0 + middle + on_arc + h / k * sin(past);
    const Expression across = (2.0 * v - k * (square(u) + square(v))) / (1.0 + h);
    point[beside] = across + 2.0 * h / k * square(sin(0.5 * past));
    return done(build);
}

namespace {

/// A lattice of displacements over a box.
struct Lattice {
    std::size_t count[3];
    Expression low[3], size[3];
    std::vector<Expression> data[3];  ///< sizes, then the displacements along one axis: a Bezier volume

    /// The displacement along `axis` at a point, the box's nearest where it lies outside.
    std::array<Expression, 3> at(Build& build, const std::array<Expression, 3>& p) const {
        Expression relative[3];
        for (std::size_t i = 0; i < 3; ++i) relative[i] = max(min((p[i] - low[i]) / size[i], 1.0), 0.0);
        std::array<Expression, 3> out;
        for (std::size_t i = 0; i < 3; ++i)
            out[i] = block(build, Op::bezier_volume, {relative[0], relative[1], relative[2]}, data[i]);
        return out;
    }

    /// A bound of how much the displacement changes over a unit of length; nothing for what is no constant.
    std::optional<double> steepness(Build& build) const {
        double sum = 0;
        const std::size_t step[3] = {count[1] * count[2], count[2], 1};
        const std::size_t all = count[0] * count[1] * count[2];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto length = constant_of(build, size[axis]);
            if (!length) return std::nullopt;
            const double spaces = static_cast<double>(count[axis] - 1);
            double most = 0;
            for (std::size_t item = 0; item < all; ++item) {
                if (item / step[axis] % count[axis] + 1 == count[axis]) continue;
                double square = 0;
                for (const std::vector<Expression>& values : data) {
                    const auto here = constant_of(build, values[3 + item]),
                               next = constant_of(build, values[3 + item + step[axis]]);
                    if (!here || !next) return std::nullopt;
                    square += (*next - *here) * (*next - *here);
                }
                most = std::max(most, square);
            }
            sum += most * (spaces / *length) * (spaces / *length);
        }
        return math::sqrt(sum);
    }
};

struct LatticeArguments {
    Expression l, m, n;
    Array box, moves;
};

/// The lattice, or what is wrong.
std::string read_lattice(Build& build, const LatticeArguments& given, Lattice& out) {
    const Expression counts[3] = {given.l, given.m, given.n};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = known(build, counts[i]);
        if (!number || !(*number >= 0.5) || !(*number < static_cast<double>(largest_net) + 0.5))
            return fmt::format("l, m and n must be known whole numbers of 1..{}", largest_net);
        out.count[i] = static_cast<std::size_t>(*number + 0.5);
    }
    const std::size_t all = out.count[0] * out.count[1] * out.count[2];
    if (given.box.size() != 6 || given.moves.size() != 3 * all)
        return "the box must have 6 items, and the displacements 3 for each control point";
    for (std::size_t i = 0; i < 3; ++i) {
        out.low[i] = given.box[i];
        out.size[i] = given.box[i + 3] - given.box[i];
        if (const auto size = constant_of(build, out.size[i]); size && !(*size > 0))
            return "the box must be larger than 0 along each axis";
        for (const std::size_t count : out.count)
            out.data[i].push_back(build.constant(static_cast<double>(count)));
        for (std::size_t item = 0; item < all; ++item) out.data[i].push_back(given.moves[3 * item + i]);
    }
    return {};
}

Expression deform(Build& build, ArrayInOut point, const LatticeArguments& given, int steps) {
    if (point.size() != 3) return build.error(needs_point);
    Lattice lattice;
    if (const std::string problem = read_lattice(build, given, lattice); !problem.empty())
        return build.error(problem);
    if (steps > 1)
        if (const auto steep = lattice.steepness(build); steep && *steep >= 1)
            warn(build,
                 fmt::format("space may fold: displacements change by up to {:.3g} over a unit of length",
                             *steep));
    const std::array<Expression, 3> given_point{point[0], point[1], point[2]};
    std::array<Expression, 3> source = given_point;
    for (int step = 0; step < steps; ++step) {
        const auto move = lattice.at(build, source);
        for (std::size_t i = 0; i < 3; ++i) source[i] = given_point[i] - move[i];
    }
    for (std::size_t i = 0; i < 3; ++i) point[i] = source[i];
    return done(build);
}

}  // namespace

Expression free_form(Build& build, ArrayInOut point, Expression l, Expression m, Expression n, Array box,
                     Array moves) {
    return deform(build, point, {l, m, n, box, moves}, 1);
}

Expression free_form_forward(Build& build, ArrayInOut point, Expression l, Expression m, Expression n,
                             Array box, Array moves, Expression steps) {
    const auto number = known(build, steps);
    if (!number || !(*number >= 0.5) || !(*number < most_steps + 0.5))
        return build.error(fmt::format("steps must be a known whole number of 1..{}", most_steps));
    return deform(build, point, {l, m, n, box, moves}, static_cast<int>(*number + 0.5));
}

Expression space_map_spline(Build& build, ArrayInOut point, Array source, Array target) {
    const std::size_t count = target.size();
    if (point.size() != 3 || count == 0 || count % 3 != 0 || source.size() != count)
        return build.error("the point must have 3 items, source and target equally many triples");
    RadialProblem problem{.used = {true, true, true, false}, .points = {}, .values = {{}, {}, {}}};
    for (std::size_t i = 0; i < count; i += 3) {
        RadialPoint place{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto from = known(build, source[i + k]), to = known(build, target[i + k]);
            if (!from || !to) return build.error("a point of source or target depends on the point of space");
            place[k] = *to;
            problem.values[k].push_back(*to - *from);
        }
        problem.points.push_back(place);
    }
    const RadialFit fit = fit_radial(problem);
    if (!fit.problem.empty()) return build.error(fit.problem);
    Expression moved[3];
    for (std::size_t k = 0; k < 3; ++k)
        moved[k] =
            point[k] - radial_sum(build, {point[0], point[1], point[2], build.constant(0)}, fit.sums[k]);
    for (std::size_t k = 0; k < 3; ++k) point[k] = moved[k];
    return done(build);
}

Rows deformation_rows() {
    constexpr std::string_view bend_formula =
        "along the arc through x0 with curvature K = theta/(x2 - x1): s = atan2(K u, 1 - K v)/K, the other "
        "coordinate (1 - hypot(K u, 1 - K v))/K; straight beyond x1, x2";
    constexpr std::string_view bend_note =
        "Lengths along the axis stay. The solid must not reach beyond the centre of the arc. Bends to "
        "another "
        "side: turn the solid about the axis first.";
    constexpr std::string_view lattice = "xt, l, m, n, box, d";
    constexpr std::string_view lattice_note =
        "Control point (i, j, k), counted from 0 along x, y, z, owns the items 3((i m + j) n + k) + 1, 2, 3 "
        "of "
        "d. l, m, n are numbers of control points, 1..21. Leave the outermost displacements 0 for a local "
        "deformation.";
    return {
        row<&bend<0>>("hfBendX", "xt, x1, x2, x0, theta",
                      {"Bends the x axis between x1 and x2 by theta in all, towards y; x0 stays.",
                       bend_formula, "barr1984", bend_note},
                      false),
        row<&bend<1>>("hfBendY", "xt, y1, y2, y0, theta",
                      {"Bends the y axis between y1 and y2 by theta in all, towards z; y0 stays.",
                       "as hfBendX, with y, z", "barr1984", bend_note},
                      false),
        row<&bend<2>>("hfBendZ", "xt, z1, z2, z0, theta",
                      {"Bends the z axis between z1 and z2 by theta in all, towards x; z0 stays.",
                       "as hfBendX, with z, x", "barr1984", bend_note},
                      false),
        row<&free_form>("hfFreeForm3D", lattice,
                        {"Free-form deformation: a lattice of displacements over a box moves space, and the "
                         "solid with it.",
                         "x - sum d_ijk B_i(u) B_j(v) B_k(w), (u, v, w) the place in the box, cut to 0..1",
                         "sederberg1986", lattice_note},
                        false),
        row<&free_form_forward>(
            "hfFreeForm3D", "xt, l, m, n, box, d, steps",
            {"The same by the forward map of Sederberg and Parry, inverted in so many steps.",
             "steps times: y = x - d(y), beginning with y = x", "sederberg1986",
             "One step is the form without steps. The error falls with each step by the largest difference "
             "of "
             "neighbouring displacements over their distance; from 1 on space may fold, which is warned of."},
            false),
        row<&space_map_spline>(
            "hfSpaceMapSpline", "xt, source, target",
            {"Drags space so that each source point comes exactly to its target, with the smoothest map "
             "between.",
             "x - (A x + b + sum w_i |x - target_i|^3), target - source at the targets", "savchenko1998",
             "Reaches everywhere; points with source = target hold it. hfSpaceMapCubic is local."},
            false),
    };
}

}  // namespace frep::shapes
