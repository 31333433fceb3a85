// Implementation of search.h: one pass finds what depends on the variables, one moves it into a region.
#include "frep/field/search.h"

#include <algorithm>
#include <unordered_map>

#include "frep/base/result.h"
#include "frep/field/region.h"

namespace frep {

namespace {

/// Coordinates from here on are variables of searches; their numbers are those of their nodes, so that each
/// is made once.
constexpr std::uint32_t first_variable = 1u << 24;

using Kind = RegionStatement::Kind;

/// Levels of statements inside one another, and searches among them.
struct Depth {
    int statements = 0, searches = 0;
};

Depth depth_of(const Region& region, std::span<const std::uint32_t> statements) {
    Depth most;
    for (const std::uint32_t number : statements) {
        const RegionStatement& s = region.statements[number];
        Depth d = depth_of(region, s.first);
        const Depth other = depth_of(region, s.second);
        d.statements = std::max(d.statements, other.statements);
        d.searches = std::max(d.searches, other.searches);
        if (s.kind == Kind::branch || s.kind == Kind::loop || s.kind == Kind::search) ++d.statements;
        if (s.kind == Kind::search) ++d.searches;
        most.statements = std::max(most.statements, d.statements);
        most.searches = std::max(most.searches, d.searches);
    }
    return most;
}

/// Moves the part of a graph that depends on some leaves into the body of a region.
class Mover {
  public:
    Mover(Graph& graph, std::span<const NodeId> variables) : graph_(graph), variables_(variables) {
        region_->origin = graph.current_origin();
        arguments_.push_back(graph.constant(1.0));  // the guard
    }

    void find_moving(NodeId f) {
        moves_.assign(f + 1, false);
        for (const NodeId id : variables_)
            if (id <= f) moves_[id] = true;
        for (NodeId id = 0; id <= f; ++id)
            for (const NodeId argument : graph_.arguments(id)) moves_[id] = moves_[id] || moves_[argument];
    }
    bool moves(NodeId id) const { return moves_[id]; }

    SearchError move(NodeId f, const SearchOptions& options) {
        std::vector<bool> needed(f + 1, false);
        needed[f] = true;
        for (NodeId id = f + 1; id-- > 0;) {
            if (!needed[id] || !moves_[id]) continue;
            for (const NodeId argument : graph_.arguments(id)) needed[argument] = true;
        }
        RegionStatement search;
        search.kind = Kind::search;
        search.origin = graph_.current_origin();
        search.tolerance = options.tolerance;
        search.in_ball = options.in_ball;
        first_ = &search.first;
        for (NodeId id = 0; id <= f; ++id) {
            if (!needed[id]) continue;
            moved_[id] = moves_[id] ? moved(id) : import(id);
        }
        for (const NodeId id : variables_) {
            const auto found = cells_of_variables_.find(id);
            search.variables.push_back(found == cells_of_variables_.end() ? new_cell() : found->second);
        }
        search.value = moved_.at(f);
        search.result = result_ = new_cell();
        region_->statements.push_back(std::move(search));
        region_->program = {static_cast<std::uint32_t>(region_->statements.size() - 1)};
        const Depth depth = depth_of(*region_, region_->program);
        if (depth.searches > most_nested_searches || depth.statements > Region::nesting_limit)
            return SearchError::nesting;
        return region_->body.over_limit() ? SearchError::too_large : SearchError::none;
    }

    NodeId finish() {
        const std::uint32_t result = result_;
        const NodeId node = graph_.make_region(region_, arguments_);
        return graph_.make(Op::output, {node}, result);
    }

  private:
    Graph& body() { return region_->body; }
    std::uint32_t new_cell() { return region_->cell_count++; }
    NodeId cell(std::uint32_t number) { return body().make(Op::cell, {}, number); }

    /// A value from outside: constants as they are, others through a cell.
    NodeId import(NodeId id) {
        body().set_origin(graph_.origin(id));
        if (graph_.node(id).op == Op::constant) return body().constant(graph_.constant_of(id));
        if (graph_.node(id).op == Op::region) return body().undefined();  // known by its outputs alone
        const std::uint32_t number = new_cell();
        region_->inputs.push_back(number);
        arguments_.push_back(id);
        return cell(number);
    }

    NodeId moved(NodeId id) {
        const Node& node = graph_.node(id);
        body().set_origin(graph_.origin(id));
        if (is_search_variable(node)) {
            const std::uint32_t number = cells_of_variables_[id] = new_cell();
            return cell(number);
        }
        std::vector<NodeId> arguments;
        for (const NodeId argument : graph_.arguments(id)) arguments.push_back(moved_.at(argument));
        if (node.op == Op::region) return move_region(id, arguments);
        if (node.op == Op::output) {
            const NodeId region = graph_.arguments(id)[0];
            return cell(first_cells_.at(region) + node.payload);
        }
        return body().make_as(graph_, id, arguments, block_names_);
    }

