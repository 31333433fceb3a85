// Pruner::cut_near() and SampledField::narrow_signs(): what is left out of sums stays within the error that
// is given back, and signs are those of the whole field at every point, also next to the surface.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/eval/batch_vm.h"
#include "frep/eval/sampled_field.h"
#include "unit/eval/blobs.h"
#include "unit/eval/engines.h"
#include "unit/eval/prune_models.h"

using namespace frep;
using frep_test::blobs;
using frep_test::blobs_in;
using frep_test::Random;

namespace {

/// F at one point by a tape.
double value_at(const ClauseTape& tape, const std::array<double, 3>& p) {
    BatchVm<double> vm;
    const std::array<const double*, 3> columns{&p[0], &p[1], &p[2]};
    double value = 0;
    vm.values(tape, columns, 1, &value);
    return value;
}

BoxLanes small_boxes(Random& random, double half) {
    BoxLanes boxes;
    boxes.count = tile_lanes;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < tile_lanes; ++k) {
            const double c = random.real(-0.7, 0.7);
            boxes.lo[i][k] = c - half;
            boxes.hi[i][k] = c + half;
        }
    return boxes;
}

/// A ball cut out of one sum, joined with another by R-functions, scaled and turned inside out.
Field blobs_in_a_tree() {
    auto graph = std::make_shared<Graph>();
    const NodeId a = blobs_in(*graph, 3, 40, 0.6, 0.4), b = blobs_in(*graph, 4, 40, 0.6, 0.6);
    NodeId ball = graph->constant(0.3);
    for (int i = 0; i < 3; ++i)
        ball = graph->make(Op::sub, {ball, graph->make(Op::square, {graph->coordinate(i)})});
    const NodeId cut = graph->make(Op::max, {graph->make(Op::neg, {a}), ball});
    const NodeId third = graph->make(Op::mul, {b, graph->constant(-3)});
    Field field;
    field.value = graph->make(Op::r_and, {cut, graph->make(Op::abs, {third})});
    field.graph = std::move(graph);
    return field;
}

struct Count {
    std::size_t clauses = 0, tapes = 0, points = 0, near_points = 0;
};

/// Compares the tapes with terms left out with the field; with its values if nothing else can go.
Count check_errors(const Field& field, std::uint64_t seed, double share, bool sums_only) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape);
    Random random(seed);
    Pruner pruner;
    Count count;
    for (int round = 0; round < 10; ++round) {
        const BoxLanes boxes = small_boxes(random, 0.04);
        CutResult near;
        RangeLanes ranges;
        const double error = pruner.cut_near(*tape, boxes, share, near);
        pruner.ranges(*tape, boxes, ranges);
        for (std::size_t k = 0; k < tile_lanes; ++k) {
            CHECK((near.tape_of[k] == CutResult::none) == ((ranges.open() >> k & 1u) == 0));
            if (near.tape_of[k] < 0) continue;
            const ClauseTape& cut = near.tapes[static_cast<std::size_t>(near.tape_of[k])];
            count.clauses += cut.clauses.size();
            ++count.tapes;
            for (int n = 0; n < 20; ++n) {
                std::array<double, 3> p{};
                for (std::size_t i = 0; i < 3; ++i) p[i] = random.real(boxes.lo[i][k], boxes.hi[i][k]);
                const double g = value_at(cut, p), f = value_at(*tape, p);
                if (sums_only) CHECK(std::fabs(g - f) <= error);
                ++count.points;
                if (g != f) ++count.near_points;
                if (std::fabs(g) > error) CHECK((g >= 0) == (f >= 0));
            }
        }
    }
    return count;
}

int sign(double f) { return f > 0 ? 1 : f < 0 ? -1 : 0; }

double value_at(SampledField& field, Vec3 p) {
    double f = 0;
    field.values({{&p.x, 1}, {&p.y, 1}, {&p.z, 1}}, {&f, 1});
    return f;
}

}  // namespace

TEST_CASE("terms left out of sums stay within the error") {
    for (const double share : {0x1p-9, 0x1p-3}) {
        const Count plain = check_errors(blobs(1, 60), 5, share, true);
        CHECK(plain.tapes > 20);
        CHECK(plain.near_points * 2 > plain.points);
        const std::size_t whole = make_clause_tape(blobs(1, 60))->clauses.size();
        CHECK(plain.clauses / plain.tapes < whole / 2);
        const Count tree = check_errors(blobs_in_a_tree(), 6, share, false);
        CHECK(tree.tapes > 20);
        CHECK(tree.near_points * 4 > tree.points);
    }
}

TEST_CASE("nothing is left out where it cannot be bounded") {
    auto graph = std::make_shared<Graph>();
    const NodeId x = graph->coordinate(0), tiny = graph->make(Op::mul, {x, graph->constant(1e-9)});
    Field field;
    // the operand of a root has no bounded weight
    field.value = graph->make(
        Op::sub, {graph->make(Op::sqrt, {graph->make(Op::add, {graph->make(Op::abs, {x}), tiny})}),
                  graph->constant(0.1)});
    field.graph = graph;
    const Count count = check_errors(field, 7, 0.5, true);
    CHECK(count.near_points == 0);
}

TEST_CASE("signs without small terms are those of the field") {
    for (const Field& field : {blobs(1, 60), blobs_in_a_tree()}) {
        auto evaluator = make_evaluator(field);
        REQUIRE(evaluator);
        auto whole = make_sampled_field(std::move(*evaluator), AxisMap::standard(3), 0.01);
        REQUIRE(whole);
        Random random(8);
        int seen = 0, roots = 0;
        for (int round = 0; round < 8; ++round) {
            std::vector<FieldPart> parts;
            for (int n = 0; n < 20; ++n) {
                const Vec3 c{random.real(-0.6, 0.6), random.real(-0.6, 0.6), random.real(-0.6, 0.6)};
                parts.push_back({{c - Vec3{0.04, 0.04, 0.04}, c + Vec3{0.04, 0.04, 0.04}}, nullptr});
            }
            std::vector<SignRange> ranges(parts.size());
            std::vector<std::shared_ptr<SampledField>> near(parts.size());
            narrow_parts(**whole, parts, ranges);
            narrow_signs(**whole, parts, near);
            for (std::size_t b = 0; b < parts.size(); ++b) {
                if (!near[b]) continue;
                ++seen;
                const Box3& box = parts[b].box;
                const std::unique_ptr<SampledField> copy = near[b]->clone();
                const auto at = [&] {
                    return Vec3{random.real(box.min.x, box.max.x), random.real(box.min.y, box.max.y),
                                random.real(box.min.z, box.max.z)};
                };
                for (int n = 0; n < 20; ++n) {
                    Vec3 p = at(), q = at();
                    const int sp = sign(value_at(**whole, p)), sq = sign(value_at(**whole, q));
                    CHECK(sign(value_at(*near[b], p)) == sp);
                    if (sp * sq >= 0) continue;
                    ++roots;
                    for (int k = 0; k < 60; ++k) {
                        const Vec3 m = (p + q) * 0.5;
                        const int s = sign(value_at(**whole, m));
                        CHECK(sign(value_at(*copy, m)) == s);
                        (s == sp ? p : q) = m;
                    }
                }
            }
        }
        CHECK(seen > 20);
        CHECK(roots > 20);
    }
}
