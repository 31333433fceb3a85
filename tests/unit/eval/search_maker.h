// Fields with searches, for the tests of searches.
#pragma once

#include <vector>

#include "frep/field/expression.h"
#include "frep/field/field.h"
#include "frep/field/search.h"

namespace frep_test {

using namespace frep;

/// A model of two coordinates under construction.
struct SearchSketch {
    std::shared_ptr<Graph> graph = std::make_shared<Graph>();
    Expression x{*graph, graph->coordinate(0)}, y{*graph, graph->coordinate(1)};
    SearchError error = SearchError::none;

    Expression number(double value) { return {*graph, graph->constant(value)}; }
    Expression variable() { return {*graph, make_search_variable(*graph)}; }
    /// The largest value of f over variables; the undefined node on an error.
    Expression largest(Expression f, std::vector<Expression> over, SearchOptions options = {}) {
        std::vector<NodeId> ids;
        for (const Expression& v : over) ids.push_back(v.id());
        const auto made = make_largest(*graph, f.id(), ids, options, error);
        return {*graph, made ? *made : graph->undefined()};
    }
    Field field(Expression f) {
        Field out;
        out.coordinates = 2;
        out.value = f.id();
        out.graph = graph;
        return out;
    }
};

}  // namespace frep_test
