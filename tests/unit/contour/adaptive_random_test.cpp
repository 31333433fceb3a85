// Random solids (csg_trees.h) through contour_adaptive: sound at every resolution, with the right volume;
// with merging too. 50 solids; 1,000 with FREP_FULL=1.
#include <doctest/doctest.h>

#include <cstdlib>

#include "unit/contour/adaptive_checks.h"
#include "unit/contour/csg_trees.h"

using namespace frep;
using namespace frep::test;

namespace {

std::uint64_t seeds() {
    const char* full = std::getenv("FREP_FULL");
    return full && full[0] == '1' ? 1000 : 50;
}

}  // namespace

TEST_CASE("random solids have sound meshes of the right volume") {
    for (std::uint64_t seed = 0; seed < seeds(); ++seed) {
        CAPTURE(seed);
        const auto field = sampled(random_solid(seed / 2, seed % 2 == 1));
        double found = 0;
        for (const int cells : {16, 33, 64}) {
            CAPTURE(cells);
            const ContourResult r = adaptive(*field, {.bounds = Box3::cube(csg_bounds), .cells = cells});
            const MeshReport report = sound_and_closed(r.mesh);
            found = report.volume.value_or(0);
        }
        const double volume = sampled_volume(*field, csg_bounds, 64, seed);
        CAPTURE(volume);
        CHECK(std::abs(found - volume) <= 0.02 * volume + 1e-3);
    }
}

TEST_CASE("random solids stay sound when cells merge") {
    for (std::uint64_t seed = 0; seed < seeds(); ++seed) {
        CAPTURE(seed);
        const auto field = sampled(random_solid(seed / 2, seed % 2 == 1));
        for (const double tolerance : {1e-3, 1e-2}) {
            CAPTURE(tolerance);
            const ContourOptions options{.bounds = Box3::cube(csg_bounds), .cells = 40};
            ContourOptions merging = options;
            merging.tolerance = tolerance;
            const MeshReport fine = check(adaptive(*field, options).mesh);
            const MeshReport merged = sound_and_closed(adaptive(*field, merging).mesh);
            CHECK(merged.euler_characteristic == fine.euler_characteristic);
            CHECK(merged.components == fine.components);
            CHECK(std::abs(merged.volume.value_or(0) - fine.volume.value_or(0)) <=
                  tolerance * fine.area + 1e-9);
        }
    }
}
