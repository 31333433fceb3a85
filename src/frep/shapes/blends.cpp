// Blending set operations and their rows. See blends.h.
#include "frep/shapes/blends.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

void warn_of_empty_extent(Build& build, std::initializer_list<Expression> extents) {
    for (const Expression& a : extents)
        if (const auto value = build.graph.constant_value(a.id()); value && *value == 0.0 && build.warn)
            build.warn("a blend extent of 0 leaves the plain set operation");
}

}  // namespace

template <Op op>
Expression blend(Build& build, Expression f1, Expression f2, Expression a0, Expression a1, Expression a2) {
    warn_of_empty_extent(build, {a1, a2});
    return apply(op, {f1, f2, a0, a1, a2});
}

template <Op op>
Expression blend_subtraction(Build& build, Expression f1, Expression f2, Expression a0, Expression a1,
                             Expression a2) {
    return blend<op>(build, f1, -f2, a0, a1, a2);
}

template <Op op>
Expression bounded_blend(Build& build, Expression f1, Expression f2, Expression f3, Expression a0,
                         Expression a1, Expression a2, Expression a3) {
    warn_of_empty_extent(build, {a1, a2, a3});
    return apply(op, {f1, f2, f3, a0, a1, a2, a3});
}

Expression bounded_subtraction(Build& build, Expression f1, Expression f2, Expression f3, Expression a0,
                               Expression a1, Expression a2, Expression a3) {
    return bounded_blend<Op::bounded_int>(build, f1, -f2, f3, a0, a1, a2, a3);
}

Rows blend_rows() {
    constexpr std::string_view bounded_names = "f1, f2, f3, a0, a1, a2, a3";
    constexpr std::string_view names = "f1, f2, a0, a1, a2";
    constexpr std::string_view bounded_cite = "pasko2002", point_cite = "pasko2005", old_cite = "pasko1994";
    constexpr std::string_view bounded_note =
        "Only the ratios of a1, a2, a3 matter; choose a3 near the largest f3 and a1, a2 near the width.";
    constexpr std::string_view extent_note = "a1 = 0 or a2 = 0 leaves the plain set operation.";
    return {
        row<&blend<Op::blend_uni>>(
            "hfBlendUni", names,
            {"Blending union; the whole surface moves, less and less away from the edge.",
             "(f1 | f2) + a0/(1 + (f1/a1)^2 + (f2/a2)^2)", old_cite, extent_note}),
        row<&blend<Op::blend_int>>("hfBlendInt", names,
                                   {"Blending intersection; a0 < 0 removes material along the edge.",
                                    "(f1 & f2) + a0/(1 + (f1/a1)^2 + (f2/a2)^2)", old_cite, extent_note}),
        row<&blend_subtraction<Op::blend_int>>(
            "hfBlendSub", names,
            {"Blending subtraction of f2 from f1.", "(f1 \\ f2) + a0/(1 + (f1/a1)^2 + (f2/a2)^2)", old_cite},
            false),
        row<&bounded_blend<Op::bounded_uni>>(
            "hfBoundedBlendUni", bounded_names,
            {"Blending union inside the bounding solid f3; outside it the plain union.",
             "(f1 | f2) + a0 (1-u)^3/(1+u), u = r1/(r1+r2), r1 = (f1/a1)^2 + (f2/a2)^2, r2 = (f3/a3)^2 where "
             "f3 > 0",
             bounded_cite, bounded_note},
            false),
        row<&bounded_blend<Op::bounded_int>>(
            "hfBoundedBlendInt", bounded_names,
            {"Blending intersection inside the bounding solid f3; outside it the plain intersection.",
             "(f1 & f2) + a0 (1-u)^3/(1+u), u as for hfBoundedBlendUni", bounded_cite, bounded_note},
            false),
        row<&bounded_subtraction>(
            "hfBoundedBlendSub", bounded_names,
            {"Blending subtraction of f2 from f1 inside the bounding solid f3; outside it the plain one.",
             "(f1 \\ f2) + a0 (1-u)^3/(1+u), u as for hfBoundedBlendUni", bounded_cite, bounded_note},
            false),
        row<&blend<Op::point_uni>>(
            "hfPointBlendUni", names,
            {"Blending union that touches surface 1 where |f2| = a2 and surface 2 where |f1| = a1.",
             "(f1 | f2) + a0 (1-u)^3/(1+u) for u < 1, u = (f1/a1)^2 + (f2/a2)^2; plain union for u >= 1",
             point_cite, "Every place where the two surfaces meet gets the blend."},
            false),
        row<&blend<Op::point_int>>(
            "hfPointBlendInt", names,
            {"Blending intersection bounded by the extents a1 and a2; a0 < 0 rounds the edge.",
             "(f1 & f2) + a0 (1-u)^3/(1+u) for u < 1, u = (f1/a1)^2 + (f2/a2)^2", point_cite},
            false),
        row<&blend_subtraction<Op::point_int>>(
            "hfPointBlendSub", names,
            {"Blending subtraction of f2 from f1 bounded by the extents a1 and a2.",
             "(f1 \\ f2) + a0 (1-u)^3/(1+u) for u < 1, u = (f1/a1)^2 + (f2/a2)^2", point_cite},
            false),
    };
}

}  // namespace frep::shapes
