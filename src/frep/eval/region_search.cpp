// Searches in regions: the part of IntervalRegion that carries them out with box_search.h. Without statements
// before the value, the body is computed in slopes; with them it runs as the rest of a region does over
// boxes.
#include <algorithm>
#include <utility>

#include "frep/eval/region_interval.h"
#include "frep/field/meaning.h"

namespace frep {

using math::Interval;

namespace {

bool is_point(std::span<const Interval> box) {
    return std::ranges::all_of(box, [](const Interval& t) { return t.lo == t.hi; });
}

}  // namespace

/// The body of a search as a function of its variables.
class IntervalRegion::Searched final : public SearchedFunction {
  public:
    Searched(IntervalRegion& region, std::uint32_t number) : region_(region), number_(number) {}
    Slope slope(std::span<const Interval> box) override { return region_.slope(number_, box); }

  private:
    IntervalRegion& region_;
    std::uint32_t number_;
};

/// The nodes that the body of a search needs, apart by whether they depend on its variables.
const IntervalRegion::SearchedNodes& IntervalRegion::nodes_of_search(std::uint32_t number) {
    if (searched_nodes_.empty()) searched_nodes_.resize(region_.statements.size());
    SearchedNodes& nodes = searched_nodes_[number];
    if (!nodes.fixed.empty() || !nodes.moving.empty()) return nodes;
    const std::vector<std::uint32_t>& variables = region_.statements[number].variables;
    std::vector<bool> moves(needed_[number].empty() ? 0 : needed_[number].back() + 1, false);
    for (const NodeId id : needed_[number]) {
        const Node& node = region_.body.node(id);
        if (node.op == Op::cell) moves[id] = std::ranges::find(variables, node.payload) != variables.end();
        for (const NodeId argument : region_.body.arguments(id)) moves[id] = moves[id] || moves[argument];
        (moves[id] ? nodes.moving : nodes.fixed).push_back(id);
        if (const auto parts = rounded_minimum(region_.body, id); parts && moves[id])
            nodes.rounded.emplace_back(id, *parts);
    }
    return nodes;
}

/// Makes ready for search_at(): the cells that the body reads, in a memory of their own.
void IntervalRegion::start_search(std::uint32_t number) {
    work_ = 0;
    most_work_ = search_work_limit;
    undecided_ = 0;
    given_up_ = false;
    may_fail_ = false;
    latest_ = nullptr;
    at_a_point_ = true;
    state_.reached = true;
    state_.fewest_steps = state_.most_steps = 0;
    state_.cells.resize(region_.cell_count);
    if (read_by_ == number) return;
    read_by_ = number;
    cells_read_.clear();
    const RegionStatement& statement = region_.statements[number];
    if (statement.first.empty()) {
        for (const NodeId id : needed_[number])
            if (region_.body.node(id).op == Op::cell) cells_read_.push_back(region_.body.node(id).payload);
    } else {
        for (std::uint32_t cell = 0; cell < region_.cell_count; ++cell) cells_read_.push_back(cell);
    }
}

BoxSearchResult IntervalRegion::run_search(std::uint32_t number) {
    const RegionStatement& statement = region_.statements[number];
    BoxSearchOptions options;
    options.variables = statement.variables.size();
    options.tolerance = statement.tolerance;
    options.in_ball = statement.in_ball;
    options.limit = Region::search_limit - searched_;
    if (!at_a_point_) {
        options.limit = std::min(options.limit, coarse_search_limit);
        options.looseness = coarse_search_looseness;
    }
    slopes_.resize(region_.body.size());
    if (statement.first.empty())
        for (const NodeId id : nodes_of_search(number).fixed) slope_of_node(statement, id, {}, false);
    Searched function(*this, number);
    return search_box(function, options);
}

/// A search over a box of space. Every point of it finds a value that is no smaller than the tolerance
/// allows.
void IntervalRegion::search(const RegionStatement& statement, std::uint32_t number) {
    const BoxSearchResult found = run_search(number);
    for (const std::uint32_t cell : statement.variables) state_.cells[cell] = {0.0, 1.0};
    Interval& out = state_.cells[statement.result];
    const bool settled = at_a_point_ ? found.finished : found.settled;
    may_fail_ = may_fail_ || !settled;
    if (found.most == -math::infinity) {
        out = Interval::empty();
        return;
    }
    const double slack = 2 * statement.tolerance * std::max(1.0, math::abs(found.least));
    const bool defined = found.least > -math::infinity;
    out = Interval(defined ? math::next_down(found.least - slack) : -math::infinity, found.most, !defined);
}

/// The body over a box of the variables.
Slope IntervalRegion::slope(std::uint32_t number, std::span<const Interval> box) {
    const RegionStatement& statement = region_.statements[number];
    ++searched_;
    if (!statement.first.empty()) return Slope::of_value(value_after(statement, number, box));
    const SearchedNodes& nodes = searched_nodes_[number];
    if (!at_a_point_) work(nodes.moving.size() + 1);
    const bool curved = !is_point(box);
    for (const NodeId id : nodes.moving)
        if (nodes.rounded.empty() || !slope_of_rounded(nodes, id, box.size(), curved))
            slope_of_node(statement, id, box, curved);
    Slope out = slopes_[statement.value];
    if (!curved) out.curvature = Interval(0.0);
    return out;
}

/// The value after the statements of the body, which leave no other trace.
Interval IntervalRegion::value_after(const RegionStatement& statement, std::uint32_t number,
                                     std::span<const Interval> box) {
    const State before = state_;
    const bool was_at_a_point = std::exchange(at_a_point_, at_a_point_ && is_point(box));
    const bool failed = std::exchange(may_fail_, false);
    const int undecided = std::exchange(undecided_, 0);
    for (std::size_t i = 0; i < box.size(); ++i) state_.cells[statement.variables[i]] = box[i];
    latest_ = nullptr;
    execute(statement.first);
    Interval value = Interval::empty();
    if (state_.reached && !given_up_) {
        evaluate(number);
        value = values_[statement.value].flagged(may_fail_);
    }
    if (given_up_) value = Interval::entire().flagged(true);
    state_ = before;
    at_a_point_ = was_at_a_point;
    may_fail_ = failed;
    undecided_ = undecided;
    given_up_ = work_ > most_work_;
    return value;
}

/// False where the node is none of a rounded minimum.
bool IntervalRegion::slope_of_rounded(const SearchedNodes& nodes, NodeId id, std::size_t variables,
                                      bool curved) {
    for (const auto& [node, parts] : nodes.rounded) {
        if (node != id) continue;
        const auto found =
            rounded_minimum_slope(slopes_[parts.a], slopes_[parts.b], slopes_[parts.r], variables, curved);
        if (!found) return false;
        slopes_[id] = *found;
        return true;
    }
    return false;
}

/// Nodes that do not depend on the variables are asked for with no box.
void IntervalRegion::slope_of_node(const RegionStatement& statement, NodeId id, std::span<const Interval> box,
                                   bool curved) {
    const Graph& body = region_.body;
    const Node& node = body.node(id);
    Slope& out = slopes_[id];
    switch (node.op) {
        case Op::constant:
            out = Slope::constant(math::constant<Interval>(body.constant_of(id)));
            break;
        case Op::cell: {
            const auto variable = std::ranges::find(statement.variables, node.payload);
            const auto index = static_cast<std::size_t>(variable - statement.variables.begin());
            out = index < box.size() ? Slope::variable(box[index], index)
                                     : Slope::constant(state_.cells[node.payload]);
            break;
        }
        case Op::undefined:
            out = Slope::constant(Interval::empty());
            break;
        case Op::load: {
            const Slope& index = slopes_[body.arguments(id)[0]];
            const Interval value = load(node, index.value);
            out = index.fixed ? Slope::constant(value) : Slope::of_value(value);
            break;
        }
        default:
            slope_arguments_.clear();
            for (const NodeId argument : body.arguments(id)) slope_arguments_.push_back(&slopes_[argument]);
            out = slope_of(node.op, slope_arguments_, body.block_of(id), box.size(), curved);
    }
}

}  // namespace frep
