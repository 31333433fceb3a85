// Clause tapes against the reference engine: a plain interpreter of clauses must give the same bits, packed
// and not packed.
#include "frep/eval/clause_tape.h"

#include <doctest/doctest.h>

#include "frep/field/meaning.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

/// The tape run clause by clause at one point.
double run(const ClauseTape& tape, std::span<const double> point) {
    std::vector<double> rows(tape.rows);
    std::copy(tape.data->constants.begin(), tape.data->constants.end(), rows.begin());
    std::copy(point.begin(), point.end(), rows.begin() + tape.data->coordinate_row(0));
    std::vector<double> arguments;
    for (const Clause& clause : tape.clauses) {
        arguments.clear();
        for (const RowNumber row : tape.operands_of(clause)) {
            CHECK(row != clause.out);
            arguments.push_back(rows[row]);
        }
        rows[clause.out] = meaning<double>(clause.op, arguments, tape.block_of(clause));
    }
    return rows[tape.root];
}

void compare(const Field& field, Random& random) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape.has_value());
    ClauseTape packed = *tape;
    pack_rows(packed);
    CHECK(packed.rows <= tape->rows);
    ClauseTape again = packed;
    pack_rows(again);
    CHECK(again.rows == packed.rows);
    const auto reference = engine(field, Engine::reference);
    REQUIRE(reference);
    Columns<double> point(static_cast<std::size_t>(field.coordinates), 1);
    for (int k = 0; k < 20; ++k) {
        for (auto& column : point.columns) column[0] = random.real(-2, 2);
        const double expected = values_of(*reference, point, 1).columns[0][0];
        std::vector<double> at;
        for (const auto& column : point.columns) at.push_back(column[0]);
        CHECK(same(run(*tape, at), expected));
        CHECK(same(run(packed, at), expected));
        CHECK(same(run(again, at), expected));
    }
}

}  // namespace

TEST_CASE("clauses give what the reference engine gives") {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        RandomOptions options;
        options.operations = 3 + static_cast<int>(seed % 60);
        options.region_percent = 0;
        Random random(seed);
        compare(RandomField(seed, options).make(), random);
    }
}

TEST_CASE("a coordinate, a constant and a shift by an iso value as roots") {
    auto graph = std::make_shared<Graph>();
    Field field;
    const NodeId x = graph->coordinate(0), half = graph->constant(0.5);
    field.graph = graph;
    field.value = x;
    const double point[3] = {0.75, 0, 0};
    CHECK(run(*make_clause_tape(field), point) == 0.75);
    const ClauseTape moved = shifted(*make_clause_tape(field), 0.25);
    CHECK(run(moved, point) == 0.5);
    CHECK(cost_of(moved) == 1);
    field.value = half;
    CHECK(run(*make_clause_tape(field), point) == 0.5);
}

TEST_CASE("a field that needs a region has no clauses") {
    RandomOptions options;
    options.region_percent = 100;
    options.operations = 1;
    CHECK(!make_clause_tape(RandomField(3, options).make()));
}
