// Blends by control points, fillets, chamfers and their rows. See control_points.h.
#include "frep/shapes/control_points.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frep/shapes/at_point.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/set_operations.h"

namespace frep::shapes {

namespace {

/// A surface is reached where |f| is this share of the distance that one unit of the gradient crosses.
constexpr double reached = 1e-12;
/// Points nearer to the edge than this share of their distance count as on the edge.
constexpr double on_edge = 1e-9;
constexpr int most_steps = 60;
/// Folds of more operands are blended as a whole.
constexpr std::size_t most_operands = 100'000;

std::optional<Vec3> point_of(Build& build, Array p) {
    const auto x = known(build, p[0]), y = known(build, p[1]), z = known(build, p[2]);
    if (!x || !y || !z) return std::nullopt;
    return Vec3{*x, *y, *z};
}

/// `p` moved to the surface f = 0 along the gradient, or an error message.
struct Projected {
    Vec3 point;
    std::string problem;
};
Projected project(Build& build, Expression f, Array x, const Vec3& p, double reach, int number) {
    Projected out{p, {}};
    for (int step = 0; step < most_steps; ++step) {
        const auto here = value_at(build, f, x, out.point);
        if (!here) {
            out.problem =
                fmt::format("f{} is no function of x alone, or it has no value at p{}", number, number);
            return out;
        }
        const double slope = length(here->gradient);
        if (std::abs(here->value) <= reached * slope * reach) return out;
        if (!(slope > 0)) break;
        out.point = out.point - here->gradient * (here->value / (slope * slope));
        if (!(length(out.point - p) <= 0.5 * reach)) break;
    }
    out.problem = fmt::format("the control point p{} does not lie near surface {}", number, number);
    return out;
}

/// One surface of a blend: of a fold of the blend's own set operation only the operand that has the surface
/// at the control point, and the others. A fold has to stay out of the blend: each of its operands bends the
/// values that the blend reads, however far away it is.
struct Local {
    Expression part;
    std::vector<Expression> others;
};

/// The operands of the fold of `op` that f is, parts of the same fold opened; f itself when it is none.
std::vector<Expression> operands(Expression f, Op op) {
    const Graph& graph = f.graph();
    std::vector<Expression> open{f}, out;
    while (!open.empty()) {
        const Expression e = open.back();
        open.pop_back();
        if (graph.node(e.id()).op != op) {
            out.push_back(e);
            continue;
        }
        const auto arguments = graph.arguments(e.id());
        for (std::size_t i = arguments.size(); i-- > 0;) open.emplace_back(f.graph(), arguments[i]);
        if (out.size() + open.size() > most_operands) return {f};
    }
    return out;
}

/// `on_surface`: the control point, on f = 0.
Local local_part(Build& build, Expression f, Array x, const Vec3& on_surface, bool unites) {
    const Op op = build.graph.node(f.id()).op;
    const bool folds = unites ? op == Op::r_or || op == Op::max : op == Op::r_and || op == Op::min;
    Local out{f, {}};
    if (!folds) return out;
    std::vector<Expression> all = operands(f, op);
    const auto values = values_at(build, all, x, on_surface);
    if (!values) return out;
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (std::abs((*values)[i].value) < std::abs((*values)[nearest].value)) nearest = i;
    out.part = all[nearest];
    std::erase(all, out.part);
    out.others = std::move(all);
    return out;
}

/// The system whose union or intersection `f` is a fold of; r0 where it is none.
SetSystem system_of(Expression f) {
    const Op op = f.graph().node(f.id()).op;
    SetSystem system;
    if (op == Op::max || op == Op::min) system.kind = SetSystem::Kind::min_max;
    return system;
}

}  // namespace

template <Op op>
Expression control_blend(Build& build, Array x, Expression f1, Expression f2, Expression a0, Array p1,
                         Array p2) {
    if (!sizes_are({{x, 3}, {p1, 3}, {p2, 3}}))
        return build.error("x and the control points must have 3 items each");
    const auto first = point_of(build, p1), second = point_of(build, p2);
    if (!first || !second) return build.error("a control point depends on the point of space");
    const double reach = length(*first - *second);
    if (!(reach > 0)) return build.error("the two control points are one");
    const Projected on_1 = project(build, f1, x, *first, reach, 1);
    if (!on_1.problem.empty()) return build.error(on_1.problem);
    const Projected on_2 = project(build, f2, x, *second, reach, 2);
    if (!on_2.problem.empty()) return build.error(on_2.problem);
    constexpr bool unites = op == Op::point_uni;
    const Local local_1 = local_part(build, f1, x, on_1.point, unites);
    const Local local_2 = local_part(build, f2, x, on_2.point, unites);
    const auto across_1 = value_at(build, local_1.part, x, on_2.point),
               across_2 = value_at(build, local_2.part, x, on_1.point);
    if (!across_1 || !across_2) return build.error("a function has no value at the other control point");
    const auto is_zero = [&](const LocalValue& v) {
        return std::abs(v.value) <= on_edge * length(v.gradient) * reach;
    };
    if (is_zero(*across_2)) return build.error("the control point p1 lies on the edge of the two surfaces");
    if (is_zero(*across_1)) return build.error("the control point p2 lies on the edge of the two surfaces");
    const Expression blend =
        apply(op, {local_1.part, local_2.part, a0, build.constant(std::abs(across_1->value)),
                   build.constant(std::abs(across_2->value))});
    const auto joined = [&](Expression whole, const Local& local, Expression with) {
        std::vector<Expression> all{with};
        all.insert(all.end(), local.others.begin(), local.others.end());
        return unites ? disjunction(system_of(whole), all) : conjunction(system_of(whole), all);
    };
    return joined(f2, local_2, joined(f1, local_1, blend));
}

namespace {

template <Op op>
Expression control_subtraction(Build& build, Array x, Expression f1, Expression f2, Expression a0, Array p1,
                               Array p2) {
    return control_blend<op>(build, x, f1, -f2, a0, p1, p2);
}

template <Op op>
Expression rounded(Build&, Expression f1, Expression f2, Expression r, double share) {
    const bool unites = op == Op::point_uni;
    return apply(op, {f1, f2, r * (unites ? share : -share), r, r});
}
template <Op op>
Expression fillet(Build& build, Expression f1, Expression f2, Expression r) {
    return rounded<op>(build, f1, f2, r, fillet_share);
}
template <Op op>
Expression chamfer(Build& build, Expression f1, Expression f2, Expression r) {
    return rounded<op>(build, f1, f2, r, chamfer_share);
}
Expression fillet_subtraction(Build& build, Expression f1, Expression f2, Expression r) {
    return fillet<Op::point_int>(build, f1, -f2, r);
}
Expression chamfer_subtraction(Build& build, Expression f1, Expression f2, Expression r) {
    return chamfer<Op::point_int>(build, f1, -f2, r);
}

Expression value_there(Build& build, Array x, Array p, Expression f) {
    if (x.size() != p.size()) return build.error("x and p must have equally many items");
    const auto value = at_point(build, f, x, p);
    return value ? *value : build.error("f depends on the point in another way than by the items of x");
}

}  // namespace

Rows control_point_rows() {
    constexpr std::string_view names = "x, f1, f2, a0, p1, p2", radius = "f1, f2, r";
    constexpr std::string_view cite = "pasko2005";
    constexpr std::string_view place_note =
        "Points beside their surface are moved onto it. Of a union (an intersection for Int and Sub) only "
        "the "
        "operand that has its surface at the point is blended. Every place where these two surfaces meet "
        "gets "
        "the blend; use hfBoundedBlendUni to choose one.";
    constexpr std::string_view round_note =
        "For functions with unit gradients (distances) and perpendicular faces; r may be a function.";
    return {
        row<&control_blend<Op::point_uni>>(
            "hfControlBlendUni", names,
            {"Blending union that begins at the point p1 of surface 1 and ends at the point p2 of surface 2.",
             "hfPointBlendUni(f1, f2, a0, |f1(p2)|, |f2(p1)|)", cite, place_note},
            false),
        row<&control_blend<Op::point_int>>(
            "hfControlBlendInt", names,
            {"Blending intersection between control points; a0 < 0 rounds the edge.",
             "hfPointBlendInt(f1, f2, a0, |f1(p2)|, |f2(p1)|)", cite, place_note},
            false),
        row<&control_subtraction<Op::point_int>>(
            "hfControlBlendSub", names,
            {"Blending subtraction of f2 from f1 between control points.",
             "hfControlBlendInt(x, f1, -f2, a0, p1, p2)", cite, place_note},
            false),
        row<&fillet<Op::point_uni>>("hfFilletUni", radius,
                                    {"Union with a nearly circular fillet of radius r.",
                                     "hfPointBlendUni(f1, f2, r/(2 sqrt(2)), r, r)", cite, round_note},
                                    false),
        row<&fillet<Op::point_int>>("hfFilletInt", radius,
                                    {"Intersection with an edge rounded by radius r.",
                                     "hfPointBlendInt(f1, f2, -r/(2 sqrt(2)), r, r)", cite, round_note},
                                    false),
        row<&fillet_subtraction>("hfFilletSub", radius,
                                 {"Subtraction of f2 from f1 with a rim rounded by radius r.",
                                  "hfFilletInt(f1, -f2, r)", cite, round_note},
                                 false),
        row<&chamfer<Op::point_uni>>(
            "hfChamferUni", radius,
            {"Union with a flat fillet: the section passes the middle of the chamfer.",
             "hfPointBlendUni(f1, f2, 6 (2 - sqrt(2)) r, r, r)", cite, round_note},
            false),
        row<&chamfer<Op::point_int>>("hfChamferInt", radius,
                                     {"Intersection with a flattened edge, legs r.",
                                      "hfPointBlendInt(f1, f2, -6 (2 - sqrt(2)) r, r, r)", cite, round_note},
                                     false),
        row<&chamfer_subtraction>("hfChamferSub", radius,
                                  {"Subtraction of f2 from f1 with a flattened rim, legs r.",
                                   "hfChamferInt(f1, -f2, r)", cite, round_note},
                                  false),
        row<&value_there>("hfAt", "x, p, f",
                          {"The value of f at the point p, f being a function of the items of x.",
                           "f(p)",
                           {},
                           "A number for the whole model where p is one."},
                          false),
    };
}

}  // namespace frep::shapes
