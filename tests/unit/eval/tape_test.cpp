// Tapes: the same results with any number of registers, few registers for folds, instructions in proportion
// to the graph.
#include <doctest/doctest.h>

#include <algorithm>

#include "frep/eval/tape.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

/// Union of `count` spheres, all spheres made before the first union.
Field spheres(int count, bool right_to_left) {
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> terms;
    for (int i = 0; i < count; ++i) {
        std::vector<NodeId> squares;
        for (int k = 0; k < 3; ++k)
            squares.push_back(graph->make(
                Op::square, {graph->make(Op::sub, {graph->coordinate(k), graph->constant(0.1 * i + k)})}));
        const NodeId sum = graph->make(Op::add, {graph->make(Op::add, {squares[0], squares[1]}), squares[2]});
        terms.push_back(graph->make(Op::sub, {graph->constant(1.0), sum}));
    }
    if (right_to_left) std::reverse(terms.begin(), terms.end());
    NodeId all = terms[0];
    for (std::size_t i = 1; i < terms.size(); ++i) all = graph->make(Op::r_or, {all, terms[i]});
    Field field;
    field.value = all;
    field.graph = std::move(graph);
    return field;
}

Tape tape_of(const Field& field, int registers = 0) {
    TapeOptions options;
    options.registers = registers;
    auto tape = make_tape(field, field.roots(), options);
    REQUIRE(tape);
    return std::move(*tape);
}

/// A full binary tree: its leaves live long, so few registers are not enough.
Field tree(int depth) {
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> level;
    for (int i = 0; i < 1 << depth; ++i)
        level.push_back(graph->make(Op::sub, {graph->coordinate(i % 3), graph->constant(0.37 * i)}));
    bool add = false;
    for (; level.size() > 1; add = !add) {
        std::vector<NodeId> next;
        for (std::size_t i = 0; i < level.size(); i += 2)
            next.push_back(graph->make(add ? Op::sub : Op::min, {level[i], level[i + 1]}));
        level = next;
    }
    Field field;
    field.value = level[0];
    field.graph = std::move(graph);
    return field;
}

}  // namespace

TEST_CASE("any number of registers gives the same values") {
    Random random(1);
    Columns<double> points(3, 100);
    for (auto& column : points.columns)
        for (double& x : column) x = random.real(-3, 3);
    for (const Field& field : {spheres(40, false), tree(9), RandomField(5, {}).make()}) {
        const Columns<double> expected = values_of(*engine(field, Engine::reference), points, 100);
        for (const int registers : {0, 3, 4, 5, 8, 64, 100'000}) {
            const Tape tape = tape_of(field, registers);
            if (registers) CHECK(tape.registers <= static_cast<std::size_t>(registers));
            CHECK(differences(expected, values_of(*engine(field, Engine::vm, registers), points, 100)) == 0);
        }
    }
}

TEST_CASE("few registers spill, many do not") {
    const Field field = tree(9);
    CHECK(tape_of(field).slots == 0);
    CHECK(tape_of(field).registers <= 11);
    CHECK(tape_of(field, 3).slots > 0);
    CHECK(tape_of(field, 3).slots <= 10);
}

TEST_CASE("a fold needs few registers, whatever the order of its nodes") {
    CHECK(tape_of(spheres(100, false)).registers <= 4);
    CHECK(tape_of(spheres(100, true)).registers <= 4);
}

TEST_CASE("instructions grow with the graph") {
    for (const int registers : {0, 3}) {
        const std::size_t one = tape_of(spheres(1000, false), registers).instructions.size();
        const std::size_t two = tape_of(spheres(2000, false), registers).instructions.size();
        CHECK(two <= 2 * one + 10);
        CHECK(two >= 2 * one - 10);
    }
    // At three registers: at most one spill a value and one reload an operand.
    const Field field = tree(12);
    const Tape all = tape_of(field), three = tape_of(field, 3);
    CHECK(three.instructions.size() <= 4 * all.instructions.size());
}

TEST_CASE("constants, inputs and parameters are no instructions") {
    auto graph = std::make_shared<Graph>();
    Field field;
    field.parameters = {2.0};
    field.value = graph->make(Op::add, {graph->coordinate(1), graph->parameter(0)});
    field.attributes = {graph->coordinate(2), graph->constant(4.0), field.value, graph->parameter(0)};
    field.graph = graph;
    const Tape tape = tape_of(field);
    CHECK(tape.instructions.size() == 1);
    CHECK(tape.inputs == std::vector<std::uint32_t>{1, 2});
    Columns<double> points(3, 2);
    points.columns = {{0, 0}, {1, 2}, {5, 6}};
    for (const Engine which : {Engine::reference, Engine::vm}) {
        const Columns<double> got = values_of(*engine(field, which), points, 2);
        CHECK(got.columns == std::vector<std::vector<double>>{{3, 4}, {5, 6}, {4, 4}, {3, 4}, {2, 2}});
    }
}

TEST_CASE("a tape over its limit is refused") {
    TapeOptions options;
    options.instruction_limit = 100;
    const Field field = spheres(100, false);
    const auto tape = make_tape(field, field.roots(), options);
    REQUIRE_FALSE(tape);
    CHECK(tape.error().kind == ErrorKind::over_limit);
}

TEST_CASE("operands of long lists survive the spills around them") {
    // Seven-ary and longer operations over values that live in slots, with three registers.
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        RandomOptions options;
        options.operations = 120;
        options.attributes = 12;
        options.region_percent = 10;
        RandomField maker(seed + 9000, options);
        const Field field = maker.make();
        Random random(seed);
        Columns<double> points(3, 9);
        for (auto& column : points.columns)
            for (double& x : column) x = random.real(-2, 2);
        const Columns<double> expected = values_of(*engine(field, Engine::reference, 0, 50), points, 9);
        for (const int registers : {0, 3, 7})
            CHECK(differences(expected, values_of(*engine(field, Engine::vm, registers, 50), points, 9)) ==
                  0);
    }
}
