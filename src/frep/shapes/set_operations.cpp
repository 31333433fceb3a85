// Systems of set operations and their rows. See set_operations.h.
#include "frep/shapes/set_operations.h"

#include <algorithm>

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

/// Joins neighbours until one is left.
template <class Join>
Expression balanced(Array functions, Join join) {
    FREP_CHECK(!functions.empty());
    std::vector<Expression> level(functions.begin(), functions.end());
    while (level.size() > 1) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i + 1 < level.size(); i += 2) level[kept++] = join(level[i], level[i + 1]);
        if (level.size() % 2 == 1) level[kept++] = level.back();
        level.resize(kept);
    }
    return level.front();
}

Expression joined(const SetSystem& system, Op r0, Op min_max, Op r_alpha, Op r0m, Op rp, Expression f1,
                  Expression f2) {
    const Expression parameter = Expression::constant(f1, system.parameter);
    switch (system.kind) {
        case SetSystem::Kind::r0:
            break;
        case SetSystem::Kind::min_max:
            return apply(min_max, {f1, f2});
        case SetSystem::Kind::r_alpha:
            return apply(r_alpha, {f1, f2, parameter});
        case SetSystem::Kind::r0m:
            return apply(r0m, {f1, f2, parameter});
        case SetSystem::Kind::rp:
            return apply(rp, {f1, f2, parameter});
    }
    return apply(r0, {f1, f2});
}

}  // namespace

Expression disjunction(const SetSystem& system, Expression f1, Expression f2) {
    return joined(system, Op::r_or, Op::max, Op::r_alpha_or, Op::r0m_or, Op::rp_or, f1, f2);
}
Expression conjunction(const SetSystem& system, Expression f1, Expression f2) {
    return joined(system, Op::r_and, Op::min, Op::r_alpha_and, Op::r0m_and, Op::rp_and, f1, f2);
}
Expression subtraction(const SetSystem& system, Expression f1, Expression f2) {
    return conjunction(system, f1, -f2);
}
Expression disjunction(const SetSystem& system, Array functions) {
    return balanced(functions, [&](Expression a, Expression b) { return disjunction(system, a, b); });
}
Expression conjunction(const SetSystem& system, Array functions) {
    return balanced(functions, [&](Expression a, Expression b) { return conjunction(system, a, b); });
}

Expression symmetric_conjunction(Array functions, Expression m) {
    // x + |x| = 2 max(x, 0) and x - |x| = 2 min(x, 0); one of product and sum is 0
    std::vector<Expression> factors, terms;
    for (const Expression& x : functions) {
        const Expression size = pow(abs(x), m);
        factors.push_back(size * (2.0 * max(x, 0.0)));
        terms.push_back(size * (2.0 * min(x, 0.0)));
    }
    return balanced(terms, [](Expression a, Expression b) { return a + b; }) +
           balanced(factors, [](Expression a, Expression b) { return a * b; });
}
Expression symmetric_disjunction(Array functions, Expression m) {
    std::vector<Expression> complements;
    for (const Expression& x : functions) complements.push_back(-x);
    return -symmetric_conjunction(complements, m);
}

