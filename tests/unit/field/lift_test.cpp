// Tests of field/lift.h: every spelling, near misses, sharing, signs against the field as it was written.
#include "frep/field/lift.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>

#include "frep/field/expression.h"
#include "frep/field/meaning.h"

using namespace frep;

namespace {

/// A model of two operands p and q that are no leaves, in a graph of its own.
struct Builder {
    std::shared_ptr<Graph> graph = std::make_shared<Graph>();
    Expression x{*graph, graph->coordinate(0)}, y{*graph, graph->coordinate(1)};
    Expression p = 1.0 - square(x), q = y - 0.25;

    Field field(Expression value) const {
        Field out;
        out.graph = graph;
        out.value = value.id();
        out.coordinates = 2;
        return out;
    }
};

/// The value of a field of plain operations at (x, y).
double value_at(const Field& field, double x, double y) {
    const Graph& graph = *field.graph;
    std::vector<double> values(graph.size()), operands;
    for (NodeId id = 0; id <= field.value; ++id) {
        const Node& node = graph.node(id);
        if (node.op == Op::constant) values[id] = graph.constant_of(id);
        if (node.op == Op::coordinate) values[id] = node.payload == 0 ? x : y;
        if (info(node.op).kind == OpKind::leaf) continue;
        operands.clear();
        for (const NodeId argument : graph.arguments(id)) operands.push_back(values[argument]);
        values[id] = meaning<double>(node.op, operands, {});
    }
    return values[field.value];
}

std::size_t count_of(const Field& field, Op op) {
    const std::vector<NodeId> roots = field.roots();
    const std::vector<bool> needed = reachable(*field.graph, roots);
    std::size_t count = 0;
    for (NodeId id = 0; id < field.graph->size(); ++id) count += needed[id] && field.graph->node(id).op == op;
    return count;
}

/// Lifts and compares values on a lattice; `op` must be all that is left of roots and absolute values.
void check_lifted(const Builder& b, Expression value, Op op) {
    const Field field = b.field(value);
    LiftReport report;
    const Field lifted = lift_r_functions(field, &report);
    CHECK(report.total() == 1);
    CHECK(report.r_functions == (op == Op::r_and || op == Op::r_or ? 1 : 0));
    CHECK(count_of(lifted, op) == 1);
    for (const Op gone : {Op::sqrt, Op::hypot, Op::pow, Op::abs}) CHECK(count_of(lifted, gone) == 0);
    for (double u = -1.9; u < 2; u += 0.3)
        for (double v = -1.7; v < 2; v += 0.3)
            CHECK(std::fabs(value_at(lifted, u, v) - value_at(field, u, v)) < 1e-13);
}

void check_kept(const Builder& b, Expression value) {
    const Field field = b.field(value);
    LiftReport report;
    const Field same = lift_r_functions(field, &report);
    CHECK(report.total() == 0);
    CHECK(same.graph == field.graph);
    CHECK(same.value == field.value);
}

}  // namespace

TEST_CASE_FIXTURE(Builder, "R-functions in every association, order and sign") {
    const Expression root = sqrt(square(p) + square(q));
    check_lifted(*this, p + q + root, Op::r_or);
    check_lifted(*this, p + (root + q), Op::r_or);
    check_lifted(*this, root + (p + q), Op::r_or);
    check_lifted(*this, (q + root) + p, Op::r_or);
    check_lifted(*this, p + q - root, Op::r_and);
    check_lifted(*this, p - (root - q), Op::r_and);
    check_lifted(*this, q - root + p, Op::r_and);
    check_lifted(*this, (p - root) - (-q), Op::r_and);
    check_lifted(*this, p - q - root, Op::r_and);
    check_lifted(*this, p - (q + root), Op::r_and);
    check_lifted(*this, root - p - q, Op::r_or);
    check_lifted(*this, root - (p + q), Op::r_or);
    check_lifted(*this, root - (q - p), Op::r_or);
    check_lifted(*this, -(p + q) - root, Op::r_and);
    check_lifted(*this, -(p + q - root), Op::r_and);
    const Expression minus_p = -p;
    check_lifted(*this, minus_p + q + sqrt(square(minus_p) + square(q)), Op::r_or);
    check_lifted(*this, q - p - sqrt(square(minus_p) + square(q)), Op::r_and);
}

