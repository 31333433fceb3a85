// Offsets, shells and their rows. See offsets.h.
#include "frep/shapes/offsets.h"

#include "frep/field/derivative.h"
#include "frep/shapes/at_point.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/set_operations.h"

namespace frep::shapes {

Expression iso_offset(Build&, Expression f, Expression c) { return f + c; }

Expression normal_offset(Build& build, Array x, Expression f, Expression d) {
    const auto slopes = derivatives(f, x, AtJumps::ignored);
    if (!slopes) return build.error(slopes.error().message);
    Expression length = build.constant(0);
    for (const Expression& slope : *slopes) length = hypot(length, slope);
    // where there is no direction, d/1 times a gradient of 0 moves nothing
    const Expression step = d / select(less(0.0, length), length, build.constant(1));
    std::vector<Expression> moved;
    for (std::size_t i = 0; i < x.size(); ++i) moved.push_back(x[i] + step * (*slopes)[i]);
    const auto there = at_point(build, f, x, moved);
    return there ? *there : build.error("f depends on the point in another way than by the items of x");
}

Expression iso_shell(Build& build, Expression f, Expression w) {
    return conjunction(build.set_system, f, w - f);
}

Expression normal_shell(Build& build, Array x, Expression f, Expression w) {
    return subtraction(build.set_system, f, normal_offset(build, x, f, -w));
}

Rows offset_rows() {
    constexpr std::string_view cite = "pasko1994b";
    constexpr std::string_view meets =
        "Exact where the normals do not meet within that length; at sharp edges it rounds and folds. "
        "hfOffsetRadius is exact everywhere, and slower.";
    return {
        row<&iso_offset>("hfIsoOffset", "f, c",
                         {"The solid grown (c > 0) or shrunk to another level of its function.", "f + c",
                          cite, "By the length c for functions with unit gradients only."},
                         false),
        row<&normal_offset>("hfNormalOffset", "x, f, d",
                            {"The solid grown (d > 0) or shrunk by the length d along its normals.",
                             "f(X + d grad f/|grad f|), f(X) where grad f = 0", cite, meets},
                            false),
        row<&iso_shell>(
            "hfIsoShell", "f, w",
            {"The wall of the solid between the levels 0 and w of its function.", "f & (w - f)", cite},
            false),
        row<&normal_shell>(
            "hfNormalShell", "x, f, w",
            {"The wall of thickness w within the solid.", "f \\ hfNormalOffset(x, f, -w)", cite, meets},
            false),
    };
}

}  // namespace frep::shapes
