// Native code against the reference engine, and in binary32 against BatchVm, bit by bit: random fields of every
// operation, with and without a domain, for each instruction set that this machine has; its memory and its
// instructions.
#include "frep/eval/native_code.h"

#include <doctest/doctest.h>

#include <cstring>

#include "frep/eval/batch_vm.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

std::vector<Isa> sets() {
    std::vector<Isa> all;
    for (const Isa isa : {Isa::avx2, Isa::avx512})
        if (isa <= machine_isa()) all.push_back(isa);
    return all;
}

bool unavailable() {
    if (NativeCode<double>::is_available()) return false;
    MESSAGE("skipped: 1 (no native code in this build or on this machine)");
    return true;
}

Columns<double> random_points(Random& random, std::size_t columns, std::size_t rows) {
    Columns<double> points(columns, rows);
    for (auto& column : points.columns)
        for (double& x : column) x = random_coordinate(random);
    return points;
}

/// Points where native code and the reference engine differ.
std::size_t differing(const Field& field, const Columns<double>& points, const NativeOptions& options) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape.has_value());
    const auto code = NativeCode<double>::compile(*tape, options);
    REQUIRE(code.has_value());
    Field alone = field;
    alone.attributes.clear();
    const auto reference = engine(alone, Engine::reference);
    REQUIRE(reference);
    const std::size_t rows = points.rows();
    const auto expected = values_of(*reference, points, rows).columns[0];
    std::vector<double> got(rows + 1, 12345.0);
    code->run(points.in().data(), rows, got.data());
    CHECK(got[rows] == 12345.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows; ++i) count += same(got[i], expected[i]) ? 0 : 1;
    return count;
}

bool same(float a, float b) { return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0; }
using frep_test::same;

Columns<float> rounded(const Columns<double>& points) {
    Columns<float> result(points.columns.size(), points.rows());
    for (std::size_t k = 0; k < points.columns.size(); ++k)
        for (std::size_t i = 0; i < points.rows(); ++i)
            result.columns[k][i] = static_cast<float>(points.columns[k][i]);
    return result;
}

/// The same in binary32, against BatchVm.
std::size_t differing_singles(const Field& field, const Columns<double>& points,
                              const NativeOptions& options) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape.has_value());
    const auto code = NativeCode<float>::compile(*tape, options);
    REQUIRE(code.has_value());
    const Columns<float> at = rounded(points);
    std::vector<float> expected(points.rows()), got(points.rows());
    BatchVm<float> vm;
    vm.values(*tape, at.in(), points.rows(), expected.data());
    code->run(at.in().data(), points.rows(), got.data());
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.rows(); ++i) count += same(got[i], expected[i]) ? 0 : 1;
    return count;
}

Field random_field(std::uint64_t seed, int operations) {
    RandomOptions options;
    options.operations = operations;
    options.region_percent = 0;
    options.attributes = 0;
    return RandomField(seed, options).make();
}

/// One operation on the first coordinates.
Field field_of(Op op) {
    auto graph = std::make_shared<Graph>();
    Field field;
    field.coordinates = std::max(info(op).arity, 1);
    std::vector<NodeId> in;
    for (int i = 0; i < info(op).arity; ++i) in.push_back(graph->coordinate(i));
    field.value = graph->make(op, in);
    field.graph = std::move(graph);
    return field;
}

}  // namespace

TEST_CASE("each operation as native code gives what the reference engine gives") {
    if (unavailable()) return;
    for (int k = 0; k < op_count; ++k) {
        const Op op = static_cast<Op>(k);
        if (info(op).kind != OpKind::plain) continue;
        Random random(static_cast<std::uint64_t>(k));
        const Field field = field_of(op);
        const auto points = random_points(random, static_cast<std::size_t>(field.coordinates), 1003);
        for (const Isa isa : sets()) {
            INFO(info(op).name, " ", name_of(isa));
            CHECK(differing(field, points, {isa, {}}) == 0);
            CHECK(differing_singles(field, points, {isa, {}}) == 0);
        }
    }
}

TEST_CASE("random fields as native code") {
    if (unavailable()) return;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const Field field = random_field(seed, 3 + static_cast<int>(seed % 90));
        Random random(seed);
        const auto points = random_points(random, 3, 1 + seed % 67);
        const std::vector<math::Interval> domain(3,
                                                 math::Interval(-2.5, 2.0 + static_cast<double>(seed % 3)));
        for (const Isa isa : sets()) {
            INFO("seed ", seed, " ", name_of(isa));
            CHECK(differing(field, points, {isa, {}}) == 0);
            CHECK(differing(field, points, {isa, domain}) == 0);
            CHECK(differing_singles(field, points, {isa, {}}) == 0);
            CHECK(differing_singles(field, points, {isa, domain}) == 0);
        }
    }
}
