// Parts of fields against the whole: signs at random points of their boxes, roots and gradients on the
// surface; through iso values, maps of coordinates, parts of parts and clones.
#include "frep/eval/narrowed_field.h"

#include <doctest/doctest.h>

#include <cmath>

#include "frep/field/expression.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using frep_test::Random;

namespace {

/// Many balls joined and cut by a wall, so that a small box needs few of them.
Field balls(bool r_functions) {
    auto graph = std::make_shared<Graph>();
    const NodeId x = graph->coordinate(0), y = graph->coordinate(1), z = graph->coordinate(2);
    Random random(11);
    const auto ball = [&] {
        NodeId sum = graph->constant(random.real(0.03, 0.12));
        for (const NodeId axis : {x, y, z}) {
            const NodeId d = graph->make(Op::sub, {axis, graph->constant(random.real(-0.8, 0.8))});
            sum = graph->make(Op::sub, {sum, graph->make(Op::square, {d})});
        }
        return sum;
    };
    NodeId all = ball();
    for (int n = 0; n < 60; ++n) all = graph->make(r_functions ? Op::r_or : Op::max, {all, ball()});
    const NodeId wall = graph->make(Op::sub, {graph->constant(0.6), graph->make(Op::add, {x, y})});
    Field field;
    field.value = graph->make(r_functions ? Op::r_and : Op::min, {all, wall});
    field.graph = graph;
    return field;
}

std::unique_ptr<SampledField> in_space(const Field& field, double iso = 0) {
    auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    auto made = make_sampled_field(std::move(*evaluator), AxisMap::standard(field.coordinates), iso);
    REQUIRE(made);
    return std::move(*made);
}

Box3 random_box(Random& random, double half) {
    const Vec3 c{random.real(-0.8, 0.8), random.real(-0.8, 0.8), random.real(-0.8, 0.8)};
    const Vec3 h{half, half, half};
    return {c - h, c + h};
}

Vec3 random_point(Random& random, const Box3& box) {
    return {random.real(box.min.x, box.max.x), random.real(box.min.y, box.max.y),
            random.real(box.min.z, box.max.z)};
}

struct At {
    double f;
    Vec3 gradient;
};
At at(SampledField& field, Vec3 p) {
    double f = 0, gx = 0, gy = 0, gz = 0;
    field.gradients({{&p.x, 1}, {&p.y, 1}, {&p.z, 1}}, {&f, 1}, {{&gx, 1}, {&gy, 1}, {&gz, 1}});
    double value = 0;
    field.values({{&p.x, 1}, {&p.y, 1}, {&p.z, 1}}, {&value, 1});
    CHECK(value == f);
    return {f, {gx, gy, gz}};
}

int sign(double f) { return f > 0 ? 1 : f < 0 ? -1 : 0; }

/// Signs at random points of the box; at a root between two of them the gradient. Counts the roots.
int compare(SampledField& whole, SampledField& part, const Box3& box, Random& random) {
    int roots = 0;
    for (int n = 0; n < 40; ++n) {
        Vec3 a = random_point(random, box), b = random_point(random, box);
        const double fa = at(whole, a).f, fb = at(whole, b).f;
        CHECK(sign(at(part, a).f) == sign(fa));
        CHECK(sign(at(part, b).f) == sign(fb));
        if (sign(fa) * sign(fb) >= 0) continue;
        for (int k = 0; k < 60; ++k) {
            const Vec3 m = (a + b) * 0.5;
            (sign(at(part, m).f) == sign(fa) ? a : b) = m;
        }
        const At w = at(whole, a), p = at(part, a);
        const double size = length(w.gradient);
        CHECK(std::fabs(w.f) < 1e-13 * (1 + size));
        CHECK(length(w.gradient - p.gradient) < 1e-6 * size);
        ++roots;
    }
    return roots;
}

void check_parts(const Field& field, double iso) {
    const auto whole = in_space(field, iso);
    Random random(3);
    int parts_seen = 0, roots = 0;
    for (int round = 0; round < 12; ++round) {
        std::vector<Box3> boxes;
        for (int n = 0; n < 21; ++n) boxes.push_back(random_box(random, 0.1));
        std::vector<SignRange> ranges(boxes.size()), plain(boxes.size());
        std::vector<std::shared_ptr<SampledField>> parts(boxes.size());
        whole->narrow(boxes, ranges, parts);
        whole->ranges(boxes, plain);
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            if (!parts[b]) continue;
            ++parts_seen;
            roots += compare(*whole, *parts[b], boxes[b], random);
            const Vec3 c = random_point(random, boxes[b]), h{0.01, 0.01, 0.01};
            const Box3 small{{std::max(c.x - h.x, boxes[b].min.x), std::max(c.y - h.y, boxes[b].min.y),
                              std::max(c.z - h.z, boxes[b].min.z)},
                             c};
            SignRange range;
            std::shared_ptr<SampledField> part;
            const auto copy = parts[b]->clone();
            copy->narrow({&small, 1}, {&range, 1}, {&part, 1});
            if (part) compare(*whole, *part, small, random);
        }
    }
    CHECK(parts_seen > 50);
    CHECK(roots > 50);
}

}  // namespace

TEST_CASE("parts of a union of balls stand for it in their boxes") {
    for (const bool r_functions : {false, true}) check_parts(balls(r_functions), 0);
}

TEST_CASE("parts of a shifted field") { check_parts(balls(false), 0.01); }

TEST_CASE("a field without clauses narrows to itself") {
    const auto evaluator = make_evaluator(balls(true), {.engine = Engine::reference});
    REQUIRE(evaluator);
    CHECK((*evaluator)->clauses() == nullptr);
    auto copy = (*evaluator)->clone();
    const auto whole = make_sampled_field(std::move(copy), AxisMap::standard(3));
    REQUIRE(whole);
    const Box3 box = Box3::cube(0.2);
    SignRange range;
    std::shared_ptr<SampledField> part;
    (*whole)->narrow({&box, 1}, {&range, 1}, {&part, 1});
    CHECK(!part);
    CHECK((range.can_be_inside || range.can_be_outside));
}

TEST_CASE("a frozen coordinate and one axis that feeds two") {
    Field field = balls(true);
    auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    AxisMap map;
    map.coordinates = {{.axis = 0, .value = 0}, {.axis = -1, .value = 0.1}, {.axis = 0, .value = 0}};
    const auto whole = make_sampled_field(std::move(*evaluator), map);
    REQUIRE(whole);
    Random random(5);
    int parts_seen = 0;
    for (int n = 0; n < 60; ++n) {
        const Box3 box = random_box(random, 0.05);
        SignRange range;
        std::shared_ptr<SampledField> part;
        (*whole)->narrow({&box, 1}, {&range, 1}, {&part, 1});
        if (!part) continue;
        ++parts_seen;
        compare(**whole, *part, box, random);
    }
    CHECK(parts_seen > 3);
}

TEST_CASE("ranges of sums over many skeletons are dear, those of set operations are not") {
    CHECK(!has_dear_ranges(*make_clause_tape(balls(true))));
    for (const int blobs : {3, 60}) {
        auto graph = std::make_shared<Graph>();
        const NodeId axes[3] = {graph->coordinate(0), graph->coordinate(1), graph->coordinate(2)};
        std::vector<NodeId> data;
        for (int n = 0; n < 5 * blobs; ++n) data.push_back(graph->constant(0.01 * n));
        Field field;
        field.value = graph->make_block(Op::blobby, axes, data);
        field.graph = graph;
        CHECK(has_dear_ranges(*make_clause_tape(field)) == (blobs > 10));
    }
}
