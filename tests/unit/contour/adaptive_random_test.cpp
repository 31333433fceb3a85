// Random solids (csg_trees.h) through contour_adaptive: sound at every resolution, with the right volume;
// with merging too. 50 solids; 1,000 with FREP_FULL=1.
#include <doctest/doctest.h>

#include "unit/contour/adaptive_checks.h"
#include "unit/contour/csg_trees.h"

using namespace frep;
using namespace frep::test;

namespace {

Mesh mesh_of(const SampledField& field, int cells) {
    return adaptive(field, {.bounds = Box3::cube(csg_bounds), .cells = cells}).mesh;
}

}  // namespace

TEST_CASE("random solids have sound meshes of the right volume") {
    for (std::uint64_t seed = 0; seed < csg_solids(); ++seed) {
        CAPTURE(seed);
        const auto field = sampled(csg_solid(seed));
        const auto sound_at = [&](int cells) {
            CAPTURE(cells);
            Mesh mesh = mesh_of(*field, cells);
            sound_and_closed(mesh);
            return mesh;
        };
        for (const int cells : {16, 33}) sound_at(cells);
        const VolumeTrial trial = try_volume(*field, seed, sound_at);
        CAPTURE(trial.found);
        CAPTURE(trial.expected);
        CHECK(trial.is_right());
    }
}

TEST_CASE("random solids stay sound when cells merge") {
    for (std::uint64_t seed = 0; seed < csg_solids(); ++seed) {
        CAPTURE(seed);
        const auto field = sampled(csg_solid(seed));
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
