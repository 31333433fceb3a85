// The pruner: its ranges hold what engines compute, its tapes stand for the field in their boxes, and neither
// the instruction set nor the form of the set operations changes what it finds.
#include "frep/eval/prune.h"

#include <doctest/doctest.h>

#include <functional>

#include "unit/eval/engines.h"
#include "unit/eval/prune_models.h"

using namespace frep;
using namespace frep_test;

namespace {

using Dual = math::Dual<double>;

RandomOptions options_for(std::uint64_t seed) {
    RandomOptions options;
    options.operations = 3 + static_cast<int>(seed % 50);
    options.region_percent = 0;
    return options;
}

bool holds(const RangeLanes& r, std::size_t k, double value) {
    const bool inside = value >= 0;
    if (inside && !(r.can_be_inside >> k & 1u)) return false;
    if (!inside && !(r.can_be_outside >> k & 1u)) return false;
    if (value != value) return (r.can_be_undefined >> k & 1u) != 0;
    return static_cast<double>(r.lo[k]) <= value && value <= static_cast<double>(r.hi[k]);
}

/// The operation and the operands of the first clause whose value its range does not hold, for messages.
std::string blame(Pruner& pruner, const ClauseTape& tape, const BoxLanes& boxes, std::size_t k,
                  const std::function<std::vector<double>(const ClauseTape&)>& values) {
    const std::vector<double> rows = values(tape);
    for (std::size_t i = 0; i < tape.clauses.size(); ++i) {
        ClauseTape part = tape;
        part.clauses.resize(i + 1);
        part.root = part.clauses.back().out;
        RangeLanes r;
        pruner.ranges(part, boxes, r);
        const double value = rows[part.root];
        if (holds(r, k, value)) continue;
        std::string text = std::string(info(part.clauses.back().op).name) + " = " + std::to_string(value) +
                           " not in " + std::to_string(r.lo[k]) + " .. " + std::to_string(r.hi[k]) + " of";
        for (const RowNumber row : tape.operands_of(part.clauses.back()))
            text += " " + std::to_string(rows[row]);
        return text;
    }
    return "nothing";
}

void check_ranges(const ClauseTape& tape, int coordinates, Random& random, std::size_t points) {
    Pruner pruner;
    const BoxLanes boxes = random_boxes(random, coordinates);
    RangeLanes r;
    pruner.ranges(tape, boxes, r);
    for (std::size_t k = 0; k < static_cast<std::size_t>(boxes.count); ++k) {
        for (std::size_t i = 0; i < points; ++i) {
            const auto point = point_in(random, boxes, k, coordinates);
            const double value = value_at<double>(tape, point);
            if (!holds(r, k, value)) {
                FAIL_CHECK(blame(pruner, tape, boxes, k, [&](const ClauseTape& t) {
                    return rows_at<double>(t, point, [](Op op, const auto& in, auto block) {
                        return meaning<double>(op, in, block);
                    });
                }));
                return;
            }
            const std::uint64_t seed = random.bits();
            if (!holds(r, k, static_cast<double>(float_value_at(tape, point, seed)))) {
                FAIL_CHECK("binary32: " << blame(pruner, tape, boxes, k, [&](const ClauseTape& t) {
                               const std::vector<float> rounded(point.begin(), point.end());
                               const auto rows = rows_at<float>(t, rounded, FloatEngine(seed));
                               return std::vector<double>(rows.begin(), rows.end());
                           }));
                return;
            }
        }
    }
}

std::vector<Dual> with_directions(const std::vector<double>& point) {
    std::vector<Dual> dual;
    for (std::size_t i = 0; i < point.size(); ++i)
        dual.push_back(Dual::variable(point[i], static_cast<int>(i)));
    return dual;
}

/// What cut tapes are compared by.
struct Comparison {
    const ClauseTape& whole;
    Purpose purpose;
    std::size_t different = 0, compared = 0;

