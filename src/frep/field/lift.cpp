// Implementation of lift.h: one loop finds the patterns in the old graph, one marks what is needed then, one
// copies.
#include "frep/field/lift.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace frep {
namespace {

/// A node with a sign.
struct Term {
    NodeId id = 0;
    bool minus = false;
};

/// What stands for a node: `op` on two signed operands, or twice that.
struct Replacement {
    NodeId node = 0;
    Op op = Op::constant;
    bool twice = false;
    std::array<Term, 2> operands;
};

class PatternFinder {
  public:
    explicit PatternFinder(const Graph& graph) : graph_(graph) {}

    /// What may stand for `id`; halves of what was found before are recognised through `twice`.
    std::optional<Replacement> find(NodeId id, const std::vector<Replacement>& found,
                                    const std::vector<std::uint32_t>& number) const {
        const Op op = graph_.node(id).op;
        if (op == Op::add || op == Op::sub) return find_sum(id);
        const NodeId whole = half_of(id);
        if (whole == id || number[whole] == 0 || !found[number[whole] - 1].twice) return std::nullopt;
        Replacement half = found[number[whole] - 1];
        half.twice = false;
        return half;
    }

  private:
    Op op_of(NodeId id) const { return graph_.node(id).op; }
    bool is_constant(NodeId id, double value) const {
        return op_of(id) == Op::constant && graph_.constant_of(id) == value;
    }

    /// `term` without the negations that it begins with.
    Term strip(Term term) const {
        while (op_of(term.id) == Op::neg) term = {graph_.arguments(term.id)[0], !term.minus};
        return term;
    }

    /// The two terms of a sum or a difference, stripped; false for other nodes.
    bool split(Term sum, std::array<Term, 2>& out) const {
        const Op op = op_of(sum.id);
        if (op != Op::add && op != Op::sub) return false;
        const auto arguments = graph_.arguments(sum.id);
        out[0] = strip({arguments[0], sum.minus});
        out[1] = strip({arguments[1], sum.minus != (op == Op::sub)});
        return true;
    }

    /// x of x / 2 and x * 0.5, else `id` itself.
    NodeId half_of(NodeId id) const {
        const Op op = op_of(id);
        if (op != Op::mul && op != Op::div) return id;
        const auto arguments = graph_.arguments(id);
        if (op == Op::div) return is_constant(arguments[1], 2.0) ? arguments[0] : id;
        if (is_constant(arguments[0], 0.5)) return arguments[1];
        return is_constant(arguments[1], 0.5) ? arguments[0] : id;
    }

    /// p of p^2, without its sign; nothing for other nodes.
    std::optional<NodeId> root_of_square(NodeId id) const {
        const auto arguments = graph_.arguments(id);
        const bool is_square =
            op_of(id) == Op::square || (op_of(id) == Op::pow && is_constant(arguments[1], 2.0));
        if (!is_square) return std::nullopt;
        return strip({arguments[0], false}).id;
    }

    /// p and q of the root of p^2 + q^2, without their signs.
    bool split_root(NodeId id, std::array<NodeId, 2>& out) const {
        const Op op = op_of(id);
        const auto arguments = graph_.arguments(id);
        if (op == Op::hypot) {
            out = {strip({arguments[0], false}).id, strip({arguments[1], false}).id};
            return true;
        }
        if (op != Op::sqrt && !(op == Op::pow && is_constant(arguments[1], 0.5))) return false;
        if (op_of(arguments[0]) != Op::add) return false;
        const auto squares = graph_.arguments(arguments[0]);
        const auto p = root_of_square(squares[0]), q = root_of_square(squares[1]);
        if (!p || !q) return false;
        out = {*p, *q};
        return true;
    }

    static bool same_pair(NodeId a, NodeId b, NodeId c, NodeId d) {
        return (a == c && b == d) || (a == d && b == c);
    }

    /// True when `id` is |u - v| for the signed terms u and v.
    bool is_distance(NodeId id, Term u, Term v) const {
        std::array<Term, 2> difference;
        if (op_of(id) != Op::abs || !split({graph_.arguments(id)[0], false}, difference)) return false;
        const bool opposite = (u.minus != v.minus) != (difference[0].minus != difference[1].minus);
        return opposite && same_pair(u.id, v.id, difference[0].id, difference[1].id);
    }

    std::optional<Replacement> find_sum(NodeId id) const {
        std::array<Term, 2> sides;
        split({id, false}, sides);
        for (std::size_t k = 0; k < 2; ++k) {
            std::array<Term, 2> inner;
            if (!split(sides[k], inner)) continue;
            if (auto found = match({inner[0], inner[1], sides[1 - k]}, id)) return found;
        }
        return find_sum_of_halves(id, sides);
    }

