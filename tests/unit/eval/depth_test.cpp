// Graphs a million levels deep and a million nodes wide, from making them to destroying them.
#include <doctest/doctest.h>

#include "frep/eval/tape.h"
#include "unit/eval/engines.h"

using namespace frep;
using namespace frep_test;

namespace {

constexpr int levels = 999'000;

Field deep(bool left) {
    auto graph = std::make_shared<Graph>();
    const NodeId x = graph->coordinate(0), y = graph->coordinate(1);
    NodeId f = x;
    for (int i = 0; i < levels; ++i) {
        const Op op = i % 2 ? Op::min : Op::sub;
        f = left ? graph->make(op, {f, y}) : graph->make(op, {y, f});
    }
    Field field;
    field.coordinates = 2;
    field.value = f;
    field.graph = std::move(graph);
    REQUIRE_FALSE(field.graph->over_limit());
    REQUIRE(field.graph->size() > 900'000);
    return field;
}

/// 2^18 sums x - c, all used by one level, then a tree: half a million values and their constants.
Field wide() {
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> level;
    for (int i = 0; i < 1 << 18; ++i)
        level.push_back(graph->make(Op::sub, {graph->coordinate(0), graph->constant(0.001 * i)}));
    while (level.size() > 1) {
        std::vector<NodeId> next;
        for (std::size_t i = 0; i < level.size(); i += 2)
            next.push_back(graph->make(Op::max, {level[i], level[i + 1]}));
        level = next;
    }
    Field field;
    field.coordinates = 1;
    field.value = level[0];
    field.graph = std::move(graph);
    REQUIRE_FALSE(field.graph->over_limit());
    return field;
}

/// Every value is used twice, the second time in opposite order: all of them live at the same time.
Field long_lived() {
    auto graph = std::make_shared<Graph>();
    constexpr int count = 240'000;
    std::vector<NodeId> terms{graph->coordinate(0)};
    for (int i = 0; i < count; ++i) terms.push_back(graph->make(Op::sin, {terms.back()}));
    NodeId f = terms.back();
    for (std::size_t i = terms.size() - 1; i-- > 0;) f = graph->make(Op::sub, {f, terms[i]});
    Field field;
    field.coordinates = 1;
    field.value = f;
    field.graph = std::move(graph);
    REQUIRE_FALSE(field.graph->over_limit());
    return field;
}

/// An n-ary sum over a quarter of a million nodes, none of which dies before it.
Field broad() {
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> items;
    for (int i = 0; i < 250'000; ++i)
        items.push_back(graph->make(Op::sub, {graph->coordinate(0), graph->constant(0.5 * i)}));
    Field field;
    field.coordinates = 1;
    const NodeId index = graph->make(Op::add, {graph->coordinate(0), graph->constant(3.0)});
    field.value = graph->make_block(Op::pick, {&index, 1}, items);
    field.graph = std::move(graph);
    REQUIRE_FALSE(field.graph->over_limit());
    return field;
}

void check_engines(const Field& field, std::size_t rows) {
    Columns<double> points(static_cast<std::size_t>(field.coordinates), rows);
    Columns<math::Interval> boxes(static_cast<std::size_t>(field.coordinates), 1);
    for (std::size_t i = 0; i < points.columns.size(); ++i) {
        for (std::size_t row = 0; row < rows; ++row)
            points.columns[i][row] = 0.5 * static_cast<double>(row) + static_cast<double>(i);
        boxes.columns[i][0] = {0.0, 1.0};
    }
    const auto reference = engine(field, Engine::reference);
    const Columns<double> expected = values_of(*reference, points, rows);
    const Columns<double> gradients = gradients_of(*reference, points, rows);
    const math::Interval enclosure = intervals_of(*reference, boxes, 1)[0];
    for (const int registers : {0, 3}) {
        const auto vm = engine(field, Engine::vm, registers);
        REQUIRE(vm);
        CHECK(differences(expected, values_of(*vm, points, rows)) == 0);
        CHECK(differences(gradients, gradients_of(*vm, points, rows)) == 0);
        CHECK(same(enclosure, intervals_of(*vm, boxes, 1)[0]));
    }
}

}  // namespace

TEST_CASE("a chain of a million operations") {
    check_engines(deep(false), 5);
    const Field field = deep(true);
    check_engines(field, 5);
    const auto tape = make_tape(field, field.roots());
    REQUIRE(tape);
    CHECK(tape.value().registers <= 2);
}

TEST_CASE("half a million leaves under one root") {
    const Field field = wide();
    check_engines(field, 3);
    const auto tape = make_tape(field, field.roots());
    REQUIRE(tape);
    CHECK(tape.value().registers <= 20);
}

TEST_CASE("hundreds of thousands of values that live at the same time") {
    check_engines(long_lived(), 2);
    check_engines(broad(), 2);
}

TEST_CASE("undefined values are traced through a chain of a million operations") {
    auto graph = std::make_shared<Graph>();
    const NodeId x = graph->coordinate(0);
    const NodeId root = graph->make(Op::sqrt, {x});
    NodeId f = root;
    for (int i = 0; i < levels; ++i) f = graph->make(i % 2 ? Op::min : Op::sub, {f, x});
    Field field;
    field.coordinates = 1;
    field.value = f;
    field.graph = graph;
    const double point = -1.0;
    const auto causes = find_undefined(field, field.value, {&point, 1});
    REQUIRE(causes.size() == 1);
    CHECK(causes[0].node == root);
}
