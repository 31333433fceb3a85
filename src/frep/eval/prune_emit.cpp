// Implementation of prune_emit.h. What has become an operation on constants, or one that gives back its
// operand bit for bit, goes too.
#include "frep/eval/prune_emit.h"

#include <numeric>
#include <optional>

#include "frep/field/meaning.h"
#include "frep/math/bits.h"

namespace frep {
namespace {

/// Operands of a choice: the row of the operand that `first`, `second` of a record stand for.
constexpr std::uint32_t first_choice(Op op) { return op == Op::select ? 1 : 0; }

Op base_of(Op op) {
    switch (op) {
        case Op::bounded_uni:
        case Op::point_uni:
            return Op::r_or;
        case Op::bounded_int:
        case Op::point_int:
            return Op::r_and;
        case Op::abs:
            return Op::neg;
        default:
            return op;
    }
}

class Emission {
  public:
    Emission(const ClauseTape& tape, unsigned group, bool set_operations, CutEmitter& emitter,
             ClauseTape& out)
        : tape_(tape),
          constants_(static_cast<RowNumber>(tape.data->constants.size())),
          group_(group),
          set_operations_(set_operations),
          operands_(emitter.operands),
          out_(out),
          first_(tape.data->first_value_row()) {
        if (emitter.row_of.size() < tape.rows) emitter.row_of.resize(tape.rows);
        if (emitter.clauses.size() < tape.clauses.size()) emitter.clauses.resize(tape.clauses.size());
        if (emitter.own_rows != first_) {
            std::iota(emitter.row_of.begin(), emitter.row_of.begin() + first_, RowNumber{0});
            emitter.own_rows = first_;
        }
        row_of_ = emitter.row_of.data();
        clauses_ = next_ = emitter.clauses.data();
        out.operands.clear();
    }

    void add(const tile::Record& record) {
        const Clause& clause = tape_.clauses[record.clause];
        const unsigned first = record.first & group_, second = record.second & group_;
        if (first == group_ || second == group_) {
            const std::uint32_t choice = first_choice(clause.op) + (first == group_ ? 0 : 1);
            row_of_[clause.out] = row_of_[tape_.operands_of(clause)[choice]];
            return;
        }
        const bool base = (record.base & group_) == group_;
        Op op = base ? base_of(clause.op) : clause.op;
        if (set_operations_ && (record.value & group_) == 0) {
            if (op == Op::r_and) op = Op::min;
            if (op == Op::r_or) op = Op::max;
        }
        if (clause.listed == 0) {
            row_of_[clause.out] = write(op, clause.count, clause.in[0], clause.in[1], clause.in[2]);
            return;
        }
        const std::span<const RowNumber> in = tape_.operands_of(clause);
        row_of_[clause.out] = op == clause.op ? write_listed(clause, in) : write(op, 2, in[0], in[1], 0);
    }

    void finish() {
        if (out_.data != tape_.data) out_.data = tape_.data;
        out_.clauses.assign(clauses_, next_);
        out_.root = row_of_[tape_.root];
        out_.rows = first_ + static_cast<RowNumber>(next_ - clauses_);
    }

  private:
    bool is(RowNumber row, double value) const {
        return row < constants_ && math::to_bits(tape_.data->constants[row]) == math::to_bits(value);
    }

    /// The row that has the clause's value already, bit for bit.
    std::optional<RowNumber> known(Op op, std::uint32_t count, RowNumber a, RowNumber b) {
        if (count == 2) {
            if (a == b && (op == Op::min || op == Op::max)) return a;
            if (op == Op::sub && is(b, 0.0)) return a;
            if (op == Op::add && is(b, -0.0)) return a;
            if (op == Op::add && is(a, -0.0)) return b;
            if (op == Op::mul && is(a, 1.0)) return b;
            if ((op == Op::mul || op == Op::div) && is(b, 1.0)) return a;
            if (b >= constants_) return std::nullopt;
        }
        if (count > 2 || a >= constants_) return std::nullopt;
        operands_.assign(1, tape_.data->constants[a]);
        if (count == 2) operands_.push_back(tape_.data->constants[b]);
        const double value = meaning<double>(op, operands_, {});
        if (is(a, value)) return a;
        if (count == 2 && is(b, value)) return b;
        return std::nullopt;
    }

    /// True where an operand has become a constant (or the same as the other one).
    bool has_news(std::uint32_t count, RowNumber x, RowNumber y, RowNumber a, RowNumber b) const {
        return (a < constants_ && x >= constants_) ||
               (count > 1 && ((b < constants_ && y >= constants_) || a == b));
    }

    /// Writes the operation on rows of the parent; the row of its value.
    RowNumber write(Op op, std::uint32_t count, RowNumber x, RowNumber y, RowNumber z) {
        const RowNumber a = row_of_[x], b = row_of_[y];
        if (has_news(count, x, y, a, b))
            if (const auto row = known(op, count, a, b)) return *row;
        Clause& clause = *next_;
        const RowNumber out = first_ + static_cast<RowNumber>(next_ - clauses_);
        clause.op = op;
        clause.listed = 0;
        clause.spare = 0;
        clause.count = count;
        clause.out = out;
        clause.in = {a, count > 1 ? b : 0, count > 2 ? row_of_[z] : 0};
        ++next_;
        return out;
    }

    RowNumber write_listed(const Clause& from, std::span<const RowNumber> in) {
        Clause& clause = *next_;
        clause = from;
        clause.in[0] = static_cast<std::uint32_t>(out_.operands.size());
        clause.out = first_ + static_cast<RowNumber>(next_ - clauses_);
        for (const RowNumber row : in) out_.operands.push_back(row_of_[row]);
        ++next_;
        return clause.out;
    }

    const ClauseTape& tape_;
    const RowNumber constants_;
    const unsigned group_;
    const bool set_operations_;
    std::vector<double>& operands_;
    ClauseTape& out_;
    const RowNumber first_;
    RowNumber* row_of_ = nullptr;
    Clause* clauses_ = nullptr;
    Clause* next_ = nullptr;
};

}  // namespace

void emit_cut_tape(const ClauseTape& tape, std::span<const tile::Record> records, unsigned group,
                   bool set_operations, CutEmitter& emitter, ClauseTape& out) {
    Emission emission(tape, group, set_operations, emitter, out);
    for (std::size_t i = records.size(); i-- > 0;)
        if ((records[i].live & group) != 0) emission.add(records[i]);
    emission.finish();
}

}  // namespace frep
