// Tests of eval/region_interval.h: enclosures of hand-made regions are what a look at them says; those of
// random programs hold every sampled value; both engines give the same bits; work is bounded.
#include "frep/eval/region_interval.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "frep/frep.h"
#include "support/random_program.h"
#include "unit/eval/engines.h"
#include "unit/eval/region_maker.h"

using namespace frep;
using namespace frep_test;
using math::Interval;

namespace {

/// The enclosure over a box, the same from both engines.
Interval enclosure(const Field& field, std::vector<Interval> box, std::int64_t max_steps = 1'000'000) {
    Columns<Interval> column(box.size(), 1);
    for (std::size_t i = 0; i < box.size(); ++i) column.columns[i][0] = box[i];
    const Interval reference = intervals_of(*engine(field, Engine::reference, 0, max_steps), column, 1)[0];
    const Interval vm = intervals_of(*engine(field, Engine::vm, 0, max_steps), column, 1)[0];
    CHECK(same(reference, vm));
    return reference;
}

bool is(const Interval& got, double lo, double hi, bool maybe_undefined = false) {
    return got.lo == lo && got.hi == hi && got.maybe_undefined == maybe_undefined;
}

bool knows_nothing(const Interval& got) { return is(got, -math::infinity, math::infinity, true); }

}  // namespace

TEST_CASE("a loop that takes the same number of steps for all points is exact") {
    Maker m = mandelbrot(50);
    const Field steps = field_of(m, 4);
    CHECK(is(enclosure(steps, {{2.5, 2.6}, {0, 0.1}}), 1, 1));
    CHECK(is(enclosure(steps, {{-0.01, 0.01}, {-0.01, 0.01}}), 50, 50));
    CHECK(is(enclosure(steps, {{-1.01, -0.99}, {-0.001, 0.001}}), 50, 50));
}

TEST_CASE("a loop that takes different numbers of steps joins what leaves") {
    Maker m = mandelbrot(50);
    const Field steps = field_of(m, 4);
    const Interval some = enclosure(steps, {{1.9, 2.1}, {0, 0.05}});
    CHECK(is(some, 1, 2));
    const Interval all = enclosure(steps, {{-2, 2}, {-2, 2}});
    CHECK(is(all, 1, 50));
}

TEST_CASE("a condition narrows what it reads, on both sides") {
    Maker m(3);  // if x^2 + abs(y) < 4 and y < 1 : r = x, else r = 10 + y
    const NodeId sum = m.make(Op::add, {m.make(Op::square, {m.cell(0)}), m.make(Op::abs, {m.cell(1)})});
    const NodeId within = m.make(Op::logical_and, {m.make(Op::less, {sum, m.number(4.0)}),
                                                   m.make(Op::less, {m.cell(1), m.number(1.0)})});
    m.region->program = {m.branch(within, {m.assign({{2, m.cell(0)}})},
                                  {m.assign({{2, m.make(Op::add, {m.cell(1), m.number(10.0)})}})})};
    const Interval got = enclosure(field_of(m, 2), {{-50, 50}, {-0.5, 0.5}});
    CHECK(got.lo == doctest::Approx(-2));
    CHECK(got.hi == doctest::Approx(10.5));
    const Interval right = enclosure(field_of(m, 2), {{3, 50}, {2, 3}});
    CHECK(right.lo == doctest::Approx(12));
}

namespace {

/// A random expression over the first two cells, or a random condition.
struct RandomExpression {
    Maker& maker;
    test::RandomProgram& random;

    NodeId value(int depth) {
        if (depth == 0 || random.pick(5) == 0)
            return random.pick(4) == 0 ? maker.number(random.number()) : maker.cell(random.pick(2) ? 1u : 0u);
        switch (random.pick(8)) {
            case 0:
            case 1:
                return maker.make(Op::add, {value(depth - 1), value(depth - 1)});
            case 2:
                return maker.make(Op::sub, {value(depth - 1), value(depth - 1)});
            case 3:
                return maker.make(Op::neg, {value(depth - 1)});
            case 4:
                return maker.make(Op::square, {value(depth - 1)});
            case 5:
                return maker.make(Op::pow, {value(depth - 1), maker.number(2.0)});
            case 6:
                return maker.make(Op::sqrt, {value(depth - 1)});
            default:
                return maker.make(Op::abs, {value(depth - 1)});
        }
    }
    NodeId condition(int depth) {
        const int kind = random.pick(depth > 0 ? 6 : 2);
        if (kind < 2) return maker.make(kind ? Op::less : Op::less_equal, {value(3), value(2)});
        if (kind == 2) return maker.make(Op::logical_not, {condition(depth - 1)});
        return maker.make(kind == 3 ? Op::logical_or : Op::logical_and,
                          {condition(depth - 1), condition(depth - 1)});
    }
};

/// The number of sampled values outside of the enclosure.
std::size_t misses(const Field& field, test::RandomProgram& random) {
    constexpr std::size_t samples = 64;
    std::vector<Interval> box;
    Columns<double> points(2, samples);
    for (std::size_t i = 0; i < 2; ++i) {
        const double low = random.number(), width = random.pick(5) * 0.7;
        box.emplace_back(low, low + width);
        for (std::size_t p = 0; p < samples; ++p)
            points.columns[i][p] = std::min(low + width * random.pick(17) / 16.0, low + width);
    }
    const Interval got = enclosure(field, box);
    const auto vm = engine(field, Engine::vm);
    std::size_t count = 0;
    const Columns<double> values = values_of(*vm, points, samples);
    for (const double v : values.columns[0]) count += v == v ? !got.contains(v) : !got.maybe_undefined;
    return count;
}

}  // namespace

