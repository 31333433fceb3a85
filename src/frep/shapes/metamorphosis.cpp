// Metamorphosis and its rows. See metamorphosis.h.
#include "frep/shapes/metamorphosis.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

Expression half_cylinder_before(Expression g, Expression t, Expression t1) { return r_and(g, t1 - t); }
Expression half_cylinder_after(Expression g, Expression t, Expression t2) { return r_and(g, t - t2); }

Expression smooth_half_cylinder_before(Expression g, Expression t, Expression t1, const Smoothing& s,
                                       Expression begins) {
    return apply(Op::bounded_int, {g, t1 - t, t - begins, s.b0, s.b1, s.b2, s.b3});
}
Expression smooth_half_cylinder_after(Expression g, Expression t, Expression t2, const Smoothing& s,
                                      Expression ends) {
    return apply(Op::bounded_int, {g, t - t2, ends - t, s.b0, s.b1, s.b2, s.b3});
}

Expression time_slab(Expression t, Expression low, Expression high) { return r_and(t - low, high - t); }

namespace {

Expression before(Build&, Expression g, Expression t, Expression t1) {
    return half_cylinder_before(g, t, t1);
}
Expression after(Build&, Expression g, Expression t, Expression t2) { return half_cylinder_after(g, t, t2); }
Expression smooth_before(Build&, Expression g, Expression t, Expression t1, Expression b0, Expression b1,
                         Expression b2, Expression b3, Expression begins) {
    return smooth_half_cylinder_before(g, t, t1, {b0, b1, b2, b3}, begins);
}
Expression smooth_after(Build&, Expression g, Expression t, Expression t2, Expression b0, Expression b1,
                        Expression b2, Expression b3, Expression ends) {
    return smooth_half_cylinder_after(g, t, t2, {b0, b1, b2, b3}, ends);
}
Expression slab(Build&, Expression t, Expression low, Expression high) { return time_slab(t, low, high); }

/// A ball whose middle and radius move linearly in time, within the slab: a cone of space-time.
Expression time_cone(Build& build, Array x, Expression t, Expression end, Array c1, Expression r1, Array c2,
                     Expression r2) {
    const std::size_t n = c1.size();
    if (n == 0 || c2.size() != n || x.size() < n)
        return build.error("the two centres must have equally many items, and x not fewer");
    const Expression k = (t + end) / (2.0 * end);
    Expression distance = build.constant(0);
    for (std::size_t i = 0; i < n; ++i) distance = distance + square(x[i] - (c1[i] + k * (c2[i] - c1[i])));
    const Expression ball = square(r1 + k * (r2 - r1)) - distance;
    return r_and(r_and(ball, t + end), end - t);
}

Expression space_time_blend(Build&, Expression g1, Expression g2, Expression t, Expression t1, Expression t2,
                            Expression end, Expression a0, Expression a1, Expression a2, Expression a3) {
    return apply(Op::bounded_uni, {half_cylinder_before(g1, t, t1), half_cylinder_after(g2, t, t2),
                                   time_slab(t, -end, end), a0, a1, a2, a3});
}

/// The numbers b1 = b2 = b3 = 1 are those of the published models.
Expression smooth_space_time_blend(Build& build, Expression g1, Expression g2, Expression t, Expression t1,
                                   Expression t2, Expression end, Expression a0, Expression a1, Expression a2,
                                   Expression a3, Expression b0, Expression c) {
    const Expression one = build.constant(1);
    const Smoothing s{b0, one, one, one};
    return apply(Op::bounded_uni,
                 {smooth_half_cylinder_before(g1, t, t1, s, -c), smooth_half_cylinder_after(g2, t, t2, s, c),
                  time_slab(t, -end, end), a0, a1, a2, a3});
}

Expression linear(Build&, Expression f1, Expression f2, Expression s) { return (1.0 - s) * f1 + s * f2; }
Expression bilinear(Build& build, Expression f00, Expression f10, Expression f01, Expression f11,
                    Expression u, Expression v) {
    return linear(build, linear(build, f00, f10, u), linear(build, f01, f11, u), v);
}

/// Color 1 within shape 1, color 2 within shape 2, elsewhere each with the weight of the other's distance.
Expression color(Build& build, Expression f1, Expression f2, ArrayInOut out, Array c1, Array c2) {
    if (out.size() != c1.size() || out.size() != c2.size())
        return build.error("the result and the two colors must have equally many items");
    const Expression far_1 = abs(f1), far_2 = abs(f2), sum = far_1 + far_2;
    // both 0: a place where the shapes touch, half of each
    const Expression inner = select(less(0.0, sum), far_2 / max(sum, 1e-300), build.constant(0.5));
    const Expression zero = build.constant(0), one = build.constant(1);
    const Expression weight = select(less_equal(0.0, f1), one, select(less_equal(0.0, f2), zero, inner));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = weight * c1[i] + (1.0 - weight) * c2[i];
    return one;
}

}  // namespace