    void at(const ClauseTape& cut, const std::vector<double>& point) {
        const double expected = value_at<double>(whole, point), got = value_at<double>(cut, point);
        ++compared;
        const bool equal = purpose == Purpose::value ? same(expected, got) || expected == got
                                                     : sign_of(expected) == sign_of(got);
        if (!equal) ++different;
    }
};

/// A point of the box where the sign of the cut tape changes between two of its points, if there is one.
bool root_between(const ClauseTape& cut, std::vector<double>& a, std::vector<double> b) {
    const auto inside = [&](const std::vector<double>& p) { return value_at<double>(cut, p) >= 0; };
    if (inside(a) == inside(b)) return false;
    for (int step = 0; step < 60; ++step) {
        std::vector<double> middle;
        for (std::size_t i = 0; i < a.size(); ++i) middle.push_back(0.5 * a[i] + 0.5 * b[i]);
        (inside(middle) == inside(a) ? a : b) = middle;
    }
    return true;
}

/// Cuts, compares at points of the boxes and near the surface, and cuts the cut tapes in turn.
void check_cuts(const ClauseTape& whole, const ClauseTape& tape, const BoxLanes& boxes, int coordinates,
                int depth, Random& random, Comparison& comparison) {
    Pruner pruner;
    CutResult result;
    pruner.cut(tape, boxes, comparison.purpose, result);
    for (std::size_t k = 0; k < static_cast<std::size_t>(boxes.count); ++k) {
        if (result.tape_of[k] == CutResult::none) {
            CHECK(comparison.purpose != Purpose::value);
            CHECK(!(result.ranges.open() >> k & 1u));
            continue;
        }
        const ClauseTape& cut = result.tape_of[k] == CutResult::whole
                                    ? tape
                                    : result.tapes[static_cast<std::size_t>(result.tape_of[k])];
        for (int i = 0; i < 4; ++i) {
            auto a = point_in(random, boxes, k, coordinates);
            const auto b = point_in(random, boxes, k, coordinates);
            comparison.at(cut, a);
            if (root_between(cut, a, b)) comparison.at(cut, a);
        }
        if (depth > 0 && random.chance(30))
            check_cuts(whole, cut, halves_of(boxes, k, coordinates), coordinates, depth - 1, random,
                       comparison);
    }
}

void check_purposes(const Field& field, std::uint64_t seed) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape);
    for (const Purpose purpose : {Purpose::value, Purpose::sign, Purpose::occupancy}) {
        Random random(seed);
        Comparison comparison{*tape, purpose};
        const BoxLanes boxes = random_boxes(random, field.coordinates);
        check_cuts(*tape, *tape, boxes, field.coordinates, 3, random, comparison);
        CAPTURE(seed);
        CAPTURE(static_cast<int>(purpose));
        CAPTURE(comparison.compared);
        CHECK(comparison.different == 0);
    }
}

/// Boxes of about one size, each about a point of the surface.
BoxLanes boxes_on_surface(const ClauseTape& tape, Random& random) {
    BoxLanes boxes;
    const double size = std::exp2(random.real(-9, -1));
    while (boxes.count < tile_lanes) {
        std::vector<double> a, b;
        for (int i = 0; i < 3; ++i) {
            a.push_back(random.real(-1, 1));
            b.push_back(random.real(-1, 1));
        }
        if (!root_between(tape, a, b)) continue;
        const auto k = static_cast<std::size_t>(boxes.count++);
        for (std::size_t i = 0; i < 3; ++i) {
            boxes.lo[i][k] = a[i] - size * random.real(0, 1);
            boxes.hi[i][k] = boxes.lo[i][k] + size;
        }
    }
    return boxes;
}

