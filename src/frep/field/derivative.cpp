// Forward differentiation; see derivative.h.
#include "frep/field/derivative.h"

#include <optional>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "frep/field/kernels/basic.h"
#include "frep/field/spelled_out.h"

namespace frep {

namespace {

/// A derivative, or nothing where it is 0 because the node does not depend on the variables.
using Slope = std::optional<Expression>;
using Slopes = std::vector<Slope>;

Slope times(const Expression& factor, const Slope& slope) {
    return slope ? Slope(factor * *slope) : std::nullopt;
}
Slope sum(const Slope& a, const Slope& b) {
    if (!a) return b;
    return b ? Slope(*a + *b) : a;
}
Slope negative(const Slope& a) { return a ? Slope(-*a) : std::nullopt; }

/// Derives nodes one after the other, arguments first; `known_` has the answers.
class Derivation {
  public:
    Derivation(Graph& graph, std::span<const Expression> variables, AtJumps at_jumps)
        : graph_(graph), count_(variables.size()), at_jumps_(at_jumps) {
        for (std::size_t k = 0; k < count_; ++k) {
            Slopes unit(count_);
            unit[k] = Expression(graph, graph.constant(1));
            known_.emplace(variables[k].id(), std::move(unit));
        }
    }

    /// The slopes of `root`. False: failed_op() has no rule.
    bool derive(NodeId root);
    const Slopes& slopes(NodeId id) const { return known_.at(id); }
    Op failed_op() const { return failed_op_; }

  private:
    bool finish(NodeId id);
    Slopes simple(NodeId id, bool& has_rule);
    Slopes one(const Expression& partial, const Slopes& a) const;
    Slopes two(const Expression& partial_a, const Slopes& a, const Expression& partial_b,
               const Slopes& b) const;
    Slopes chosen(const Expression& condition, const Slopes& a, const Slopes& b) const;
    Slopes jumping(const Slopes& base, const Slopes& cause, const Expression& gap) const;
    Expression number(double value) const { return {graph_, graph_.constant(value)}; }

