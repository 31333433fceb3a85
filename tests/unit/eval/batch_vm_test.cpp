// BatchVm on every instruction set that this machine has: in binary64 the bits of the reference engine for
// values and gradients, packed or not, for batches of every small size; in binary32 the same bits on all
// instruction sets, near those of binary64, and the rules of the profile.
#include "frep/eval/batch_vm.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

/// The instruction sets of this machine, narrowest first.
std::vector<Isa> sets() {
    std::vector<Isa> all;
    for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512})
        if (isa <= machine_isa()) all.push_back(isa);
    return all;
}

template <class Real>
BatchVm<Real> vm_for(Isa isa) {
    set_isa_limit(isa);
    BatchVm<Real> vm;
    set_isa_limit(Isa::avx512);
    return vm;
}

bool same(float a, float b) { return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0; }
using frep_test::same;

template <class Real>
std::size_t differences(const Columns<Real>& a, const Columns<Real>& b) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < a.columns.size(); ++k)
        for (std::size_t i = 0; i < a.columns[k].size(); ++i)
            count += !same(a.columns[k][i], b.columns[k][i]);
    return count;
}

Columns<double> random_points(Random& random, int coordinates, std::size_t rows) {
    Columns<double> points(static_cast<std::size_t>(coordinates), rows);
    for (auto& column : points.columns)
        for (double& x : column) x = random_coordinate(random);
    return points;
}

Columns<float> rounded(const Columns<double>& points) {
    Columns<float> result(points.columns.size(), points.rows());
    for (std::size_t k = 0; k < points.columns.size(); ++k)
        for (std::size_t i = 0; i < points.rows(); ++i)
            result.columns[k][i] = static_cast<float>(points.columns[k][i]);
    return result;
}

template <class Real>
Columns<Real> values_of(BatchVm<Real>& vm, const ClauseTape& tape, const Columns<Real>& points,
                        std::size_t rows) {
    Columns<Real> out(1, rows);
    vm.values(tape, points.in(), rows, out.columns[0].data());
    return out;
}

template <class Real>
Columns<Real> gradients_of(BatchVm<Real>& vm, const ClauseTape& tape, const Columns<Real>& points,
                           std::size_t rows) {
    Columns<Real> out(points.columns.size() + 1, rows);
    const auto pointers = out.out();
    vm.gradients(tape, points.in(), rows, pointers[0], std::span(pointers).subspan(1));
    return out;
}

RandomOptions options_for(std::uint64_t seed) {
    RandomOptions options;
    options.operations = 3 + static_cast<int>(seed % 50);
    options.coordinates = seed % 9 == 8 ? static_cast<int>(seed % 8) : 3;
    options.region_percent = 0;
    return options;
}

}  // namespace

TEST_CASE("batch vm in binary64: the bits of the reference engine on every instruction set") {
    const std::size_t graphs = 400 * scale(20);
    for (const Isa isa : sets()) {
        BatchVm<double> vm = vm_for<double>(isa);  // one for all fields, as in use
        std::size_t wrong_values = 0, wrong_gradients = 0, defined = 0;
        for (std::uint64_t seed = 0; seed < graphs; ++seed) {
            const Field field = bind_parameters(RandomField(seed + 7000, options_for(seed)).make());
            const std::size_t rows = 1 + seed % 70;
            Random random(seed);
            const Columns<double> points = random_points(random, field.coordinates, rows);
            const auto reference = engine(field, Engine::reference);
            ClauseTape tape = *make_clause_tape(field);
            if (seed % 2 == 0) pack_rows(tape);
            const Columns<double> all = frep_test::values_of(*reference, points, rows);
            Columns<double> expected(1, rows);
            expected.columns[0] = all.columns[0];
            const auto slopes = frep_test::gradients_of(*reference, points, rows);
            const std::size_t values = differences(expected, values_of(vm, tape, points, rows));
            const std::size_t gradients = differences(slopes, gradients_of(vm, tape, points, rows));
            if (values + gradients > 0 && wrong_values + wrong_gradients == 0)
                MESSAGE(name_of(isa), " seed ", seed, ": ", values, " values, ", gradients,
                        " gradients differ");
            wrong_values += values;
            wrong_gradients += gradients;
            for (const double f : expected.columns[0]) defined += f == f;
        }
        CHECK(wrong_values == 0);
        CHECK(wrong_gradients == 0);
        CHECK(defined > graphs * 8);
    }
}