    /// The statements of an inner region, with cells, arrays and nodes of their own here. Its cells begin
    /// undefined each time.
    NodeId move_region(NodeId id, std::span<const NodeId> arguments) {
        const Region& inner = graph_.region_of(id);
        const std::uint32_t base = region_->cell_count;
        const auto arrays = static_cast<std::uint32_t>(region_->arrays.size());
        const auto statements = static_cast<std::uint32_t>(region_->statements.size());
        first_cells_[id] = base;
        region_->cell_count += inner.cell_count;
        for (const RegionArray& array : inner.arrays)
            region_->arrays.push_back({array.first_cell + base, array.size});
        const std::vector<NodeId> nodes = copy_body(inner, base, arrays);
        for (RegionStatement s : inner.statements) {
            for (auto& [target, value] : s.assignments) target += base, value = nodes[value];
            for (std::uint32_t& variable : s.variables) variable += base;
            for (auto* list : {&s.first, &s.second})
                for (std::uint32_t& number : *list) number += statements;
            for (NodeId* node : {&s.index, &s.value, &s.condition}) *node = nodes.empty() ? 0 : nodes[*node];
            s.array += arrays;
            s.result += base;
            region_->statements.push_back(std::move(s));
        }
        RegionStatement start;
        start.origin = inner.origin;
        const NodeId nothing = body().undefined();
        for (std::uint32_t k = 0; k < inner.cell_count; ++k)
            start.assignments.emplace_back(base + k, nothing);
        for (std::size_t k = 0; k < inner.inputs.size(); ++k)
            start.assignments[inner.inputs[k]].second = arguments[k + 1];
        first_->push_back(add(std::move(start)));
        std::vector<std::uint32_t> program;
        for (const std::uint32_t number : inner.program) program.push_back(number + statements);
        const auto guard = body().constant_value(arguments[0]);
        if (guard && *guard != 0) {
            first_->insert(first_->end(), program.begin(), program.end());
        } else {
            RegionStatement branch;
            branch.kind = Kind::branch;
            branch.condition = arguments[0];
            branch.first = std::move(program);
            branch.origin = inner.origin;
            first_->push_back(add(std::move(branch)));
        }
        return nothing;
    }

    std::uint32_t add(RegionStatement statement) {
        region_->statements.push_back(std::move(statement));
        return static_cast<std::uint32_t>(region_->statements.size() - 1);
    }

    /// The nodes of an inner region's body, here.
    std::vector<NodeId> copy_body(const Region& inner, std::uint32_t first_cell, std::uint32_t first_array) {
        std::vector<NodeId> nodes(inner.body.size());
        std::vector<std::uint32_t> block_names;
        std::vector<NodeId> arguments;
        for (NodeId id = 0; id < inner.body.size(); ++id) {
            const Node& node = inner.body.node(id);
            body().set_origin(inner.body.origin(id));
            arguments.clear();
            for (const NodeId argument : inner.body.arguments(id)) arguments.push_back(nodes[argument]);
            if (node.op == Op::cell)
                nodes[id] = cell(node.payload + first_cell);
            else if (node.op == Op::load)
                nodes[id] = body().make(Op::load, arguments, node.payload + first_array);
            else
                nodes[id] = body().make_as(inner.body, id, arguments, block_names);
        }
        return nodes;
    }

    Graph& graph_;
    std::span<const NodeId> variables_;
    std::shared_ptr<Region> region_ = std::make_shared<Region>();
    std::vector<NodeId> arguments_;  ///< of the region node
    std::vector<bool> moves_;        ///< by node: depends on a variable
    std::unordered_map<NodeId, NodeId> moved_;
    std::unordered_map<NodeId, std::uint32_t> cells_of_variables_, first_cells_;
    std::vector<std::uint32_t> block_names_;
    std::vector<std::uint32_t>* first_ = nullptr;
    std::uint32_t result_ = 0;
};

}  // namespace

NodeId make_search_variable(Graph& graph) {
    return graph.coordinate(static_cast<int>(first_variable + graph.size()));
}

bool is_search_variable(const Node& node) {
    return node.op == Op::coordinate && node.payload >= first_variable;
}

std::vector<NodeId> search_variables_of(const Graph& graph, NodeId f) {
    const std::vector<bool> needed = reachable(graph, {&f, 1});
    std::vector<NodeId> found;
    for (NodeId id = 0; id <= f; ++id)
        if (needed[id] && is_search_variable(graph.node(id))) found.push_back(id);
    return found;
}

std::optional<NodeId> make_largest(Graph& graph, NodeId f, std::span<const NodeId> variables,
                                   const SearchOptions& options, SearchError& error) {
    error = SearchError::none;
    std::vector<NodeId> sorted(variables.begin(), variables.end());
    std::ranges::sort(sorted);
    const bool each_once = std::ranges::adjacent_find(sorted) == sorted.end();
    const bool all = std::ranges::all_of(sorted, [&](NodeId v) { return is_search_variable(graph.node(v)); });
    if (sorted.empty() || sorted.size() > most_search_variables || !each_once || !all)
        error = SearchError::variables;
    if (!(options.tolerance >= least_tolerance && options.tolerance <= most_tolerance))
        error = SearchError::tolerance;
    for (NodeId id = 0; id < graph.size(); ++id)
        if (graph.node(id).op == Op::cell) error = SearchError::in_loop;
    if (error != SearchError::none) return std::nullopt;
    Mover mover(graph, variables);
    mover.find_moving(f);
    if (!mover.moves(f)) return f;
    error = mover.move(f, options);
    if (error != SearchError::none) return std::nullopt;
    return mover.finish();
}

}  // namespace frep
