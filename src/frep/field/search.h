// The largest value of a function over some of its variables, as a node: max over t in [0, 1]^n of f(X, t).
// Variables are leaves of the graph like coordinates, with numbers beyond those of any model; make_largest()
// moves what depends on them into a region with a search (region.h). Projections, sweeps, Minkowski sums and
// offsets are such functions (shapes/extremum.h, sweeps.h). Tested by
// tests/unit/eval/region_search_test.cpp.
#pragma once

#include <optional>
#include <span>

#include "frep/field/graph.h"

namespace frep {

/// Variables of one search.
inline constexpr std::size_t most_search_variables = 3;
/// Searches inside one another.
inline constexpr int most_nested_searches = 4;
/// The bounds of SearchOptions::tolerance.
inline constexpr double least_tolerance = 1e-9, most_tolerance = 0.5;

/// A new variable, which goes through [0, 1].
NodeId make_search_variable(Graph& graph);
bool is_search_variable(const Node& node);

struct SearchOptions {
    /// The value v at a point is not below the maximum by more than tolerance * max(1, |v|), and the rounding
    /// of f itself. From least_tolerance to most_tolerance.
    double tolerance = 1e-6;
    /// Only the ball |t - 1/2| <= 1/2 of the variables.
    bool in_ball = false;
};

/// Why there is no such node.
enum class SearchError {
    none,
    variables,  ///< not one to three different variables
    tolerance,  ///< out of its bounds
    in_loop,    ///< the graph is the body of a loop that depends on the point
    nesting,    ///< more than most_nested_searches, or statements nested beyond Region::nesting_limit
    too_large,  ///< more than Graph::node_limit nodes
};

/// The largest value of `f` over `variables`: `f` itself where it depends on none of them. Where f is
/// undefined it counts as smaller than any number. Searches and loops within f that depend on the variables
/// move into the new region. Nothing on an error, which `error` tells.
std::optional<NodeId> make_largest(Graph& graph, NodeId f, std::span<const NodeId> variables,
                                   const SearchOptions& options, SearchError& error);

/// The variables that `f` depends on, in the order of their numbers.
std::vector<NodeId> search_variables_of(const Graph& graph, NodeId f);

}  // namespace frep
