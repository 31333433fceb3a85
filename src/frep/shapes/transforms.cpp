// Space transformations and their rows. See transforms.h.
#include "frep/shapes/transforms.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr const char* needs_point = "the array to transform must have 3 items";

Expression done(Build& build) { return build.constant(1.0); }

void warn_of_zero(Build& build, std::initializer_list<Expression> scales) {
    for (const Expression& s : scales)
        if (const auto value = build.graph.constant_value(s.id()); value && *value == 0.0 && build.warn)
            build.warn("a scale of 0 gives infinite coordinates");
}

/// Turns the two coordinates after `axis` (in cyclic order).
void turn(ArrayInOut point, int axis, Expression angle) {
    const auto first = static_cast<std::size_t>((axis + 1) % 3),
               second = static_cast<std::size_t>((axis + 2) % 3);
    const Expression u = point[first], v = point[second];
    const Expression c = cos(angle), s = sin(angle);
    point[first] = u * c + v * s;
    point[second] = v * c - u * s;
}

/// Weight of a control point at relative distance given by its square.
Expression cubic_weight(Expression square_distance) {
    const Expression rest = max(1.0 - sqrt(square_distance), 0.0);  // (1-r)^3/(1+r), 0 from r = 1 on
    return rest * square(rest) / (2.0 - rest);
}
Expression exponential_weight(Expression square_distance) { return exp(-square_distance); }

template <class Weight>
Expression space_map(Build& build, ArrayInOut point, Array source, Array target, Array extent,
                     Weight weight) {
    const std::size_t n = source.size();
    if (point.size() != 3 || n % 3 != 0 || !sizes_are({{target, n}, {extent, n}}))
        return build.error("the point must have 3 items, source, target and b equally many triples");
    for (std::size_t k = 0; k < n; k += 3) {
        Expression move[3], part[3];
        for (std::size_t i = 0; i < 3; ++i) {
            move[i] = target[k + i] - source[k + i];
            part[i] = (point[i] - target[k + i]) / (extent[k + i] * (1.0 + abs(move[i])));
        }
        const Expression w = weight(norm2({part[0], part[1], part[2]}));
        for (std::size_t i = 0; i < 3; ++i) point[i] = point[i] - w * move[i];
    }
    return done(build);
}

}  // namespace

Expression scale(Build& build, ArrayInOut point, Expression sx, Expression sy, Expression sz) {
    if (point.size() != 3) return build.error(needs_point);
    warn_of_zero(build, {sx, sy, sz});
    point[0] = point[0] / sx;
    point[1] = point[1] / sy;
    point[2] = point[2] / sz;
    return done(build);
}

Expression shift(Build& build, ArrayInOut point, Expression dx, Expression dy, Expression dz) {
    if (point.size() != 3) return build.error(needs_point);
    point[0] = point[0] - dx;
    point[1] = point[1] - dy;
    point[2] = point[2] - dz;
    return done(build);
}

template <int axis>
Expression rotate(Build& build, ArrayInOut point, Expression angle) {
    if (point.size() != 3) return build.error(needs_point);
    turn(point, axis, angle);
    return done(build);
}

template <int axis>
Expression twist(Build& build, ArrayInOut point, Expression p1, Expression p2, Expression a1, Expression a2) {
    if (point.size() != 3) return build.error(needs_point);
    warn_of_zero(build, {p2 - p1});
    const Expression t = (point[axis] - p1) / (p2 - p1);
    turn(point, axis, (1.0 - t) * a1 + t * a2);
    return done(build);
}

template <int axis>
Expression taper(Build& build, ArrayInOut point, Expression p1, Expression p2, Expression s1, Expression s2) {
    if (point.size() != 3) return build.error(needs_point);
    const Expression p = point[axis];
    const auto k1 = build.graph.constant_value(p1.id()), k2 = build.graph.constant_value(p2.id());
    Expression ratio;
    if (k1 && k2 && *k1 < *k2) {  // clamping is tight for intervals and smooth for gradients
        const Expression t = min(max((p - p1) / (p2 - p1), 0.0), 1.0);
        ratio = s1 + t * (s2 - s1);
    } else {
        const Expression t = (p - p1) / (p2 - p1);
        const Expression between = s1 + t * (s2 - s1);
        ratio = select(less_equal(p, p1), s1, select(less_equal(p2, p), s2, between));
    }
    const auto q1 = build.graph.constant_value(s1.id()), q2 = build.graph.constant_value(s2.id());
    const bool never_tiny = q1 && q2 && ((*q1 > 1e-5 && *q2 > 1e-5) || (*q1 < -1e-5 && *q2 < -1e-5));
    if (!never_tiny) ratio = select(less(abs(ratio), 1e-6), build.constant(1.0), ratio);
    for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
        const auto i = static_cast<std::size_t>(other);
        point[i] = point[i] / ratio;
    }
    return done(build);
}

