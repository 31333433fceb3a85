// Extrema over variables, projections, Minkowski sums, offsets by a radius, and their rows. See extremum.h.
#include "frep/shapes/extremum.h"

#include <vector>

#include <fmt/format.h>

#include "frep/math/functions.h"
#include "frep/shapes/at_point.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/searching.h"

namespace frep::shapes {

namespace {

std::string text_of(SearchError error) {
    switch (error) {
        case SearchError::variables:
            return "the variables must be one to three different ones of hfVariable";
        case SearchError::tolerance:
            return fmt::format("the tolerance must lie between {} and {}", least_tolerance, most_tolerance);
        case SearchError::in_loop:
            return "no search can stand in a loop whose number of steps depends on the point";
        case SearchError::nesting:
            return fmt::format("more than {} searches lie inside one another", most_nested_searches);
        default:
            return "the function to search is too large";
    }
}

/// The one variable below a node.
std::optional<Expression> variable_of(Expression t) {
    const std::vector<NodeId> found = search_variables_of(t.graph(), t.id());
    if (found.size() != 1) return std::nullopt;
    return Expression(t.graph(), found[0]);
}

Expression search_over(Build& build, Expression f, Array variables, Expression tolerance) {
    std::vector<Expression> found;
    for (const Expression& t : variables) {
        const auto variable = variable_of(t);
        if (!variable) return build.no_search(text_of(SearchError::variables));
        found.push_back(*variable);
    }
    return search(build, f, found, tolerance);
}

/// A value of a search, negated; the error value stays.
Expression negated(Build& build, Expression f) {
    const auto value = build.graph.constant_value(f.id());
    return value && *value == error_value ? f : -f;
}

/// The smaller of a and b, or up to `radius` / 2 more where they are nearly equal: smooth, so that at the
/// largest value its derivatives are shared between a and b as those of the maximum are.
Expression smooth_smaller(Expression a, Expression b, Expression radius) {
    return 0.5 * (a + b + radius - hypot(a - b, radius));
}

}  // namespace

Expression search(Build& build, Expression f, std::span<const Expression> variables, Expression tolerance,
                  bool in_ball) {
    const auto number = known(build, tolerance);
    if (!number) return build.no_search("the tolerance depends on the point");
    std::vector<NodeId> ids;
    for (const Expression& v : variables) ids.push_back(v.id());
    SearchError error = SearchError::none;
    const auto made = make_largest(build.graph, f.id(), ids, {*number, in_ball}, error);
    return made ? Expression(build.graph, *made) : build.no_search(text_of(error));
}

std::optional<Expression> moved(Build& build, Expression f, Array x, Array p) {
    const auto value = at_point(build, f, x, p);
    if (!value) build.error("f depends on the point in another way than by the items of x");
    return value;
}

Expression variable(Build& build, Expression low, Expression high) {
    for (const Expression& end : {low, high}) {
        const auto number = build.graph.constant_value(end.id());
        if (number && !(math::abs(*number) < math::infinity))
            return build.no_search("the range of a variable must be finite");
    }
    return low + (high - low) * unit_variable(build);
}

Expression largest(Build& build, Expression f, Expression t, Expression tolerance) {
    return search_over(build, f, {&t, 1}, tolerance);
}

Expression smallest(Build& build, Expression f, Expression t, Expression tolerance) {
    return negated(build, largest(build, -f, t, tolerance));
}

namespace {

Expression largest_of_all(Build& build, Expression f, Array t, Expression tolerance) {
    return search_over(build, f, t, tolerance);
}
Expression smallest_of_all(Build& build, Expression f, Array t, Expression tolerance) {
    return negated(build, search_over(build, -f, t, tolerance));
}

}  // namespace

Expression projection(Build& build, Array x, Expression f, Expression k, Expression low, Expression high,
                      Expression tolerance) {
    const auto number = known(build, k);
    if (!number || !(*number >= 1 && *number <= static_cast<double>(x.size())) ||
        math::trunc(*number) != *number)
        return build.error("k must be the number of an item of x");
    std::vector<Expression> p(x.begin(), x.end());
    const Expression t = variable(build, low, high);
    p[static_cast<std::size_t>(*number) - 1] = t;
    const auto along = moved(build, f, x, p);
    return along ? search_over(build, *along, {&t, 1}, tolerance) : build.constant(error_value);
}

Expression minkowski_sum(Build& build, Array x, Expression f1, Expression f2, Array low, Array high,
                         Expression tolerance) {
    const std::size_t n = x.size();
    if (n < 1 || n > most_search_variables || low.size() != n || high.size() != n)
        return build.error("x must have 1 to 3 items, and low and high as many");
    std::vector<Expression> first, rest;
    for (std::size_t i = 0; i < n; ++i) {
        first.push_back(variable(build, low[i], high[i]));
        rest.push_back(x[i] - first[i]);
    }
    const auto there = moved(build, f1, x, first), from_there = moved(build, f2, x, rest);
    if (!there || !from_there) return build.constant(error_value);
    return search_over(build, smooth_smaller(*there, *from_there, tolerance), first, tolerance);
}

Expression radius_offset(Build& build, Array x, Expression f, Expression r, Expression tolerance) {
    const std::size_t n = x.size();
    if (n != 2 && n != 3) return build.error("x must have 2 or 3 items");
    const auto radius = known(build, r);
    if (!radius || !(math::abs(*radius) < math::infinity))
        return build.error("the radius must be one finite number");
    std::vector<Expression> variables, p;
    for (std::size_t i = 0; i < n; ++i) {
        variables.push_back(unit_variable(build));
        p.push_back(x[i] + r * (2.0 * variables[i] - 1.0));
    }
    const auto around = moved(build, f, x, p);
    if (!around) return build.constant(error_value);
    if (*radius >= 0) return search(build, *around, variables, tolerance, true);
    return negated(build, search(build, -*around, variables, tolerance, true));
}

Rows extremum_rows() {
    constexpr std::string_view cite = "pasko1997";
    constexpr std::string_view promise =
        "Found by intervals: the value v is less than the true one by no more than tolerance max(1, |v|), or "
        "undefined where that cannot be proved. tolerance lies between 1e-9 and 0.5.";
    constexpr std::string_view sum_note =
        "The box low..high must hold the shape f1. Where f1(Y) and f2(X - Y) are nearly equal the smaller "
        "one "
        "is rounded, by up to tolerance/2 upwards. The work grows as the tolerance shrinks: 0.01 is good for "
        "pictures.";
    return {
        row<&variable>("hfVariable", "low, high",
                       {"A variable from low to high, for hfMaximum and hfMinimum.", "a new variable", cite,
                        "A value that depends on it has a meaning within hfMaximum or hfMinimum alone."},
                       false),
        row<&largest>(
            "hfMaximum", "f, t, tolerance",
            {"The largest value of f over the variable t, of hfVariable.", "max over t of f", cite, promise},
            false),
        row<&smallest>(
            "hfMinimum", "f, t, tolerance",
            {"The smallest value of f over the variable t, of hfVariable.", "min over t of f", cite, promise},
            false),
        row<&largest_of_all>("hfMaximumOver", "f, t, tolerance",
                             {"The largest value of f over one to three variables, the items of t.",
                              "max over t[1], t[2], t[3] of f", cite, promise},
                             false),
        row<&smallest_of_all>("hfMinimumOver", "f, t, tolerance",
                              {"The smallest value of f over one to three variables, the items of t.",
                               "min over t[1], t[2], t[3] of f", cite, promise},
                              false),
        row<&projection>("hfProjection", "x, f, k, low, high, tolerance",
                         {"Projection (shadow) of f along its item number k of x, from low to high.",
                          "max over x[k] in low..high of f(x)", cite, promise},
                         false),
        row<&minkowski_sum>("hfMinkowskiSum", "x, f1, f2, low, high, tolerance",
                            {"Minkowski sum: all sums of a point of f1 and a point of f2.",
                             "max over Y in low..high of min(f1(Y), f2(x - Y))", "pasko2003", sum_note},
                            false),
        row<&radius_offset>("hfOffsetRadius", "x, f, r, tolerance",
                            {"Offset by the radius r: f grown by a ball, or shrunk where r < 0.",
                             "max of f over the ball |Y - x| <= r; min for r < 0", "pasko1994b", promise},
                            false),
    };
}

}  // namespace frep::shapes
