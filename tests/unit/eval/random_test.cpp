// Random fields through all engines: the same bits for values and gradients, and no value outside its
// interval.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "frep/eval/reference.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

constexpr std::int64_t max_steps = 60;

Columns<double> random_points(Random& random, int coordinates, std::size_t rows) {
    Columns<double> points(static_cast<std::size_t>(coordinates), rows);
    for (auto& column : points.columns)
        for (double& x : column) x = random_coordinate(random);
    return points;
}

RandomOptions options_for(std::uint64_t seed) {
    RandomOptions options;
    options.operations = 3 + static_cast<int>(seed % 40);
    options.coordinates = static_cast<int>(seed % 7) == 6 ? static_cast<int>(seed % 13) : 3;
    return options;
}

/// Corners and random points of a box.
double point_of(Random& random, const math::Interval& side) {
    switch (random.below(4)) {
        case 0:
            return side.lo;
        case 1:
            return side.hi;
        default: {
            const double x = side.lo + (side.hi - side.lo) * random.real(0, 1);
            return x >= side.lo && x <= side.hi ? x : side.lo;
        }
    }
}

math::Interval random_side(Random& random) {
    double a = random_coordinate(random),
           b = random.chance(70) ? a + random.real(-0.5, 0.5) : random_coordinate(random);
    if (a != a) a = 0;
    if (b != b) b = a;
    return a <= b ? math::Interval(a, b) : math::Interval(b, a);
}

bool holds(const math::Interval& range, double value) {
    return value != value ? range.maybe_undefined : range.contains(value);
}

/// The operation whose value is outside its interval although those of its arguments are inside theirs.
std::string culprit(const Field& field, std::span<const math::Interval> box, std::span<const double> point) {
    GraphWalk<double> values(field, {&field.value, 1}, max_steps);
    GraphWalk<math::Interval> ranges(field, {&field.value, 1}, max_steps);
    values.run(point);
    ranges.run(box);
    const std::vector<bool> needed = reachable(*field.graph, {&field.value, 1});
    for (NodeId id = 0; id < needed.size(); ++id) {
        const Op op = field.graph->node(id).op;
        if (needed[id] && op != Op::region && !holds(ranges.value(id), values.value(id)))
            return std::string(info(op).name);
    }
    return "none";
}

using Culprits = std::map<std::string, std::size_t>;

/// Boxes of one field against values inside; returns the violations and counts the operations at fault.
std::size_t check_boxes(const Field& field, Random& random, std::size_t count, Culprits& culprits) {
    constexpr std::size_t inside = 8;
    const auto reference = engine(field, Engine::reference, 0, max_steps);
    const auto vm = engine(field, Engine::vm, 0, max_steps);
    const auto n = static_cast<std::size_t>(field.coordinates);
    Columns<math::Interval> boxes(n, count);
    Columns<double> points(n, count * inside);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t b = 0; b < count; ++b) {
            boxes.columns[i][b] = random_side(random);
            for (std::size_t k = 0; k < inside; ++k)
                points.columns[i][b * inside + k] = point_of(random, boxes.columns[i][b]);
        }
    }
    const auto expected = intervals_of(*reference, boxes, count);
    const auto got = intervals_of(*vm, boxes, count);
    const auto values = values_of(*vm, points, count * inside);
    std::size_t wrong = 0;
    for (std::size_t b = 0; b < count; ++b) {
        wrong += !same(expected[b], got[b]);
        for (std::size_t k = 0; k < inside; ++k) {
            const double value = values.columns[0][b * inside + k];
            if (holds(got[b], value)) continue;
            ++wrong;
            std::vector<math::Interval> box;
            std::vector<double> point;
            for (std::size_t i = 0; i < n; ++i) {
                box.push_back(boxes.columns[i][b]);
                point.push_back(points.columns[i][b * inside + k]);
            }
            ++culprits[culprit(field, box, point)];
        }
    }
    return wrong;
}

}  // namespace

TEST_CASE("random fields give the same bits in every engine") {
    const std::size_t graphs = 3000 * scale(20);
    std::size_t wrong_values = 0, wrong_gradients = 0, not_finite = 0, defined = 0, total = 0;
    for (std::uint64_t seed = 0; seed < graphs; ++seed) {
        RandomField maker(seed, options_for(seed));
        const Field field = maker.make();
        Random random(seed + 77);
        const std::size_t rows = 1 + random.below(seed % 50 == 0 ? 700 : 40);
        const Columns<double> points = random_points(random, field.coordinates, rows);
        const auto reference = engine(field, Engine::reference, 0, max_steps);
        REQUIRE(reference);
        const Columns<double> expected = values_of(*reference, points, rows);
        const Columns<double> expected_gradients = gradients_of(*reference, points, rows);
        for (const int registers : {0, 3, 5}) {
            const auto vm = engine(field, Engine::vm, registers, max_steps);
            REQUIRE(vm);
            const std::size_t values = differences(expected, values_of(*vm, points, rows));
            const std::size_t gradients = differences(expected_gradients, gradients_of(*vm, points, rows));
            if (values + gradients > 0 && wrong_values + wrong_gradients == 0)
                MESSAGE("seed ", seed, " registers ", registers, ": ", values, " values, ", gradients,
                        " gradients differ");
            wrong_values += values;
            wrong_gradients += gradients;
        }
        for (std::size_t p = 0; p < rows; ++p) {
            const double f = expected.columns[0][p];
            ++total;
            defined += f == f;
            wrong_values += !same(f, expected_gradients.columns[0][p]);
            if (!(f - f == 0)) continue;
            for (std::size_t i = 1; i < expected_gradients.columns.size(); ++i) {
                const double d = expected_gradients.columns[i][p];
                not_finite += !(d - d == 0);
            }
        }
    }
    CHECK(wrong_values == 0);
    CHECK(wrong_gradients == 0);
    CHECK(not_finite == 0);
    MESSAGE(graphs, " graphs, ", total, " points, defined at ", defined);
    CHECK(defined * 4 > total);
}

TEST_CASE("no value of a random field lies outside its interval") {
    const std::size_t pairs = 100'000 * scale(100);
    constexpr std::size_t boxes = 50;
    std::size_t wrong = 0;
    Culprits culprits;
    for (std::uint64_t seed = 0; seed * boxes < pairs; ++seed) {
        RandomField maker(seed + 500'000'000, options_for(seed));
        const Field field = maker.make();
        Random random(seed + 4711);
        wrong += check_boxes(field, random, boxes, culprits);
    }
    for (const auto& [name, count] : culprits) MESSAGE(name, ": ", count, " values outside");
    CHECK(wrong == 0);
}

TEST_CASE("a clone computes what its original computes") {
    RandomField maker(12, {});
    const Field field = maker.make();
    Random random(5);
    const Columns<double> points = random_points(random, field.coordinates, 333);
    for (const Engine which : {Engine::reference, Engine::vm}) {
        const auto original = engine(field, which);
        const auto copy = original->clone();
        CHECK(differences(values_of(*original, points, 333), values_of(*copy, points, 333)) == 0);
    }
}
