// The algebraic primitives and their rows. See primitives.h.
#include "frep/shapes/primitives.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr double smallest_size = 1e-6;

bool three(Array x, Array center) { return sizes_are({{x, 3}, {center, 3}}); }

/// Coordinates relative to the centre: `along` an axis, and the two others in order.
struct AxisPoint {
    Expression along, first, second;
};
template <int axis>
AxisPoint axis_point(Array x, Array center) {
    constexpr int first = axis == 0 ? 1 : 0;
    constexpr int second = axis == 2 ? 1 : 2;
    return {x[axis] - center[axis], x[first] - center[first], x[second] - center[second]};
}

Expression tiny(Expression size) { return less(abs(size), smallest_size); }

}  // namespace

Expression sphere(Build& build, Array x, Array center, Expression radius) {
    if (!three(x, center)) return build.error(needs_3d);
    return square(radius) - norm2(vec3(x) - vec3(center));
}

Expression ellipsoid(Build& build, Array x, Array center, Expression a, Expression b, Expression c) {
    if (!three(x, center)) return build.error(needs_3d);
    const Vec3x p = vec3(x) - vec3(center);
    const Expression value = 1.0 - norm2({p.x / a, p.y / b, p.z / c});
    return guarded(build, logical_or(logical_or(tiny(a), tiny(b)), tiny(c)),
                   "a semi-axis of the ellipsoid is 0", value);
}

template <int axis>
Expression cylinder(Build& build, Array x, Array center, Expression radius) {
    if (!three(x, center)) return build.error(needs_3d);
    const AxisPoint p = axis_point<axis>(x, center);
    return square(radius) - square(p.first) - square(p.second);
}

template <int axis>
Expression elliptic_cylinder(Build& build, Array x, Array center, Expression a, Expression b) {
    if (!three(x, center)) return build.error(needs_3d);
    const AxisPoint p = axis_point<axis>(x, center);
    return 1.0 - square(p.first / a) - square(p.second / b);
}

template <int axis>
Expression torus(Build& build, Array x, Array center, Expression ring, Expression tube) {
    if (!three(x, center)) return build.error(needs_3d);
    const AxisPoint p = axis_point<axis>(x, center);
    // r0^2 - X^2 - Y^2 - Z^2 - R^2 + 2 R sqrt(Y^2 + Z^2), with the square completed
    const Expression from_ring = sqrt(square(p.first) + square(p.second)) - ring;
    return square(tube) - square(p.along) - square(from_ring);
}

Expression block_solid(Build& build, Array x, Array vertex, Expression dx, Expression dy, Expression dz) {
    if (!three(x, vertex)) return build.error("x and the corner must have 3 items each");
    const Expression size[3] = {dx, dy, dz};
    Expression slab[3];
    for (int i = 0; i < 3; ++i) {
        const Expression from_corner = x[i] - vertex[i];
        slab[i] = from_corner * (size[i] - from_corner);
    }
    const Expression bad = logical_or(logical_or(less(dx, 0.0), less(dy, 0.0)), less(dz, 0.0));
    return guarded(build, bad, "a size of the block is negative", r_and(r_and(slab[0], slab[1]), slab[2]));
}

Expression superellipsoid(Build& build, Array x, Array center, Expression a, Expression b, Expression c,
                          Expression s1, Expression s2) {
    if (!three(x, center)) return build.error(needs_3d);
    const Vec3x p = vec3(x) - vec3(center);
    const Expression across = pow(abs(p.x / a), 2.0 / s2) + pow(abs(p.y / b), 2.0 / s2);
    return 1.0 - pow(across, s2 / s1) - pow(abs(p.z / c), 2.0 / s1);
}

template <int axis>
Expression cone(Build& build, Array x, Array center, Expression slope) {
    if (!three(x, center)) return build.error(needs_3d);
    const AxisPoint p = axis_point<axis>(x, center);
    return square(p.along) - square(p.first / slope) - square(p.second / slope);
}

template <int axis>
Expression elliptic_cone(Build& build, Array x, Array center, Expression a, Expression b) {
    if (!three(x, center)) return build.error(needs_3d);
    const AxisPoint p = axis_point<axis>(x, center);
    return square(p.along) - square(p.first / a) - square(p.second / b);
}

