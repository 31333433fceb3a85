// What the pruner costs and leaves on a .vm model: prune_bench MODEL.vm N TILES [sign|occupancy|value], with
// N samples an axis over [-1,1] and TILES like 64,16,8 (sizes of the tiles of each level, in samples).
// Classifies all of the cube (square), as docs of pruning count it: tile-ops are clauses times boxes, a leaf
// tile is one of the last level where the sign is open. One line for each instruction set; CPU time of the
// best of three runs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "frep/eval/prune.h"
#include "frep/frep.h"

namespace {

using namespace frep;

struct Counts {
    std::size_t leaf_tiles = 0, leaf_clauses = 0, tapes = 0, passes = 0;
    double leaf_points = 0, point_operations = 0;
};

struct Tile {
    double low[3];
};

class Classifier {
  public:
    Classifier(const Field& field, double samples, std::vector<double> tiles, Purpose purpose, Isa isa)
        : coordinates_(field.coordinates),
          spacing_(2 / samples),
          tiles_(std::move(tiles)),
          purpose_(purpose),
          pruner_(isa),
          levels_(tiles_.size()) {
        parts_.push_back(static_cast<int>(samples / tiles_[0]));
        for (std::size_t i = 1; i < tiles_.size(); ++i)
            parts_.push_back(static_cast<int>(tiles_[i - 1] / tiles_[i]));
    }

    Counts run(const ClauseTape& tape) {
        counts = {};
        const Tile all{{-1, -1, -1}};
        visit(tape, {all}, 0);
        return counts;
    }
    std::size_t tile_operations() const { return pruner_.tile_operations(); }

  private:
    struct Level {
        std::vector<Tile> waiting;
        CutResult result;
    };

    /// Splits the tiles, which share `tape`, into those of `level`.
    void visit(const ClauseTape& tape, const std::vector<Tile>& tiles, std::size_t level) {
        const double size = tiles_[level] * spacing_;
        std::vector<Tile>& batch = levels_[level].waiting;
        batch.clear();
        const int n = parts_[level], depth = coordinates_ == 3 ? n : 1;
        for (const Tile& tile : tiles) {
            for (int i = 0; i < n * n * depth; ++i) {
                const int x = i % n, y = i / n % n, z = i / n / n;
                batch.push_back({{tile.low[0] + x * size, tile.low[1] + y * size, tile.low[2] + z * size}});
                if (batch.size() == tile_lanes) flush(tape, level);
            }
        }
        if (!batch.empty()) flush(tape, level);
    }

    void flush(const ClauseTape& tape, std::size_t level) {
        const double size = tiles_[level] * spacing_;
        const std::vector<Tile> tiles = levels_[level].waiting;
        levels_[level].waiting.clear();
        boxes_.count = static_cast<int>(tiles.size());
        for (std::size_t k = 0; k < tiles.size(); ++k) {
            for (std::size_t i = 0; i < 3; ++i) {
                boxes_.lo[i][k] = tiles[k].low[i];
                boxes_.hi[i][k] = tiles[k].low[i] + size;
            }
        }
        CutResult& result = levels_[level].result;
        pruner_.cut(tape, boxes_, purpose_, result);
        ++counts.passes;
        counts.tapes += static_cast<std::size_t>(result.tape_count);
        for (int number = CutResult::whole; number < result.tape_count; ++number) {
            if (number == CutResult::none) continue;
            std::vector<Tile> group;
            for (std::size_t k = 0; k < tiles.size(); ++k)
                if (result.tape_of[k] == number) group.push_back(tiles[k]);
            if (group.empty()) continue;
            const ClauseTape& cut =
                number == CutResult::whole ? tape : result.tapes[static_cast<std::size_t>(number)];
            if (level + 1 < tiles_.size())
                visit(cut, group, level + 1);
            else
                add_leaves(cut, group.size());
        }
    }

    void add_leaves(const ClauseTape& tape, std::size_t tiles) {
        const double points = std::max(1.0, tiles_.back());
        const double volume = coordinates_ == 3 ? points * points * points : points * points;
        counts.leaf_tiles += tiles;
        counts.leaf_clauses += tiles * tape.clauses.size();
        counts.point_operations += volume * static_cast<double>(tiles * tape.clauses.size());
    }

    int coordinates_;
    double spacing_;
    std::vector<double> tiles_;
    std::vector<int> parts_;
    Purpose purpose_;
    Pruner pruner_;
    std::vector<Level> levels_;
    BoxLanes boxes_;
    Counts counts;
};

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        fmt::print(stderr, "usage: prune_bench MODEL.vm N TILES [sign|occupancy|value]\n");
        return 2;
    }
    const auto text = read_file(argv[1], std::size_t{1} << 30);
    if (!text) return fmt::print(stderr, "{}\n", text.error().message), 1;
    const Model model(Source(argv[1], *text), {}, ModelText::vm);
    const auto field = model.field();
    if (!field) return fmt::print(stderr, "{}\n", field.error().message), 1;
    const auto tape = make_clause_tape(*field);
    if (!tape) return 1;
    std::vector<double> tiles;
    for (const char* at = argv[3]; *at != 0;) {
        char* end = nullptr;
        tiles.push_back(std::strtod(at, &end));
        at = *end == ',' ? end + 1 : end;
    }
    const std::string wish = argc > 4 ? argv[4] : "sign";
    const Purpose purpose = wish == "value"       ? Purpose::value
                            : wish == "occupancy" ? Purpose::occupancy
                                                  : Purpose::sign;
    fmt::print("{} clauses\n", tape->clauses.size());
    for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
        if (machine_isa() < isa) continue;
        Classifier classifier(*field, std::atof(argv[2]), tiles, purpose, isa);
        double best = 1e30;
        Counts counts;
        std::size_t operations = 0;
        for (int run = 0; run < 3; ++run) {
            const std::size_t before = classifier.tile_operations();
            const double start = cpu_seconds();
            counts = classifier.run(*tape);
            best = std::min(best, cpu_seconds() - start);
            operations = classifier.tile_operations() - before;
        }
        fmt::print(
            "{:6}: {:8.2f} ms, {:.3f} M tile-ops ({:.2f} ns each), {} passes, {} tapes, {} leaf tiles, leaf "
            "tape {:.1f}, {:.2f} M point-ops\n",
            name_of(isa), best * 1e3, static_cast<double>(operations) * 1e-6,
            best * 1e9 / static_cast<double>(operations), counts.passes, counts.tapes, counts.leaf_tiles,
            static_cast<double>(counts.leaf_clauses) /
                static_cast<double>(std::max<std::size_t>(1, counts.leaf_tiles)),
            counts.point_operations * 1e-6);
    }
    return 0;
}
