// Searches in regions: values against formulas, all engines with the same bits, enclosures that hold samples,
// gradients against formulas, searches and loops inside one another, what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "unit/eval/engines.h"
#include "unit/eval/region_maker.h"
#include "unit/eval/search_maker.h"

using namespace frep;
using namespace frep_test;

namespace {

using Dual = math::Dual<double>;

Columns<double> grid() {
    constexpr std::size_t side = 11;
    Columns<double> points(2, side * side);
    for (std::size_t i = 0; i < side * side; ++i) {
        points.columns[0][i] = -2.0 + 0.4 * static_cast<double>(i % side);
        points.columns[1][i] = -1.9 + 0.38 * static_cast<double>(i / side);
    }
    return points;
}

/// Values and partials at the grid, after a check that all engines agree.
Columns<double> agreed(const Field& field) {
    const Columns<double> points = grid();
    const auto reference = engine(field, Engine::reference);
    REQUIRE(reference);
    const Columns<double> values = values_of(*reference, points, points.rows());
    const Columns<double> gradients = gradients_of(*reference, points, points.rows());
    for (const int registers : {0, 3}) {
        const auto vm = engine(field, Engine::vm, registers);
        REQUIRE(vm);
        CHECK(differences(values, values_of(*vm, points, points.rows())) == 0);
        CHECK(differences(gradients, gradients_of(*vm, points, points.rows())) == 0);
    }
    return gradients;
}

/// The largest error of value and gradient against `expected(x, y)`, a dual number.
template <class Function>
double error_against(const Field& field, Function expected) {
    const Columns<double> got = agreed(field), points = grid();
    double worst = 0;
    for (std::size_t i = 0; i < points.rows(); ++i) {
        const Dual want =
            expected(Dual::variable(points.columns[0][i], 0), Dual::variable(points.columns[1][i], 1));
        worst = std::max(worst, std::abs(got.columns[0][i] - want.value));
        for (std::size_t k = 0; k < 2; ++k)
            worst = std::max(worst, 1e-3 * std::abs(got.columns[k + 1][i] - want.d[k]));
    }
    return worst;
}

/// The number of samples outside of the enclosures of cells of a grid, the same from both engines.
std::size_t misses(const Field& field, double size) {
    const Columns<double> points = grid();
    Columns<math::Interval> boxes(2, points.rows());
    for (std::size_t i = 0; i < points.rows(); ++i)
        for (std::size_t k = 0; k < 2; ++k)
            boxes.columns[k][i] = {points.columns[k][i], points.columns[k][i] + size};
    const auto vm = engine(field, Engine::vm);
    const auto reference = engine(field, Engine::reference);
    const auto ranges = intervals_of(*vm, boxes, points.rows());
    const auto others = intervals_of(*reference, boxes, points.rows());
    std::size_t missed = 0;
    for (std::size_t i = 0; i < points.rows(); ++i) missed += !same(ranges[i], others[i]);
    for (int step = 0; step < 9; ++step) {
        Columns<double> inside = points;
        for (std::size_t i = 0; i < points.rows(); ++i) {
            inside.columns[0][i] += size * 0.5 * (step % 3);
            inside.columns[1][i] += size * 0.5 * (step / 3);
        }
        const Columns<double> values = values_of(*vm, inside, points.rows());
        for (std::size_t i = 0; i < points.rows(); ++i) {
            const double f = values.columns[0][i];
            missed += f != f ? !ranges[i].maybe_undefined : !ranges[i].contains(f);
        }
    }
    return missed;
}

}  // namespace

TEST_CASE("a disk along a segment is a capsule") {
    SearchSketch s;
    const Expression t = s.variable();
    const Field capsule = s.field(s.largest(0.25 - square(s.x - (2.0 * t - 1.0)) - square(s.y - t), {t}));
    const auto formula = [](Dual x, Dual y) {
        // the foot on the segment (-1, 0) .. (1, 1)
        const double foot = std::clamp((2 * (x.value + 1) + y.value) / 5, 0.0, 1.0);
        const Dual dx = x - Dual(2 * foot - 1), dy = y - Dual(foot);
        return Dual(0.25) - dx * dx - dy * dy;
    };
    CHECK(error_against(capsule, formula) < 1e-6);
    for (const double size : {0.0, 0.01, 0.3, 4.0}) CHECK(misses(capsule, size) == 0);
    Columns<math::Interval> box(2, 1);
    box.columns = {{{-0.1, 0.1}}, {{0.45, 0.55}}};
    const auto inside = intervals_of(*engine(capsule, Engine::vm), box, 1)[0];
    CHECK(inside.surely_positive());
    box.columns = {{{-0.1, 0.1}}, {{1.3, 1.4}}};
    CHECK(intervals_of(*engine(capsule, Engine::vm), box, 1)[0].surely_negative());
}