namespace {

template <Op op>
Expression by_parameter(Build&, Expression f1, Expression f2, Expression parameter) {
    return apply(op, {f1, f2, parameter});
}
template <Op op>
Expression minus_by_parameter(Build&, Expression f1, Expression f2, Expression parameter) {
    return apply(op, {f1, -f2, parameter});
}
template <Op op>
Expression plain(Build&, Expression f1, Expression f2) {
    return apply(op, {f1, f2});
}
template <Op op>
Expression plain_minus(Build&, Expression f1, Expression f2) {
    return apply(op, {f1, -f2});
}

Expression complement(Build&, Expression f) { return -f; }

Expression symmetric_difference(Build& build, Expression f1, Expression f2) {
    const SetSystem& system = build.set_system;
    return disjunction(system, subtraction(system, f1, f2), subtraction(system, f2, f1));
}

constexpr const char* needs_items = "the list of functions is empty";

Expression union_of(Build& build, Array list) {
    return list.empty() ? build.error(needs_items) : disjunction(build.set_system, list);
}
Expression intersection_of(Build& build, Array list) {
    return list.empty() ? build.error(needs_items) : conjunction(build.set_system, list);
}
Expression symmetric_union(Build& build, Array list, Expression m) {
    return list.empty() ? build.error(needs_items) : symmetric_disjunction(list, m);
}
Expression symmetric_intersection(Build& build, Array list, Expression m) {
    return list.empty() ? build.error(needs_items) : symmetric_conjunction(list, m);
}

/// max(f1, f2) + max(k - |f1 - f2|, 0)^2/(4 k): the polynomial that the pruner knows (eval/tile_smooth.h).
Expression smooth_max(Expression f1, Expression f2, Expression k) {
    const Expression soft = square(max(k - abs(f1 - f2), 0.0)) / (4.0 * k);
    return max(f1, f2) + soft;
}
Expression smooth_min(Expression f1, Expression f2, Expression k) {
    const Expression soft = square(max(k - abs(f1 - f2), 0.0)) / (4.0 * k);
    return min(f1, f2) - soft;
}
Expression smooth(Build& build, Expression k, Expression value, Expression sharp) {
    if (const auto width = build.graph.constant_value(k.id())) {
        if (*width > 0.0) return value;
        if (*width == 0.0) return sharp;
        return build.error("the width of a smooth set operation is negative");
    }
    return select(less(0.0, k), value, sharp);
}
Expression smooth_union(Build& build, Expression f1, Expression f2, Expression k) {
    return smooth(build, k, smooth_max(f1, f2, k), max(f1, f2));
}
Expression smooth_intersection(Build& build, Expression f1, Expression f2, Expression k) {
    return smooth(build, k, smooth_min(f1, f2, k), min(f1, f2));
}
Expression smooth_subtraction(Build& build, Expression f1, Expression f2, Expression k) {
    return smooth_intersection(build, f1, -f2, k);
}

/// Ricci's functions are positive, and < 1 inside: g = 1 - f, cut where powers still have a base.
Expression ricci_form(Expression f) { return max(1.0 - f, 1e-5); }
Expression ricci_union(Build&, Expression f1, Expression f2, Expression p) {
    const Expression sum = pow(ricci_form(f1), -p) + pow(ricci_form(f2), -p);
    return 1.0 - pow(sum, -1.0 / p);
}
Expression ricci_intersection(Build&, Expression f1, Expression f2, Expression p) {
    const Expression sum = pow(ricci_form(f1), p) + pow(ricci_form(f2), p);
    return 1.0 - pow(sum, 1.0 / p);
}

}  // namespace

