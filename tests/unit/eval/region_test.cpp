// Hand-made regions in every engine: loops, branches, arrays, step limits, undefined conditions, the guard.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/eval/engines.h"
#include "unit/eval/region_maker.h"

using namespace frep;
using namespace frep_test;

namespace {

Columns<double> grid() {
    Columns<double> points(2, 41 * 41);
    for (std::size_t i = 0; i < 41; ++i) {
        for (std::size_t k = 0; k < 41; ++k) {
            points.columns[0][i * 41 + k] = -2.0 + 0.1 * static_cast<double>(k);
            points.columns[1][i * 41 + k] = -2.0 + 0.1 * static_cast<double>(i);
        }
    }
    return points;
}

/// Values of the field at the grid, after a check that all engines agree on values and gradients.
std::vector<double> agreed_values(const Field& field, std::int64_t max_steps = 1'000'000) {
    const Columns<double> points = grid();
    const std::size_t rows = points.rows();
    const auto reference = engine(field, Engine::reference, 0, max_steps);
    REQUIRE(reference);
    const Columns<double> expected = values_of(*reference, points, rows);
    const Columns<double> gradients = gradients_of(*reference, points, rows);
    for (const int registers : {0, 3}) {
        const auto vm = engine(field, Engine::vm, registers, max_steps);
        REQUIRE(vm);
        CHECK(differences(expected, values_of(*vm, points, rows)) == 0);
        CHECK(differences(gradients, gradients_of(*vm, points, rows)) == 0);
    }
    return expected.columns[0];
}

/// Compares with the same computation written in C++.
template <class Function>
void check_against(const Field& field, Function function, std::int64_t max_steps = 1'000'000) {
    const std::vector<double> got = agreed_values(field, max_steps);
    const Columns<double> points = grid();
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < got.size(); ++row)
        wrong += !same(got[row], function(points.columns[0][row], points.columns[1][row]));
    CHECK(wrong == 0);
}

const double undefined = math::quiet_nan;

}  // namespace

TEST_CASE("a loop that ends at another step for every point") {
    Maker m = mandelbrot(200);
    check_against(field_of(m, 4), [](double cx, double cy) {
        double x = 0, y = 0, steps = 0;
        while (x * x + y * y < 4 && steps < 200) {
            const double next = x * x - y * y + cx, product = x * y;
            y = product + product + cy;
            x = next;
            ++steps;
        }
        return steps;
    });
}

TEST_CASE("derivatives go through a loop") {
    Maker m(3);  // r = x; three times r = r * x + y
    const NodeId again = m.make(Op::less, {m.cell(2), m.number(3.0)});
    const NodeId next = m.make(Op::add, {m.make(Op::mul, {m.cell(0), m.cell(0)}), m.cell(1)});
    const auto step = m.assign({{0, next}, {2, m.make(Op::add, {m.cell(2), m.number(1.0)})}});
    m.region->program = {m.assign({{2, m.number(0.0)}}), m.loop(again, {step})};
    const Field field = field_of(m, 0);
    agreed_values(field);
    Columns<double> points(2, 1);
    points.columns = {{0.5}, {0.25}};
    const auto vm = engine(field, Engine::vm);
    const Columns<double> got = gradients_of(*vm, points, 1);
    // r1 = 1/2, r2 = 1/2, r3 = 1/2; dr/dx = 2 r dr/dx, dr/dy = 2 r dr/dy + 1
    CHECK(got.columns[0][0] == 0.5);
    CHECK(got.columns[1][0] == 1.0);
    CHECK(got.columns[2][0] == 3.0);
}

TEST_CASE("nested loops share one count of steps") {
    Maker m(5);  // for i < 3 : for k < 4 : sum += x
    const NodeId inner_on = m.make(Op::less, {m.cell(3), m.number(4.0)});
    const NodeId outer_on = m.make(Op::less, {m.cell(2), m.number(3.0)});
    const auto add = m.assign(
        {{4, m.make(Op::add, {m.cell(4), m.cell(0)})}, {3, m.make(Op::add, {m.cell(3), m.number(1.0)})}});
    const auto reset = m.assign({{3, m.number(0.0)}, {2, m.make(Op::add, {m.cell(2), m.number(1.0)})}});
    const auto inner = m.loop(inner_on, {add});
    m.region->program = {m.assign({{2, m.number(0.0)}, {3, m.number(0.0)}, {4, m.number(0.0)}}),
                         m.loop(outer_on, {reset, inner})};
    const Field field = field_of(m, 4);
    auto sum = [](double x, double) {
        double s = 0;
        for (int i = 0; i < 12; ++i) s += x;
        return s;
    };
    check_against(field, sum);
    check_against(field, sum, 15);  // 3 steps outside and 12 inside
    check_against(
        field, [](double, double) { return undefined; }, 14);
}

TEST_CASE("a branch not taken need not end") {
    Maker m(3);  // if x < 0 : loop for ever, else r = y
    const auto for_ever = m.loop(m.number(1.0), {m.assign({{2, m.number(1.0)}})});
    const auto negative = m.make(Op::less, {m.cell(0), m.number(0.0)});
    m.region->program = {m.branch(negative, {for_ever}, {m.assign({{2, m.cell(1)}})})};
    check_against(
        field_of(m, 2), [](double x, double y) { return x < 0 ? undefined : y; }, 100);
}