    Graph& graph_;
    std::size_t count_;
    AtJumps at_jumps_;
    std::unordered_map<NodeId, Slopes> known_;
    std::unordered_map<NodeId, NodeId> formula_of_;  ///< operations that are derived through their formula
    Op failed_op_ = Op::constant;
};

bool moves(const Slopes& slopes) {
    for (const Slope& slope : slopes)
        if (slope) return true;
    return false;
}

Slopes Derivation::one(const Expression& partial, const Slopes& a) const {
    Slopes out(count_);
    for (std::size_t k = 0; k < count_; ++k) out[k] = times(partial, a[k]);
    return out;
}

Slopes Derivation::two(const Expression& partial_a, const Slopes& a, const Expression& partial_b,
                       const Slopes& b) const {
    Slopes out(count_);
    for (std::size_t k = 0; k < count_; ++k) out[k] = sum(times(partial_a, a[k]), times(partial_b, b[k]));
    return out;
}

/// Slopes of the side that the condition picks.
Slopes Derivation::chosen(const Expression& condition, const Slopes& a, const Slopes& b) const {
    Slopes out(count_);
    for (std::size_t k = 0; k < count_; ++k)
        if (a[k] || b[k]) out[k] = select(condition, a[k].value_or(number(0)), b[k].value_or(number(0)));
    return out;
}

/// `base`, undefined where `gap`, which moves with `cause`, is 0: there the function jumps.
Slopes Derivation::jumping(const Slopes& base, const Slopes& cause, const Expression& gap) const {
    if (at_jumps_ == AtJumps::ignored || !moves(cause)) return base;
    Slopes out(count_);
    for (std::size_t k = 0; k < count_; ++k)
        out[k] = cause[k] || base[k] ? sum(base[k], number(0) / gap) : std::nullopt;
    return out;
}

/// The rules of the operations that are not spelled out by others.
Slopes Derivation::simple(NodeId id, bool& has_rule) {
    const Op op = graph_.node(id).op;
    const Expression f(graph_, id);
    std::vector<Expression> arguments;
    for (const NodeId argument : graph_.arguments(id)) arguments.emplace_back(graph_, argument);
    const Slopes none(count_);
    const Expression a = arguments.empty() ? f : arguments[0];
    const Expression b = arguments.size() < 2 ? a : arguments[1];
    const Slopes da = arguments.empty() ? none : slopes(a.id());
    const Slopes db = arguments.size() < 2 ? none : slopes(b.id());
    const Expression unit = number(1), half = number(0.5);
    switch (op) {
        case Op::add:
            return two(unit, da, unit, db);
        case Op::sub:
            return two(unit, da, number(-1), db);
        case Op::mul:
            return two(b, da, a, db);
        case Op::div: {
            Slopes out(count_);
            for (std::size_t k = 0; k < count_; ++k)
                if (const Slope top = sum(da[k], negative(times(f, db[k])))) out[k] = *top / b;
            return out;
        }
        case Op::neg:
            return one(number(-1), da);
        case Op::square:
            return one(2.0 * a, da);
        case Op::sqrt:
            return one(select(less(0.0, f), 0.5 / f, number(0)), da);
        case Op::abs:
            return one(sign(a), da);
        case Op::min:
            return chosen(less(a, b), da, db);
        case Op::max:
            return chosen(less(b, a), da, db);
        case Op::hypot: {
            const Expression angle = atan2(b, a);
            return two(cos(angle), da, sin(angle), db);
        }
        case Op::r_and:
        case Op::r_or: {
            // 1 -+ a/sqrt(a^2 + b^2): an angle is bounded over boxes that hold the edge, a quotient is not
            const Expression angle = atan2(b, a);
            if (op == Op::r_and) return two(1.0 - cos(angle), da, 1.0 - sin(angle), db);
            return two(1.0 + cos(angle), da, 1.0 + sin(angle), db);
        }
        case Op::exp:
            return one(f, da);
        case Op::log:
            return one(1.0 / a, da);
        case Op::log10:
            return one(1.0 / (math::log(10.0) * a), da);
        case Op::sin:
            return one(cos(a), da);
        case Op::cos:
            return one(-sin(a), da);
        case Op::tan:
            return one(1.0 + square(f), da);
        case Op::asin:
            return one(1.0 / sqrt(1.0 - square(a)), da);
        case Op::acos:
            return one(-1.0 / sqrt(1.0 - square(a)), da);
        case Op::atan:
            return one(1.0 / (1.0 + square(a)), da);
        case Op::atan2: {
            const Expression radius = square(a) + square(b);
            Slopes both = da;
            for (std::size_t k = 0; k < count_; ++k)
                if (!both[k]) both[k] = db[k];
            return jumping(two(b / radius, da, -a / radius, db), both, math::pi - abs(f));
        }
        case Op::sinh:
            return one(cosh(a), da);
        case Op::cosh:
            return one(sinh(a), da);
        case Op::tanh:
            return one(1.0 - square(f), da);
        case Op::pow:
            if (moves(db)) return two(b * pow(a, b - 1.0), da, f * log(a), db);
            return one(graph_.constant_value(b.id()) == 2.0 ? 2.0 * a : b * pow(a, b - 1.0), da);
        case Op::sign:
            return jumping(none, da, a);
        case Op::floor:
        case Op::ceil:
        case Op::trunc:
            return jumping(none, da, a - f);
        case Op::round:
            return jumping(none, da, a + half - f);
        case Op::remainder: {
            const Expression quotient = a / b, whole = trunc(quotient);
            const Slopes smooth = two(unit, da, -whole, db);
            return jumping(smooth, smooth, quotient - whole);
        }
        case Op::truth:
        case Op::logical_not:
            return jumping(none, da, abs(a) - kernels::truth_tolerance);
        case Op::logical_and:
        case Op::logical_or:
            return two(number(0), jumping(none, da, abs(a) - kernels::truth_tolerance), number(0),
                       jumping(none, db, abs(b) - kernels::truth_tolerance));
        case Op::less:
        case Op::less_equal:
            return jumping(none, two(unit, da, unit, db), a - b);
        case Op::equal:
            return jumping(none, two(unit, da, unit, db), abs(a - b) - kernels::truth_tolerance);
        case Op::select: {
            // where the condition changes the two sides may differ; what its slopes say is "0, or undefined"
            const Slopes sides = chosen(a, db, slopes(arguments[2].id()));
            if (at_jumps_ == AtJumps::ignored) return sides;
            return two(unit, sides, unit, da);
        }
        default:
            has_rule = false;
            return none;
    }
}

/// Enters the slopes of a node whose arguments (or whose formula) have theirs.
bool Derivation::finish(NodeId id) {
    if (const auto formula = formula_of_.find(id); formula != formula_of_.end()) {
        known_.emplace(id, slopes(formula->second));
        return true;
    }
    bool depends = false;
    for (const NodeId argument : graph_.arguments(id)) depends = depends || moves(slopes(argument));
    bool has_rule = true;
    Slopes out = depends ? simple(id, has_rule) : Slopes(count_);
    if (!has_rule) {
        failed_op_ = graph_.node(id).op;
        return false;
    }
    known_.emplace(id, std::move(out));
    return true;
}

bool Derivation::derive(NodeId root) {
    std::vector<std::pair<NodeId, bool>> open{{root, false}};  // node, arguments done
    while (!open.empty()) {
        const auto [id, ready] = open.back();
        if (known_.contains(id)) {
            open.pop_back();
            continue;
        }
        if (ready) {
            open.pop_back();
            if (!finish(id)) return false;
            continue;
        }
        open.back().second = true;
        if (const auto formula = spelled_out(graph_, id)) {
            formula_of_.emplace(id, formula->id());
            open.emplace_back(formula->id(), false);
            continue;
        }
        for (const NodeId argument : graph_.arguments(id)) open.emplace_back(argument, false);
    }
    return true;
}

}  // namespace

Result<std::vector<Expression>> derivatives(Expression f, std::span<const Expression> variables,
                                            AtJumps at_jumps) {
    Graph& graph = f.graph();
    Derivation derivation(graph, variables, at_jumps);
    if (!derivation.derive(f.id()))
        return Error{ErrorKind::invalid_argument,
                     fmt::format("{} has no derivative formula", info(derivation.failed_op()).name)};
    std::vector<Expression> out;
    for (const Slope& slope : derivation.slopes(f.id()))
        out.push_back(slope.value_or(Expression(graph, graph.constant(0))));
    return out;
}

}  // namespace frep
