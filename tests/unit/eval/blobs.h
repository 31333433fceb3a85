// Sums of bells, written as arithmetic: many terms, of which most are small in any one place.
#pragma once

#include <memory>

#include "frep/field/expression.h"
#include "frep/field/field.h"
#include "unit/eval/random_graph.h"

namespace frep_test {

/// level - sum of exp(-40 |p - c|^2) over `count` centers in [-half, half]^3, the sum as a tree: nodes of one
/// graph. Every other one is scaled by a constant from .5 to 1.5.
inline frep::NodeId blobs_in(frep::Graph& graph, std::uint64_t seed, int count, double half, double level) {
    using namespace frep;
    Random random(seed);
    std::vector<NodeId> terms;
    for (int n = 0; n < count; ++n) {
        NodeId sum = graph.constant(0);
        for (int i = 0; i < 3; ++i) {
            const NodeId d =
                graph.make(Op::sub, {graph.coordinate(i), graph.constant(random.real(-half, half))});
            sum = graph.make(Op::add, {sum, graph.make(Op::square, {d})});
        }
        NodeId bell = graph.make(Op::exp, {graph.make(Op::mul, {sum, graph.constant(-40)})});
        if (n % 2 == 1) bell = graph.make(Op::mul, {bell, graph.constant(random.real(0.5, 1.5))});
        terms.push_back(bell);
    }
    while (terms.size() > 1) {
        std::vector<NodeId> sums;
        for (std::size_t i = 0; i + 1 < terms.size(); i += 2)
            sums.push_back(graph.make(Op::add, {terms[i], terms[i + 1]}));
        if (terms.size() % 2 == 1) sums.push_back(terms.back());
        terms = std::move(sums);
    }
    return graph.make(Op::sub, {graph.constant(level), terms[0]});
}

inline frep::Field blobs(std::uint64_t seed, int count, double half = 0.6, double level = 0.5) {
    frep::Field field;
    auto graph = std::make_shared<frep::Graph>();
    field.value = blobs_in(*graph, seed, count, half, level);
    field.graph = std::move(graph);
    field.coordinates = 3;
    return field;
}

}  // namespace frep_test