Expression stretch(Build& build, ArrayInOut point, Array fixed, Expression sx, Expression sy, Expression sz) {
    if (point.size() != 3 || fixed.size() != 3)
        return build.error("the array to transform and the fixed point must have 3 items each");
    warn_of_zero(build, {sx, sy, sz});
    const Expression s[3] = {sx, sy, sz};
    for (std::size_t i = 0; i < 3; ++i) point[i] = fixed[i] + (point[i] - fixed[i]) / s[i];
    return done(build);
}

Expression space_map_cubic(Build& build, ArrayInOut point, Array source, Array target, Array extent) {
    return space_map(build, point, source, target, extent, cubic_weight);
}

Expression space_map_exponential(Build& build, ArrayInOut point, Array source, Array target, Array extent) {
    return space_map(build, point, source, target, extent, exponential_weight);
}

Rows transform_rows() {
    constexpr std::string_view twist_note =
        "Not clamped: outside p1..p2 the solid goes on turning at the same rate.";
    constexpr std::string_view taper_note = "A scale nearer to 0 than 1e-6 counts as 1.";
    constexpr std::string_view hyperfun = "adzhiev1999";
    constexpr std::string_view barr = "barr1984";
    constexpr std::string_view map_note =
        "The old documentation gives (xt, source, delta, b) with one number b; the tools took targets and 3 "
        "numbers b a point, and so does this.";
    return {
        row<&scale>("hfScale3D", "xt, sx, sy, sz",
                    {"Scales the solid about the origin.", "x/sx, y/sy, z/sz", hyperfun,
                     "A scale of 0 is not refused; it is warned of and gives infinities."}),
        row<&shift>("hfShift3D", "xt, dx, dy, dz", {"Moves the solid.", "x - dx, y - dy, z - dz", hyperfun}),
        row<&rotate<0>>("hfRotate3DX", "xt, theta",
                        {"Turns the solid about the x axis, from y towards z, by radians.",
                         "y cos + z sin, -y sin + z cos", hyperfun}),
        row<&rotate<1>>("hfRotate3DY", "xt, theta",
                        {"Turns the solid about the y axis, from z towards x, by radians.",
                         "z cos + x sin, -z sin + x cos", hyperfun}),
        row<&rotate<2>>("hfRotate3DZ", "xt, theta",
                        {"Turns the solid about the z axis, from x towards y, by radians.",
                         "x cos + y sin, -x sin + y cos", hyperfun}),
        row<&twist<0>>("hfTwistX", "xt, x1, x2, theta1, theta2",
                       {"Twists about the x axis: angle theta1 at x1, theta2 at x2.",
                        "rotation by (1-t) theta1 + t theta2, t = (x-x1)/(x2-x1)", barr, twist_note}),
        row<&twist<1>>("hfTwistY", "xt, y1, y2, theta1, theta2",
                       {"Twists about the y axis: angle theta1 at y1, theta2 at y2.",
                        "rotation by (1-t) theta1 + t theta2, t = (y-y1)/(y2-y1)", barr, twist_note}),
        row<&twist<2>>("hfTwistZ", "xt, z1, z2, theta1, theta2",
                       {"Twists about the z axis: angle theta1 at z1, theta2 at z2.",
                        "rotation by (1-t) theta1 + t theta2, t = (z-z1)/(z2-z1)", barr, twist_note}),
        row<&taper<0>>("hfTaperX", "xt, x1, x2, s1, s2",
                       {"Tapers along x: scale s1 below x1, s2 above x2, linear between.", "y/s, z/s", barr,
                        taper_note}),
        row<&taper<1>>("hfTaperY", "xt, y1, y2, s1, s2",
                       {"Tapers along y: scale s1 below y1, s2 above y2, linear between.", "x/s, z/s", barr,
                        taper_note}),
        row<&taper<2>>("hfTaperZ", "xt, z1, z2, s1, s2",
                       {"Tapers along z: scale s1 below z1, s2 above z2, linear between.", "x/s, y/s", barr,
                        taper_note}),
        row<&stretch>("hfStretch3D", "xt, x0, sx, sy, sz",
                      {"Scales the solid about the fixed point x0.", "x0 + (x - x0)/s for each axis",
                       hyperfun, "A scale of 0 is not refused; it is warned of and gives infinities."}),
        row<&space_map_cubic>(
            "hfSpaceMapCubic", "xt, source, target, b",
            {"Drags the space about source points to target points, one after the other.",
             "x - w (target - source); w = (1-r)^3/(1+r) for r <= 1, else 0; r^2 = sum over the axes of "
             "((x - target)/(b (1 + |target - source|)))^2",
             "savchenko1998", map_note}),
        row<&space_map_exponential>(
            "hfSpaceMapExp", "xt, source, target, b",
            {"Drags the space about source points to target points with a weight that reaches everywhere.",
             "x - exp(-r^2) (target - source), r as for hfSpaceMapCubic", "savchenko1998", map_note}),
    };
}

}  // namespace frep::shapes