/// At roots of cut tapes the field is 0 to within rounding and has the same gradient; on edges, where two
/// surfaces meet within rounding, either gradient of them.
void check_surface(const Field& field, double tolerance) {
    const auto tape = make_clause_tape(field);
    Random random(3);
    Pruner pruner;
    CutResult result;
    std::size_t roots = 0, shorter = 0, unlike = 0;
    for (int round = 0; round < 40; ++round) {
        const BoxLanes boxes = boxes_on_surface(*tape, random);
        pruner.cut(*tape, boxes, Purpose::sign, result);
        for (std::size_t k = 0; k < tile_lanes; ++k) {
            CHECK(result.tape_of[k] != CutResult::none);
            if (result.tape_of[k] < 0) continue;
            ++shorter;
            const ClauseTape& cut = result.tapes[static_cast<std::size_t>(result.tape_of[k])];
            for (int i = 0; i < 4; ++i) {
                auto a = point_in(random, boxes, k, 3);
                if (!root_between(cut, a, point_in(random, boxes, k, 3))) continue;
                const Dual f = value_at<Dual>(*tape, with_directions(a));
                const Dual g = value_at<Dual>(cut, with_directions(a));
                double size = 0, difference = 0;
                for (std::size_t d = 0; d < 3; ++d) {
                    size = std::max(size, std::fabs(f.d[d]));
                    difference = std::max(difference, std::fabs(f.d[d] - g.d[d]));
                }
                ++roots;
                CHECK(std::fabs(f.value) <= 1e-13 * (1 + size));
                if (difference > tolerance * size) ++unlike;
            }
        }
    }
    CHECK(shorter > 300);
    CHECK(roots > 300);
    CHECK(unlike == 0);
}

bool equal(const ClauseTape& a, const ClauseTape& b) {
    const auto alike = [](const Clause& c, const Clause& d) {
        return c.op == d.op && c.listed == d.listed && c.count == d.count && c.out == d.out && c.in == d.in;
    };
    return a.root == b.root && a.rows == b.rows && a.operands == b.operands &&
           std::equal(a.clauses.begin(), a.clauses.end(), b.clauses.begin(), b.clauses.end(), alike);
}

/// Cuts by two pruners of two instruction sets and compares all of both answers.
void compare_sets(const Field& field, Isa isa, std::uint64_t seed) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape);
    Random random(seed);
    Pruner plain(Isa::sse2), wide(isa);
    CutResult a, b;
    for (const Purpose purpose : {Purpose::value, Purpose::sign, Purpose::occupancy}) {
        const BoxLanes boxes = random_boxes(random, field.coordinates);
        plain.cut(*tape, boxes, purpose, a);
        wide.cut(*tape, boxes, purpose, b);
        CAPTURE(seed);
        for (std::size_t k = 0; k < tile_lanes; ++k) {
            CHECK(math::to_bits(static_cast<double>(a.ranges.lo[k])) ==
                  math::to_bits(static_cast<double>(b.ranges.lo[k])));
            CHECK(math::to_bits(static_cast<double>(a.ranges.hi[k])) ==
                  math::to_bits(static_cast<double>(b.ranges.hi[k])));
        }
        CHECK(a.ranges.can_be_inside == b.ranges.can_be_inside);
        CHECK(a.ranges.can_be_outside == b.ranges.can_be_outside);
        CHECK(a.ranges.can_be_undefined == b.ranges.can_be_undefined);
        CHECK(a.tape_of == b.tape_of);
        REQUIRE(a.tape_count == b.tape_count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(a.tape_count); ++i)
            CHECK(equal(a.tapes[i], b.tapes[i]));
    }
}

/// What cutting a model down to small boxes finds, tape by tape and box by box.
std::vector<std::size_t> findings(const Field& field, Purpose purpose) {
    std::vector<std::size_t> found;
    const auto whole = make_clause_tape(field);
    Pruner pruner;
    std::function<void(const ClauseTape&, const BoxLanes&, int)> visit =
        [&](const ClauseTape& tape, const BoxLanes& boxes, int depth) {
            CutResult result;
            pruner.cut(tape, boxes, purpose, result);
            for (std::size_t k = 0; k < static_cast<std::size_t>(boxes.count); ++k) {
                found.push_back(static_cast<std::size_t>(result.tape_of[k] + 2));
                if (result.tape_of[k] == CutResult::none) continue;
                const ClauseTape& cut = result.tape_of[k] == CutResult::whole
                                            ? tape
                                            : result.tapes[static_cast<std::size_t>(result.tape_of[k])];
                found.push_back(cut.clauses.size());
                if (depth > 0) visit(cut, halves_of(boxes, k, 3), depth - 1);
            }
        };
    BoxLanes cube;
    cube.count = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        cube.lo[i][0] = -1;
        cube.hi[i][0] = 1;
    }
    visit(*whole, halves_of(cube, 0, 3), 3);
    return found;
}

}  // namespace

