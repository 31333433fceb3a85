// Attribute functions of single values and sets, and their rows. See attributes.h; look-up tables stand in
// attribute_tables.cpp.
#include "frep/shapes/attributes.h"

#include <algorithm>

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

Expression done(Build& build) { return build.constant(1.0); }

/// 1 where a <= b, else 0.
Expression at_most(Expression a, Expression b) { return less_equal(a, b); }

bool increasing(Build& build, Expression a, Expression b) {
    const auto low = build.graph.constant_value(a.id()), high = build.graph.constant_value(b.id());
    return low && high && *low < *high;
}

}  // namespace

Expression wave(Build&, Expression v, Expression b1, Expression b2, Expression freq) {
    const Expression low = min(b1, b2), high = max(b1, b2);
    return low + (high - low) * (1.0 + sin(freq * v)) / 2.0;
}

Expression checker_board(Build& build, Array x, Array block_size, Array gap, ArrayInOut o, Array in_block,
                         Array in_gap) {
    const std::size_t axes = x.size();
    if (axes == 0 || !sizes_are({{block_size, axes}, {gap, axes}}))
        return build.error("x, block and gap must have equal sizes");
    Expression inside = build.constant(1.0);
    for (std::size_t i = 0; i < axes; ++i) {
        const Expression period = block_size[i] + gap[i];
        const Expression from_corner = x[i] - floor(x[i] / period) * period;
        inside = logical_and(inside, logical_and(less(0.0, from_corner), less(from_corner, block_size[i])));
    }
    if (in_block.size() == in_gap.size())
        for (std::size_t i = 0; i < std::min(o.size(), in_block.size()); ++i)
            o[i] = select(inside, in_block[i], in_gap[i]);
    return done(build);
}

Expression union_attributes(Build& build, Expression f1, Expression f2, ArrayInOut o, Array i1, Array i2,
                            Expression mode) {
    const Expression value = r_or(f1, f2), zero = build.constant(0.0);
    const Expression in1 = at_most(zero, f1), in2 = at_most(zero, f2), in = less(-1e-6, value);
    const std::size_t count = std::min({o.size(), i1.size(), i2.size()});
    for (std::size_t i = 0; i < count; ++i) {
        Expression common = select(equal(mode, 4.0), max(i1[i], i2[i]), o[i]);
        common = select(equal(mode, 3.0), min(i1[i], i2[i]), common);
        common = select(equal(mode, 2.0), i1[i] + i2[i], common);
        common = select(equal(mode, 1.0), i2[i], common);
        common = select(equal(mode, 0.0), i1[i], common);
        const Expression only2 = select(logical_and(in2, logical_not(in1)), i2[i], common);
        const Expression chosen = select(logical_and(in1, logical_not(in2)), i1[i], only2);
        o[i] = select(in, chosen, o[i]);
    }
    return value;
}

Expression set_color(Build& build, Expression f, ArrayInOut o, Expression r, Expression g, Expression b) {
    if (o.size() != 3) return build.error("a colour must have 3 items");
    const Expression inside = at_most(build.constant(0.0), f);
    const Expression color[3] = {r, g, b};
    for (std::size_t i = 0; i < 3; ++i) o[i] = select(inside, color[i], o[i]);
    return done(build);
}

Expression set_attributes(Build& build, Expression f, ArrayInOut o, Array in) {
    const Expression inside = at_most(build.constant(0.0), f);
    for (std::size_t i = 0; i < std::min(o.size(), in.size()); ++i) o[i] = select(inside, in[i], o[i]);
    return done(build);
}

template <bool cubic>
Expression mix(Build&, ArrayInOut o, Array i1, Array i2, Expression f, Expression fmin, Expression fmax) {
    const Expression t = (f - fmin) / (fmax - fmin);
    const Expression clamped = min(max(t, 0.0), 1.0);
    const Expression weight = cubic ? square(clamped) * (3.0 - 2.0 * clamped) : clamped;
    for (std::size_t i = 0; i < std::min({o.size(), i1.size(), i2.size()}); ++i)
        o[i] = (1.0 - weight) * i1[i] + weight * i2[i];
    return t;
}

