// Distance primitives, SARDF operations and their rows. See distance.h.
#include "frep/shapes/distance.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

bool three(Array x, Array center) { return sizes_are({{x, 3}, {center, 3}}); }

/// Distance to the axis through the centre, and coordinate along it.
struct Polar {
    Expression along, across;
};
template <int axis>
Polar polar(Array x, Array center) {
    constexpr int first = (axis + 1) % 3, second = (axis + 2) % 3;
    return {x[axis] - center[axis], hypot(x[first] - center[first], x[second] - center[second])};
}

}  // namespace

template <int axis>
Expression distance_cone(Build& build, Array x, Array center, Expression slope) {
    if (!three(x, center)) return build.error(needs_3d);
    const Polar p = polar<axis>(x, center);
    const Expression half_angle = atan(slope);
    return abs(p.along) * sin(half_angle) - p.across * cos(half_angle);
}

Expression distance_cylinder(Build& build, Array x, Array center, Array direction, Expression radius) {
    if (!sizes_are({{x, 3}, {center, 3}, {direction, 3}}))
        return build.error("x, the centre and the direction must have 3 items each");
    const Vec3x u = vec3(direction);
    const Expression length = sqrt(norm2(u));
    const Vec3x unit = {u.x / length, u.y / length, u.z / length};
    return radius - sqrt(norm2(cross(vec3(x) - vec3(center), unit)));
}

template <int axis>
Expression distance_torus(Build& build, Array x, Array center, Expression ring, Expression tube) {
    if (!three(x, center)) return build.error(needs_3d);
    const Polar p = polar<axis>(x, center);
    return tube - hypot(p.across - ring, p.along);
}

Expression distance_ellipsoid(Build& build, Array x, Array center, Expression a, Expression b, Expression c) {
    if (!three(x, center)) return build.error(needs_3d);
    const Vec3x p = vec3(x) - vec3(center);
    return apply(Op::ellipsoid_distance, {p.x, p.y, p.z, a, b, c});
}

Expression distance_block(Build& build, Array x, Array vertex, Expression dx, Expression dy, Expression dz) {
    if (!three(x, vertex)) return build.error("x and the corner must have 3 items each");
    const Expression size[3] = {dx, dy, dz};
    const Expression radius = build.constant(0.2), alpha = build.constant(0.0);
    Expression value = x[0] - vertex[0];
    for (std::size_t i = 0; i < 3; ++i) {
        const Expression from_corner = x[i] - vertex[i];
        if (i > 0) value = apply(Op::sardf_int, {value, from_corner, radius, alpha});
        value = apply(Op::sardf_int, {value, size[i] - from_corner, radius, alpha});
    }
    return value;
}

Expression sardf_intersection(Build&, Expression f1, Expression f2, Expression radius, Expression alpha) {
    return apply(Op::sardf_int, {f1, f2, radius, alpha});
}
Expression sardf_union(Build&, Expression f1, Expression f2, Expression radius, Expression alpha) {
    return -apply(Op::sardf_int, {-f1, -f2, radius, alpha});
}
Expression sardf_subtraction(Build&, Expression f1, Expression f2, Expression radius, Expression alpha) {
    return apply(Op::sardf_int, {f1, -f2, radius, alpha});
}

Expression distance_blend_intersection(Build&, Expression f1, Expression f2, Expression radius) {
    return apply(Op::sardf_blend, {f1, f2, radius});
}
Expression distance_blend_union(Build&, Expression f1, Expression f2, Expression radius) {
    return -apply(Op::sardf_blend, {-f1, -f2, radius});
}

Expression sawtooth(Build&, Expression t, Expression n, Expression a, Expression f) {
    return apply(Op::sawtooth, {t, n, a, f});
}