TEST_CASE("ranges hold the values of binary64 and binary32 engines") {
    const std::uint64_t fields = 3000 * scale(20);
    for (std::uint64_t seed = 0; seed < fields; ++seed) {
        const Field field = RandomField(seed, options_for(seed)).make();
        const auto tape = make_clause_tape(field);
        REQUIRE(tape);
        Random random(seed + 77);
        CAPTURE(seed);
        check_ranges(*tape, field.coordinates, random, 4);
    }
}

TEST_CASE("cut tapes of random fields stand for them") {
    const std::uint64_t fields = 120 * scale(50);
    for (std::uint64_t seed = 0; seed < fields; ++seed)
        check_purposes(RandomField(seed, options_for(seed)).make(), seed);
}

TEST_CASE("cut tapes of models stand for them") {
    for (const bool rounded : {false, true}) {
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            check_purposes(machined_part(rounded), seed);
            check_purposes(many_balls(rounded, 40), seed);
            check_purposes(blended_links(rounded, 12), seed);
        }
    }
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        check_purposes(smooth_balls(30), seed);
        check_purposes(smooth_balls(30, true), seed);
        check_purposes(skin_of(smooth_balls(30), 0.01), seed);
        check_purposes(skin_of(machined_part(seed % 2 == 0), 0.02), seed);
    }
}

TEST_CASE("cut tapes of random solids stand for them") {
    const std::uint64_t solids = 500 * scale(40);
    for (std::uint64_t seed = 0; seed < solids; ++seed) {
        const Field field = RandomSolid(seed).make();
        check_purposes(field, seed);
        Random random(seed);
        CAPTURE(seed);
        check_ranges(*make_clause_tape(field), 3, random, 4);
    }
}

TEST_CASE("surface and gradients of cut tapes are those of the field") {
    check_surface(machined_part(false), 1e-9);
    check_surface(machined_part(true), 1e-9);
    check_surface(many_balls(true, 40), 1e-9);
    check_surface(blended_links(true, 12), 1e-9);
    check_surface(smooth_balls(30), 1e-9);
    check_surface(skin_of(machined_part(false), 0.02), 1e-9);
    check_surface(skin_of(smooth_balls(30, true), 0.01), 1e-9);
}

TEST_CASE("all instruction sets give the same ranges, groups and tapes") {
    for (const Isa isa : {Isa::avx2, Isa::avx512}) {
        if (machine_isa() < isa) continue;
        for (std::uint64_t seed = 0; seed < 150; ++seed)
            compare_sets(RandomField(seed, options_for(seed)).make(), isa, seed);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            compare_sets(machined_part(true), isa, seed);
            compare_sets(blended_links(true, 12), isa, seed);
            compare_sets(smooth_balls(30), isa, seed);
        }
    }
}

TEST_CASE("R-functions are cut like min and max") {
    CHECK(findings(machined_part(true), Purpose::sign) == findings(machined_part(false), Purpose::sign));
    CHECK(findings(many_balls(true, 60), Purpose::sign) == findings(many_balls(false, 60), Purpose::sign));
    const auto signs = findings(machined_part(true), Purpose::sign);
    CHECK(signs == findings(machined_part(true), Purpose::occupancy));
    CHECK(signs.size() > 1000);
}