TEST_CASE("an undefined condition makes every cell undefined") {
    Maker m(3);  // r = y; if sqrt(x) : r = 1
    const auto one = m.assign({{2, m.number(1.0)}});
    m.region->program = {m.assign({{2, m.cell(1)}}), m.branch(m.make(Op::sqrt, {m.cell(0)}), {one}, {})};
    check_against(field_of(m, 1), [](double x, double y) { return x < 0 ? undefined : y; });
    check_against(field_of(m, 2), [](double x, double y) { return x < 0 ? undefined : x < 1e-12 ? y : 1.0; });
    Maker n(3);  // while sqrt(x) : x = x - 1
    const auto less = n.assign({{0, n.make(Op::sub, {n.cell(0), n.number(1.0)})}});
    n.region->program = {n.loop(n.make(Op::sqrt, {n.cell(0)}), {less})};
    check_against(field_of(n, 1), [](double x, double y) {
        while (std::sqrt(x) >= 1e-6) x -= 1;
        return x < 0 ? undefined : y;
    });
}

TEST_CASE("an undefined value that is not used has no effect") {
    Maker m(4);  // unassigned cell 3; r = y
    m.region->program = {m.assign({{2, m.cell(1)}, {0, m.cell(3)}})};
    check_against(field_of(m, 2), [](double, double y) { return y; });
    check_against(field_of(m, 0), [](double, double) { return undefined; });
}

TEST_CASE("all right sides are computed before a cell is written") {
    Maker m(2);
    m.region->program = {m.assign({{0, m.cell(1)}, {1, m.cell(0)}})};
    check_against(field_of(m, 0), [](double, double y) { return y; });
    check_against(field_of(m, 1), [](double x, double) { return x; });
}

TEST_CASE("arrays take indices that differ from point to point") {
    Maker m(7);  // cells 2..5 are the array, 6 the result
    m.region->arrays = {{2, 4}};
    std::vector<std::uint32_t> program;
    for (int i = 1; i <= 4; ++i)
        program.push_back(m.store(0, m.number(i), m.make(Op::mul, {m.cell(1), m.number(i)})));
    program.push_back(m.store(0, m.cell(0), m.number(-1.0)));
    program.push_back(m.assign({{6, m.load(0, m.make(Op::add, {m.cell(0), m.number(1.0)}))}}));
    m.region->program = program;
    const Field field = field_of(m, 6);
    check_against(field, [](double x, double y) {
        double items[4] = {y * 1.0, y * 2.0, y * 3.0, y * 4.0};
        auto index = [](double v) { return std::ceil(v) - (std::ceil(v) - v > 0.5 ? 1.0 : 0.0); };
        const double at = index(x);
        if (at >= 1 && at <= 4)
            items[static_cast<int>(at) - 1] = -1;
        else
            for (double& item : items) item = undefined;
        const double from = index(x + 1);
        return from >= 1 && from <= 4 ? items[static_cast<int>(from) - 1] : undefined;
    });
}

TEST_CASE("loads out of range are undefined") {
    Maker m(5);
    m.region->arrays = {{2, 2}};
    m.region->program = {m.assign({{2, m.number(7.0)}, {3, m.number(8.0)}}),
                         m.assign({{4, m.load(0, m.cell(0))}})};
    check_against(field_of(m, 4), [](double x, double) {
        const double c = std::ceil(x), index = c - x > 0.5 ? c - 1 : c;
        return index == 1 ? 7.0 : index == 2 ? 8.0 : undefined;
    });
}

TEST_CASE("a region with a false or undefined guard does nothing") {
    for (const double guard : {0.0, 1e-7, -1e-7, undefined}) {
        Maker m(2);
        m.region->program = {m.loop(m.number(1.0), {m.assign({{0, m.number(1.0)}})})};
        check_against(field_of(m, 1, guard), [](double, double) { return undefined; });
    }
    Maker m(2);
    check_against(field_of(m, 1, -1.0), [](double, double y) { return y; });
    auto graph = std::make_shared<Graph>();  // the guard differs from point to point
    Maker n(2);
    n.region->inputs = {0};
    const NodeId arguments[2] = {graph->make(Op::less, {graph->constant(0.0), graph->coordinate(0)}),
                                 graph->coordinate(1)};
    Field field;
    field.coordinates = 2;
    field.value = graph->make(Op::output, {graph->make_region(n.region, arguments)}, 0);
    field.graph = graph;
    check_against(field, [](double x, double y) { return x > 0 ? y : undefined; });
}

TEST_CASE("a region with many cells runs in narrow batches") {
    constexpr std::uint32_t items = 600'000;
    Maker m(3 + items);
    m.region->arrays = {{3, items}};
    m.region->program = {m.store(0, m.cell(0), m.cell(1)), m.assign({{2, m.load(0, m.cell(0))}})};
    const Field field = field_of(m, 2);
    const auto reference = engine(field, Engine::reference);
    const auto vm = engine(field, Engine::vm);
    REQUIRE(vm);
    Columns<double> points(2, 11);
    for (std::size_t row = 0; row < 11; ++row) {
        points.columns[0][row] = row == 5 ? 0.0 : 60'000.0 * static_cast<double>(row) + 1;
        points.columns[1][row] = static_cast<double>(row);
    }
    const Columns<double> values = values_of(*vm, points, 11);
    CHECK(differences(values_of(*reference, points, 11), values) == 0);
    CHECK(values.columns[0][3] == 3.0);
    CHECK(values.columns[0][5] != values.columns[0][5]);
    CHECK(values.columns[0][10] != values.columns[0][10]);
}
