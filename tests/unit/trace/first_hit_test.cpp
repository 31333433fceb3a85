// The first points of solids along rays against roots that are known: spheres, a torus, a thin plate,
// needles; cut faces; fields about which intervals say nothing.
#include "frep/trace/first_hit.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "frep/field/expression.h"
#include "frep/trace/distance_grid.h"

using namespace frep;
using namespace frep::tracing;

namespace {

/// A solid given by an expression of x, y, z.
template <class Body>
std::unique_ptr<SampledField> solid(Body body) {
    auto graph = std::make_shared<Graph>();
    const Expression x(*graph, graph->coordinate(0)), y(*graph, graph->coordinate(1)),
        z(*graph, graph->coordinate(2));
    Field field;
    field.value = body(x, y, z).id();
    field.graph = graph;
    field.coordinates = 3;
    auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    auto sampled = make_sampled_field(std::move(*evaluator), AxisMap::standard(3));
    REQUIRE(sampled);
    return std::move(*sampled);
}

std::vector<Hit> traced(const SampledField& field, const Box3& box, const std::vector<Ray>& rays,
                        bool* sampled = nullptr) {
    FieldPool pool(field);
    const Job job;
    auto grid = DistanceGrid::make(pool, box, 64, job);
    REQUIRE(grid);
    if (sampled) *sampled = grid->sampled();
    const FieldPool::Lease lease = pool.borrow();
    std::vector<Hit> hits(rays.size());
    FirstHit(*grid, *lease, 0.01, 1e-3).trace(rays, hits);
    return hits;
}

/// Parallel rays along -z over [-half, half]^2.
std::vector<Ray> rays_down(double half, int n) {
    std::vector<Ray> rays;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            rays.push_back({{half * ((2 * i + 1.0) / n - 1), half * ((2 * j + 1.0) / n - 1), 5}, {0, 0, -1}});
    return rays;
}

}  // namespace

TEST_CASE("a sphere is met where the quadratic says") {
    const auto ball = solid([](auto x, auto y, auto z) { return 1.0 - (x * x + y * y + z * z); });
    const auto rays = rays_down(1.2, 40);
    const auto hits = traced(*ball, Box3::cube(1.5), rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double rest = 1 - rays[i].origin.x * rays[i].origin.x - rays[i].origin.y * rays[i].origin.y;
        CHECK(hits[i].is_hit() == (rest > 0));
        if (rest > 0) {
            CHECK(std::fabs(hits[i].t - (5 - std::sqrt(rest))) < 1e-7);
            CHECK(hits[i].cut_by == 0);
        }
    }
}

TEST_CASE("of the four roots of a torus the first is taken") {
    const auto torus = solid([](auto x, auto y, auto z) {
        const auto r = sqrt(x * x + y * y) - 1.0;
        return 0.09 - (r * r + z * z);
    });
    std::vector<Ray> rays;
    for (int n = -5; n <= 5; ++n) rays.push_back({{-4, 0, n * 0.05}, {1, 0, 0}});
    const auto hits = traced(*torus, Box3::cube(2), rays);
    for (int n = -5; n <= 5; ++n) {
        const double z = n * 0.05;
        CHECK(std::fabs(hits[static_cast<std::size_t>(n + 5)].t - (3 - std::sqrt(0.09 - z * z))) < 1e-7);
    }
}

TEST_CASE("a plate of a thousandth of the box hides what is behind it") {
    const auto field = solid([](auto x, auto y, auto z) {
        const auto plate = 0.001 - abs(z - 0.737);
        const auto ball = 0.5 - sqrt(x * x + y * y + z * z);
        return max(plate, ball);
    });
    for (const Hit& hit : traced(*field, Box3::cube(1), rays_down(0.9, 30)))
        CHECK(std::fabs(hit.t - (5 - 0.738)) < 1e-6);
}

/// A field whose ranges are dear: a sum over `count` triangles, below 0.3.
Expression many_triangles(Expression x, Expression y, Expression z, int count) {
    Graph& graph = x.graph();
    const NodeId point[3] = {x.id(), y.id(), z.id()};
    std::vector<NodeId> data;
    for (int n = 0; n < count; ++n)
        for (const double item :
             {-0.5, 0.0, -0.1 * n, 0.5, 0.0, -0.1 * n, 0.0, 0.5, -0.1 * n, 4.0, 0.3 / count})
            data.push_back(graph.constant(item));
    return {graph, graph.make_block(Op::conv_triangle, point, data)};
}

TEST_CASE("close samples find what is as thick as the resolution, samples half a cell apart do not") {
    const auto plate = solid([](auto, auto, auto z) { return 0.001 - abs(z - 0.737); });
    FieldPool pool(*plate);
    const auto grid = DistanceGrid::make(pool, Box3::cube(1), 64, {});
    REQUIRE(grid);
    REQUIRE(!grid->sampled());
    const FieldPool::Lease lease = pool.borrow();
    const auto rays = rays_down(0.9, 30);
    std::vector<Hit> close(rays.size()), wide(rays.size());
    FirstHit(*grid, *lease, 0.01, 1e-3, HitSearch::close_samples).trace(rays, close);
    FirstHit(*grid, *lease, 0.01, 1e-3, HitSearch::samples).trace(rays, wide);
    std::size_t missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        REQUIRE(close[i].is_hit());
        CHECK(std::fabs(close[i].t - (5 - 0.738)) < 1e-6);
        missed += wide[i].is_hit() ? 0 : 1;
    }
    CHECK(missed > 0);
}

