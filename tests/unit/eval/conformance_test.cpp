// Every operation of the table through every engine against its meaning in double precision: values bit for
// bit, gradients bit for bit between engines, finite and near central differences, intervals that hold
// values.
#include <doctest/doctest.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <array>
#include <cmath>
#include <string>

#include "frep/field/meaning.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

/// One operation on coordinates as a field; data of block operations are constants, or coordinates as well.
struct Case {
    Op op;
    Field field;
    std::vector<double> block;  ///< constant data
    std::size_t arguments = 0;  ///< coordinates
};

bool is_tested(Op op) { return info(op).kind != OpKind::leaf; }

Case plain_case(Op op) {
    Case test;
    test.op = op;
    test.arguments = static_cast<std::size_t>(info(op).arity);
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> arguments;
    for (std::size_t i = 0; i < test.arguments; ++i)
        arguments.push_back(graph->coordinate(static_cast<int>(i)));
    test.field.value = graph->make(op, arguments);
    test.field.graph = std::move(graph);
    test.field.coordinates = static_cast<int>(test.arguments);
    return test;
}

/// A block operation with `items` items; with `nodes` some of their numbers are coordinates.
Case block_case(Op op, Random& random, std::size_t items, bool nodes) {
    Case test;
    test.op = op;
    auto graph = std::make_shared<Graph>();
    std::vector<NodeId> lead, data;
    int used = 0;
    for (int i = 0; i < info(op).arity; ++i) lead.push_back(graph->coordinate(used++));
    const DataLayout layout = data_layout(op);
    std::size_t count = layout.item * items;
    if (layout.volume) {
        count = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t n = layout.least + random.below(4);
            test.block.push_back(static_cast<double>(n));
            count *= n;
        }
    }
    for (std::size_t i = 0; i < count; ++i) test.block.push_back(random.plain(3));
    if (op == Op::outline_distance) test.block = outline_data(random);
    count = layout.volume ? count : test.block.size();
    for (const double value : test.block) data.push_back(graph->constant(value));
    if (nodes) {
        const std::size_t first = layout.volume ? 3 : 0;
        const std::size_t start = random.below(count);
        for (std::size_t i = 0; i < count && used < 12; ++i)
            data[first + (start + i) % count] = graph->coordinate(used++);
    }
    test.field.value = graph->make_block(op, lead, data);
    test.field.graph = std::move(graph);
    test.field.coordinates = used;
    test.arguments = static_cast<std::size_t>(used);
    return test;
}

std::vector<Case> cases_of(Op op) {
    if (info(op).kind == OpKind::plain) return {plain_case(op)};
    Random random(static_cast<std::uint64_t>(op));
    std::vector<Case> cases;
    for (std::size_t items = 1; items <= 3; ++items) {
        cases.push_back(block_case(op, random, items, false));
        cases.push_back(block_case(op, random, items, true));
    }
    return cases;
}

/// The meaning at one point, straight from the dispatch.
double meaning_at(const Case& test, const Columns<double>& points, std::size_t row) {
    const Graph& graph = *test.field.graph;
    std::vector<double> arguments;
    for (const NodeId id : graph.arguments(test.field.value)) {
        const bool constant = graph.node(id).op == Op::constant;
        arguments.push_back(constant ? graph.constant_of(id) : points.columns[graph.node(id).payload][row]);
    }
    return meaning<double>(test.op, arguments, graph.block_of(test.field.value));
}

/// All pairs of special numbers for one and two arguments, random mixtures of special and ordinary beyond.
Columns<double> special_points(std::size_t arguments, Random& random) {
    const std::size_t n = special_numbers.size();
    const std::size_t pairs = arguments == 1 ? n : n * n;
    const std::size_t rows = pairs + 1501 * scale(20);
    Columns<double> points(arguments, rows);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < arguments; ++i) {
            double x = random.chance(25) ? special_numbers[random.below(n)] : random.real(-4, 4);
            if (random.chance(10)) x = 1.0 + random.real(-2e-6, 2e-6);
            if (row < pairs && i == 0) x = special_numbers[row % n];
            if (row < pairs && i == 1) x = special_numbers[row / n];
            points.columns[i][row] = x;
        }
    }
    return points;
}

struct Engines {
    std::vector<std::unique_ptr<Evaluator>> all;
    explicit Engines(const Field& field) {
        all.push_back(engine(field, Engine::reference));
        for (const int registers : {0, 3, 4}) all.push_back(engine(field, Engine::vm, registers));
        all.push_back(engine(field, Engine::jit));
        for (const auto& evaluator : all) REQUIRE(evaluator);
    }
};

std::string name_of(Op op) { return std::string(info(op).name); }

}  // namespace