TEST_CASE("roots without clauses, decided boxes, and what is not worth cutting") {
    auto graph = std::make_shared<Graph>();
    Field field;
    const NodeId x = graph->coordinate(0);
    field.graph = graph;
    field.value = x;
    BoxLanes boxes;
    boxes.count = 3;
    boxes.lo = {};
    boxes.hi = {};
    boxes.lo[0] = {-2, -1, 0};
    boxes.hi[0] = {-1, 1, 1};
    Pruner pruner;
    CutResult result;
    const auto coordinate = make_clause_tape(field);
    pruner.cut(*coordinate, boxes, Purpose::sign, result);
    CHECK(result.tape_of[0] == CutResult::none);
    CHECK(result.tape_of[1] == CutResult::whole);
    CHECK(result.tape_of[2] == CutResult::none);
    CHECK(result.ranges.can_be_inside == 6);
    CHECK(result.ranges.can_be_outside == 3);
    CHECK(result.ranges.lo[1] == -1);
    CHECK(result.ranges.hi[1] == 1);
    pruner.cut(*coordinate, boxes, Purpose::value, result);
    CHECK(result.tape_of[0] == CutResult::whole);
    field.value = graph->make(Op::add, {graph->make(Op::square, {x}), graph->constant(-0.5)});
    const auto parabola = make_clause_tape(field);
    pruner.cut(*parabola, boxes, Purpose::sign, result);
    CHECK(result.tape_of[0] == CutResult::none);
    CHECK(result.tape_of[1] == CutResult::whole);
    CHECK(result.tape_count == 0);
    field.value = graph->make(Op::sqrt, {x});
    RangeLanes roots;
    pruner.ranges(*make_clause_tape(field), boxes, roots);
    CHECK(roots.can_be_undefined == 3);
    CHECK(roots.can_be_inside == 6);
    CHECK(roots.can_be_outside == 3);
}

TEST_CASE("bounds keep the zeros and the signs that are exact") {
    Sketch s(true);
    BoxLanes boxes;
    boxes.count = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        boxes.lo[i][0] = 0;
        boxes.hi[i][0] = 1e-30;
    }
    Pruner pruner;
    RangeLanes r;
    const auto low_end = [&](Expression e) {
        pruner.ranges(*make_clause_tape(s.field(e)), boxes, r);
        return r.lo[0];
    };
    const auto x = s.x(0), y = s.x(1);
    CHECK(low_end(x * y) == 0);
    CHECK(low_end(square(x)) == 0);
    CHECK(low_end(sqrt(x)) == 0);
    CHECK(low_end(0.1 * x) == 0);
    CHECK(low_end(x + y) == 0);
    CHECK(low_end(r_and(x, y)) == 0);
    CHECK(low_end(hypot(x, y)) == 0);
    CHECK(low_end(-x * y) < 0);  // underflows in binary32, but not in binary64
    CHECK(low_end(x - 1e-40) < 0);
    CHECK(low_end(x + 1e-40) > 0);
}

TEST_CASE("exp, sine and cosine of narrow and wide ranges") {
    Sketch s(true);
    const auto x = s.x(0);
    Random random(11);
    Pruner pruner;
    RangeLanes r;
    BoxLanes boxes;
    boxes.count = tile_lanes;
    for (const Op op : {Op::exp, Op::sin, Op::cos}) {
        const auto tape = make_clause_tape(s.field(frep::apply(op, {x})));
        double widest = 0;
        for (int round = 0; round < 4000; ++round) {
            const double size = random.chance(50) ? 0 : std::exp2(random.real(-20, 3));
            const double reach = std::exp2(random.real(-30, op == Op::exp ? 6.6 : 13));
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t k = 0; k < tile_lanes; ++k) {
                    boxes.lo[i][k] = static_cast<double>(static_cast<float>(random.real(-reach, reach)));
                    boxes.hi[i][k] = boxes.lo[i][k] + size;
                }
            }
            pruner.ranges(*tape, boxes, r);
            for (std::size_t k = 0; k < tile_lanes; ++k) {
                for (int i = 0; i < 3; ++i) {
                    const double at =
                        i == 0 ? boxes.lo[0][k] : std::min(boxes.hi[0][k], boxes.lo[0][k] + size * i / 2);
                    const std::array<double, 1> in{at};
                    const double value = meaning<double>(op, in, {});
                    const double places = value > 1e-37 || value < -1e-37 ? 0x1p-22 * std::fabs(value) : 0;
                    CHECK(static_cast<double>(r.lo[k]) <= value - places);
                    CHECK(static_cast<double>(r.hi[k]) >= value + places);
                    if (size == 0 && op != Op::exp)
                        widest =
                            std::max(widest, static_cast<double>(r.hi[k]) - static_cast<double>(r.lo[k]));
                }
            }
        }
        CHECK(widest < 3e-6);
    }
}
