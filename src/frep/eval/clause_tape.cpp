// Implementation of clause_tape.h: one loop over the nodes in the order of order.h; rows by last use.
#include "frep/eval/clause_tape.h"

#include <algorithm>
#include <limits>

#include "frep/eval/order.h"

namespace frep {
namespace {

constexpr RowNumber no_row = std::numeric_limits<RowNumber>::max();
constexpr std::size_t direct_operands = 3;

/// Numbers constants and coordinates first, since their rows come before those of values.
class Translator {
  public:
    Translator(const Field& field, ClauseData& data) : field_(field), graph_(*field.graph), data_(data) {
        row_of_.resize(graph_.size(), no_row);
    }

    bool number_leaves(const std::vector<NodeId>& order) {
        for (const NodeId id : order) {
            const Node& node = graph_.node(id);
            switch (node.op) {
                case Op::region:
                case Op::output:
                case Op::cell:
                case Op::load:
                    return false;
                case Op::constant:
                    add_constant(id, graph_.constant_of(id));
                    break;
                case Op::parameter:
                    add_constant(id, field_.parameters[node.payload]);
                    break;
                case Op::undefined:
                    add_constant(id, std::numeric_limits<double>::quiet_NaN());
                    break;
                default:
                    break;
            }
        }
        return true;
    }

    void translate(const std::vector<NodeId>& order, ClauseTape& tape) {
        RowNumber next = data_.first_value_row();
        tape.clauses.reserve(order.size() - std::min(order.size(), data_.constants.size()) + 1);
        for (const NodeId id : order) {
            const Node& node = graph_.node(id);
            if (node.op == Op::coordinate) row_of_[id] = data_.coordinate_row(static_cast<int>(node.payload));
            if (row_of_[id] != no_row) continue;
            tape.clauses.push_back(clause_of(id, tape));
            tape.clauses.back().out = row_of_[id] = next++;
        }
        tape.rows = next;
    }

    RowNumber row_of(NodeId id) const { return row_of_[id]; }

  private:
    void add_constant(NodeId id, double value) {
        row_of_[id] = static_cast<RowNumber>(data_.constants.size());
        data_.constants.push_back(value);
    }

    Clause clause_of(NodeId id, ClauseTape& tape) {
        const Node& node = graph_.node(id);
        const auto arguments = graph_.arguments(id);
        Clause clause;
        clause.op = node.op;
        clause.count = static_cast<std::uint32_t>(arguments.size());
        const bool is_block = info(node.op).kind == OpKind::block;
        if (!is_block && arguments.size() <= direct_operands) {
            for (std::size_t k = 0; k < arguments.size(); ++k) clause.in[k] = row_of_[arguments[k]];
            return clause;
        }
        clause.listed = 1;
        clause.in[0] = static_cast<std::uint32_t>(tape.operands.size());
        for (const NodeId argument : arguments) tape.operands.push_back(row_of_[argument]);
        const auto block = is_block ? graph_.block_of(id) : std::span<const double>();
        if (!block.empty()) {
            data_.blocks.push_back(block);
            clause.in[1] = static_cast<std::uint32_t>(data_.blocks.size());
        }
        return clause;
    }

    const Field& field_;
    const Graph& graph_;
    ClauseData& data_;
    std::vector<RowNumber> row_of_;  ///< by node
};

}  // namespace

std::optional<ClauseTape> make_clause_tape(const Field& field) {
    auto data = std::make_shared<ClauseData>();
    data->graph = field.graph;
    data->coordinates = field.coordinates;
    Scheduler scheduler(*field.graph);
    const std::vector<NodeId>& order = scheduler.schedule({&field.value, 1});
    Translator translator(field, *data);
    if (!translator.number_leaves(order)) return std::nullopt;
    ClauseTape tape;
    translator.translate(order, tape);
    tape.root = translator.row_of(field.value);
    tape.data = std::move(data);
    return tape;
}

ClauseTape shifted(const ClauseTape& tape, double iso) {
    if (iso == 0) return tape;
    // The new constant comes after the others, so that all later rows move up by one.
    auto data = std::make_shared<ClauseData>(*tape.data);
    const auto iso_row = static_cast<RowNumber>(data->constants.size());
    data->constants.push_back(iso);
    const auto moved = [&](RowNumber row) { return row < iso_row ? row : row + 1; };
    ClauseTape out = tape;
    out.data = std::move(data);
    for (Clause& clause : out.clauses) {
        clause.out = moved(clause.out);
        if (!clause.listed)
            for (RowNumber& row : clause.in) row = moved(row);
    }
    for (RowNumber& row : out.operands) row = moved(row);
    Clause shift;
    shift.op = Op::sub;
    shift.count = 2;
    shift.out = tape.rows + 1;
    shift.in = {moved(tape.root), iso_row, 0};
    out.clauses.push_back(shift);
    out.root = shift.out;
    out.rows = tape.rows + 2;
    return out;
}

void pack_rows(ClauseTape& tape) {
    const RowNumber first = tape.data->first_value_row();
    const std::size_t count = tape.clauses.size();
    // By clause: the number of the last one that reads it, plus 1; found backwards, so that rows may repeat.
    std::vector<std::size_t> last_reader(count), pending(tape.rows - first, 0);
    if (tape.root >= first) pending[tape.root - first] = count + 1;
    for (std::size_t i = count; i-- > 0;) {
        const Clause& clause = tape.clauses[i];
        last_reader[i] = std::max(pending[clause.out - first], i + 1);
        pending[clause.out - first] = 0;
        for (const RowNumber row : tape.operands_of(clause))
            if (row >= first && pending[row - first] == 0) pending[row - first] = i + 1;
    }
    // Lists of the rows that become free after a clause.
    std::vector<RowNumber> list(count + 2, no_row), next_in_list;
    std::vector<RowNumber> renamed(tape.rows - first, no_row), free_rows;
    for (std::size_t i = 0; i < count; ++i) {
        Clause& clause = tape.clauses[i];
        RowNumber* in = clause.listed ? tape.operands.data() + clause.in[0] : clause.in.data();
        for (std::size_t k = 0; k < clause.count; ++k)
            if (in[k] >= first) in[k] = renamed[in[k] - first];
        RowNumber row = static_cast<RowNumber>(next_in_list.size());
        if (free_rows.empty()) {
            next_in_list.push_back(no_row);
        } else {
            row = free_rows.back();
            free_rows.pop_back();
        }
        renamed[clause.out - first] = first + row;
        clause.out = first + row;
        next_in_list[row] = list[last_reader[i]];
        list[last_reader[i]] = row;
        for (RowNumber freed = list[i + 1]; freed != no_row; freed = next_in_list[freed])
            free_rows.push_back(freed);
    }
    if (tape.root >= first) tape.root = renamed[tape.root - first];
    tape.rows = first + static_cast<RowNumber>(next_in_list.size());
}

double cost_of(const ClauseTape& tape, const Clause& clause) {
    const OpInfo& row = info(clause.op);
    const std::size_t items = row.kind == OpKind::block ? clause.count - static_cast<std::size_t>(row.arity) +
                                                              tape.block_of(clause).size()
                                                        : 1;
    return row.cost * static_cast<double>(items);
}

double cost_of(const ClauseTape& tape) {
    double cost = 0;
    for (const Clause& clause : tape.clauses) cost += cost_of(tape, clause);
    return cost;
}

}  // namespace frep