Expression clamp(Build&, Expression f, Expression a, Expression b) { return min(max(f, a), b); }
Expression step(Build&, Expression f, Expression a) { return at_most(a, f); }
Expression pulse_old(Build& build, Expression f, Expression high, Expression low) {
    return pulse(build, f, low, high);
}
Expression pulse(Build&, Expression f, Expression low, Expression high) {
    return logical_and(at_most(low, f), at_most(f, high));
}

Expression smooth_step(Build& build, Expression f, Expression a, Expression b) {
    const Expression t = (f - a) / (b - a);
    if (increasing(build, a, b)) {
        const Expression clamped = min(max(t, 0.0), 1.0);
        return square(clamped) * (3.0 - 2.0 * clamped);
    }
    const Expression zero = build.constant(0.0), one = build.constant(1.0);
    const Expression between = square(t) * (3.0 - 2.0 * t);
    return select(less(f, a), zero, select(less_equal(b, f), one, between));
}
Expression smooth_step_old(Build& build, Expression, Expression, Expression, Expression f, Expression a,
                           Expression b) {
    return smooth_step(build, f, a, b);
}

Expression modulo(Build&, Expression a, Expression b) {
    const Expression rest = a - trunc(a / b) * b;
    return select(less(rest, 0.0), rest + b, rest);
}
Expression floor_old(Build&, Expression a) { return trunc(a); }
Expression floor_down(Build&, Expression a) { return floor(a); }

template <bool wrapped>
Expression rgb_to_hsv(Build& build, Array rgb, ArrayInOut hsv) {
    if (!sizes_are({{rgb, 3}, {hsv, 3}})) return build.error("a colour must have 3 items");
    const Expression zero = build.constant(0.0), r = rgb[0], g = rgb[1], b = rgb[2];
    const Expression high = max(max(r, g), b), low = min(min(r, g), b);
    const Expression range = high - low;
    const Expression from_green = 120.0 + 60.0 * (b - r) / range, from_blue = 240.0 + 60.0 * (r - g) / range;
    Expression from_red = 60.0 * (g - b) / range;
    if (wrapped) from_red = select(less(from_red, 0.0), from_red + 360.0, from_red);
    const Expression is_red = less_equal(high, r), is_green = less_equal(high, g);
    const Expression hue = select(is_red, from_red, select(is_green, from_green, from_blue));
    hsv[0] = select(less_equal(range, zero), zero, hue);
    hsv[1] = select(less_equal(high, zero), zero, range / high);
    hsv[2] = high;
    return done(build);
}

Expression hsv_to_rgb(Build& build, Array hsv, ArrayInOut rgb) {
    if (!sizes_are({{hsv, 3}, {rgb, 3}})) return build.error("a colour must have 3 items");
    const Expression h = hsv[0] - 360.0 * floor(hsv[0] / 360.0), s = hsv[1], v = hsv[2];
    const Expression zero = build.constant(0.0);
    const Expression first = less(h, 120.0), second = less(h, 240.0);
    const Expression ramp[3] = {
        select(first, (120.0 - h) / 60.0, select(second, zero, (h - 240.0) / 60.0)),
        select(first, h / 60.0, select(second, (240.0 - h) / 60.0, zero)),
        select(first, zero, select(second, (h - 120.0) / 60.0, (360.0 - h) / 60.0)),
    };
    for (std::size_t i = 0; i < 3; ++i) rgb[i] = (1.0 - s + s * min(ramp[i], 1.0)) * v;
    return done(build);
}