TEST_CASE("a thin plate beside sums and noise is found as well") {
    // the plate is a fifteenth of a cell thick
    const auto plate_of = [](auto z) { return 0.001 - abs(z - 0.737); };
    const auto triangles =
        solid([&](auto x, auto y, auto z) { return max(many_triangles(x, y, z, 20) - 0.1, plate_of(z)); });
    CHECK(triangles->has_dear_ranges());
    const auto rough = solid([&](auto x, auto y, auto z) {
        Expression noise = 0.4 - sqrt(x * x + y * y + z * z);
        for (int octave = 0; octave < 5; ++octave) {
            const double f = std::exp2(octave);
            noise = noise + apply(Op::lattice_noise, {x * (3 * f), y * (3 * f), z * (3 * f)}) * (0.1 / f);
        }
        return max(noise, plate_of(z));
    });
    CHECK(rough->has_dear_ranges());
    for (const auto* field : {triangles.get(), rough.get()}) {
        bool sampled = true;
        for (const Hit& hit : traced(*field, Box3::cube(1), rays_down(0.9, 30), &sampled))
            CHECK(std::fabs(hit.t - (5 - 0.738)) < 1e-6);
        CHECK(!sampled);
    }
}

TEST_CASE("needles are met by the rays that go through them") {
    const auto field = solid([](auto x, auto y, auto z) {
        const auto needle = 0.002 - sqrt(square(x - 0.3) + square(z - 0.1));
        return max(needle, -abs(y) - 5.0);
    });
    std::vector<Ray> rays;
    for (int n = 0; n < 20; ++n) rays.push_back({{0.3, -0.9 + 0.09 * n, 5}, {0, 0, -1}});
    for (const Hit& hit : traced(*field, Box3::cube(1), rays)) CHECK(std::fabs(hit.t - (5 - 0.102)) < 1e-6);
}

TEST_CASE("where the box cuts the solid, its side is the surface") {
    const auto all = solid([](auto x, auto, auto) { return 5.0 - abs(x); });
    for (const Hit& hit : traced(*all, Box3::cube(1), rays_down(0.9, 4))) {
        CHECK(std::fabs(hit.t - 4) < 1e-12);
        CHECK(hit.cut_by == 6);
    }
}

TEST_CASE("an empty box has no hits") {
    const auto none = solid([](auto x, auto, auto) { return -1.0 - x * x; });
    for (const Hit& hit : traced(*none, Box3::cube(1), rays_down(0.9, 4))) CHECK(!hit.is_hit());
}

TEST_CASE("neighbours that share proofs have the hits of single rays") {
    const auto ball = solid([](auto x, auto y, auto z) { return 1.0 - sqrt(x * x + y * y + z * z); });
    const auto rays = rays_down(1.1, 16);
    FieldPool pool(*ball);
    const Job job;
    const auto grid = DistanceGrid::make(pool, Box3::cube(1.5), 48, job);
    REQUIRE(grid);
    const FieldPool::Lease lease = pool.borrow();
    std::vector<Hit> alone(rays.size()), together(rays.size());
    FirstHit first_hit(*grid, *lease, 0.1, 1e-3);
    for (std::size_t i = 0; i < rays.size(); ++i) first_hit.trace({&rays[i], 1}, {&alone[i], 1});
    first_hit.trace(rays, together);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CHECK(alone[i].is_hit() == together[i].is_hit());
        if (alone[i].is_hit()) CHECK(std::fabs(alone[i].t - together[i].t) < 1e-8);
    }
}

TEST_CASE("distances of a ball, inside the lattice and beyond") {
    const auto ball = solid([](auto x, auto y, auto z) { return 1.0 - (x * x + y * y + z * z); });
    FieldPool pool(*ball);
    const Job job;
    const auto grid = DistanceGrid::make(pool, Box3::cube(2), 64, job);
    REQUIRE(grid);
    CHECK(std::fabs(grid->lowest() + 1) < grid->step());
    for (double r = 1; r < 1.8; r += 0.01) {
        const Vec3 p{0.6 * r, 0.0, 0.8 * r};
        CHECK(grid->distance(p) < r - 1 + 1.2 * grid->step());
        if (r > 1.1) continue;
        CHECK(grid->distance(p) > r - 1 - 1.2 * grid->step());
        CHECK(dot(grid->direction(p), p) > 0.97 * r);
    }
    const double far = grid->distance({30, 0, 0});
    CHECK(far <= 29.01);
    CHECK(far > 28);
    CHECK(grid->distance({0.95, 0, 0}) < 0);
}

TEST_CASE("samples alone find what is thicker than half a cell") {
    const auto ball = solid([](auto x, auto y, auto z) { return 1.0 - (x * x + y * y + z * z); });
    const auto rays = rays_down(1.2, 20);
    FieldPool pool(*ball);
    const Job job;
    const auto grid = DistanceGrid::make(pool, Box3::cube(1.5), 64, job);
    REQUIRE(grid);
    const FieldPool::Lease lease = pool.borrow();
    std::vector<Hit> proved(rays.size()), sampled(rays.size());
    FirstHit(*grid, *lease, 0.01, 1e-3).trace(rays, proved);
    FirstHit(*grid, *lease, 0.01, 1e-3, HitSearch::samples).trace(rays, sampled);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec3 o = rays[i].origin;
        if (o.x * o.x + o.y * o.y > 0.98 && o.x * o.x + o.y * o.y < 1) continue;  // a grazed rim
        REQUIRE(proved[i].is_hit() == sampled[i].is_hit());
        if (!proved[i].is_hit()) continue;
        CHECK(std::fabs(proved[i].t - sampled[i].t) < 1e-7);
        CHECK(length(proved[i].gradient - sampled[i].gradient) < 1e-6);
    }
}