Rows metamorphosis_rows() {
    constexpr std::string_view paper = "pasko2004", thesis = "pasko1995";
    constexpr std::string_view parameters_note =
        "a3 near T; a0 large enough to bridge the gap of the shapes, which should be near to distances. "
        "Without "
        "smoothing nearly all change happens between t1 and t2.";
    return {
        row<&linear>("hfMorph", "f1, f2, s",
                     {"Linear metamorphosis: f1 for s = 0, f2 for s = 1.", "(1-s) f1 + s f2", thesis}, false),
        row<&bilinear>("hfMorphBilinear", "f00, f10, f01, f11, u, v",
                       {"Bilinear metamorphosis between four shapes at the corners of 0..1 x 0..1.",
                        "(1-u)(1-v) f00 + u(1-v) f10 + (1-u)v f01 + u v f11", thesis},
                       false),
        row<&before>("hfHalfCylinderBefore", "g, t, t1",
                     {"Shape g in space-time until the time t1.", "g & (t1 - t)", paper}, false),
        row<&after>("hfHalfCylinderAfter", "g, t, t2",
                    {"Shape g in space-time from the time t2 on.", "g & (t - t2)", paper}, false),
        row<&smooth_before>("hfSmoothHalfCylinderBefore", "g, t, t1, b0, b1, b2, b3, begins",
                            {"Shape g until the time t1, shrinking from the time `begins` on (b0 < 0).",
                             "hfBoundedBlendInt(g, t1 - t, t - begins, b0, b1, b2, b3)", paper,
                             "Usual: b1 = b2 = b3 = 1 and b0 between -0.2 and -0.8 for shapes of size 1."},
                            false),
        row<&smooth_after>("hfSmoothHalfCylinderAfter", "g, t, t2, b0, b1, b2, b3, ends",
                           {"Shape g from the time t2 on, growing until the time `ends` (b0 < 0).",
                            "hfBoundedBlendInt(g, t - t2, ends - t, b0, b1, b2, b3)", paper,
                            "As for hfSmoothHalfCylinderBefore."},
                           false),
        row<&slab>("hfTimeSlab", "t, low, high",
                   {"The span of time from low to high, a bounding solid.", "(t - low) & (high - t)", paper},
                   false),
        row<&time_cone>("hfTimeCone", "x, t, T, c1, R1, c2, R2",
                        {"Bounding solid that moves from the ball c1, R1 at -T to the ball c2, R2 at T.",
                         "(R^2 - |x - c|^2) & (t + T) & (T - t), c and R linear in t", paper,
                         "The centres say how many items of x count: 2 for shapes of the plane, 3 in space."},
                        false),
        row<&space_time_blend>(
            "hfSpaceTimeBlend", "g1, g2, t, t1, t2, T, a0, a1, a2, a3",
            {"Space-time bounded blending: g1 at t = -T becomes g2 at t = T.",
             "hfBoundedBlendUni(g1 & (t1 - t), g2 & (t - t2), (t + T) & (T - t), a0, a1, a2, a3)", paper,
             parameters_note},
            false),
        row<&smooth_space_time_blend>(
            "hfSpaceTimeBlendSmooth", "g1, g2, t, t1, t2, T, a0, a1, a2, a3, b0, c",
            {"The same with smoothed half-cylinders between -c and c, for an even transition.",
             "as hfSpaceTimeBlend, of hfSmoothHalfCylinderBefore and After with b1 = b2 = b3 = 1", paper,
             "b0 between -0.2 and -1.5; too small a number makes the shape vanish: raise a0."},
            false),
        row<&color>("hfA_SpaceTimeColor", "F1, F2, o, c1, c2",
                    {"Color of a frame: c1 within F1, c2 within F2, mixed by distance elsewhere.",
                     "o = w c1 + (1-w) c2, w = |F2|/(|F1| + |F2|) where both are negative", paper},
                    false),
    };
}

}  // namespace frep::shapes
