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
          group_(group),
          set_operations_(set_operations),
          row_of_(emitter.row_of),
          operands_(emitter.operands),
          out_(out) {
        const RowNumber shared = tape.data->first_value_row();
        const std::size_t known = row_of_.size();
        if (known < tape.rows) row_of_.resize(tape.rows);
        // rows of constants and coordinates keep their numbers; only they are read before they are written
        std::iota(row_of_.begin(), row_of_.begin() + shared, RowNumber{0});
        if (out.data != tape.data) out.data = tape.data;
        out.clauses.clear();
        out.operands.clear();
        next_ = shared;
    }

    void add(const tile::Record& record) {
        const Clause& clause = tape_.clauses[record.clause];
        const std::span<const RowNumber> in = tape_.operands_of(clause);
        const std::uint32_t choice = first_choice(clause.op);
        if (holds(record.first)) {
            row_of_[clause.out] = row_of_[in[choice]];
        } else if (holds(record.second)) {
            row_of_[clause.out] = row_of_[in[choice + 1]];
        } else {
            const bool base = holds(record.base);
            Op op = base ? base_of(clause.op) : clause.op;
            if (set_operations_ && (record.value & group_) == 0) {
                if (op == Op::r_and) op = Op::min;
                if (op == Op::r_or) op = Op::max;
            }
            row_of_[clause.out] = write(clause, op, base && info(op).arity == 2 ? in.first(2) : in);
        }
    }

    void finish() {
        out_.root = row_of_[tape_.root];
        out_.rows = next_;
    }

  private:
    /// True if all boxes of the group are in the mask.
    bool holds(std::uint16_t mask) const { return (mask & group_) == group_; }

    bool is_constant(RowNumber row) const { return row < tape_.data->constants.size(); }
    bool is(RowNumber row, double value) const {
        return is_constant(row) && math::to_bits(tape_.data->constants[row]) == math::to_bits(value);
    }

    /// The row that has the clause's value already, bit for bit.
    std::optional<RowNumber> known(Op op, RowNumber a, RowNumber b, bool binary) {
        if (binary) {
            if (a == b && (op == Op::min || op == Op::max)) return a;
            if (op == Op::sub && is(b, 0.0)) return a;
            if (op == Op::add && is(b, -0.0)) return a;
            if (op == Op::add && is(a, -0.0)) return b;
            if (op == Op::mul && is(a, 1.0)) return b;
            if ((op == Op::mul || op == Op::div) && is(b, 1.0)) return a;
        }
        if (!is_constant(a) || (binary && !is_constant(b))) return std::nullopt;
        operands_ = {tape_.data->constants[a]};
        if (binary) operands_.push_back(tape_.data->constants[b]);
        const double value = meaning<double>(op, operands_, {});
        if (is(a, value)) return a;
        if (binary && is(b, value)) return b;
        return std::nullopt;
    }

    RowNumber write(const Clause& clause, Op op, std::span<const RowNumber> in) {
        const bool listed = clause.listed != 0 && in.size() == clause.count;
        if (!listed && in.size() <= 2) {
            const RowNumber a = row_of_[in[0]], b = row_of_[in[in.size() - 1]];
            if (const auto row = known(op, a, b, in.size() == 2)) return *row;
        }
        Clause copy = clause;
        copy.op = op;
        copy.count = static_cast<std::uint32_t>(in.size());
        copy.out = next_++;
        if (listed) {
            copy.in[0] = static_cast<std::uint32_t>(out_.operands.size());
            for (const RowNumber row : in) out_.operands.push_back(row_of_[row]);
        } else {
            copy.listed = 0;
            copy.in = {};
            for (std::size_t k = 0; k < in.size(); ++k) copy.in[k] = row_of_[in[k]];
        }
        out_.clauses.push_back(copy);
        return copy.out;
    }

    const ClauseTape& tape_;
    unsigned group_;
    bool set_operations_;
    std::vector<RowNumber>& row_of_;
    std::vector<double>& operands_;
    ClauseTape& out_;
    RowNumber next_ = 0;
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
