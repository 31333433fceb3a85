// Implementation of jet.h.
#include "frep/measure/jet.h"

#include <algorithm>

#include "frep/field/meaning.h"
#include "frep/field/spelled_out.h"
#include "frep/measure/jet_rules.h"

namespace frep::measuring {

namespace {

using math::Interval;

/// Operations of up to this many operands may have a formula.
constexpr std::size_t most_operands = 7;

Interval cut(const Interval& a, const Interval& b) {
    return {std::max(a.lo, b.lo), std::min(a.hi, b.hi), a.maybe_undefined};
}

}  // namespace

void JetMachine::load(const ClauseData& data) {
    constants_.clear();
    for (const double c : data.constants) {
        constants_.emplace_back();
        constants_.back().value = Interval(c);
    }
}

const Jet& JetMachine::row(RowNumber number) const {
    if (number >= first_value_) return rows_[number - first_value_];
    return number >= first_coordinate_ ? coordinates_[number - first_coordinate_] : constants_[number];
}

/// The tape of the operation's formula, or null.
const ClauseTape* JetMachine::formula_of(Op op, std::size_t operands) {
    const auto [known, is_new] = formulas_.try_emplace(op);
    if (is_new && operands <= most_operands && info(op).kind == OpKind::plain) {
        auto graph = std::make_shared<Graph>();
        std::vector<NodeId> coordinates;
        for (std::size_t i = 0; i < operands; ++i)
            coordinates.push_back(graph->coordinate(static_cast<int>(i)));
        const NodeId node = graph->make(op, coordinates);
        if (const auto formula = spelled_out(*graph, node)) {
            Field field;
            field.value = formula->id();
            field.coordinates = static_cast<int>(operands);
            field.graph = std::move(graph);
            if (auto tape = make_clause_tape(field))
                known->second = std::make_unique<ClauseTape>(std::move(*tape));
        }
    }
    return known->second.get();
}

Jet JetMachine::run_formula(const ClauseTape& formula, std::span<const Jet* const> operands) {
    if (!inner_) inner_ = std::make_unique<JetMachine>();
    for (std::size_t i = 0; i < operands.size(); ++i) inner_->coordinates_[i] = *operands[i];
    return inner_->run_loaded(formula, with_second_);
}

Jet JetMachine::run_point_blend(Op op, const ClauseTape& formula, std::span<const Jet* const> operands) {
    std::array<Jet, 2> near{*operands[0], *operands[1]};
    bool is_near = true, is_reached = true;
    for (std::size_t k = 0; k < 2; ++k) {
        const Jet& extent = *operands[3 + k];
        if (extent.moves != 0) continue;
        // a little more, for what engines round
        const double most = (math::abs(extent.value) * Interval(1 + 0x1p-40)).hi;
        is_near = is_near && near[k].value.lo >= -most && near[k].value.hi <= most;
        near[k].value = cut(near[k].value, {-most, most});
        is_reached = is_reached && !near[k].value.is_empty();
    }
    if (is_near) return run_formula(formula, operands);
    const Op plain = op == Op::point_uni ? Op::r_or : Op::r_and;
    const std::array<Interval, 2> values{operands[0]->value, operands[1]->value};
    const Interval value = meaning<Interval>(plain, std::span<const Interval>(values), {});
    Jet out = *jet_of(plain, value, operands.first(2), with_second_);
    if (!is_reached) return out;
    const std::array<const Jet*, 5> inner{&near[0], &near[1], operands[2], operands[3], operands[4]};
    const Jet blended = run_formula(formula, inner);
    const auto either = [](Interval& a, const Interval& b) {
        a = {std::min(a.lo, b.lo), std::max(a.hi, b.hi), a.maybe_undefined || b.maybe_undefined};
    };
    either(out.value, blended.value);
    out.moves |= blended.moves;
    for (std::size_t k = 0; k < out.first.size(); ++k) either(out.first[k], blended.first[k]);
    for (std::size_t k = 0; k < out.second.size(); ++k) either(out.second[k], blended.second[k]);
    return out;
}

Jet JetMachine::apply(const ClauseTape& tape, const Clause& clause) {
    const std::span<const RowNumber> numbers = tape.operands_of(clause);
    std::array<const Jet*, most_operands> few{};
    std::array<Interval, most_operands> few_values;
    std::vector<const Jet*> many(numbers.size() > few.size() ? numbers.size() : 0);
    std::vector<Interval> many_values(many.size());
    const std::span<const Jet*> jets = many.empty() ? std::span(few).first(numbers.size()) : std::span(many);
    const std::span<Interval> values =
        many.empty() ? std::span(few_values).first(numbers.size()) : std::span(many_values);
    std::uint8_t moves = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        jets[i] = &row(numbers[i]);
        values[i] = jets[i]->value;
        moves |= jets[i]->moves;
    }
    const Interval value =
        meaning<Interval>(clause.op, std::span<const Interval>(values), tape.block_of(clause));
    if (moves == 0) return {value, {}, {}, 0};
    if (const auto jet = jet_of(clause.op, value, jets, with_second_)) return *jet;
    if (const ClauseTape* formula = formula_of(clause.op, numbers.size())) {
        const bool by_points = clause.op == Op::point_uni || clause.op == Op::point_int;
        Jet jet = by_points ? run_point_blend(clause.op, *formula, jets) : run_formula(*formula, jets);
        if (jet.value.is_empty() || jet.value.maybe_undefined) return unknown_jet(value, moves);
        jet.value = cut(value, jet.value);
        return jet;
    }
    // a step that is not in the box
    if (value.lo == value.hi) return {value, {}, {}, 0};
    return unknown_jet(value, moves);
}

Jet JetMachine::run_loaded(const ClauseTape& tape, bool with_second) {
    if (data_ != tape.data) {
        data_ = tape.data;
        load(*data_);
    }
    with_second_ = with_second;
    first_coordinate_ = data_->coordinate_row(0);
    first_value_ = data_->first_value_row();
    if (tape.rows > first_value_ && rows_.size() < tape.rows - first_value_)
        rows_.resize(tape.rows - first_value_);
    for (const Clause& clause : tape.clauses) rows_[clause.out - first_value_] = apply(tape, clause);
    return row(tape.root);
}

Jet JetMachine::run(const ClauseTape& tape, std::span<const Interval> box,
                    std::span<const std::size_t> variables, bool with_second) {
    coordinates_.fill({});
    for (std::size_t i = 0; i < box.size(); ++i) coordinates_[i].value = box[i];
    for (std::size_t k = 0; k < variables.size(); ++k) {
        coordinates_[variables[k]].first[k] = Interval(1.0);
        coordinates_[variables[k]].moves = static_cast<std::uint8_t>(1u << k);
    }
    return run_loaded(tape, with_second);
}

}  // namespace frep::measuring