Rows primitive_rows() {
    constexpr std::string_view from = "adzhiev1999";
    return {
        row<&sphere>("hfSphere", "x, center, R", {"Ball of radius R.", "R^2 - X^2 - Y^2 - Z^2", from}),
        row<&ellipsoid>("hfEllipsoid", "x, center, a, b, c",
                        {"Ellipsoid with axes along the coordinates.", "1 - (X/a)^2 - (Y/b)^2 - (Z/c)^2",
                         from, "A semi-axis nearer to 0 than 1e-6 gives the error value -1111111111111."}),
        row<&cylinder<0>>("hfCylinderX", "x, center, R",
                          {"Infinite cylinder along x.", "R^2 - Y^2 - Z^2", from}),
        row<&cylinder<1>>("hfCylinderY", "x, center, R",
                          {"Infinite cylinder along y.", "R^2 - X^2 - Z^2", from}),
        row<&cylinder<2>>("hfCylinderZ", "x, center, R",
                          {"Infinite cylinder along z.", "R^2 - X^2 - Y^2", from}),
        row<&elliptic_cylinder<0>>("hfEllCylX", "x, center, a, b",
                                   {"Infinite elliptic cylinder along x.", "1 - (Y/a)^2 - (Z/b)^2", from}),
        row<&elliptic_cylinder<1>>("hfEllCylY", "x, center, a, b",
                                   {"Infinite elliptic cylinder along y.", "1 - (X/a)^2 - (Z/b)^2", from}),
        row<&elliptic_cylinder<2>>("hfEllCylZ", "x, center, a, b",
                                   {"Infinite elliptic cylinder along z.", "1 - (X/a)^2 - (Y/b)^2", from}),
        row<&torus<0>>("hfTorusX", "x, center, R, r0",
                       {"Torus about the x axis: ring radius R, tube radius r0.",
                        "r0^2 - X^2 - Y^2 - Z^2 - R^2 + 2 R sqrt(Y^2 + Z^2)", from}),
        row<&torus<1>>("hfTorusY", "x, center, R, r0",
                       {"Torus about the y axis: ring radius R, tube radius r0.",
                        "r0^2 - X^2 - Y^2 - Z^2 - R^2 + 2 R sqrt(X^2 + Z^2)", from}),
        row<&torus<2>>("hfTorusZ", "x, center, R, r0",
                       {"Torus about the z axis: ring radius R, tube radius r0.",
                        "r0^2 - X^2 - Y^2 - Z^2 - R^2 + 2 R sqrt(X^2 + Y^2)", from}),
        row<&block_solid>("hfBlock", "x, vertex, dx, dy, dz",
                          {"Block with its minimum corner at vertex.",
                           "(u & v) & w, u = X (dx - X), v = Y (dy - Y), w = Z (dz - Z), & = R-intersection",
                           from, "A negative size gives the error value -1111111111111."}),
        row<&superellipsoid>("hfSuperell", "x, center, a, b, c, s1, s2",
                             {"Superellipsoid; s1 shapes the profile along z, s2 the section across.",
                              "1 - (|X/a|^(2/s2) + |Y/b|^(2/s2))^(s2/s1) - |Z/c|^(2/s1)", "barr1981",
                              "Powers follow the rules of the language: a base below 1e-6 counts as 0."}),
        row<&cone<0>>(
            "hfConeX", "x, center, R",
            {"Double infinite cone along x, R = radius at height 1.", "X^2 - (Y/R)^2 - (Z/R)^2", from}),
        row<&cone<1>>(
            "hfConeY", "x, center, R",
            {"Double infinite cone along y, R = radius at height 1.", "Y^2 - (X/R)^2 - (Z/R)^2", from}),
        row<&cone<2>>(
            "hfConeZ", "x, center, R",
            {"Double infinite cone along z, R = radius at height 1.", "Z^2 - (X/R)^2 - (Y/R)^2", from}),
        row<&elliptic_cone<0>>("hfEllConeX", "x, center, a, b",
                               {"Double infinite elliptic cone along x.", "X^2 - (Y/a)^2 - (Z/b)^2", from}),
        row<&elliptic_cone<1>>("hfEllConeY", "x, center, a, b",
                               {"Double infinite elliptic cone along y.", "Y^2 - (X/a)^2 - (Z/b)^2", from}),
        row<&elliptic_cone<2>>("hfEllConeZ", "x, center, a, b",
                               {"Double infinite elliptic cone along z.", "Z^2 - (X/a)^2 - (Y/b)^2", from}),
    };
}

}  // namespace frep::shapes
