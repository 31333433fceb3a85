// Expression: a node of a graph under construction, with the usual operators, for writing library functions
// and models in C++. Values are cheap handles; the graph must outlive them.
#pragma once

#include <initializer_list>
#include <span>

#include "frep/field/graph.h"

namespace frep {

class Expression {
  public:
    Expression() = default;
    Expression(Graph& graph, NodeId id) : graph_(&graph), id_(id) {}
    /// A constant of the same graph as `like`.
    static Expression constant(const Expression& like, double value) {
        return {*like.graph_, like.graph_->constant(value)};
    }

    Graph& graph() const { return *graph_; }
    NodeId id() const { return id_; }
    bool operator==(const Expression&) const = default;

  private:
    Graph* graph_ = nullptr;
    NodeId id_ = 0;
};

/// `op` on arguments of one graph.
inline Expression apply(Op op, std::initializer_list<Expression> arguments) {
    NodeId ids[8];
    std::size_t count = 0;
    for (const Expression& argument : arguments) ids[count++] = argument.id();
    Graph& graph = arguments.begin()->graph();
    return {graph, graph.make(op, std::span<const NodeId>(ids, count))};
}

inline Expression operator-(Expression a) { return apply(Op::neg, {a}); }

#define FREP_BINARY(name, op)                                                                      \
    inline Expression name(Expression a, Expression b) { return apply(Op::op, {a, b}); }           \
    inline Expression name(Expression a, double b) { return name(a, Expression::constant(a, b)); } \
    inline Expression name(double a, Expression b) { return name(Expression::constant(b, a), b); }
FREP_BINARY(operator+, add)
FREP_BINARY(operator-, sub)
FREP_BINARY(operator*, mul)
FREP_BINARY(operator/, div)
FREP_BINARY(min, min)
FREP_BINARY(max, max)
FREP_BINARY(hypot, hypot)
FREP_BINARY(pow, pow)
FREP_BINARY(atan2, atan2)
FREP_BINARY(remainder, remainder)
FREP_BINARY(less, less)
FREP_BINARY(less_equal, less_equal)
FREP_BINARY(equal, equal)
FREP_BINARY(logical_and, logical_and)
FREP_BINARY(logical_or, logical_or)
FREP_BINARY(r_and, r_and)
FREP_BINARY(r_or, r_or)
#undef FREP_BINARY

#define FREP_UNARY(name) \
    inline Expression name(Expression a) { return apply(Op::name, {a}); }
FREP_UNARY(square)
FREP_UNARY(sqrt)
FREP_UNARY(abs)
FREP_UNARY(sign)
FREP_UNARY(floor)
FREP_UNARY(ceil)
FREP_UNARY(trunc)
FREP_UNARY(round)
FREP_UNARY(exp)
FREP_UNARY(log)
FREP_UNARY(log10)
FREP_UNARY(sin)
FREP_UNARY(cos)
FREP_UNARY(tan)
FREP_UNARY(asin)
FREP_UNARY(acos)
FREP_UNARY(atan)
FREP_UNARY(sinh)
FREP_UNARY(cosh)
FREP_UNARY(tanh)
FREP_UNARY(truth)
FREP_UNARY(logical_not)
#undef FREP_UNARY

/// b where the condition is true (|condition| >= 1e-6), else c.
inline Expression select(Expression condition, Expression b, Expression c) {
    return apply(Op::select, {condition, b, c});
}

}  // namespace frep
