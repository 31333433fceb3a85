// The formulas; see spelled_out.h.
#include "frep/field/spelled_out.h"

#include <vector>

namespace frep {

namespace {

using Arguments = std::span<const Expression>;

Expression r_alpha_or(Expression a, Expression b, Expression alpha) {
    return (a + b + sqrt(square(a) + square(b) - 2.0 * alpha * a * b)) / (1.0 + alpha);
}
Expression r0m_or(Expression a, Expression b, Expression m) { return r_or(a, b) * pow(hypot(a, b), m); }
Expression rp_or(Expression a, Expression b, Expression p) {
    return a + b + pow(pow(abs(a), p) + pow(abs(b), p), 1.0 / p);
}

Expression is_zero(Expression a) { return logical_and(less_equal(a, 0.0), less_equal(0.0, a)); }

/// f/a, or `otherwise` for an extent of 0.
Expression ratio(Expression f, Expression a, double otherwise) {
    return select(is_zero(a), Expression::constant(f, otherwise), f / a);
}
/// (f1/a1)^2 + (f2/a2)^2; large for an extent of 0, which means no displacement.
Expression nearness(Expression f1, Expression f2, Expression a1, Expression a2) {
    return square(ratio(f1, a1, 1e100)) + square(ratio(f2, a2, 1e100));
}
/// (1-u)^3/(1+u) of t = 1 - u.
Expression bell(Expression t) { return t * square(t) / (2.0 - t); }

Expression blend_uni(Expression f1, Expression f2, Expression a0, Expression a1, Expression a2) {
    return r_or(f1, f2) + a0 / (1.0 + nearness(f1, f2, a1, a2));
}
Expression point_uni(Expression f1, Expression f2, Expression a0, Expression a1, Expression a2) {
    return r_or(f1, f2) + a0 * bell(max(1.0 - nearness(f1, f2, a1, a2), 0.0));
}
Expression bounded_uni(Expression f1, Expression f2, Expression f3, Expression a0, Expression a1,
                       Expression a2, Expression a3) {
    const Expression depth = square(ratio(max(f3, 0.0), a3, 0));
    const Expression whole = max(nearness(f1, f2, a1, a2) + depth, 1e-300);  // both 0: no displacement
    return r_or(f1, f2) + a0 * bell(depth / whole);
}

}  // namespace

std::optional<Expression> spelled_out(Graph& graph, NodeId node) {
    std::vector<Expression> a;
    for (const NodeId argument : graph.arguments(node)) a.emplace_back(graph, argument);
    // unions are written out; an intersection is the complement of the union of the complements
    switch (graph.node(node).op) {
        case Op::r_alpha_and:
            return -r_alpha_or(-a[0], -a[1], a[2]);
        case Op::r_alpha_or:
            return r_alpha_or(a[0], a[1], a[2]);
        case Op::r0m_and:
            return -r0m_or(-a[0], -a[1], a[2]);
        case Op::r0m_or:
            return r0m_or(a[0], a[1], a[2]);
        case Op::rp_and:
            return -rp_or(-a[0], -a[1], a[2]);
        case Op::rp_or:
            return rp_or(a[0], a[1], a[2]);
        case Op::blend_uni:
            return blend_uni(a[0], a[1], a[2], a[3], a[4]);
        case Op::blend_int:
            return -blend_uni(-a[0], -a[1], -a[2], a[3], a[4]);
        case Op::point_uni:
            return point_uni(a[0], a[1], a[2], a[3], a[4]);
        case Op::point_int:
            return -point_uni(-a[0], -a[1], -a[2], a[3], a[4]);
        case Op::bounded_uni:
            return bounded_uni(a[0], a[1], a[2], a[3], a[4], a[5], a[6]);
        case Op::bounded_int:
            return -bounded_uni(-a[0], -a[1], a[2], -a[3], a[4], a[5], a[6]);
        default:
            return std::nullopt;
    }
}

}  // namespace frep