TEST_CASE("batch vm: long batches equal short ones") {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Field field = bind_parameters(RandomField(seed + 90, options_for(seed)).make());
        ClauseTape tape = *make_clause_tape(field);
        pack_rows(tape);
        Random random(seed);
        const std::size_t rows = 1500 + random.below(40);
        const Columns<double> points = random_points(random, field.coordinates, rows);
        BatchVm<double> vm;
        const Columns<double> whole = values_of(vm, tape, points, rows);
        const Columns<double> slopes = gradients_of(vm, tape, points, rows);
        std::size_t wrong = 0;
        for (const std::size_t first : {std::size_t{0}, std::size_t{1}, rows - 17}) {
            Columns<double> part(points.columns.size(), 17);
            for (std::size_t k = 0; k < part.columns.size(); ++k)
                std::copy_n(points.columns[k].begin() + static_cast<std::ptrdiff_t>(first), 17,
                            part.columns[k].begin());
            const Columns<double> values = values_of(vm, tape, part, 17);
            const Columns<double> gradients = gradients_of(vm, tape, part, 17);
            for (std::size_t i = 0; i < 17; ++i) {
                wrong += !same(values.columns[0][i], whole.columns[0][first + i]);
                for (std::size_t k = 0; k < gradients.columns.size(); ++k)
                    wrong += !same(gradients.columns[k][i], slopes.columns[k][first + i]);
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("batch vm in binary32: the same bits on every instruction set, total gradients") {
    const std::size_t graphs = 400 * scale(20);
    std::size_t wrong = 0, not_finite = 0, differ_in_value = 0, defined = 0;
    std::vector<BatchVm<float>> vms;
    for (const Isa isa : sets()) vms.push_back(vm_for<float>(isa));
    for (std::uint64_t seed = 0; seed < graphs; ++seed) {
        const Field field = bind_parameters(RandomField(seed + 7000, options_for(seed)).make());
        const std::size_t rows = 1 + seed % 70;
        Random random(seed);
        const Columns<float> points = rounded(random_points(random, field.coordinates, rows));
        ClauseTape tape = *make_clause_tape(field);
        if (seed % 2 == 1) pack_rows(tape);
        const Columns<float> values = values_of(vms[0], tape, points, rows);
        const Columns<float> gradients = gradients_of(vms[0], tape, points, rows);
        for (std::size_t k = 1; k < vms.size(); ++k) {
            wrong += differences(values, values_of(vms[k], tape, points, rows));
            wrong += differences(gradients, gradients_of(vms[k], tape, points, rows));
        }
        for (std::size_t i = 0; i < rows; ++i) {
            const float f = values.columns[0][i];
            defined += f == f;
            differ_in_value += !same(f, gradients.columns[0][i]);
            if (!(f - f == 0)) continue;
            for (std::size_t k = 1; k < gradients.columns.size(); ++k)
                not_finite += !(gradients.columns[k][i] - gradients.columns[k][i] == 0);
        }
    }
    CHECK(wrong == 0);
    CHECK(differ_in_value == 0);
    CHECK(not_finite == 0);
    CHECK(defined > graphs * 8);
}

namespace {

/// Random sums, products, roots and set operations without cancellation in their conditions: a float engine
/// stays near a double one.
Field well_conditioned(std::uint64_t seed) {
    Random random(seed);
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> pool;
    for (int i = 0; i < 3; ++i) pool.push_back(graph->coordinate(i));
    for (int i = 0; i < 4; ++i) pool.push_back(graph->constant(random.real(-2, 2)));
    const auto any = [&] { return pool[random.below(pool.size())]; };
    for (int i = 0; i < 20; ++i) {
        const NodeId a = any(), b = any();
        switch (random.below(11)) {
            case 0:
                pool.push_back(graph->make(Op::add, {a, b}));
                break;
            case 1:
                pool.push_back(graph->make(Op::sub, {a, b}));
                break;
            case 2:
                pool.push_back(graph->make(Op::mul, {graph->make(Op::sin, {a}), b}));
                break;
            case 3:
                pool.push_back(graph->make(Op::min, {a, b}));
                break;
            case 4:
                pool.push_back(graph->make(Op::max, {a, b}));
                break;
            case 5:
                pool.push_back(graph->make(Op::cos, {a}));
                break;
            case 6:
                pool.push_back(graph->make(Op::r_and, {a, b}));
                break;
            case 7:
                pool.push_back(graph->make(Op::r_or, {a, b}));
                break;
            case 8:
                pool.push_back(graph->make(Op::hypot, {a, b}));
                break;
            case 9:
                pool.push_back(graph->make(Op::exp, {graph->make(Op::sin, {a})}));
                break;
            default:
                pool.push_back(graph->make(
                    Op::atan2, {a, graph->make(Op::add, {graph->make(Op::abs, {b}), graph->constant(1.0)})}));
        }
    }
    Field field;
    field.value = pool.back();
    field.graph = std::move(graph);
    return field;
}

}  // namespace

TEST_CASE("batch vm: binary32 is near binary64 where the field is well conditioned") {
    constexpr std::size_t rows = 64;
    std::size_t far = 0, compared = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Field field = well_conditioned(seed);
        const ClauseTape tape = *make_clause_tape(field);
        Random random(seed);
        Columns<double> points(3, rows);
        for (auto& column : points.columns)
            for (double& x : column) x = static_cast<double>(static_cast<float>(random.real(-2, 2)));
        BatchVm<double> wide;
        BatchVm<float> narrow;
        const auto exact = values_of(wide, tape, points, rows);
        const auto single = values_of(narrow, tape, rounded(points), rows);
        double largest = 1;
        for (const double f : exact.columns[0]) largest = std::max(largest, std::abs(f));
        for (std::size_t i = 0; i < rows; ++i) {
            ++compared;
            // 20 operations, each with factors of at most 4 or so along a path
            far += !(std::abs(exact.columns[0][i] - static_cast<double>(single.columns[0][i])) <=
                     2e-4 * largest);
        }
    }
    CHECK(compared == 300 * rows);
    CHECK(far == 0);
}

TEST_CASE("batch vm: roots that are leaves, and the empty batch") {
    auto graph = std::make_shared<Graph>();
    Field field;
    const NodeId y = graph->coordinate(1), third = graph->constant(1.0 / 3);
    field.graph = graph;
    Columns<double> points(3, 5);
    for (std::size_t i = 0; i < 5; ++i) points.columns[1][i] = static_cast<double>(i);
    BatchVm<double> vm;
    field.value = y;
    CHECK(values_of(vm, *make_clause_tape(field), points, 5).columns[0] == points.columns[1]);
    const auto slopes = gradients_of(vm, *make_clause_tape(field), points, 5);
    CHECK(slopes.columns[0] == points.columns[1]);
    CHECK(slopes.columns[2] == std::vector<double>(5, 1.0));
    CHECK(slopes.columns[1] == std::vector<double>(5, 0.0));
    field.value = third;
    CHECK(values_of(vm, *make_clause_tape(field), points, 5).columns[0] == std::vector<double>(5, 1.0 / 3));
    CHECK(values_of(vm, *make_clause_tape(field), points, 0).columns[0].empty());
    BatchVm<float> single;
    CHECK(values_of(single, *make_clause_tape(field), rounded(points), 5).columns[0] ==
          std::vector<float>(5, static_cast<float>(1.0 / 3)));
}

#if defined(__SSE2__)
TEST_CASE("batch vm computes under the rules whatever the caller's control register") {
    auto graph = std::make_shared<Graph>();
    Field field;
    field.value = graph->make(Op::mul, {graph->coordinate(0), graph->constant(0.5)});
    field.graph = graph;
    field.coordinates = 1;
    const ClauseTape tape = *make_clause_tape(field);
    Columns<float> points(1, 3);
    points.columns[0] = {0x1p-126f, 0x1p-148f, -0x1.8p-140f};  // their halves are denormal
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);  // flush to zero, denormals are zero
    BatchVm<float> vm;
    const auto values = values_of(vm, tape, points, 3);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    CHECK(values.columns[0] == std::vector<float>{0x1p-127f, 0x1p-149f, -0x1.8p-141f});
    CHECK((after & 0x8040) == 0x8040);
}
#endif
