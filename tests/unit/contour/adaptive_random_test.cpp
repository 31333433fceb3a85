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

Mesh mesh_of(const SampledField& field, int cells) {
    return adaptive(field, {.bounds = Box3::cube(csg_bounds), .cells = cells}).mesh;
}

/// Whether the volume of the mesh is within 2 % of one from samples. What thin parts and the chance of the
/// samples take away must vanish with the resolution.
bool has_right_volume(SampledField& field, std::uint64_t seed) {
    for (const int cells : {64, 128, 192}) {
        const double found = check(mesh_of(field, cells)).volume.value_or(0);
        const double expected = sampled_volume(field, csg_bounds, cells, seed);
        if (std::abs(found - expected) <= 0.02 * expected + 1e-4) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("random solids have sound meshes of the right volume") {
    for (std::uint64_t seed = 0; seed < seeds(); ++seed) {
        CAPTURE(seed);
        const auto field = sampled(random_solid(seed / 2, seed % 2 == 1));
        for (const int cells : {16, 33, 64}) {
            CAPTURE(cells);
            sound_and_closed(mesh_of(*field, cells));
        }
        CHECK(has_right_volume(*field, seed));
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
