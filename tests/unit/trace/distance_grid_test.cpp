// The lattice around a solid: what its cells claim holds at every sample; without intervals samples stand in,
// and pictures stay the same; loops that depend on the point.
#include "frep/trace/distance_grid.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "frep/frep.h"
#include "solid_fields.h"

using namespace frep;
using namespace frep::test;
using namespace frep::tracing;

namespace {

DistanceGrid grid_of(const SampledField& field, double half, int cells) {
    FieldPool pool(field);
    auto grid = DistanceGrid::make(pool, Box3::cube(half), cells, Job());
    REQUIRE(grid);
    return std::move(*grid);
}

const auto torus = [](auto x, auto y, auto z) {
    const auto r = sqrt(x * x + y * y) - 1.0;
    return 0.4 - sqrt(r * r + z * z);
};

/// 0.4 - the distance from the circle.
double torus_distance(Vec3 p) {
    const double r = std::sqrt(p.x * p.x + p.y * p.y) - 1;
    return std::sqrt(r * r + p.z * p.z) - 0.4;
}

Image draft(const SampledField& field, double half) {
    SceneOptions scene;
    scene.bounds = Box3::cube(half);
    scene.quality = PictureQuality::draft;
    scene.longest_side = 80;
    PictureOptions options;
    options.width = options.height = 80;
    options.backdrop = Backdrop::transparent;
    options.ground = false;
    auto image = render_solid(field, scene, options, Job());
    REQUIRE(image);
    return std::move(*image);
}

/// Pixels that one picture covers and the other does not.
int differently_covered(const Image& a, const Image& b) {
    int count = 0;
    for (std::size_t i = 3; i < a.pixels.size(); i += 4)
        count += std::abs(int{a.pixels[i]} - int{b.pixels[i]}) > 128 ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("cells keep their word, with intervals and without") {
    const auto known = solid(torus);
    const WithoutIntervals unknown(solid(torus));
    for (const SampledField* field :
         {static_cast<const SampledField*>(known.get()), static_cast<const SampledField*>(&unknown)}) {
        const DistanceGrid grid = grid_of(*field, 2, 48);
        CHECK(grid.sampled() == (field == &unknown));
        int counts[3] = {}, broken = 0;
        const auto [nx, ny, nz] = grid.cells();
        for (int k = 0; k < nz; ++k) {
            for (int j = 0; j < ny; ++j) {
                for (int i = 0; i < nx; ++i) {
                    const CellState state = grid.state(i, j, k);
                    ++counts[static_cast<int>(state)];
                    if (state == CellState::mixed) continue;
                    for (int n = 0; n < 9; ++n) {  // corners and middle
                        const Vec3 at{n == 8 ? 0.5 : n & 1, n == 8 ? 0.5 : n >> 1 & 1, n == 8 ? 0.5 : n >> 2};
                        const Vec3 p =
                            grid.origin() + grid.step() * (Vec3{double(i), double(j), double(k)} + at);
                        const double d = torus_distance(p);
                        const bool kept = state == CellState::outside ? d > -1e-9 : d < 1e-9;
                        broken += kept ? 0 : 1;
                    }
                }
            }
        }
        CHECK(broken == 0);
        CHECK(counts[0] > 0);
        CHECK(counts[1] > 0);
        CHECK(counts[2] > 0);
    }
}

TEST_CASE("distances from a torus, and the points that a camera must see") {
    const DistanceGrid grid = grid_of(*solid(torus), 2, 64);
    const double step = grid.step();
    int beyond = 0;
    for (int n = 0; n < 1000; ++n) {  // points that fill the box evenly
        const auto part = [n](double ratio) { return n * ratio - std::floor(n * ratio); };
        const Vec3 p{3.6 * part(0.8191725134) - 1.8, 3.6 * part(0.6710436067) - 1.8,
                     1.2 * part(0.5497004779) - 0.6};
        const Vec3 q = (1 / step) * (p - grid.origin());
        const auto [nx, ny, nz] = grid.cells();
        const bool within = q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x <= nx && q.y <= ny && q.z <= nz;
        const double d = torus_distance(p), found = grid.distance(p);
        if (!within) {
            ++beyond;
            CHECK(found < d + 1.3 * step);
        } else if (d > -step) {
            CHECK(std::fabs(found - d) < 1.3 * step);
        } else {
            CHECK(found < 0.3 * step);
        }
    }
    CHECK(beyond < 700);
    CHECK(grid.surface_points().size() > 1000);
    for (const Vec3& p : grid.surface_points()) {
        CHECK(torus_distance(p) < step);
        CHECK(torus_distance(p) > -4 * step);
    }
    CHECK(std::fabs(grid.lowest() + 0.4) < step);
}

TEST_CASE("without intervals the picture is that of the same solid with them") {
    const Image known = draft(*solid(torus), 2);
    CHECK(differently_covered(known, draft(WithoutIntervals(solid(torus)), 2)) < 8);
}

TEST_CASE("loops that depend on the point: the solid that they compute is seen") {
    // The root of a square by Newton's iteration, as long as it moves: a ball.
    const auto model = compile(R"hf(my_model(x[3], a[1])
{
  square = x[1]^2 + x[2]^2 + x[3]^2 + 0.000001;
  r = 1;
  d = 1;
  i = 0;
  while d > 0.0000001 and i < 12 loop
    q = 0.5*(r + square/r);
    d = abs(q - r);
    r = q;
    i = i + 1;
  endloop;
  my_model = 1 - r;
})hf");
    REQUIRE(model);
    const auto field = model->field();
    REQUIRE(field);
    const auto loops = in_space(*field);
    const auto ball = solid([](auto x, auto y, auto z) { return 1.0 - sqrt(x * x + y * y + z * z); });
    CHECK(differently_covered(draft(*ball, 1.5), draft(*loops, 1.5)) < 8);
}