    /// (p + q)/2 -+ |p - q|/2.
    std::optional<Replacement> find_sum_of_halves(NodeId id, const std::array<Term, 2>& sides) const {
        const std::array<NodeId, 2> whole{half_of(sides[0].id), half_of(sides[1].id)};
        if (whole[0] == sides[0].id || whole[1] == sides[1].id) return std::nullopt;
        for (std::size_t k = 0; k < 2; ++k) {
            std::array<Term, 2> inner;
            if (!split(strip({whole[k], sides[k].minus}), inner)) continue;
            auto found = match({inner[0], inner[1], strip({whole[1 - k], sides[1 - k].minus})}, id);
            if (!found || !found->twice) continue;
            found->twice = false;
            return found;
        }
        return std::nullopt;
    }

    std::optional<Replacement> match(const std::array<Term, 3>& terms, NodeId id) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const Term last = terms[k], u = terms[k == 0 ? 1 : 0], v = terms[k == 2 ? 1 : 2];
            std::array<NodeId, 2> under;
            if (split_root(last.id, under) && same_pair(u.id, v.id, under[0], under[1]))
                return Replacement{id, last.minus ? Op::r_and : Op::r_or, false, {u, v}};
            if (is_distance(last.id, u, v))
                return Replacement{id, last.minus ? Op::min : Op::max, true, {u, v}};
        }
        return std::nullopt;
    }

    const Graph& graph_;
};

/// Copies what is needed of a graph, with replacements.
class Lifter {
  public:
    Lifter(const Field& field, const std::vector<Replacement>& found,
           const std::vector<std::uint32_t>& number)
        : field_(field), graph_(*field.graph), found_(found), number_(number), renamed_(graph_.size(), 0) {}

    Field run(LiftReport& counts) {
        mark();
        Graph out;
        out.set_parameters(graph_.parameters());
        std::vector<std::uint32_t> block_names;
        std::vector<NodeId> arguments;
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (!needed_[id]) continue;
            out.set_origin(graph_.origin(id));
            if (number_[id] != 0) {
                const Replacement& replacement = found_[number_[id] - 1];
                renamed_[id] = replace(out, replacement);
                ++(is_r_function(replacement.op) ? counts.r_functions : counts.min_max);
                continue;
            }
            arguments.clear();
            for (const NodeId argument : graph_.arguments(id)) arguments.push_back(renamed_[argument]);
            renamed_[id] = out.make_as(graph_, id, arguments, block_names);
        }
        Field lifted = field_;
        lifted.value = renamed_[field_.value];
        for (NodeId& attribute : lifted.attributes) attribute = renamed_[attribute];
        lifted.graph = std::make_shared<const Graph>(std::move(out));
        return lifted;
    }

  private:
    void mark() {
        needed_.assign(graph_.size(), 0);
        for (const NodeId root : field_.roots()) needed_[root] = 1;
        for (NodeId id = static_cast<NodeId>(graph_.size()); id-- > 0;) {
            if (!needed_[id]) continue;
            if (number_[id] != 0) {
                for (const Term& term : found_[number_[id] - 1].operands) needed_[term.id] = 1;
            } else {
                for (const NodeId argument : graph_.arguments(id)) needed_[argument] = 1;
            }
        }
    }

    static bool is_r_function(Op op) { return op == Op::r_and || op == Op::r_or; }

    NodeId replace(Graph& out, const Replacement& replacement) const {
        std::array<NodeId, 2> operands{};
        for (std::size_t k = 0; k < 2; ++k) {
            const Term term = replacement.operands[k];
            operands[k] = renamed_[term.id];
            if (term.minus) operands[k] = out.make(Op::neg, {operands[k]});
        }
        const NodeId once = out.make(replacement.op, operands);
        return replacement.twice ? out.make(Op::add, {once, once}) : once;
    }

    const Field& field_;
    const Graph& graph_;
    const std::vector<Replacement>& found_;
    const std::vector<std::uint32_t>& number_;  ///< by node: its replacement + 1, or 0
    std::vector<std::uint8_t> needed_;
    std::vector<NodeId> renamed_;
};

}  // namespace

Field lift_r_functions(const Field& field, LiftReport* report) {
    const Graph& graph = *field.graph;
    const PatternFinder finder(graph);
    std::vector<Replacement> found;
    std::vector<std::uint32_t> number(graph.size(), 0);
    for (NodeId id = 0; id < graph.size(); ++id) {
        const Op op = graph.node(id).op;
        if (op != Op::add && op != Op::sub && op != Op::mul && op != Op::div) continue;
        const auto replacement = finder.find(id, found, number);
        if (!replacement) continue;
        found.push_back(*replacement);
        number[id] = static_cast<std::uint32_t>(found.size());
    }
    LiftReport counts;
    Field lifted = found.empty() ? field : Lifter(field, found, number).run(counts);
    if (report) *report = counts;
    return lifted;
}

}  // namespace frep