Rows set_operation_rows() {
    constexpr std::string_view alpha = "f1, f2, alpha", power = "f1, f2, m", norm = "f1, f2, p",
                               two = "f1, f2", width = "f1, f2, k";
    constexpr std::string_view rvachev = "rvachev1982", thesis = "pasko1995", ricci = "ricci1973",
                               quilez = "quilez2008", shapiro = "shapiro2007";
    constexpr std::string_view alpha_note =
        "-1 < alpha <= 1, a number or a function with alpha(a,b) = alpha(b,a) = alpha(-a,b); 1 is max and "
        "min, "
        "0 is R0. Undefined outside.";
    constexpr std::string_view power_note =
        "C^m on the edge, but not normalized: do not blend it. m >= 0; undefined below.";
    constexpr std::string_view norm_note = "p = 2 is R0; p > 1, undefined at and below 1.";
    constexpr std::string_view smooth_note =
        "Exactly max or min where |f1 - f2| >= k; k is a length where f1 and f2 are distances.";
    return {
        row<&plain<Op::r_or>>("hfR0Uni", two,
                              {"Union by the system R0, whatever the file's operators mean.",
                               "f1 + f2 + sqrt(f1^2 + f2^2)", rvachev},
                              false),
        row<&plain<Op::r_and>>("hfR0Int", two,
                               {"Intersection by the system R0.", "f1 + f2 - sqrt(f1^2 + f2^2)", rvachev},
                               false),
        row<&plain_minus<Op::r_and>>(
            "hfR0Sub", two, {"Subtraction of f2 from f1 by the system R0.", "hfR0Int(f1, -f2)", rvachev},
            false),
        row<&plain<Op::max>>(
            "hfMaxUni", two,
            {"Union by the larger value; associative, creased where f1 = f2.", "max(f1, f2)", rvachev},
            false),
        row<&plain<Op::min>>("hfMinInt", two, {"Intersection by the smaller value.", "min(f1, f2)", rvachev},
                             false),
        row<&plain_minus<Op::min>>(
            "hfMinSub", two, {"Subtraction of f2 from f1 by the smaller value.", "min(f1, -f2)", rvachev},
            false),
        row<&by_parameter<Op::r_alpha_or>>(
            "hfRAlphaUni", alpha,
            {"Union by the system R_alpha.", "(f1 + f2 + sqrt(f1^2 + f2^2 - 2 alpha f1 f2))/(1 + alpha)",
             thesis, alpha_note},
            false),
        row<&by_parameter<Op::r_alpha_and>>(
            "hfRAlphaInt", alpha,
            {"Intersection by the system R_alpha.",
             "(f1 + f2 - sqrt(f1^2 + f2^2 - 2 alpha f1 f2))/(1 + alpha)", thesis, alpha_note},
            false),
        row<&minus_by_parameter<Op::r_alpha_and>>("hfRAlphaSub", alpha,
                                                  {"Subtraction of f2 from f1 by the system R_alpha.",
                                                   "hfRAlphaInt(f1, -f2, alpha)", thesis, alpha_note},
                                                  false),
        row<&by_parameter<Op::r0m_or>>("hfR0mUni", power,
                                       {"Union by the system R_0^m, C^m everywhere.",
                                        "hfR0Uni(f1, f2) (f1^2 + f2^2)^(m/2)", thesis, power_note},
                                       false),
        row<&by_parameter<Op::r0m_and>>("hfR0mInt", power,
                                        {"Intersection by the system R_0^m, C^m everywhere.",
                                         "hfR0Int(f1, f2) (f1^2 + f2^2)^(m/2)", thesis, power_note},
                                        false),
        row<&minus_by_parameter<Op::r0m_and>>(
            "hfR0mSub", power,
            {"Subtraction of f2 from f1 by the system R_0^m.", "hfR0mInt(f1, -f2, m)", thesis, power_note},
            false),
        row<&by_parameter<Op::rp_or>>(
            "hfRpUni", norm,
            {"Union by the system R_p.", "f1 + f2 + (|f1|^p + |f2|^p)^(1/p)", rvachev, norm_note}, false),
        row<&by_parameter<Op::rp_and>>(
            "hfRpInt", norm,
            {"Intersection by the system R_p.", "f1 + f2 - (|f1|^p + |f2|^p)^(1/p)", rvachev, norm_note},
            false),
        row<&minus_by_parameter<Op::rp_and>>(
            "hfRpSub", norm,
            {"Subtraction of f2 from f1 by the system R_p.", "hfRpInt(f1, -f2, p)", rvachev, norm_note},
            false),
        row<&complement>("hfComplement", "f", {"All that is outside of the solid.", "-1 f", thesis}, false),
        row<&symmetric_difference>("hfSymDiff", two,
                                   {"Symmetric difference: what belongs to one of the two, not to both.",
                                    "(f1 \\ f2) | (f2 \\ f1)", thesis, "By the file's system of operations."},
                                   false),
        row<&union_of>("hfUnionOf", "list",
                       {"Union of all functions of an array, as a balanced tree.",
                        "(f1 | f2) | (f3 | f4) ...", thesis, "By the file's system of operations."},
                       false),
        row<&intersection_of>("hfIntersectionOf", "list",
                              {"Intersection of all functions of an array, as a balanced tree.",
                               "(f1 & f2) & (f3 & f4) ...", thesis, "By the file's system of operations."},
                              false),
        row<&symmetric_union>("hfSymmetricUni", "list, m",
                              {"Union of an array by one symmetric function, the same for every order, C^m.",
                               "sum of x^m (x + |x|), minus prod of (-x)^m (|x| - x)", shapiro,
                               "For predicates: values grow with the power of the number of operands."},
                              false),
        row<&symmetric_intersection>(
            "hfSymmetricInt", "list, m",
            {"Intersection of an array by one symmetric function, the same for every order, C^m.",
             "sum of (-1)^m x^m (x - |x|), plus prod of x^m (x + |x|)", shapiro,
             "For predicates: values grow with the power of the number of operands."},
            false),
        row<&smooth_union>("hfSmoothUni", width,
                           {"Compact smooth union: adds material only where |f1 - f2| < k.",
                            "max(f1, f2) + max(k - |f1 - f2|, 0)^2/(4 k)", quilez, smooth_note},
                           false),
        row<&smooth_intersection>("hfSmoothInt", width,
                                  {"Compact smooth intersection: removes material only where |f1 - f2| < k.",
                                   "min(f1, f2) - max(k - |f1 - f2|, 0)^2/(4 k)", quilez, smooth_note},
                                  false),
        row<&smooth_subtraction>(
            "hfSmoothSub", width,
            {"Compact smooth subtraction of f2 from f1.", "hfSmoothInt(f1, -f2, k)", quilez, smooth_note},
            false),
        row<&ricci_union>(
            "hfRicciUni", norm,
            {"Ricci's blending union of functions that are 0 on the surface and at most 1 inside.",
             "1 - ((1-f1)^-p + (1-f2)^-p)^(-1/p)", ricci,
             "1 - f is Ricci's function, < 1 inside; it is cut at 1e-5 from below. The larger p, "
             "the sharper."},
            false),
        row<&ricci_intersection>("hfRicciInt", norm,
                                 {"Ricci's blending intersection.", "1 - ((1-f1)^p + (1-f2)^p)^(1/p)", ricci,
                                  "As for hfRicciUni."},
                                 false),
    };
}

}  // namespace frep::shapes
