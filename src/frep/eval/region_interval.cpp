// Implementation of region_interval.h. Recursion is over the nesting of statements, which is at most
// Region::nesting_limit deep.
#include "frep/eval/region_interval.h"

#include <algorithm>
#include <utility>

#include "frep/eval/region_narrow.h"
#include "frep/eval/region_nodes.h"
#include "frep/field/kernels/basic.h"
#include "frep/field/meaning.h"

namespace frep {

namespace {

using math::Interval;

constexpr NodeId no_node = ~NodeId{0};

/// The items of an array that an index may mean, counted from 0: first .. last, none if first > last.
struct ItemRange {
    std::size_t first = 1, last = 0;
    bool leaves = true;  ///< some index may be undefined or out of range

    bool none() const { return first > last; }
};

ItemRange items_of(Interval index, const RegionArray& array) {
    ItemRange out;
    const Interval rounded = math::round_half_up(index);
    const double size = static_cast<double>(array.size);
    if (rounded.is_empty() || !(rounded.hi >= 1) || !(rounded.lo <= size)) return out;
    out.first = static_cast<std::size_t>(std::max(rounded.lo, 1.0)) - 1;
    out.last = static_cast<std::size_t>(std::min(rounded.hi, size)) - 1;
    out.leaves = rounded.maybe_undefined || rounded.lo < 1 || rounded.hi > size;
    return out;
}

bool is_whole(double v) { return math::abs(v) <= 0x1p53 && math::trunc(v) == v; }
bool is_whole(Interval a) { return is_whole(a.lo) && is_whole(a.hi); }

/// Sums and differences of whole numbers are exact: the counters of loops must not grow by a rounding step in
/// every turn, or else none would ever be decided. False: not such an operation.
bool add_whole(Op op, std::span<const Interval> operands, Interval& sum) {
    if (op != Op::add && op != Op::sub) return false;
    const Interval a = operands[0], b = op == Op::add ? operands[1] : -operands[1];
    if (a.is_empty() || b.is_empty() || !is_whole(a) || !is_whole(b)) return false;
    sum = Interval(a.lo + b.lo, a.hi + b.hi, a.maybe_undefined || b.maybe_undefined);
    return is_whole(sum);
}

}  // namespace

IntervalRegion::IntervalRegion(const Region& region, std::int64_t max_steps)
    : region_(region),
      max_steps_(max_steps),
      needed_(nodes_by_statement(region)),
      values_(region.body.size()) {}

void IntervalRegion::run(std::span<const Interval> arguments) {
    const Interval guard = arguments[0];
    const auto runs = kernels::is_true(Interval(guard.lo, guard.hi));
    state_.cells.assign(region_.cell_count, Interval::empty());
    if (guard.is_empty() || !runs.can_be_true) return;
    state_.fewest_steps = state_.most_steps = 0;
    state_.reached = true;
    may_fail_ = guard.maybe_undefined || runs.can_be_false;
    given_up_ = region_.cell_count > cell_limit;
    undecided_ = 0;
    work_ = 0;
    latest_ = nullptr;
    most_work_ = work_limit;
    at_a_point_ = false;
    searched_ = 0;
    for (std::size_t k = 0; k < region_.inputs.size(); ++k)
        state_.cells[region_.inputs[k]] = arguments[k + 1];
    if (!given_up_) execute(region_.program);
    for (Interval& cell : state_.cells) {
        if (given_up_) {
            cell = Interval::entire().flagged(true);
        } else {
            cell = state_.reached ? cell.flagged(may_fail_) : Interval::empty();
        }
    }
}

void IntervalRegion::work(std::size_t amount) {
    work_ += static_cast<std::int64_t>(amount);
    given_up_ = given_up_ || work_ > most_work_ || undecided_ > undecided_limit;
}

void IntervalRegion::execute(std::span<const std::uint32_t> statements) {
    for (const std::uint32_t number : statements) {
        if (!state_.reached || given_up_) return;
        const RegionStatement& statement = region_.statements[number];
        switch (statement.kind) {
            case RegionStatement::Kind::assign:
                evaluate(number);
                for (const auto& [cell, node] : statement.assignments) state_.cells[cell] = values_[node];
                latest_ = &statement;
                break;
            case RegionStatement::Kind::store:
                evaluate(number);
                store(statement);
                latest_ = nullptr;
                break;
            case RegionStatement::Kind::branch:
                branch(statement, number);
                break;
            case RegionStatement::Kind::loop:
                loop(statement, number);
                break;
            case RegionStatement::Kind::search:
                search(statement, number);
                latest_ = nullptr;
                break;
        }
    }
}

/// Runs the condition. Points where it is undefined fail. A condition that is the content of a cell, as loops
/// have it, is what the latest assignment computed for that cell: the values of its nodes are still there.
IntervalRegion::Sides IntervalRegion::decide(const RegionStatement& statement, std::uint32_t number) {
    const Node& node = region_.body.node(statement.condition);
    Interval condition;
    Sides sides;
    sides.node = statement.condition;
    if (node.op == Op::cell) {
        work(1);
        condition = state_.cells[node.payload];
        sides.node = no_node;
        if (latest_) sides.assigned = latest_->assignments;
        for (const auto& [cell, value] : sides.assigned)
            if (cell == node.payload) sides.node = value;
    } else {
        evaluate(number);
        condition = values_[statement.condition];
    }
    may_fail_ = may_fail_ || condition.maybe_undefined || condition.is_empty();
    if (condition.is_empty()) return sides;
    const auto mask = kernels::is_true(Interval(condition.lo, condition.hi));
    sides.first = mask.can_be_true;
    sides.second = mask.can_be_false;
    if (sides.first && sides.second) ++undecided_;
    return sides;
}

/// Keeps the points of the state that take the side `truth` of an undecided condition.
void IntervalRegion::keep(State& state, const Sides& sides, bool truth) const {
    if (sides.node == no_node) return;
    state.reached = narrow(region_.body, values_, sides.node, truth, sides.assigned, state.cells);
}

void IntervalRegion::branch(const RegionStatement& statement, std::uint32_t number) {
    const Sides sides = decide(statement, number);
    if (!sides.first || !sides.second) {
        state_.reached = sides.first || sides.second;
        execute(sides.first ? statement.first : statement.second);
        return;
    }
    work(2 * state_.cells.size());
    State other = state_;
    keep(other, sides, false);
    keep(state_, sides, true);
    latest_ = nullptr;
    execute(statement.first);
    std::swap(state_, other);
    latest_ = nullptr;
    execute(statement.second);
    join(state_, other);
    latest_ = nullptr;
}

void IntervalRegion::loop(const RegionStatement& statement, std::uint32_t number) {
    State left;
    left.reached = false;
    while (state_.reached && !given_up_) {
        const Sides sides = decide(statement, number);
        if (sides.second) {
            work(2 * state_.cells.size());
            State leaving = state_;
            if (sides.first) keep(leaving, sides, false);
            join(left, leaving);
        }
        if (!sides.first) break;
        if (sides.second) keep(state_, sides, true);
        if (!state_.reached) break;
        ++state_.fewest_steps;
        ++state_.most_steps;
        may_fail_ = may_fail_ || state_.most_steps > max_steps_;
        if (state_.fewest_steps > max_steps_) break;
        execute(statement.first);
    }
    latest_ = nullptr;
    state_ = std::move(left);
    if (state_.cells.empty()) state_.cells.resize(region_.cell_count);
}

void IntervalRegion::join(State& into, const State& other) {
    if (!other.reached) return;
    if (!into.reached) {
        into = other;
        return;
    }
    for (std::size_t i = 0; i < into.cells.size(); ++i)
        into.cells[i] = math::hull(into.cells[i], other.cells[i]);
    into.fewest_steps = std::min(into.fewest_steps, other.fewest_steps);
    into.most_steps = std::max(into.most_steps, other.most_steps);
}

/// The one item that is meant for all points is replaced; of several each may keep what it has.
void IntervalRegion::store(const RegionStatement& statement) {
    const RegionArray& array = region_.arrays[statement.array];
    const ItemRange items = items_of(values_[statement.index], array);
    const Interval value = values_[statement.value];
    Interval* const first = state_.cells.data() + array.first_cell;
    if (items.none()) {
        std::fill(first, first + array.size, Interval::empty());
    } else if (items.first == items.last && !items.leaves) {
        first[items.first] = value;
    } else {
        for (std::size_t i = items.first; i <= items.last; ++i) first[i] = math::hull(first[i], value);
        for (std::size_t i = 0; i < array.size; ++i) first[i] = first[i].flagged(items.leaves);
    }
    work(items.none() || items.leaves ? array.size : items.last - items.first + 1);
}

Interval IntervalRegion::load(const Node& node, Interval index) {
    const RegionArray& array = region_.arrays[node.payload];
    const ItemRange items = items_of(index, array);
    if (items.none()) return Interval::empty();
    const Interval* const first = state_.cells.data() + array.first_cell;
    Interval value = first[items.first];
    for (std::size_t i = items.first + 1; i <= items.last; ++i) value = math::hull(value, first[i]);
    work(items.last - items.first);
    return value.flagged(items.leaves);
}

void IntervalRegion::evaluate(std::uint32_t number) {
    const Graph& body = region_.body;
    work(needed_[number].size() + 1);
    for (const NodeId id : needed_[number]) {
        const Node& node = body.node(id);
        arguments_.clear();
        for (const NodeId argument : body.arguments(id)) arguments_.push_back(values_[argument]);
        switch (node.op) {
            case Op::constant:
                values_[id] = math::constant<Interval>(body.constant_of(id));
                break;
            case Op::cell:
                values_[id] = state_.cells[node.payload];
                break;
            case Op::load:
                values_[id] = load(node, arguments_[0]);
                break;
            case Op::undefined:
                values_[id] = Interval::empty();
                break;
            default:
                if (!add_whole(node.op, arguments_, values_[id]))
                    values_[id] = meaning<Interval>(node.op, arguments_, body.block_of(id));
        }
    }
}

}  // namespace frep