TEST_CASE("narrowing keeps every point, for random conditions and assignments before them") {
    const std::size_t count = std::max<std::size_t>(4000, scale(200'000));
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        CAPTURE(seed);
        test::RandomProgram random(seed);
        Maker m(4);
        RandomExpression expressions{m, random};
        const NodeId condition = expressions.condition(2);
        NodeId tested = condition;
        std::vector<std::uint32_t> program;
        if (seed % 2) {  // the condition is a cell, assigned together with new contents of the other cells
            std::vector<std::pair<std::uint32_t, NodeId>> assignments{{2, condition}};
            if (random.pick(3)) assignments.emplace_back(0, expressions.value(2));
            if (random.pick(3)) assignments.emplace_back(1, expressions.value(2));
            program.push_back(m.assign(assignments));
            tested = m.cell(2);
        }
        const auto keep = [&](std::uint32_t cell) { return m.assign({{3, m.cell(cell)}}); };
        program.push_back(
            m.branch(tested, {keep(random.pick(2) ? 1u : 0u)}, {keep(random.pick(2) ? 1u : 0u)}));
        m.region->program = program;
        CHECK(misses(field_of(m, 3), random) == 0);
    }
}

TEST_CASE("an escape loop written in HyperFun is pruned") {
    const char* const text =
        "my_model(x[3], a[1]) { p = x[1]; q = x[2]; r = x[3]; w = 0; i = 0; n = p^2 + q^2 + r^2 + w^2;"
        " while i < 40 and n < 16 loop t = p^2 - q^2 - r^2 - w^2 - 0.2; q = 2*p*q + 0.8; r = 2*p*r;"
        " w = 2*p*w; p = t; n = p^2 + q^2 + r^2 + w^2; i = i + 1; endloop; my_model = 4 - n; }";
    const auto field = Model(Source("julia.hf", text)).field();
    REQUIRE(static_cast<bool>(field));
    REQUIRE(has_regions(*field));
    const auto outside = [&](const Interval& part) { return part.hi < 0 && !part.maybe_undefined; };
    CHECK(outside(enclosure(*field, {{3, 3.5}, {0, 0.5}, {-0.5, 0.5}})));
    CHECK(outside(enclosure(*field, {{-0.1, 0.1}, {1.6, 1.8}, {-0.1, 0.1}})));
    ContourOptions options;
    options.bounds = Box3::cube(4);
    options.cells = 64;
    const auto pruned = contour(*field, options);
    options.prune = false;
    const auto full = contour(*field, options);
    REQUIRE(static_cast<bool>(pruned));
    REQUIRE(static_cast<bool>(full));
    CHECK(pruned->sampled_blocks * 5 < full->sampled_blocks);
    CHECK(pruned->mesh.vertices == full->mesh.vertices);
    CHECK(pruned->mesh.triangles == full->mesh.triangles);
}

TEST_CASE("branches: one side where the condition is decided, both joined where it is not") {
    Maker m(3);  // if x < 0 : r = 1 + y, else r = 5
    const auto negative = m.make(Op::less, {m.cell(0), m.number(0.0)});
    m.region->program = {m.branch(negative, {m.assign({{2, m.make(Op::neg, {m.cell(1)})}})},
                                  {m.assign({{2, m.number(5.0)}})})};
    const Field field = field_of(m, 2);
    CHECK(is(enclosure(field, {{-2, -1}, {3, 4}}), -4, -3));
    CHECK(is(enclosure(field, {{0, 1}, {3, 4}}), 5, 5));
    CHECK(is(enclosure(field, {{-1, 1}, {3, 4}}), -4, 5));
    Maker n(3);  // a side that writes nothing keeps the old content, undefined here
    n.region->program = {
        n.branch(n.make(Op::less, {n.cell(0), n.number(0.0)}), {n.assign({{2, n.number(1.0)}})}, {})};
    const Field half = field_of(n, 2);
    CHECK(is(enclosure(half, {{-2, -1}, {0, 0}}), 1, 1));
    CHECK(is(enclosure(half, {{-1, 1}, {0, 0}}), 1, 1, true));
    CHECK(enclosure(half, {{1, 2}, {0, 0}}).is_empty());
}

TEST_CASE("undefined conditions make the whole region undefined") {
    Maker m(3);  // r = y; if sqrt(x) : r = 1
    const auto one = m.assign({{2, m.number(1.0)}});
    m.region->program = {m.assign({{2, m.cell(1)}}), m.branch(m.make(Op::sqrt, {m.cell(0)}), {one}, {})};
    const Field y = field_of(m, 1);
    CHECK(enclosure(y, {{-2, -1}, {3, 4}}).is_empty());
    CHECK(is(enclosure(y, {{-2, 1}, {3, 4}}), 3, 4, true));
    CHECK(is(enclosure(y, {{1, 2}, {3, 4}}), 3, 4));
    CHECK(is(enclosure(field_of(m, 2), {{1, 2}, {3, 4}}), 1, 1));
    Maker n(2);  // while sqrt(x) : x = x - 1
    const auto less = n.assign({{0, n.make(Op::sub, {n.cell(0), n.number(1.0)})}});
    n.region->program = {n.loop(n.make(Op::sqrt, {n.cell(0)}), {less})};
    CHECK(enclosure(field_of(n, 1), {{0.5, 0.75}, {3, 4}}).is_empty());
    CHECK(is(enclosure(field_of(n, 1), {{2, 2}, {3, 4}}), 3, 4));
    CHECK(is(enclosure(field_of(n, 1), {{0.5, 2}, {3, 4}}), 3, 4, true));
}

TEST_CASE("the guard") {
    for (const double guard : {0.0, 1e-7, math::quiet_nan}) {
        Maker m(2);
        CHECK(enclosure(field_of(m, 1, guard), {{0, 1}, {3, 4}}).is_empty());
    }
    Maker m(2);
    CHECK(is(enclosure(field_of(m, 1, -1.0), {{0, 1}, {3, 4}}), 3, 4));
    auto graph = std::make_shared<Graph>();  // the guard differs from point to point
    Maker n(2);
    n.region->inputs = {0};
    const NodeId arguments[2] = {graph->make(Op::less, {graph->constant(0.0), graph->coordinate(0)}),
                                 graph->coordinate(1)};
    Field field;
    field.coordinates = 2;
    field.value = graph->make(Op::output, {graph->make_region(n.region, arguments)}, 0);
    field.graph = graph;
    CHECK(is(enclosure(field, {{1, 2}, {3, 4}}), 3, 4));
    CHECK(is(enclosure(field, {{-1, 2}, {3, 4}}), 3, 4, true));
    CHECK(enclosure(field, {{-2, -1}, {3, 4}}).is_empty());
}

TEST_CASE("arrays: one item is replaced, of several each may be") {
    Maker m(6);  // cells 2..4 are the array, 5 the result: q = 10, 20, 30; q[x] = 7; r = q[y]
    m.region->arrays = {{2, 3}};
    m.region->program = {m.assign({{2, m.number(10.0)}, {3, m.number(20.0)}, {4, m.number(30.0)}}),
                         m.store(0, m.cell(0), m.number(7.0)), m.assign({{5, m.load(0, m.cell(1))}})};
    const Field field = field_of(m, 5);
    CHECK(is(enclosure(field, {{1.6, 2.4}, {2, 2}}), 7, 7));
    CHECK(is(enclosure(field, {{1.6, 2.4}, {1, 1}}), 10, 10));
    CHECK(is(enclosure(field, {{2, 2}, {1, 3}}), 7, 30));
    CHECK(is(enclosure(field, {{1, 2}, {2, 2}}), 7, 20));
    CHECK(is(enclosure(field, {{1, 2}, {3, 3}}), 30, 30));
    CHECK(is(enclosure(field, {{2, 2}, {3, 5}}), 30, 30, true));  // the load may leave
    CHECK(is(enclosure(field, {{3, 5}, {1, 1}}), 10, 10, true));  // the store may leave
    CHECK(is(enclosure(field, {{0, 5}, {1, 1}}), 7, 10, true));
    CHECK(enclosure(field, {{4, 5}, {1, 1}}).is_empty());
    CHECK(enclosure(field, {{1, 2}, {-3, 0.4}}).is_empty());
}

TEST_CASE("steps: none too many, some too many, all too many") {
    Maker m(3);  // while x > 0 : x = x - 1; r = y
    const auto down = m.assign({{0, m.make(Op::sub, {m.cell(0), m.number(1.0)})}});
    m.region->program = {m.loop(m.make(Op::less, {m.number(0.0), m.cell(0)}), {down})};
    const Field field = field_of(m, 1);
    CHECK(is(enclosure(field, {{9.5, 9.75}, {3, 4}}, 10), 3, 4));
    CHECK(is(enclosure(field, {{9.5, 10.5}, {3, 4}}, 10), 3, 4, true));
    CHECK(enclosure(field, {{11.5, 12.5}, {3, 4}}, 10).is_empty());
}

TEST_CASE("work is bounded: too many steps, undecided conditions or cells answer that nothing is known") {
    Maker endless(2);
    endless.region->program = {endless.loop(endless.number(1.0), {endless.assign({{0, endless.cell(0)}})})};
    CHECK(knows_nothing(enclosure(field_of(endless, 1), {{0, 1}, {3, 4}})));
    Maker undecided(3);  // while x < y : x = x + 0
    const auto same_again =
        undecided.assign({{0, undecided.make(Op::min, {undecided.cell(0), undecided.cell(0)})}});
    undecided.region->program = {
        undecided.loop(undecided.make(Op::less, {undecided.cell(0), undecided.cell(1)}), {same_again})};
    CHECK(knows_nothing(enclosure(field_of(undecided, 1), {{0, 2}, {1, 3}})));
    Maker wide(IntervalRegion::cell_limit + 1);
    CHECK(knows_nothing(enclosure(field_of(wide, 1), {{0, 1}, {3, 4}})));
    Maker within(IntervalRegion::cell_limit);
    CHECK(is(enclosure(field_of(within, 1), {{0, 1}, {3, 4}}), 3, 4));
}

namespace {

/// What the sampled boxes of one program came to.
struct Tally {
    std::size_t boxes = 0, wrong = 0, informative = 0;
};

/// Boxes of several sizes; values at their corners and at points inside lie in the enclosures of both
/// engines.
void check_program(const Field& field, test::RandomProgram& random, int boxes, Tally& tally) {
    constexpr std::size_t samples = 24;
    const auto reference = engine(field, Engine::reference);
    const auto vm = engine(field, Engine::vm);
    REQUIRE(reference);
    REQUIRE(vm);
    for (int b = 0; b < boxes; ++b) {
        Columns<Interval> box(3, 1);
        Columns<double> points(3, samples);
        const double width = b % 4 == 0 ? 0 : b % 4 == 1 ? 1e-3 : b % 4 == 2 ? 0.25 : 2;
        for (std::size_t i = 0; i < 3; ++i) {
            const double low = random.number() + random.number() / 64;
            box.columns[i][0] = {low, low + width};
            for (std::size_t p = 0; p < samples; ++p) {
                const double share = p < 8 ? static_cast<double>((p >> i) & 1u) : random.pick(1025) / 1024.0;
                points.columns[i][p] = std::min(low + width * share, low + width);
            }
        }
        const Interval got = intervals_of(*vm, box, 1)[0];
        ++tally.boxes;
        tally.wrong += !same(got, intervals_of(*reference, box, 1)[0]);
        tally.informative += got.lo > -math::infinity || got.hi < math::infinity || !got.maybe_undefined;
        const Columns<double> values = values_of(*vm, points, samples);
        for (const double v : values.columns[0])
            tally.wrong += v == v ? !got.contains(v) : !got.maybe_undefined;
    }
}

}  // namespace

TEST_CASE("random programs: every sampled value lies in the enclosure") {
    Tally tally;
    const std::size_t wanted = std::max<std::size_t>(20'000, scale(1'000'000));
    for (std::uint64_t seed = 1; tally.boxes < wanted; ++seed) {
        test::RandomProgram program(seed);
        const Model model(Source("random.hf", program.text()));
        Diagnostics found;
        const auto lowered = model.lower(*model.find_object(""), {0.75, -0.5}, found);
        REQUIRE(static_cast<bool>(lowered));
        Field field = lowered->field;
        field.attributes.clear();
        if (!has_regions(field)) continue;
        const std::size_t wrong = tally.wrong;
        test::RandomProgram random(seed + 77);
        check_program(field, random, 8, tally);
        CAPTURE(seed);
        CHECK(tally.wrong == wrong);
    }
    CHECK(tally.wrong == 0);
    CHECK(tally.informative * 2 > tally.boxes);
}