TEST_CASE("every operation has its meaning in every engine") {
    for (int index = 0; index < op_count; ++index) {
        const auto op = static_cast<Op>(index);
        if (!is_tested(op)) continue;
        CAPTURE(name_of(op));
        for (const Case& test : cases_of(op)) {
            Random random(static_cast<std::uint64_t>(index) + 100);
            const Columns<double> points = special_points(test.arguments, random);
            const std::size_t rows = points.rows();
            Columns<double> expected(1, rows);
            for (std::size_t row = 0; row < rows; ++row)
                expected.columns[0][row] = meaning_at(test, points, row);
            for (const auto& evaluator : Engines(test.field).all)
                CHECK(differences(expected, values_of(*evaluator, points, rows)) == 0);
        }
    }
}

TEST_CASE("gradients are the same in every engine, and finite where the value is") {
    for (int index = 0; index < op_count; ++index) {
        const auto op = static_cast<Op>(index);
        if (!is_tested(op)) continue;
        CAPTURE(name_of(op));
        for (const Case& test : cases_of(op)) {
            Random random(static_cast<std::uint64_t>(index) + 200);
            const Columns<double> points = special_points(test.arguments, random);
            const std::size_t rows = points.rows();
            const Engines engines(test.field);
            const Columns<double> expected = gradients_of(*engines.all[0], points, rows);
            for (const auto& evaluator : engines.all)
                CHECK(differences(expected, gradients_of(*evaluator, points, rows)) == 0);
            std::size_t wrong_value = 0, not_finite = 0;
            for (std::size_t row = 0; row < rows; ++row) {
                const double f = expected.columns[0][row];
                wrong_value += !same(f, meaning_at(test, points, row));
                if (!std::isfinite(f)) continue;
                for (std::size_t i = 1; i < expected.columns.size(); ++i)
                    not_finite += !std::isfinite(expected.columns[i][row]);
            }
            CHECK(wrong_value == 0);
            CHECK(not_finite == 0);
        }
    }
}

TEST_CASE("gradients are near central differences where the operation is smooth") {
    for (int index = 0; index < op_count; ++index) {
        const auto op = static_cast<Op>(index);
        if (!is_tested(op)) continue;
        CAPTURE(name_of(op));
        std::size_t smooth = 0, wrong = 0;
        for (const Case& test : cases_of(op)) {
            Random random(static_cast<std::uint64_t>(index) + 300);
            constexpr std::size_t rows = 400;
            Columns<double> points(test.arguments, rows);
            for (auto& column : points.columns)
                for (double& x : column) x = random.chance(50) ? random.real(0.1, 0.95) : random.real(-3, 3);
            const auto vm = engine(test.field, Engine::vm);
            const Columns<double> gradients = gradients_of(*vm, points, rows);
            for (std::size_t i = 0; i < test.arguments; ++i) {
                const double h = 1e-5;
                auto shifted = [&](double by) {
                    Columns<double> moved = points;
                    for (double& x : moved.columns[i]) x += by;
                    return values_of(*vm, moved, rows).columns[0];
                };
                const auto low = shifted(-h), high = shifted(h), lower = shifted(-2 * h),
                           higher = shifted(2 * h);
                for (std::size_t row = 0; row < rows; ++row) {
                    const double near = (high[row] - low[row]) / (2 * h);
                    const double far = (higher[row] - lower[row]) / (4 * h);
                    const double forward = (high[row] - gradients.columns[0][row]) / h;
                    const double size = 1 + std::fabs(near) + std::fabs(gradients.columns[0][row]);
                    // Not smooth here: the differences disagree among themselves.
                    if (!(std::fabs(near - far) < 1e-6 * size) || !(std::fabs(near - forward) < 1e-2 * size))
                        continue;
                    ++smooth;
                    if (std::fabs(near - gradients.columns[i + 1][row]) < 1e-4 * size) continue;
                    if (++wrong == 1)
                        MESSAGE("argument ", i, " at ", points.columns[0][row], ": ",
                                gradients.columns[i + 1][row], " for ", near);
                }
            }
        }
        CHECK(wrong == 0);
        CHECK(smooth > 50);
    }
}

TEST_CASE("intervals hold the values of every operation") {
    for (int index = 0; index < op_count; ++index) {
        const auto op = static_cast<Op>(index);
        if (!is_tested(op)) continue;
        CAPTURE(name_of(op));
        for (const Case& test : cases_of(op)) {
            Random random(static_cast<std::uint64_t>(index) + 400);
            const std::size_t boxes = 600 * scale(20);
            constexpr std::size_t inside = 12;
            Columns<math::Interval> sides(test.arguments, boxes);
            Columns<double> points(test.arguments, boxes * inside);
            for (std::size_t i = 0; i < test.arguments; ++i) {
                for (std::size_t b = 0; b < boxes; ++b) {
                    double lo = random_coordinate(random);
                    double hi = random.chance(60) ? lo + random.real(0, 1) : random_coordinate(random);
                    if (lo != lo) lo = 0;
                    if (hi != hi) hi = lo;
                    if (hi < lo) std::swap(lo, hi);
                    sides.columns[i][b] = {lo, hi};
                    for (std::size_t k = 0; k < inside; ++k) {
                        const double x = lo + (hi - lo) * random.real(0, 1);
                        const double pick[3] = {lo, hi, x >= lo && x <= hi ? x : hi};
                        points.columns[i][b * inside + k] = pick[std::min<std::size_t>(random.below(6), 2)];
                    }
                }
            }
            const auto reference = engine(test.field, Engine::reference);
            const auto vm = engine(test.field, Engine::vm);
            const auto expected = intervals_of(*reference, sides, boxes);
            const auto got = intervals_of(*vm, sides, boxes);
            const auto values = values_of(*vm, points, boxes * inside);
            std::size_t different = 0, outside = 0;
            for (std::size_t b = 0; b < boxes; ++b) {
                different += !same(expected[b], got[b]);
                for (std::size_t k = 0; k < inside; ++k) {
                    const double value = values.columns[0][b * inside + k];
                    const bool held = value != value ? got[b].maybe_undefined : got[b].contains(value);
                    if (held) continue;
                    if (++outside == 1)
                        MESSAGE("value ", value, " at ", points.columns[0][b * inside + k], " outside [",
                                got[b].lo, ", ", got[b].hi, "]");
                }
            }
            CHECK(different == 0);
            CHECK(outside == 0);
        }
    }
}