TEST_CASE("kinks, waves and several peaks are searched to the tolerance") {
    SearchSketch s;
    const Expression t = s.variable();
    const Expression u = 4.0 * t - 2.0;
    const Field kink = s.field(s.largest(min(1.0 - abs(u - s.x), s.y - 0.5 * u), {t}));
    const auto sampled = [](auto f) {
        double most = -1e300;
        for (int i = 0; i <= 200000; ++i) most = std::max(most, f(-2 + 4 * i / 200000.0));
        return most;
    };
    const auto check = [&](const Field& field, auto f) {
        const Columns<double> got = agreed(field), points = grid();
        for (std::size_t i = 0; i < points.rows(); i += 7) {
            const double x = points.columns[0][i], y = points.columns[1][i];
            const double most = sampled([&](double v) { return f(x, y, v); });
            CHECK(got.columns[0][i] >= most - 1e-6 * std::max(1.0, std::abs(most)));
            CHECK(got.columns[0][i] <= most + 2e-4);
        }
        CHECK(misses(field, 0.2) == 0);
    };
    check(kink, [](double x, double y, double v) { return std::min(1 - std::abs(v - x), y - 0.5 * v); });
    const Field waves = s.field(s.largest(sin(5.0 * u + s.x) * cos(s.y * u) - 0.1 * square(u), {t}));
    check(waves,
          [](double x, double y, double v) { return std::sin(5 * v + x) * std::cos(y * v) - 0.1 * v * v; });
    const Field lengths = s.field(s.largest(r_or(0.3 - hypot(s.x - u, s.y), 0.2 - abs(s.x + u)), {t}));
    check(lengths, [](double x, double y, double v) {
        const double a = 0.3 - std::hypot(x - v, y), b = 0.2 - std::abs(x + v);
        return a + b + std::hypot(a, b);
    });
}

TEST_CASE("two variables: the sum of two disks") {
    SearchSketch s;
    const Expression u = s.variable(), v = s.variable();
    const Expression a = 4.0 * u - 2.0, b = 4.0 * v - 2.0;
    const Expression f = min(1.0 - hypot(a, b), 0.5 - hypot(s.x - a, s.y - b));
    const Field sum = s.field(s.largest(f, {u, v}, {1e-3, false}));
    const Columns<double> got = agreed(sum), points = grid();
    for (std::size_t i = 0; i < points.rows(); ++i) {
        const double r = std::hypot(points.columns[0][i], points.columns[1][i]);
        const double want = r >= 0.5 ? (1.5 - r) / 2 : 0.5;
        CHECK(std::abs(got.columns[0][i] - want) <= 1.001e-3);
    }
    CHECK(misses(sum, 0.3) == 0);
}

TEST_CASE("the ball of the variables: an offset by a radius") {
    SearchSketch s;
    const Expression u = s.variable(), v = s.variable();
    const Expression f = 1.0 - square(s.x + (2.0 * u - 1.0) * 0.4) - square(s.y + (2.0 * v - 1.0) * 0.4);
    const Field offset = s.field(s.largest(f, {u, v}, {1e-6, true}));
    const auto formula = [](Dual x, Dual y) {
        const Dual r = math::hypot(x, y);
        const Dual out = r.value > 0.4 ? r - Dual(0.4) : Dual(0.0);
        return Dual(1.0) - out * out;
    };
    CHECK(error_against(offset, formula) < 6e-6);  // values down to -5
    CHECK(misses(offset, 0.25) == 0);
}

TEST_CASE("a part without values counts as smaller than any number") {
    SearchSketch s;
    const Expression t = s.variable();
    const Field half = s.field(s.largest(sqrt(s.x - t) - t, {t}));  // largest at t = 0 where x >= 0
    const Columns<double> got = agreed(half), points = grid();
    for (std::size_t i = 0; i < points.rows(); ++i) {
        const double x = points.columns[0][i], f = got.columns[0][i];
        if (x < 0) CHECK(std::isnan(f));
        if (x > 1e-9) CHECK(f == doctest::Approx(std::sqrt(x)));
    }
    CHECK(misses(half, 0.3) == 0);
    const Field nothing = s.field(s.largest(log(t - 2.0), {t}));
    CHECK(std::isnan(agreed(nothing).columns[0][0]));
}

