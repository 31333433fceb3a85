// The gallery: every model of examples/ says where it comes from, compiles without a warning and, if it is a
// solid, meshes to a closed, oriented manifold at three resolutions; a flat one gives closed outlines. The
// models of examples/library/ and examples/thesis/ compile and are not empty. scripts/gallery renders all.
#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "frep/frep.h"
#include "unit/gallery/models.h"

using namespace frep;
using namespace frep::test;

namespace {

/// Sanitizers make a test ten times slower: one resolution is enough for them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
const std::vector<int> resolutions{48};
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
const std::vector<int> resolutions{48};
#else
const std::vector<int> resolutions{48, 72, 96};
#endif
#else
const std::vector<int> resolutions{48, 72, 96};
#endif

}  // namespace

TEST_CASE("every model of the gallery says where it comes from and what may be changed") {
    const auto models = models_in(examples);
    CHECK(models.size() >= 16);
    for (const auto& path : models) {
        CAPTURE(path.filename().string());
        const Loaded loaded = load(path);
        const lang::Annotations& notes = loaded.model.program().annotations;
        CHECK_FALSE(notes.title.empty());
        CHECK_FALSE(notes.author.empty());
        CHECK_FALSE(notes.license.empty());
        CHECK(length_unit(notes.units).has_value());
        REQUIRE_FALSE(notes.parameters.empty());
        for (const auto& parameter : notes.parameters) {
            CAPTURE(parameter.name);
            CHECK(parameter.low < parameter.high);
        }
    }
}

TEST_CASE("every solid of the gallery gives a closed, oriented manifold at three resolutions") {
    for (const auto& path : models_in(examples)) {
        const Loaded loaded = load(path);
        if (loaded.field.coordinates < 3) continue;
        for (const int cells : resolutions) {
            CAPTURE(path.filename().string());
            CAPTURE(cells);
            const auto surface = contour(loaded.field, {.bounds = loaded.box, .cells = cells});
            REQUIRE(static_cast<bool>(surface));
            const MeshReport report = check(surface->mesh);
            CHECK(report.triangles > 0);
            CHECK(report.closed);
            CHECK(report.manifold);
            CHECK(report.oriented);
        }
    }
}

TEST_CASE("every example of the library gives a surface") {
    for (const auto& path : models_in(examples / "library")) {
        CAPTURE(path.filename().string());
        const Loaded loaded = load(path);
        if (loaded.field.coordinates < 3) continue;
        const auto surface = contour(loaded.field, {.bounds = loaded.box, .cells = 32});
        REQUIRE(static_cast<bool>(surface));
        CHECK_FALSE(surface->mesh.triangles.empty());
        CHECK(std::count(surface->touches.begin(), surface->touches.end(), true) == 0);
    }
}

TEST_CASE("every model of the thesis' figures says where it comes from and is not empty") {
    auto models = models_in(examples / "thesis");
    CHECK(models.size() >= 10);
    const auto figures = models_in(examples / "thesis" / "blending");
    CHECK(figures.size() >= 15);
    models.insert(models.end(), figures.begin(), figures.end());
    for (const auto& path : models) {
        CAPTURE(path.filename().string());
        const Loaded loaded = load(path);
        const lang::Annotations& notes = loaded.model.program().annotations;
        CHECK_FALSE(notes.title.empty());
        CHECK_FALSE(notes.author.empty());
        CHECK_FALSE(notes.license.empty());
        CHECK_FALSE(notes.source.empty());
        CHECK(length_unit(notes.units).has_value());
        CHECK_FALSE(notes.parameters.empty());
        if (loaded.field.coordinates < 3) {
            auto evaluator = make_evaluator(loaded.field);
            REQUIRE(static_cast<bool>(evaluator));
            const auto sampled = make_sampled_field(std::move(*evaluator), AxisMap::standard(2));
            REQUIRE(static_cast<bool>(sampled));
            const auto outlines = contour_plane(**sampled, {.bounds = loaded.box, .cells = 64}, Job{});
            REQUIRE(static_cast<bool>(outlines));
            CHECK_FALSE(outlines->outlines.empty());
        } else {
            const auto surface = contour(loaded.field, {.bounds = loaded.box, .cells = 32});
            REQUIRE(static_cast<bool>(surface));
            CHECK_FALSE(surface->mesh.triangles.empty());
        }
    }
}