Rows attribute_rows() {
    constexpr std::string_view from = "schmitt2001";
    return {
        row<&wave>("hfA_Wave", "v, b1, b2, freq",
                   {"Wave between the bounds b1 and b2.", "lo + (hi - lo) (1 + sin(freq v))/2", from}),
        row<&checker_board>(
            "hfA_CheckerBoard", "x, block, gap, o, inblock, ingap",
            {"Blocks and gaps that repeat along every axis.",
             "o = inblock where 0 < x - floor(x/(block+gap)) (block+gap) < block on all axes, "
             "else ingap",
             from, "o is left as it is when inblock and ingap have different sizes."}),
        row<&union_attributes>("hfA_Union", "f1, f2, o, i1, i2, op",
                               {"Union of two solids with attributes.",
                                "f1 | f2; where it is > -1e-6: only f1 >= 0: o = i1; only f2 >= 0: o = i2; "
                                "otherwise op 0: i1, 1: "
                                "i2, 2: i1 + i2, 3: smaller, 4: larger",
                                from}),
        row<&set_color>("hfA_SetColor", "f, o, r, g, b",
                        {"Colour of a solid.", "o = (r, g, b) where f >= 0", from}),
        row<&set_attributes>(
            "hfA_SetAttributes", "f, o, i1",
            {"Attributes of a solid.", "o = i1 where f >= 0, as many items as both have", from}),
        row<&mix<false>>("hfA_Lerp", "o, i1, i2, f, fmin, fmax",
                         {"Linear mix of attributes; returns t without clamping.",
                          "o = (1-t) i1 + t i2, t = (f - fmin)/(fmax - fmin) clamped to 0..1", from}),
        row<&mix<false>>(
            "hfA_Cerp", "o, i1, i2, f, fmin, fmax",
            {"The same as hfA_Lerp.", "o = (1-t) i1 + t i2, t = (f - fmin)/(fmax - fmin) clamped to 0..1",
             from, "Meant to be cubic; the old table bound it to hfA_Lerp. hfA_CubicMix is cubic."}),
        row<&mix<true>>("hfA_CubicMix", "o, i1, i2, f, fmin, fmax",
                        {"Smooth mix of attributes; returns t without clamping.",
                         "o = (1-w) i1 + w i2, w = t^2 (3 - 2 t), t clamped to 0..1"},
                        false),
        row<&clamp>("hfA_Clamp", "f, a, b", {"f clamped to a..b.", "min(max(f, a), b)", from}),
        row<&step>("hfA_Step", "f, a", {"Step from 0 to 1 at a.", "0 for f < a, else 1", from}),
        row<&pulse_old>("hfA_Pulse", "f, hi, lo",
                        {"1 between two bounds, else 0.", "1 for lo <= f <= hi, else 0", from,
                         "The upper bound comes first; hfA_PulseBetween takes lo, hi."}),
        row<&pulse>("hfA_PulseBetween", "f, lo, hi",
                    {"1 between two bounds, else 0.", "1 for lo <= f <= hi, else 0"}, false),
        row<&smooth_step>(
            "hfA_SmoothStep", "f, a, b",
            {"Smooth step from a to b.", "t^2 (3 - 2 t), t = (f-a)/(b-a) clamped to 0..1", from}),
        row<&smooth_step_old>("hfA_SmoothStep", "unused1, unused2, unused3, f, a, b",
                              {"Smooth step from a to b.", "t^2 (3 - 2 t), t = (f-a)/(b-a) clamped to 0..1",
                               from, "The old tools took six numbers and used the last three."}),
        row<&modulo>(
            "hfA_Modulo", "a, b",
            {"Remainder that is not negative for b > 0.", "a - trunc(a/b) b, plus b where negative", from}),
        row<&floor_old>("hfA_Floor", "a",
                        {"a without its fraction.", "trunc(a)", from,
                         "Truncates toward 0 in spite of its name; hfA_FloorDown is the floor."}),
        row<&floor_down>("hfA_FloorDown", "a", {"Largest whole number not above a.", "floor(a)"}, false),
        row<&rgb_to_hsv<false>>(
            "hfA_RGBToHSV", "rgb, hsv",
            {"Hue (degrees), saturation, value of a colour.",
             "V = max, S = (max - min)/max, H = 60 (g-b)/(max-min) for red, 120 + ..., 240 + ...",
             "smith1978",
             "Hue is negative where red is largest and green < blue; hfA_RGBToHue360 wraps it."}),
        row<&rgb_to_hsv<true>>("hfA_RGBToHue360", "rgb, hsv",
                               {"Hue in 0..360 degrees, saturation, value of a colour.",
                                "as hfA_RGBToHSV, H + 360 where negative", "smith1978"},
                               false),
        row<&hsv_to_rgb>("hfA_HSVToRGB", "hsv, rgb",
                         {"Colour of a hue (degrees, any), saturation and value.",
                          "(1 - S + S ramp) V, ramp = clipped (120-H)/60, H/60, ... by thirds of the circle",
                          "smith1978"}),
    };
}

}  // namespace frep::shapes
