// Implementation of blend_fields.h.
#include "frep/measure/blend_fields.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

#include "frep/field/copy.h"

namespace frep::measuring {

namespace {

bool is_union(Op op) { return op == Op::blend_uni || op == Op::bounded_uni || op == Op::point_uni; }

/// The function at a node of `graph`, with the coordinates and parameters of `like`.
Field field_of(const Graph& graph, NodeId root, const Field& like) {
    Field out;
    out.coordinates = like.coordinates;
    out.parameters = like.parameters;
    out.graph = std::make_shared<const Graph>(compact(graph, {&root, 1}));
    out.value = root;
    return out;
}

/// Value numbering: rows of a tape that surely hold equal numbers get one name.
class RowNames {
  public:
    explicit RowNames(const ClauseTape& tape) : tape_(tape), names_(tape.rows) {
        for (RowNumber row = 0; row < tape.rows; ++row) names_[row] = row;
        for (std::size_t i = 0; i < tape.clauses.size(); ++i) add(i);
    }

    RowNumber operator[](RowNumber row) const { return names_[row]; }
    /// The clause that a name was first made for, or null for a constant or a coordinate.
    const Clause* clause_of(RowNumber name) const {
        const auto found = clause_of_.find(name);
        return found == clause_of_.end() ? nullptr : &tape_.clauses[found->second];
    }
    bool is_negative_of(RowNumber a, RowNumber b) const {
        const Clause* clause = clause_of(a);
        return clause && clause->op == Op::neg && names_[tape_.operands_of(*clause)[0]] == b;
    }

  private:
    void add(std::size_t index) {
        const Clause& clause = tape_.clauses[index];
        const std::span<const RowNumber> operands = tape_.operands_of(clause);
        if ((clause.op == Op::min || clause.op == Op::max) && names_[operands[0]] == names_[operands[1]]) {
            names_[clause.out] = names_[operands[0]];
            return;
        }
        std::uint64_t hash = static_cast<std::uint64_t>(clause.op) + 1;
        for (const RowNumber operand : operands) hash = (hash ^ names_[operand]) * 0x9e3779b97f4a7c15u;
        const auto [known, is_new] = by_hash_.emplace(hash, index);
        if (!is_new && same(clause, tape_.clauses[known->second])) {
            names_[clause.out] = names_[tape_.clauses[known->second].out];
        } else {
            clause_of_.emplace(clause.out, index);
        }
    }
    bool same(const Clause& a, const Clause& b) const {
        const auto left = tape_.operands_of(a), right = tape_.operands_of(b);
        return a.op == b.op && tape_.block_of(a).data() == tape_.block_of(b).data() &&
               std::equal(left.begin(), left.end(), right.begin(), right.end(),
                          [&](RowNumber p, RowNumber q) { return names_[p] == names_[q]; });
    }

    const ClauseTape& tape_;
    std::vector<RowNumber> names_;  ///< by row
    std::unordered_map<std::uint64_t, std::size_t> by_hash_;
    std::unordered_map<RowNumber, std::size_t> clause_of_;
};

}  // namespace

bool is_bounded_blend(Op op) { return op == Op::bounded_uni || op == Op::bounded_int; }
bool is_point_blend(Op op) { return op == Op::point_uni || op == Op::point_int; }
bool is_blend(Op op) {
    return is_bounded_blend(op) || is_point_blend(op) || op == Op::blend_uni || op == Op::blend_int;
}

BlendFields blend_fields(const Field& field, NodeId blend) {
    const Graph& from = *field.graph;
    const auto operand = [&](std::size_t k) { return from.arguments(blend)[k]; };
    BlendFields out;
    {
        Graph graph;
        const NodeId with = copy_of_root(graph, from, field.value);
        const NodeId plain = copy_of_root(
            graph, from, field.value, [&](NodeId id, std::span<const NodeId> a) -> std::optional<NodeId> {
                if (id != blend) return std::nullopt;
                return graph.make(is_union(from.node(id).op) ? Op::r_or : Op::r_and, {a[0], a[1]});
            });
        const NodeId above = graph.make(Op::max, {with, plain}), below = graph.make(Op::min, {with, plain});
        const NodeId change = graph.make(Op::min, {above, graph.make(Op::neg, {below})});
        out.change = field_of(graph, change, field);
    }
    Graph graph;
    const NodeId first = graph.make(Op::abs, {copy_of_root(graph, from, operand(0))});
    const NodeId second = graph.make(Op::abs, {copy_of_root(graph, from, operand(1))});
    const NodeId joint = graph.make(Op::neg, {graph.make(Op::max, {first, second})});
    out.joint = field_of(graph, joint, field);
    return out;
}

bool surely_no_change(const ClauseTape& tape) {
    const RowNames names(tape);
    const Clause* root = names.clause_of(names[tape.root]);
    if (!root || root->op != Op::min) return false;
    const RowNumber a = names[tape.operands_of(*root)[0]], b = names[tape.operands_of(*root)[1]];
    return names.is_negative_of(a, b) || names.is_negative_of(b, a);
}

}  // namespace frep::measuring
