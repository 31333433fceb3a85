// find_undefined: where an undefined value begins.
#include <doctest/doctest.h>

#include <algorithm>

#include "frep/eval/evaluator.h"

using namespace frep;

namespace {

struct Fixture {
    std::shared_ptr<Graph> graph = std::make_shared<Graph>();
    NodeId x = graph->coordinate(0), y = graph->coordinate(1);

    std::vector<NodeId> causes(NodeId root, double at_x, double at_y) const {
        Field field;
        field.coordinates = 2;
        field.value = root;
        field.graph = graph;
        const double point[2] = {at_x, at_y};
        std::vector<NodeId> nodes;
        for (const UndefinedCause& cause : find_undefined(field, root, point)) nodes.push_back(cause.node);
        std::sort(nodes.begin(), nodes.end());
        return nodes;
    }
};

using Nodes = std::vector<NodeId>;

}  // namespace

TEST_CASE_FIXTURE(Fixture, "the cause is the first undefined operation") {
    const NodeId root = graph->make(Op::sqrt, {x}), log = graph->make(Op::log, {y});
    const NodeId sum = graph->make(Op::add, {graph->make(Op::sin, {root}), log});
    CHECK(causes(sum, 1, 1).empty());
    CHECK(causes(sum, -1, 1) == Nodes{root});
    CHECK(causes(sum, 1, -1) == Nodes{log});
    CHECK(causes(sum, -1, -1) == Nodes{root, log});
}

TEST_CASE_FIXTURE(Fixture, "a value that is not used is no cause") {
    const NodeId root = graph->make(Op::sqrt, {x}), log = graph->make(Op::log, {x});
    const NodeId chosen = graph->make(Op::select, {y, root, log});
    CHECK(causes(chosen, -1, 1) == Nodes{root});
    CHECK(causes(chosen, -1, 0) == Nodes{log});
    CHECK(causes(graph->make(Op::select, {root, x, y}), -1, 1) == Nodes{root});
}

TEST_CASE_FIXTURE(Fixture, "the causes of a table look-up") {
    const NodeId root = graph->make(Op::sqrt, {x}), log = graph->make(Op::log, {x});
    const NodeId items[2] = {root, log};
    const NodeId item = graph->make_block(Op::pick, {&y, 1}, items);
    CHECK(causes(item, -1, 1) == Nodes{root});
    CHECK(causes(item, -1, 2) == Nodes{log});
    CHECK(causes(item, -1, 3) == Nodes{item});
}

TEST_CASE_FIXTURE(Fixture, "a loop with too many steps, or with an undefined condition") {
    auto region = std::make_shared<Region>();
    region->cell_count = 1;
    region->inputs = {0};
    RegionStatement loop;
    loop.kind = RegionStatement::Kind::loop;
    loop.condition = region->body.make(Op::sqrt, {region->body.make(Op::cell, {}, 0)});
    region->statements = {loop};
    region->program = {0};
    const NodeId arguments[2] = {graph->constant(1.0), x};
    const NodeId id = graph->make_region(region, arguments);
    const NodeId out = graph->make(Op::output, {id}, 0);
    CHECK(causes(out, 1, 0) == Nodes{id});   // never ends
    CHECK(causes(out, -1, 0) == Nodes{id});  // condition undefined
    CHECK(causes(out, 0, 0).empty());
}

TEST_CASE_FIXTURE(Fixture, "an unassigned variable") {
    const NodeId nothing = graph->undefined();
    CHECK(causes(graph->make(Op::add, {x, nothing}), 1, 1) == Nodes{nothing});
}
