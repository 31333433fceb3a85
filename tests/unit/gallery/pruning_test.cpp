// What pruning may not change, on the solids of the gallery and of the benches: meshes with and without it,
// and the signs of the cells that it called empty or full. Slices; all of it with FREP_FULL=1.
#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "frep/frep.h"
#include "unit/contour/csg_trees.h"
#include "unit/gallery/models.h"

using namespace frep;
using namespace frep::test;

namespace {

bool is_full() {
    const char* full = std::getenv("FREP_FULL");
    return full && full[0] == '1';
}

std::unique_ptr<SampledField> field_in_space(const Field& field) {
    auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    auto made = make_sampled_field(std::move(*evaluator), AxisMap::standard(field.coordinates));
    REQUIRE(made);
    return std::move(*made);
}

struct Cells {
    std::uint64_t empty = 0, full = 0, wrong = 0;
};

/// Goes down as the meshers do, each part asked through what stands for the field there, and samples one
/// random point in each of `per_box`^3 cells of every box that was called empty or full.
class Descent {
  public:
    Descent(SampledField& field, int depth, int per_box, std::uint64_t seed)
        : field_(field), depth_(depth), per_box_(per_box), chance_(seed) {}

    Cells run(const Box3& box) {
        visit({{box, nullptr}}, 0);
        return cells_;
    }

  private:
    void visit(std::vector<FieldPart> parts, int level) {
        std::vector<SignRange> ranges(parts.size());
        narrow_parts(field_, parts, ranges);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const SignRange& r = ranges[i];
            const bool empty = !r.can_be_inside, full = !r.can_be_outside && !r.can_be_undefined;
            if (empty || full) {
                sample(parts[i].box, full);
            } else if (level < depth_) {
                visit(eighths(parts[i]), level + 1);
            }
        }
    }

    static std::vector<FieldPart> eighths(const FieldPart& part) {
        const Vec3 a = part.box.min, c = part.box.max, b = 0.5 * (a + c);
        std::vector<FieldPart> out;
        for (int k = 0; k < 8; ++k) {
            const bool x = k & 1, y = k & 2, z = k & 4;
            out.push_back({{{x ? b.x : a.x, y ? b.y : a.y, z ? b.z : a.z},
                            {x ? c.x : b.x, y ? c.y : b.y, z ? c.z : b.z}},
                           part.field});
        }
        return out;
    }

    void sample(const Box3& box, bool full) {
        const int n = per_box_;
        std::vector<double> x, y, z;
        const auto at = [&](double lo, double hi, int i) {
            return std::min(lo + (hi - lo) * (i + chance_.between(0, 1)) / n, hi);
        };
        for (int i = 0; i < n * n * n; ++i) {
            x.push_back(at(box.min.x, box.max.x, i % n));
            y.push_back(at(box.min.y, box.max.y, i / n % n));
            z.push_back(at(box.min.z, box.max.z, i / n / n));
        }
        std::vector<double> values(x.size());
        field_.values({x, y, z}, values);
        (full ? cells_.full : cells_.empty) += values.size();
        for (const double v : values) cells_.wrong += (v >= 0) == full ? 0u : 1u;
    }

    SampledField& field_;
    int depth_, per_box_;
    Chance chance_;
    Cells cells_;
};

/// Meshes by both methods in `box`, and those without pruning.
void compare_meshes(const SampledField& field, const Box3& box, int cells) {
    CAPTURE(cells);
    for (const auto contour_by : {contour_adaptive, contour_cells}) {
        ContourOptions options{.bounds = box, .cells = cells};
        const auto pruned = contour_by(field, options, {});
        options.prune = false;
        const auto plain = contour_by(field, options, {});
        REQUIRE(pruned);
        REQUIRE(plain);
        CHECK_FALSE(pruned->mesh.triangles.empty());
        CHECK(pruned->mesh.triangles == plain->mesh.triangles);
        REQUIRE(pruned->mesh.vertices.size() == plain->mesh.vertices.size());
        double worst = 0;
        for (std::size_t v = 0; v < plain->mesh.vertices.size(); ++v)
            worst = std::max(worst, length(pruned->mesh.vertices[v] - plain->mesh.vertices[v]));
        CHECK(worst <= 1e-9 * length(box.max - box.min));
    }
}

}  // namespace

TEST_CASE("meshes with and without pruning: the same triangles, and vertices to rounding") {
    for (const auto& path : solids()) {
        const Loaded loaded = load(path);
        if (loaded.field.coordinates < 3) continue;
        CAPTURE(path.filename().string());
        const auto field = field_in_space(loaded.field);
        compare_meshes(*field, loaded.box, is_full() ? 96 : 24);
        // R-unions of balls smaller than a cell cross edges of the lattice three times.
        if (path.stem() != "runion1000") continue;
        const std::vector<int> grids =
            is_full() ? std::vector{12, 16, 17, 20, 23, 28, 32, 40, 48, 64} : std::vector{20, 48};
        for (const int cells : grids) compare_meshes(*field, loaded.box, cells);
    }
}

TEST_CASE("no sign changes in cells that pruning calls empty or full") {
    const int depth = is_full() ? 6 : 4;
    Cells all;
    std::uint64_t seed = 0;
    for (const auto& path : solids()) {
        const Loaded loaded = load(path);
        if (loaded.field.coordinates < 3) continue;
        CAPTURE(path.filename().string());
        const auto field = field_in_space(loaded.field);
        const Cells cells = Descent(*field, depth, 4, ++seed).run(loaded.box);
        CHECK(cells.wrong == 0);
        all.empty += cells.empty;
        all.full += cells.full;
    }
    // Random solids have what models have not: edges anywhere, parts that only just touch.
    for (seed = 0; seed < (is_full() ? 400u : 40u); ++seed) {
        CAPTURE(seed);
        const auto field = sampled(csg_solid(seed));
        const Cells cells = Descent(*field, is_full() ? 6 : 5, 3, seed).run(Box3::cube(csg_bounds));
        CHECK(cells.wrong == 0);
        all.empty += cells.empty;
        all.full += cells.full;
    }
    MESSAGE("cells: ", all.empty, " empty, ", all.full, " full");
    CHECK(all.empty + all.full >= (is_full() ? 10'000'000u : 500'000u));
    CHECK(all.full >= (is_full() ? 1'000'000u : 50'000u));
}
