// Ranges of noise, sums over skeletons and Bezier volumes, sixteen boxes at a time: they hold what engines of
// both profiles compute, they are about as narrow as general intervals, and no instruction set differs.
#include <doctest/doctest.h>

#include "frep/eval/prune.h"
#include "unit/eval/engines.h"
#include "unit/eval/prune_models.h"

using namespace frep;
using namespace frep_test;

namespace {

constexpr Op lane_ops[] = {Op::lattice_noise, Op::blobby,     Op::metaball,  Op::soft,
                           Op::fitted_blob,   Op::conv_point, Op::conv_line, Op::bezier_volume};

/// One term of a sum, now and then one that counts nothing.
void add_term(Op op, Random& random, std::vector<double>& data) {
    const auto place = [&] { return random.chance(20) ? random.plain(2) : random.real(-2, 2); };
    for (int i = 0; i < 3; ++i) data.push_back(place());
    switch (op) {
        case Op::blobby:
            data.push_back(random.real(0, 20));
            data.push_back(random.real(-2, 2));
            break;
        case Op::metaball:
            data.push_back(random.real(-2, 2));
            data.push_back(random.real(-0.2, 2));
            break;
        case Op::soft:
            data.push_back(random.real(-0.2, 2));
            break;
        case Op::fitted_blob:
            data.push_back(random.real(-2, 2));
            data.push_back(random.real(-0.2, 2));
            break;
        case Op::conv_point:
            data.push_back(random.real(0, 30));
            break;
        default: {
            const bool is_short = random.chance(20), is_point = random.chance(5);
            for (int i = 0; i < 3; ++i) {
                const double begin = data[data.size() - 3];
                data.push_back(is_point ? begin : is_short ? begin + random.real(-0.01, 0.01) : place());
            }
            data.push_back(random.real(-1, 1) < 0 ? random.real(0.1, 2) : random.real(2, 40));
        }
    }
}

std::vector<double> random_data(Op op, Random& random) {
    std::vector<double> data;
    if (op == Op::bezier_volume) {
        std::size_t count = 1;
        for (int i = 0; i < 3; ++i) {
            const std::size_t n = 1 + random.below(7);
            data.push_back(static_cast<double>(n));
            count *= n;
        }
        for (std::size_t i = 0; i < count; ++i) data.push_back(random.real(-5, 5));
        return data;
    }
    const std::size_t terms = 1 + random.below(30);
    for (std::size_t i = 0; i < terms; ++i) add_term(op, random, data);
    return data;
}

Field random_sum(Op op, Random& random) {
    auto graph = std::make_shared<Graph>();
    const NodeId axes[3] = {graph->coordinate(0), graph->coordinate(1), graph->coordinate(2)};
    Field field;
    field.coordinates = 3;
    if (op == Op::lattice_noise) {
        field.value = graph->make(op, {axes[0], axes[1], axes[2]});
    } else {
        std::vector<NodeId> data;
        for (const double item : random_data(op, random)) data.push_back(graph->constant(item));
        field.value = graph->make_block(op, axes, data);
    }
    field.graph = graph;
    return field;
}

/// Boxes in 0..1 for volumes, a little beyond now and then; for sums also far from everything.
BoxLanes boxes_for(Op op, Random& random) {
    BoxLanes boxes = random_boxes(random, 3);
    const double scale = op == Op::bezier_volume ? 0.25 : random.chance(20) ? 100 : 1;
    const double shift = op == Op::bezier_volume ? 0.5 : op == Op::lattice_noise ? random.real(-300, 300) : 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(boxes.count); ++k)
        for (std::size_t i = 0; i < 3; ++i) {
            boxes.lo[i][k] = scale * boxes.lo[i][k] + shift;
            boxes.hi[i][k] = scale * boxes.hi[i][k] + shift;
        }
    // single points of binary32, where nothing but rounding widens a range
    for (std::size_t k = 0; k < 3 && random.chance(50); ++k)
        for (std::size_t i = 0; i < 3; ++i)
            boxes.lo[i][k] = boxes.hi[i][k] = static_cast<double>(random.below(4096)) * 0x1p-12;
    return boxes;
}

/// Widths of ranges, added up.
struct Widths {
    double lanes = 0, general = 0;
};

void check_boxes(const ClauseTape& tape, Op op, Random& random, Widths& widths) {
    Pruner pruner;
    const BoxLanes boxes = boxes_for(op, random);
    RangeLanes r;
    pruner.ranges(tape, boxes, r);
    CHECK(r.can_be_undefined == 0);
    for (std::size_t k = 0; k < static_cast<std::size_t>(boxes.count); ++k) {
        const double lo = static_cast<double>(r.lo[k]), hi = static_cast<double>(r.hi[k]);
        for (int i = 0; i < 8; ++i) {
            const auto point = point_in(random, boxes, k, 3);
            const double value = value_at<double>(tape, point);
            const auto single = static_cast<double>(float_value_at(tape, point, random.bits()));
            CAPTURE(info(op).name);
            CAPTURE(lo);
            CAPTURE(hi);
            REQUIRE(lo <= value);
            REQUIRE(value <= hi);
            REQUIRE(lo <= single);
            REQUIRE(single <= hi);
        }
        std::vector<math::Interval> box;
        for (std::size_t i = 0; i < 3; ++i) box.push_back({boxes.lo[i][k], boxes.hi[i][k]});
        const math::Interval general = meaning<math::Interval>(op, box, tape.block_of(tape.clauses.back()));
        widths.lanes += std::min(hi - lo, 1e3);
        widths.general += std::min(general.hi - general.lo, 1e3);
    }
}

}  // namespace

TEST_CASE("ranges in lanes hold the values of both profiles and are narrow") {
    for (const Op op : lane_ops) {
        Random random(static_cast<std::uint64_t>(op));
        Widths widths;
        for (std::uint64_t round = 0; round < 100 * scale(10); ++round) {
            const Field field = random_sum(op, random);
            const auto tape = make_clause_tape(field);
            REQUIRE(tape);
            check_boxes(*tape, op, random, widths);
        }
        CAPTURE(info(op).name);
        CAPTURE(widths.lanes);
        CAPTURE(widths.general);
        CHECK(widths.lanes < 1.02 * widths.general);
    }
}

TEST_CASE("ranges of noise and sums are the same for all instruction sets") {
    Pruner plain(Isa::sse2);
    for (const Isa isa : {Isa::avx2, Isa::avx512}) {
        if (isa > machine_isa()) continue;
        Pruner wide(isa);
        for (const Op op : lane_ops) {
            Random random(static_cast<std::uint64_t>(op));
            for (int round = 0; round < 20; ++round) {
                const Field field = random_sum(op, random);
                const auto tape = make_clause_tape(field);
                const BoxLanes boxes = boxes_for(op, random);
                RangeLanes a, b;
                plain.ranges(*tape, boxes, a);
                wide.ranges(*tape, boxes, b);
                CAPTURE(info(op).name);
                CHECK(a.lo == b.lo);
                CHECK(a.hi == b.hi);
            }
        }
    }
}
