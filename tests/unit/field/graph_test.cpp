// The graph arena: sharing, exact simplification, folding, bound values, compaction.
#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "frep/field/expression.h"
#include "frep/field/field.h"

using namespace frep;

namespace {

struct Fixture {
    Graph graph;
    Expression x{graph, graph.coordinate(0)};
    Expression y{graph, graph.coordinate(1)};
    Expression number(double value) { return {graph, graph.constant(value)}; }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "equal expressions are one node") {
    CHECK((x + y).id() == (y + x).id());
    CHECK((x - y).id() != (y - x).id());
    CHECK(sqrt(x * y).id() == sqrt(y * x).id());
    CHECK(number(0.0).id() != number(-0.0).id());
    CHECK(number(__builtin_nan("")).id() == number(-__builtin_nan("1")).id());
}

TEST_CASE_FIXTURE(Fixture, "simplifications keep every bit") {
    CHECK((x * x).id() == square(x).id());
    CHECK((-(-x)).id() == x.id());
    CHECK((x - 0.0).id() == x.id());
    CHECK((x + 0.0).id() != x.id());  // -0 + 0 is +0
    CHECK((x + -0.0).id() == x.id());
    CHECK((x * 1.0).id() == x.id());
    CHECK((x + -y).id() == (x - y).id());
    CHECK((x - -y).id() == (x + y).id());
    CHECK(max(x, x).id() == x.id());
    CHECK(truth(less(x, y)).id() == less(x, y).id());
    CHECK(select(number(1), x, y).id() == x.id());
    CHECK(select(number(1e-7), x, y).id() == y.id());
}

TEST_CASE_FIXTURE(Fixture, "constants fold, undefined constants keep their node") {
    const Expression four = number(1) + number(3);
    CHECK(graph.constant_value(four.id()) == 4.0);
    CHECK(graph.node(four.id()).op == Op::constant);
    const Expression root = sqrt(number(-1));
    CHECK(graph.node(root.id()).op == Op::sqrt);
    const auto value = graph.constant_value(root.id());
    REQUIRE(value);
    CHECK(*value != *value);
    CHECK_FALSE(graph.constant_value(x.id()));
}

TEST_CASE("parameters are bound but not constant") {
    Graph graph;
    graph.set_parameters({5.0});
    const Expression a(graph, graph.parameter(0));
    const Expression b = a * 2.0;
    CHECK_FALSE(graph.constant_value(b.id()));
    CHECK(graph.bound_value(b.id()) == 10.0);
    CHECK(graph.depends_on_parameters(b.id()));
    const Expression x(graph, graph.coordinate(0));
    CHECK_FALSE(graph.bound_value((x + a).id()));
}

TEST_CASE_FIXTURE(Fixture, "truncate forgets nodes and finds the old ones again") {
    const NodeId sum = (x + y).id();
    const std::size_t size = graph.size();
    const Expression more = sqrt(x + y) * 3.0;
    graph.truncate(size);
    CHECK(graph.size() == size);
    CHECK((x + y).id() == sum);
    CHECK((sqrt(x + y) * 3.0).id() == more.id());
}

TEST_CASE_FIXTURE(Fixture, "compact keeps what the roots need") {
    const Expression kept = square(x) + number(2);
    static_cast<void>(exp(y));
    std::array<NodeId, 1> roots{kept.id()};
    const Graph out = compact(graph, roots);
    CHECK(out.size() == 4);  // x, x^2, 2, sum
    CHECK(out.node(roots[0]).op == Op::add);
    CHECK(count_operations(out, roots).operations == 2);
}

TEST_CASE_FIXTURE(Fixture, "constant data of a sum become a block, shared when equal") {
    const std::array lead{x.id(), y.id(), x.id()};
    const std::array<NodeId, 4> data{number(1).id(), number(2).id(), number(3).id(), number(4).id()};
    const NodeId sum = graph.make_block(Op::conv_point, lead, data);
    CHECK(graph.block_of(sum).size() == 4);
    CHECK(graph.arguments(sum).size() == 3);
    CHECK(graph.make_block(Op::conv_point, lead, data) == sum);
    const std::array<NodeId, 4> moving{number(1).id(), y.id(), number(3).id(), number(4).id()};
    const NodeId other = graph.make_block(Op::conv_point, lead, moving);
    CHECK(graph.block_of(other).empty());
    CHECK(graph.arguments(other).size() == 7);
}

TEST_CASE("a graph stops at its node limit and says so") {
    Graph graph;
    const Expression x(graph, graph.coordinate(0));
    Expression sum = x;
    for (std::size_t i = 0; i < Graph::node_limit + 10 && !graph.over_limit(); ++i) sum = sin(sum);
    CHECK(graph.over_limit());
    CHECK(graph.size() <= Graph::node_limit);
}

TEST_CASE("bound parameters become constants and fold") {
    Graph graph;
    graph.set_parameters({3, 5});
    const NodeId power = graph.make(Op::pow, {graph.parameter(0), graph.constant(4)});
    const NodeId sum = graph.make(Op::add, {power, graph.coordinate(0)});
    const NodeId data[] = {graph.constant(0), graph.parameter(1), graph.constant(0), graph.constant(1),
                           graph.constant(1)};
    const NodeId lead[] = {graph.coordinate(0), graph.coordinate(1), graph.coordinate(2)};
    const NodeId blob = graph.make_block(Op::blobby, lead, data);
    Field field;
    field.value = graph.make(Op::mul, {sum, blob});
    field.attributes = {graph.parameter(1), graph.undefined()};
    field.parameters = {2, 7};  // rebound: other values than the graph was made for
    field.graph = std::make_shared<const Graph>(std::move(graph));

    const Field bound = bind_parameters(field);
    for (NodeId id = 0; id < bound.graph->size(); ++id) CHECK(bound.graph->node(id).op != Op::parameter);
    CHECK(bound.graph->constant_value(bound.attributes[0]) == 7);
    CHECK(bound.graph->node(bound.attributes[1]).op == Op::undefined);
    const auto factors = bound.graph->arguments(bound.value);
    REQUIRE(bound.graph->node(factors[0]).op == Op::add);
    const auto terms = bound.graph->arguments(factors[0]);
    const bool constant_first = bound.graph->node(terms[0]).op == Op::constant;
    CHECK(bound.graph->constant_value(terms[constant_first ? 0 : 1]) == 16);
    REQUIRE(bound.graph->block_of(factors[1]).size() == 5);
    CHECK(bound.graph->block_of(factors[1])[1] == 7);

    Field plain = field;
    plain.value = lead[0];
    plain.attributes.clear();
    CHECK(bind_parameters(plain).graph == plain.graph);
}