TEST_CASE("searches inside one another") {
    SearchSketch s;
    const Expression t = s.variable(), u = s.variable();
    const Expression inner = s.largest(1.0 - square(s.x - t) - square(s.y - t - 0.5 * u), {u}, {1e-6, false});
    const Field both = s.field(s.largest(inner, {t}, {1e-2, false}));
    REQUIRE(s.error == SearchError::none);
    const Columns<double> got = agreed(both), points = grid();
    for (std::size_t i = 0; i < points.rows(); ++i) {
        const double x = points.columns[0][i], y = points.columns[1][i];
        double most = -1e9;
        for (int k = 0; k <= 1000; ++k) {
            const double v = k / 1000.0, w = std::clamp(2 * (y - v), 0.0, 1.0);
            most = std::max(most, 1 - (x - v) * (x - v) - std::pow(y - v - 0.5 * w, 2));
        }
        CHECK(std::abs(got.columns[0][i] - most) <= 1.1e-2 * std::max(1.0, std::abs(most)));
    }
    CHECK(misses(both, 0.3) == 0);
}

TEST_CASE("a loop that depends on the variable runs in the search") {
    SearchSketch s;
    const Expression t = s.variable();
    Maker m(3);  // while cell 0 >= 0.25: cell 0 -= 0.25, cell 2 += 1
    m.region->inputs = {0, 2};
    const auto on = m.make(Op::less_equal, {m.number(0.25), m.cell(0)});
    m.region->program = {m.loop(on, {m.assign({{0, m.make(Op::sub, {m.cell(0), m.number(0.25)})},
                                               {2, m.make(Op::add, {m.cell(2), m.number(1.0)})}})})};
    const NodeId arguments[] = {s.graph->constant(1), t.id(), s.graph->constant(0)};
    const NodeId region = s.graph->make_region(m.region, arguments);
    const Expression steps{*s.graph, s.graph->make(Op::output, {region}, 2)};
    const Field field = s.field(s.largest(steps - 8.0 * abs(t - 0.55) + s.x, {t}, {1e-2, false}));
    const Columns<double> got = agreed(field), points = grid();
    for (std::size_t i = 0; i < points.rows(); ++i)  // two steps from 1/2 on, best at 0.55
        CHECK(got.columns[0][i] == doctest::Approx(2 + points.columns[0][i]).epsilon(0.02));
    CHECK(misses(field, 0.3) == 0);
}

TEST_CASE("a search that cannot be finished is undefined, and says so") {
    SearchSketch s;
    const Expression t = s.variable(), u = s.variable(), v = s.variable();
    const auto wild = [](Expression e) { return sin(1e6 * e); };
    const Field field =
        s.field(s.largest(wild(t * s.x) + wild(u * 1.7 + s.y) + wild(v + t * u), {t, u, v}, {1e-9, false}));
    Columns<double> point(2, 1);
    point.columns = {{0.3}, {0.4}};
    CHECK(std::isnan(values_of(*engine(field, Engine::vm), point, 1).columns[0][0]));
    const double at[] = {0.3, 0.4};
    CHECK(find_undefined(field, field.value, at, 1000).size() == 1);
    Columns<math::Interval> box(2, 1);
    box.columns = {{{0.3, 0.31}}, {{0.4, 0.41}}};
    CHECK(intervals_of(*engine(field, Engine::vm), box, 1)[0].maybe_undefined);
}

TEST_CASE("what no search can be made of is refused") {
    SearchSketch s;
    const Expression t = s.variable(), u = s.variable();
    const auto refused = [&](Expression f, std::vector<Expression> over, SearchOptions options = {}) {
        s.largest(f, over, options);
        return s.error;
    };
    CHECK(refused(t, {}) == SearchError::variables);
    CHECK(refused(t, {t, t}) == SearchError::variables);
    CHECK(refused(t, {s.x}) == SearchError::variables);
    CHECK(refused(t, {t, u, s.variable(), s.variable()}) == SearchError::variables);
    for (const double tolerance : {0.0, -1.0, 1e-12, 1.0, math::quiet_nan, math::infinity})
        CHECK(refused(t, {t}, {tolerance, false}) == SearchError::tolerance);
    CHECK(s.largest(s.x, {t}) == s.x);
    Expression f = s.x;
    for (int i = 0; i < most_nested_searches; ++i) {
        const Expression v = s.variable();
        f = s.largest(f - v, {v});  // the inner one does not depend on v
    }
    CHECK(s.error == SearchError::none);
    std::vector<Expression> vs;
    for (int i = 0; i <= most_nested_searches; ++i) vs.push_back(s.variable());
    f = s.x;
    for (const Expression& v : vs) f = f - square(v - 0.3);
    for (const Expression& v : vs) f = s.largest(f, {v});
    CHECK(s.error == SearchError::nesting);
    CHECK_FALSE(engine(s.field(t), Engine::vm));  // a variable of no search
    Graph body;
    const NodeId v = make_search_variable(body), cell = body.make(Op::cell, {}, 0);
    const NodeId sum = body.make(Op::add, {v, cell});
    CHECK_FALSE(make_largest(body, sum, {&v, 1}, {}, s.error));
    CHECK(s.error == SearchError::in_loop);
}