/// Rule 5: what is read and undefined makes the value undefined, for numbers and for intervals. `select`
/// reads one branch; data items may be left out.
TEST_CASE("an undefined operand makes every operation undefined") {
    for (int index = 0; index < op_count; ++index) {
        const auto op = static_cast<Op>(index);
        if (!is_tested(op)) continue;
        CAPTURE(name_of(op));
        Random random(static_cast<std::uint64_t>(index) + 500);
        const Case test = cases_of(op)[0];
        const auto reads = static_cast<std::size_t>(op == Op::select ? 1 : info(op).arity);
        std::size_t defined = 0;
        for (int trial = 0; trial < 300; ++trial) {
            std::vector<double> point(test.arguments);
            for (double& x : point) {
                do x = random_coordinate(random);
                while (x != x);
            }
            point[random.below(reads)] = math::quiet_nan;
            const auto block = test.field.graph->block_of(test.field.value);
            const std::vector<math::Interval> box(point.begin(), point.end());
            const double value = meaning<double>(op, point, block);
            defined += value == value || !meaning<math::Interval>(op, box, block).maybe_undefined;
        }
        CHECK(defined == 0);
    }
}

TEST_CASE("every number of points gives the same values") {
    RandomField maker(3, {});
    const Field field = maker.make();
    Random random(9);
    Columns<double> points(3, 600);
    for (auto& column : points.columns)
        for (double& x : column) x = random.real(-2, 2);
    const auto vm = engine(field, Engine::vm);
    const Columns<double> all = values_of(*vm, points, 600);
    for (const std::size_t rows : {0, 1, 2, 3, 4, 5, 7, 63, 64, 65, 255, 256, 257, 599}) {
        const Columns<double> some = values_of(*vm, points, rows);
        std::size_t different = 0;
        for (std::size_t row = 0; row < rows; ++row)
            different += !same(some.columns[0][row], all.columns[0][row]);
        CHECK(different == 0);
    }
}

#if defined(__SSE2__)
TEST_CASE("a caller's rounding mode and flush-to-zero change nothing and are put back") {
    auto graph = std::make_shared<Graph>();
    const NodeId x = graph->coordinate(0);
    Field field;
    field.coordinates = 1;
    field.value = graph->make(Op::add, {graph->make(Op::mul, {x, graph->constant(0.1)}),
                                        graph->make(Op::div, {x, graph->constant(3.0)})});
    field.graph = graph;
    Columns<double> points(1, 3);
    points.columns[0] = {0x1p-1070, 1.0, 0.7};
    for (const Engine which : {Engine::reference, Engine::vm}) {
        const auto evaluator = engine(field, which);
        const Columns<double> expected = values_of(*evaluator, points, 3);
        const Columns<double> expected_gradients = gradients_of(*evaluator, points, 3);
        const unsigned saved = _mm_getcsr(), strange = saved | 0x8040u | 0x4000u;  // FTZ, DAZ, round up
        _mm_setcsr(strange);
        const Columns<double> values = values_of(*evaluator, points, 3);
        const Columns<double> gradients = gradients_of(*evaluator, points, 3);
        const unsigned after = _mm_getcsr();
        _mm_setcsr(saved);
        CHECK((after & ~0x3fu) == (strange & ~0x3fu));
        CHECK(differences(expected, values) == 0);
        CHECK(differences(expected_gradients, gradients) == 0);
    }
}
#endif

TEST_CASE("fields that no engine can run are refused") {
    auto graph = std::make_shared<Graph>();
    Field field;
    field.coordinates = 2;
    field.value = graph->make(Op::add, {graph->coordinate(2), graph->parameter(0)});
    field.graph = graph;
    CHECK_FALSE(make_evaluator(field));
    field.coordinates = 3;
    CHECK_FALSE(make_evaluator(field));
    field.parameters = {1.0};
    CHECK(make_evaluator(field));
    EvaluatorOptions options;
    options.registers = 2;
    CHECK_FALSE(make_evaluator(field, options));
    CHECK(engines().size() >= 2);  // jit where the machine has it
}