Rows distance_rows() {
    constexpr std::string_view from = "fayolle2006";
    constexpr std::string_view sardf =
        "; R = radius of the fillet of the inner level sets, alpha = angle of the outer sector";
    static const std::string uni_doc = "SARDF union: values stay near distances" + std::string(sardf) + ".";
    static const std::string int_doc =
        "SARDF intersection: values stay near distances" + std::string(sardf) + ".";
    static const std::string sub_doc =
        "SARDF subtraction of f2 from f1: values stay near distances" + std::string(sardf) + ".";
    return {
        row<&distance_cone<0>>("hfDConeX", "x, center, R",
                               {"Double infinite cone along x with distance values.",
                                "|X| sin t - sqrt(Y^2 + Z^2) cos t, t = atan R", from}),
        row<&distance_cone<1>>("hfDConeY", "x, center, R",
                               {"Double infinite cone along y with distance values.",
                                "|Y| sin t - sqrt(X^2 + Z^2) cos t, t = atan R", from}),
        row<&distance_cone<2>>("hfDConeZ", "x, center, R",
                               {"Double infinite cone along z with distance values.",
                                "|Z| sin t - sqrt(X^2 + Y^2) cos t, t = atan R", from}),
        row<&distance_cylinder>("hfDCylinder", "x, center, u, R",
                                {"Infinite cylinder about the line through center with direction u.",
                                 "R - distance to the line", from}),
        row<&distance_torus<0>>("hfDTorusX", "x, center, R, r0",
                                {"Torus about the x axis with distance values.",
                                 "r0 - sqrt((sqrt(Y^2 + Z^2) - R)^2 + X^2)", from}),
        row<&distance_torus<1>>("hfDTorusY", "x, center, R, r0",
                                {"Torus about the y axis with distance values.",
                                 "r0 - sqrt((sqrt(X^2 + Z^2) - R)^2 + Y^2)", from}),
        row<&distance_torus<2>>("hfDTorusZ", "x, center, R, r0",
                                {"Torus about the z axis with distance values.",
                                 "r0 - sqrt((sqrt(X^2 + Y^2) - R)^2 + Z^2)", from}),
        row<&distance_ellipsoid>(
            "hfDEllipsoid", "x, center, a, b, c",
            {"Ellipsoid with exact signed Euclidean distance.", "distance to the surface, positive inside",
             "eberly2013",
             "The old library was wrong inside on the planes of symmetry; this is right there."}),
        row<&distance_block>("hfDBlock", "x, vertex, dx, dy, dz",
                             {"Block with values near distances.",
                              "SARDF intersection (R = 0.2, alpha = 0) of X, dx - X, Y, dy - Y, Z, dz - Z",
                              from, "The old C library had the file but not the name."}),
        row<&sardf_union>("hfDUni", "f1, f2, R, alpha", {uni_doc, "-hfDInt(-f1, -f2, R, alpha)", from}),
        row<&sardf_intersection>(
            "hfDInt", "f1, f2, R, alpha",
            {int_doc,
             "min(f1, f2) outside the fillet; in it d with (f1-a)^2 + (f2-a)^2 = (a-d)^2, "
             "a = 2 sqrt(R d), or a = d + R from d = R on",
             from}),
        row<&sardf_subtraction>("hfDSub", "f1, f2, R, alpha", {sub_doc, "hfDInt(f1, -f2, R, alpha)", from}),
        row<&distance_blend_union>(
            "hfDBlendUni", "f1, f2, r",
            {"Larger operand with a circular fillet of radius r.",
             "(f1 + f2 + 2 r - sqrt(2 r^2 - (f1-f2)^2))/2 for |f1-f2| <= r, else max(f1, f2)", from}),
        row<&distance_blend_intersection>(
            "hfDBlendInt", "f1, f2, r",
            {"Smaller operand with a circular fillet of radius r.",
             "(f1 + f2 - 2 r + sqrt(2 r^2 - (f1-f2)^2))/2 for |f1-f2| <= r, else min(f1, f2)", from}),
        row<&sawtooth>("hfSawtooth", "t, n, a, f",
                       {"Partial Fourier sum of a sawtooth of frequency f: n - 1 terms.",
                        "(1/2 - sum over i = 1..n-1 of sin(2 pi i f t)/i) 2/(a pi); 0 for n <= 1", from,
                        "Undefined for n above 10001."}),
    };
}

}  // namespace frep::shapes