TEST_CASE_FIXTURE(Builder, "squares and roots in every spelling") {
    check_lifted(*this, p + q + sqrt(p * p + q * q), Op::r_or);
    check_lifted(*this, p + q - sqrt(pow(p, 2.0) + square(q)), Op::r_and);
    check_lifted(*this, p + q - pow(pow(p, 2.0) + pow(q, 2.0), 0.5), Op::r_and);
    check_lifted(*this, p + q + hypot(q, p), Op::r_or);
    check_lifted(*this, p - q + hypot(-q, p), Op::r_or);
}

TEST_CASE_FIXTURE(Builder, "minimum and maximum by the absolute value") {
    check_lifted(*this, 0.5 * (p + q - abs(p - q)), Op::min);
    check_lifted(*this, (p + q - abs(q - p)) / 2.0, Op::min);
    check_lifted(*this, (p + (q + abs(p - q))) / 2.0, Op::max);
    check_lifted(*this, (abs(p - q) - (p + q)) * 0.5, Op::max);
    check_lifted(*this, 0.5 * (p + q) - 0.5 * abs(p - q), Op::min);
    check_lifted(*this, abs(q - p) / 2.0 + (q + p) / 2.0, Op::max);
    check_lifted(*this, (p - q + abs(p + q)) / 2.0, Op::max);
    check_lifted(*this, p + q + abs(p - q), Op::max);
}

TEST_CASE_FIXTURE(Builder, "near misses stay") {
    const Expression root = sqrt(square(p) + square(q));
    check_kept(*this, p + x + root);
    check_kept(*this, p + q + 2.0 * root);
    check_kept(*this, p + root);
    check_kept(*this, p + q + sqrt(square(p) - square(q)));
    check_kept(*this, p + q + sqrt(square(p) + q));
    check_kept(*this, p + q + sqrt(square(p) + square(q) + 1.0));
    check_kept(*this, p + q + sqrt(square(p) + square(x)));
    check_kept(*this, p + q + pow(square(p) + square(q), 0.25));
    check_kept(*this, p + q + sqrt(pow(p, 3.0) + square(q)));
    check_kept(*this, p * q + root);
    check_kept(*this, p + q + abs(p + q));
    check_kept(*this, p - q + abs(p - q));
    check_kept(*this, p + q - abs(p - x));
    check_kept(*this, (p + q) / 2.0 - abs(p - q) / 3.0);
}

TEST_CASE_FIXTURE(Builder, "folds are lifted through, and what others use stays") {
    Expression fold = p;
    for (int i = 0; i < 20; ++i) {
        const Expression next = q - 0.125 * i * x;
        fold = fold + next + sqrt(square(fold) + square(next));
    }
    LiftReport report;
    const Field lifted = lift_r_functions(field(fold), &report);
    CHECK(report.r_functions == 20);
    CHECK(count_of(lifted, Op::sqrt) == 0);
    CHECK(count_of(lifted, Op::r_or) == 20);

    const Expression root = sqrt(square(p) + square(q));
    const Field shared = lift_r_functions(field((p + q + root) * root), &report);
    CHECK(report.r_functions == 1);
    CHECK(count_of(shared, Op::sqrt) == 1);
}

TEST_CASE("a fold of 100000 levels") {
    Builder b;
    Expression fold = b.p;
    for (int i = 0; i < 100000; ++i) fold = fold + b.q + sqrt(square(fold) + square(b.q));
    LiftReport report;
    const Field lifted = lift_r_functions(b.field(fold), &report);
    CHECK(report.r_functions == 100000);
    CHECK(count_of(lifted, Op::r_or) == 100000);
}

TEST_CASE("attributes, parameters and blocks come along") {
    auto graph = std::make_shared<Graph>();
    graph->set_parameters({3.0});
    const Expression x(*graph, graph->coordinate(0)), a(*graph, graph->parameter(0));
    const std::array<NodeId, 3> items{graph->constant(5), graph->constant(6), graph->constant(7)};
    const Expression table(*graph, graph->make_block(Op::pick, std::array{x.id()}, items));
    Field field;
    field.value = (x + a - hypot(x, a)).id();
    field.attributes = {table.id(), (table + a).id()};
    field.coordinates = 1;
    field.parameters = {3.0};
    field.graph = graph;
    const Field lifted = lift_r_functions(field);
    const Graph& out = *lifted.graph;
    CHECK(out.node(lifted.value).op == Op::r_and);
    CHECK(out.depends_on_parameters(lifted.value));
    REQUIRE(lifted.attributes.size() == 2);
    const auto block = out.block_of(lifted.attributes[0]);
    CHECK(std::vector<double>(block.begin(), block.end()) == std::vector<double>{5, 6, 7});
    CHECK(out.arguments(lifted.attributes[1]).size() == 2);
    CHECK(lifted.parameters == field.parameters);
}
