// Areas by the monotone formula. See outline_formula.h.
#include "frep/shapes/outline_formula.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "frep/shapes/polygon.h"
#include "frep/shapes/set_operations.h"

namespace frep::shapes {

namespace {

struct Contour {
    Outline outline;
    double area = 0;                  ///< above 0
    int turns = 1;                    ///< 1 for a counter-clockwise contour, -1 for a clockwise one
    std::vector<std::size_t> around;  ///< the contours that it lies in
};

double signed_area(const std::vector<Vec2>& v) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 &a = v[i], &b = v[(i + 1) % v.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * sum;
}

/// True for a point inside; contours do not meet, so the point is never on the boundary.
bool contains(const std::vector<Vec2>& v, Vec2 p) {
    bool inside = false;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 &a = v[i], &b = v[(i + 1) % v.size()];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        if ((side > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

/// Contours by ascending area, with what they lie in; or what is wrong.
Result<std::vector<Contour>> nested(const FilledPart& part) {
    std::vector<Contour> out;
    for (const std::vector<Vec2>& vertices : part.contours) {
        const double area = signed_area(vertices);
        out.push_back({make_outline(vertices), std::fabs(area), area < 0 ? -1 : 1, {}});
        if (const std::string& problem = out.back().outline.problem; !problem.empty())
            return Error{ErrorKind::invalid_argument, problem};
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Contour& a, const Contour& b) { return a.area < b.area; });
    for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t k = i + 1; k < out.size(); ++k) {
            if (outlines_meet(out[i].outline, out[k].outline))
                return Error{ErrorKind::invalid_argument, "contours meet"};
            if (contains(out[k].outline.vertices, out[i].outline.vertices[0])) out[i].around.push_back(k);
        }
    return out;
}

Expression part_formula(const SetSystem& system, const std::vector<Contour>& contours, FillRule rule,
                        Expression x, Expression y) {
    const auto is_filled = [&](int winding) {
        return rule == FillRule::nonzero ? winding != 0 : winding % 2 != 0;
    };
    // Where the filling begins or ends: inside it is not as outside.
    std::vector<bool> is_boundary;
    for (const Contour& contour : contours) {
        int outside = 0;
        for (const std::size_t k : contour.around) outside += contours[k].turns;
        is_boundary.push_back(is_filled(outside) != is_filled(outside + contour.turns));
    }
    // Small ones come first, so what a contour holds is complete when it is met.
    std::vector<std::vector<Expression>> holds(contours.size());
    std::vector<Expression> top;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (!is_boundary[i]) continue;
        Expression value = monotone_polygon(system, contours[i].outline, x, y);
        if (!holds[i].empty()) value = subtraction(system, value, disjunction(system, holds[i]));
        std::vector<Expression>* place = &top;
        for (const std::size_t k : contours[i].around) {
            if (!is_boundary[k]) continue;
            place = &holds[k];
            break;
        }
        place->push_back(value);
    }
    return disjunction(system, top);
}

}  // namespace

Result<Expression> area_formula(const SetSystem& system, const Area& area, Expression x, Expression y) {
    constexpr std::size_t most_vertices = 4096;
    std::size_t vertices = 0;
    for (const FilledPart& part : area.parts)
        for (const auto& contour : part.contours) vertices += contour.size();
    if (vertices > most_vertices)
        return Error{
            ErrorKind::over_limit,
            fmt::format("the outline has {} vertices, the formula takes {} at most; hfOutline takes more",
                        vertices, most_vertices)};
    std::vector<Expression> parts;
    for (const FilledPart& part : area.parts) {
        const auto contours = nested(part);
        if (!contours)
            return Error{contours.error().kind,
                         contours.error().message + ", which the formula cannot express; hfOutline can"};
        parts.push_back(part_formula(system, *contours, part.rule, x, y));
    }
    return disjunction(system, parts);
}

}  // namespace frep::shapes
