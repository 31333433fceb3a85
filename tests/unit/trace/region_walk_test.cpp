// One leaf of the picture of Prospero, from the whole picture down, as docs/performance.md tells it: the
// table there has the lines that the pruner gives today, and the leaf's tape the pixels of the whole tape.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frep/eval/batch_vm.h"
#include "frep/eval/prune.h"
#include "frep/trace/tile_worker.h"
#include "support/bench_model.h"
#include "support/evaluate.h"

using namespace frep;

namespace {

constexpr int picture_side = 1024, leaf_side = 16, split = 4;
constexpr int leaf_x = 400, leaf_y = 448;  ///< pixels from the left and from the top

struct Middles {
    PartMiddles<float> x, y;
    CoordinateSources sources;

    explicit Middles(int coordinates) {
        x.set(-1, 2.0 / picture_side, picture_side);
        y.set(1, -2.0 / picture_side, picture_side);
        sources.set(AxisMap::standard(coordinates), {0, 1, CoordinateSources::fixed}, 0);
    }
    /// The 16 parts of a tile, and in `lane` the one that has the leaf.
    BoxLanes parts(int left, int top, int side, int& lane) const {
        BoxLanes boxes;
        boxes.count = split * split;
        const int part = side / split;
        for (int k = 0; k < boxes.count; ++k) {
            const int px = left + k % split * part, py = top + k / split * part;
            sources.set_box({x[px], y[py + part - 1], 0}, {x[px + part - 1], y[py], 0}, k, boxes);
        }
        lane = (leaf_y - top) / part * split + (leaf_x - left) / part;
        return boxes;
    }
};

/// Signs of the tape at the pixels of the leaf.
std::vector<bool> pixels(const ClauseTape& tape, const Middles& middles) {
    PointBatch<float> points;
    constexpr std::size_t count = leaf_side * leaf_side;
    points.prepare(middles.sources, count);
    for (std::size_t i = 0; i < count; ++i) {
        points.axis[0][i] = middles.x.rounded[leaf_x + i % leaf_side];
        points.axis[1][i] = middles.y.rounded[leaf_y + i / leaf_side];
    }
    std::vector<float> values(count);
    BatchVm<float> vm;
    vm.values(tape, points.coordinates(), count, values.data());
    std::vector<bool> inside;
    for (const float value : values) inside.push_back(value >= 0);
    return inside;
}

}  // namespace

TEST_CASE("a leaf of Prospero, from the whole picture down") {
    const auto field = test::bench_field("prospero.vm");
    if (!field) return;
    const auto whole = make_clause_tape(bind_parameters(*field));
    REQUIRE(whole.has_value());
    const Middles middles(field->coordinates);

    const std::string page = test::read_text(FREP_SOURCE_DIR "/docs/performance.md");
    Pruner pruner;
    ClauseTape tape = *whole;
    CutResult cut;
    int left = 0, top = 0;
    for (int side = picture_side; side > leaf_side; side /= split) {
        int lane = 0;
        const BoxLanes boxes = middles.parts(left, top, side, lane);
        pruner.cut(tape, boxes, Purpose::occupancy, cut);
        const unsigned open = cut.ranges.open();
        REQUIRE((open >> lane & 1u) == 1);
        const int number = cut.tape_of[static_cast<std::size_t>(lane)];
        const ClauseTape next = number < 0 ? tape : cut.tapes[static_cast<std::size_t>(number)];
        const int inside = std::popcount(static_cast<unsigned>(cut.ranges.can_be_inside & ~open));
        const std::string line = fmt::format("| {} | ({}, {}) | {} | {}, {}, {} | {} | {} |", side, left, top,
                                             tape.clauses.size(), 16 - std::popcount(open) - inside, inside,
                                             std::popcount(open), cut.tape_count, next.clauses.size());
        CHECK_MESSAGE(page.find(line) != std::string::npos, line);
        tape = next;
        left += lane % split * (side / split);
        top += lane / split * (side / split);
    }
    CHECK(left == leaf_x);
    CHECK(top == leaf_y);
    const auto expected = pixels(*whole, middles);
    CHECK(pixels(tape, middles) == expected);
    const auto count = std::count(expected.begin(), expected.end(), true);
    const std::string line = fmt::format("{} of its 256 pixels are inside", count);
    CHECK_MESSAGE(page.find(line) != std::string::npos, line);
}
