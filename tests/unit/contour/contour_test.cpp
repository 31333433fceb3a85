// Tests of contour/contour.h: known spheres, topology, closedness on hostile data, caps, walls, determinism.
#include "frep/contour/contour.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "frep/geom/mesh_check.h"
#include "unit/contour/test_fields.h"

using namespace frep;
using test::FunctionField;
using test::generic_field;
using test::infinity;
using test::sphere_function;
using test::torus_function;
using test::undefined;

namespace {

ContourResult contoured(const SampledField& field, const ContourOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    Result<ContourResult> result = contour_cells(field, options, job);
    REQUIRE(static_cast<bool>(result));
    REQUIRE(is_valid(result->mesh));
    REQUIRE(result->mesh.normals.size() == result->mesh.vertices.size());
    for (const Vec3& n : result->mesh.normals) REQUIRE(std::abs(length(n) - 1) < 1e-12);
    return std::move(*result);
}

MeshReport closed_manifold(const Mesh& mesh) {
    const MeshReport report = check(mesh);
    CHECK(report.closed);
    CHECK(report.manifold);
    CHECK(report.oriented);
    CHECK(check(mesh, {.as_float32 = false}).manifold);
    std::vector<bool> is_used(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) is_used[v] = true;
    }
    CHECK(std::find(is_used.begin(), is_used.end(), false) == is_used.end());
    return report;
}

bool same_bytes(const ContourResult& a, const ContourResult& b) {
    const auto same = [](const auto& u, const auto& v) {
        return u.size() == v.size() &&
               (u.empty() || std::memcmp(u.data(), v.data(), u.size() * sizeof u[0]) == 0);
    };
    return same(a.mesh.vertices, b.mesh.vertices) && same(a.mesh.normals, b.mesh.normals) &&
           same(a.mesh.triangles, b.mesh.triangles) && a.undefined_points == b.undefined_points &&
           a.first_undefined == b.first_undefined && a.touches == b.touches;
}

/// Uncorrelated values at the lattice points of the grid that `cells` cells on [-1, 1]^3 give, constant
/// around.
FunctionField noise_field(std::uint64_t seed, int cells, double share_inside = 0.5, double share_nan = 0) {
    return FunctionField([=](double x, double y, double z) {
        const auto index = [=](double v) {
            return static_cast<std::uint64_t>(std::floor((v + 1) * 0.5 * cells + 0.5) + 100);
        };
        const std::uint64_t i = (index(z) * 1000 + index(y)) * 1000 + index(x);
        if (test::noise(seed + 77, i) < 2 * share_nan - 1) return undefined;
        return test::noise(seed, i) + 2 * share_inside - 1;
    });
}

constexpr std::array<bool, 6> no_sides{};

}  // namespace

TEST_CASE("the sphere of the theory notes, counts and measures to the last digit") {
    const FunctionField sphere = generic_field(sphere_function(1));
    struct Row {
        int cells;
        std::size_t vertices, triangles;
        double area, volume;
    };
    for (const Row& row : {Row{8, 174, 344, 12.23106, 3.96387}, Row{16, 726, 1448, 12.48799, 4.13584},
                           Row{32, 2886, 5768, 12.54657, 4.17532}}) {
        CAPTURE(row.cells);
        const ContourResult r = contoured(sphere, {.bounds = Box3::cube(1.3), .cells = row.cells});
        const MeshReport report = closed_manifold(r.mesh);
        CHECK(report.vertices == row.vertices);
        CHECK(report.triangles == row.triangles);
        CHECK(report.euler_characteristic == 2);
        CHECK(std::abs(report.area - row.area) < 6e-6);
        CHECK(std::abs(report.volume.value() - row.volume) < 6e-6);
        CHECK(r.undefined_points == 0);
        CHECK(r.touches == no_sides);
        for (std::size_t v = 0; v < r.mesh.vertices.size(); ++v) {
            const Vec3 p = r.mesh.vertices[v];
            REQUIRE(std::abs(length(p) - 1) < 1e-12);
            REQUIRE(dot(p, p) <= 1);  // the inside end is kept
            REQUIRE(dot(p, r.mesh.normals[v]) > 1 - 1e-9);
        }
    }
}

TEST_CASE("a torus has genus 1, two spheres have two components, a shell a cavity") {
    MeshReport r =
        closed_manifold(contoured(generic_field(torus_function(1, 0.4)), {.bounds = Box3::cube(1.5)}).mesh);
    CHECK(r.genus == 1.0);
    CHECK(r.volume.value() == doctest::Approx(2 * 9.8696044 * 0.16).epsilon(2e-3));
    const auto two = [](auto x, auto y, auto z) {
        using math::max;
        return max(sphere_function(0.4, -0.5)(x, y, z), sphere_function(0.4, 0.5)(x, y, z));
    };
    r = closed_manifold(contoured(generic_field(two), {.bounds = Box3::cube(1), .cells = 50}).mesh);
    CHECK(r.components == 2);
    CHECK(r.genus == 0.0);
    const auto merged = [](auto x, auto y, auto z) {
        using math::max;
        return max(sphere_function(0.5, -0.3)(x, y, z), sphere_function(0.5, 0.3)(x, y, z));
    };
    r = closed_manifold(contoured(generic_field(merged), {.bounds = Box3::cube(1), .cells = 50}).mesh);
    CHECK(r.components == 1);
    const auto shell = [](auto x, auto y, auto z) {
        using math::min;
        return min(sphere_function(0.9)(x, y, z), -sphere_function(0.5)(x, y, z));
    };
    r = closed_manifold(contoured(generic_field(shell), {.bounds = Box3::cube(1), .cells = 60}).mesh);
    CHECK(r.components == 2);
    CHECK(r.volume.value() == doctest::Approx(4.18879 * (0.729 - 0.125)).epsilon(5e-3));
}

TEST_CASE("random noise gives a closed oriented manifold under the cap") {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        const FunctionField field = noise_field(seed, 10);
        const ContourResult r = contoured(field, {.bounds = Box3::cube(1), .cells = 10, .cap = true});
        closed_manifold(r.mesh);
        CHECK(r.mesh.triangles.size() > 2000);
        CHECK(check(contoured(field, {.bounds = Box3::cube(1), .cells = 10}).mesh).boundary_edges > 0);
        CHECK(r.touches == std::array<bool, 6>{true, true, true, true, true, true});
    }
    closed_manifold(contoured(noise_field(1, 40), {.bounds = Box3::cube(1), .cells = 40, .cap = true}).mesh);
    for (const double share : {0.05, 0.2, 0.8, 0.95}) {
        CAPTURE(share);
        closed_manifold(
            contoured(noise_field(5, 17, share), {.bounds = Box3::cube(1), .cells = 17, .cap = true}).mesh);
    }
}

TEST_CASE("noise with undefined and infinite values stays closed, and is counted") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        const FunctionField field = noise_field(seed, 13, 0.6, 0.2);
        const ContourResult r = contoured(field, {.bounds = Box3::cube(1), .cells = 13, .cap = true});
        closed_manifold(r.mesh);
        CHECK(r.undefined_points > 14 * 14 * 14 / 10);
        REQUIRE(r.first_undefined.has_value());
    }
    const FunctionField infinite([](double x, double y, double z) {
        const double v = noise_field(3, 11)(x, y, z);
        return v > 0.3 ? infinity : v < -0.3 ? -infinity : v;
    });
    closed_manifold(contoured(infinite, {.bounds = Box3::cube(1), .cells = 11, .cap = true}).mesh);
}

TEST_CASE("the cap closes a shape at the box, exactly on its sides") {
    // A ball that the box cuts on five sides, and a box filled completely.
    const FunctionField ball = generic_field(sphere_function(1, 0, 0, 0.2));
    const Box3 box{{-0.7, -0.8, -0.5}, {0.9, 0.8, 1.5}};
    const ContourResult open = contoured(ball, {.bounds = box, .cells = 20});
    const ContourResult capped = contoured(ball, {.bounds = box, .cells = 20, .cap = true});
    CHECK(check(open.mesh).boundary_edges > 0);
    CHECK(check(open.mesh).manifold);
    closed_manifold(capped.mesh);
    CHECK(capped.touches == std::array<bool, 6>{true, true, true, true, true, false});
    CHECK(open.touches == capped.touches);
    const Box3 grid = capped.grid.bounds();
    for (const Vec3& v : capped.mesh.vertices) REQUIRE(grid.contains(v));
    CHECK(check(capped.mesh, {.as_float32 = false}).bounds->min == grid.min);

    const FunctionField everything = generic_field([](auto x, auto, auto) { return x * 0.0 + 1.0; });
    for (const int cells : {1, 2, 6, 7, 8, 14, 20}) {
        CAPTURE(cells);
        const ContourResult full =
            contoured(everything, {.bounds = Box3::cube(1), .cells = cells, .cap = true});
        const MeshReport report = closed_manifold(full.mesh);
        CHECK(report.genus == 0.0);
        CHECK(report.volume.value() == doctest::Approx(8).epsilon(1e-12));
        CHECK(report.area == doctest::Approx(24).epsilon(1e-12));
        const ContourResult uncut = contoured(everything, {.bounds = Box3::cube(1), .cells = cells});
        CHECK(uncut.mesh.triangles.empty());
        CHECK(uncut.touches == std::array<bool, 6>{true, true, true, true, true, true});
    }
}

TEST_CASE("constant functions") {
    for (const double value : {-1.0, undefined, -infinity}) {
        const FunctionField field([=](double, double, double) { return value; });
        const ContourResult r = contoured(field, {.bounds = Box3::cube(1), .cells = 12, .cap = true});
        CHECK(r.mesh.vertices.empty());
        CHECK(r.touches == no_sides);
        CHECK(r.undefined_points == (value == value ? 0 : 13 * 13 * 13));
    }
    // Surely undefined by its intervals: counted without a sample taken.
    const FunctionField nowhere =
        generic_field([](auto x, auto, auto) { return math::sqrt(-1.0 - math::square(x)); });
    const ContourResult none = contoured(nowhere, {.bounds = Box3::cube(1), .cells = 12});
    CHECK(none.sampled_blocks == 0);
    CHECK(none.undefined_points == 13 * 13 * 13);
    CHECK(none.first_undefined == Vec3{-1, -1, -1});
    const FunctionField zero([](double, double, double) { return 0.0; });  // 0 is inside, everywhere
    CHECK(contoured(zero, {.bounds = Box3::cube(1), .cells = 4}).touches[0]);
}

TEST_CASE("a surface through grid vertices, edges and faces") {
    // The octahedron and the cube have their corners and faces exactly on samples: F = 0 there, inside.
    const auto octahedron = [](auto x, auto y, auto z) {
        using math::abs;
        return 1.0 - abs(x) - abs(y) - abs(z);
    };
    const auto cube = [](auto x, auto y, auto z) {
        using math::abs;
        using math::min;
        return min(min(1.0 - abs(x), 1.0 - abs(y)), 1.0 - abs(z));
    };
    for (const int cells : {8, 16, 20}) {
        CAPTURE(cells);
        MeshReport r = closed_manifold(
            contoured(generic_field(octahedron), {.bounds = Box3::cube(2), .cells = cells}).mesh);
        CHECK(r.volume.value() == doctest::Approx(4.0 / 3).epsilon(1e-3));
        r = closed_manifold(contoured(generic_field(cube), {.bounds = Box3::cube(2), .cells = cells}).mesh);
        CHECK(r.genus == 0.0);
        CHECK(r.volume.value() == doctest::Approx(8).epsilon(1e-3));
    }
    for (const int cells : {8, 20}) {
        const ContourResult r =
            contoured(generic_field(octahedron), {.bounds = Box3::cube(2), .cells = cells});
        for (const Vec3& v : r.mesh.vertices) {
            const auto off = [&](double c) {
                return std::abs((c + 2) / r.grid.cell - std::round((c + 2) / r.grid.cell));
            };
            REQUIRE(std::max({off(v.x), off(v.y), off(v.z)}) > 0.99e-4);
        }
    }
    // Only one sample is inside, with F = 0: a tiny octahedron, not nothing and not degenerate.
    const auto point = [](auto x, auto y, auto z) {
        return -math::square(x) - math::square(y) - math::square(z);
    };
    const ContourResult r = contoured(generic_field(point), {.bounds = Box3::cube(1), .cells = 4});
    CHECK(r.mesh.triangles.size() == 8);
    closed_manifold(r.mesh);
}

TEST_CASE("a solid that ends where F is undefined gets a wall there") {
    // Inside the ball, and undefined for x > 0.3: the wall is a disk with normal +x.
    const auto value = [](auto x, auto y, auto z) {
        return sphere_function(1)(x, y, z) + 0.0 * math::sqrt(0.3 - x);
    };
    const ContourResult r = contoured(generic_field(value), {.bounds = Box3::cube(1.3), .cells = 40});
    const MeshReport report = closed_manifold(r.mesh);
    CHECK(report.volume.value() == doctest::Approx(3.14159265 * (1.3 - (0.027 + 1) / 3)).epsilon(5e-3));
    CHECK(report.bounds->max.x == doctest::Approx(0.3).epsilon(1e-6));
    CHECK(r.undefined_points > 0);
    REQUIRE(r.first_undefined.has_value());
    CHECK(r.first_undefined->x > 0.3);
    std::size_t on_wall = 0;
    for (std::size_t v = 0; v < r.mesh.vertices.size(); ++v) {
        const Vec3 p = r.mesh.vertices[v];
        if (p.x < 0.3 - 1e-9 || p.y * p.y + p.z * p.z > 0.7) continue;
        ++on_wall;
        REQUIRE(r.mesh.normals[v].x > 0.999);
    }
    CHECK(on_wall > 100);
}

TEST_CASE("pruning and threads change no byte") {
    const auto cut_ball = [](auto x, auto y, auto z) {
        return sphere_function(0.6)(x, y, z) + 0.0 * math::sqrt(x + 0.4);
    };
    const auto half_defined = [](auto x, auto y, auto z) {
        using math::max;
        return max(torus_function(1, 0.3)(x, y, z), sphere_function(0.4)(x, y, z)) * math::sqrt(x + 1.0);
    };
    for (const bool cap : {false, true}) {
        for (const auto& field :
             {generic_field(sphere_function(0.9, 0.3)), generic_field(torus_function(1, 0.3)),
              generic_field(half_defined), generic_field(cut_ball)}) {
            for (const int cells : {5, 30, 61}) {
                CAPTURE(cells);
                ContourOptions options{
                    .bounds = {{-1.2, -1.3, -0.2}, {1.1, 1.0, 0.7}}, .cells = cells, .cap = cap};
                options.prune = false;
                const ContourResult plain = contoured(field, options);
                options.prune = true;
                const ContourResult pruned = contoured(field, options);
                CHECK(same_bytes(plain, pruned));
                CHECK(plain.mesh.triangles.size() > 0);
                if (cells == 61) CHECK(pruned.sampled_blocks < plain.sampled_blocks);
                for (const int threads : {2, 8}) CHECK(same_bytes(plain, contoured(field, options, threads)));
            }
        }
    }
}

TEST_CASE("the number of evaluated blocks follows the surface") {
    const FunctionField sphere = generic_field(sphere_function(1));
    const std::size_t coarse = contoured(sphere, {.bounds = Box3::cube(1.3), .cells = 50}).sampled_blocks;
    const std::size_t fine = contoured(sphere, {.bounds = Box3::cube(1.3), .cells = 200}).sampled_blocks;
    CHECK(fine < 24 * coarse);
}

TEST_CASE("flat boxes, huge and shifted coordinates") {
    const FunctionField sphere = generic_field(sphere_function(1e6, 4e6, 0, 0));
    MeshReport r = closed_manifold(
        contoured(sphere, {.bounds = {{2.9e6, -1.1e6, -1.1e6}, {5.1e6, 1.1e6, 1.1e6}}, .cells = 30}).mesh);
    CHECK(r.volume.value() == doctest::Approx(4.18879e18).epsilon(1e-2));
    const ContourResult flat =
        contoured(generic_field(sphere_function(1)), {.bounds = {{-2, -2, 0}, {2, 2, 0}}, .cells = 40});
    CHECK(flat.grid.cells[2] == 1);
    CHECK(check(flat.mesh).manifold);
}

TEST_CASE("limits and cancellation are errors") {
    const FunctionField sphere = generic_field(sphere_function(1));
    const auto kind = [&](const ContourOptions& options, const Job& job) {
        const Result<ContourResult> result = contour_cells(sphere, options, job);
        REQUIRE_FALSE(static_cast<bool>(result));
        CHECK_FALSE(result.error().message.empty());
        return result.error().kind;
    };
    CHECK(kind({.bounds = Box3::cube(1.3), .cells = 2'000'000}, Job{}) == ErrorKind::over_limit);
    CHECK(kind({.bounds = Box3::cube(1.3), .cells = 100, .memory_limit = 100'000}, Job{}) ==
          ErrorKind::over_limit);
    CHECK(kind({.bounds = Box3::cube(1.3), .cells = 100, .memory_limit = 1000}, Job{}) ==
          ErrorKind::over_limit);
    CHECK(kind({.bounds = Box3::cube(1.3), .cells = 0}, Job{}) == ErrorKind::invalid_argument);
    Job cancelled;
    cancelled.cancel();
    CHECK(kind({.bounds = Box3::cube(1.3)}, cancelled) == ErrorKind::cancelled);
}

TEST_CASE("wrong intervals are noticed, not drawn") {
    // The range denies the right half of the ball.
    const FunctionField liar(sphere_function(1), [](test::Interval x, test::Interval, test::Interval) {
        return x.lo > 0 ? test::Interval(-2, -1) : test::Interval(-2, 1);
    });
    const Result<ContourResult> result = contour_cells(liar, {.bounds = Box3::cube(1.3), .cells = 40}, Job{});
    REQUIRE_FALSE(static_cast<bool>(result));
    CHECK(result.error().message.find("pruning") != std::string::npos);
}

TEST_CASE("parts of a field that stand for it in blocks keep positions, and normals to rounding") {
    auto graph = std::make_shared<Graph>();
    const NodeId axes[3] = {graph->coordinate(0), graph->coordinate(1), graph->coordinate(2)};
    NodeId all = graph->constant(-1.0);
    for (int n = 0; n < 25; ++n) {
        NodeId ball = graph->constant(0.05 + 0.03 * test::noise(1, static_cast<std::uint64_t>(n)));
        for (std::uint64_t a = 0; a < 3; ++a) {
            const double c = 0.8 * test::noise(2 + a, static_cast<std::uint64_t>(n));
            const NodeId d = graph->make(Op::sub, {axes[a], graph->constant(c)});
            ball = graph->make(Op::sub, {ball, graph->make(Op::square, {d})});
        }
        all = graph->make(n % 5 == 4 ? Op::max : Op::r_or, {all, ball});
    }
    Field field;
    field.graph = graph;
    field.value = all;
    auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    const auto sampled = make_sampled_field(std::move(*evaluator), AxisMap::standard(3));
    REQUIRE(sampled);
    ContourOptions options{.bounds = Box3::cube(1.1), .cells = 70};
    options.prune = false;
    const auto plain = contour_cells(**sampled, options, Job());
    options.prune = true;
    const auto pruned = contour_cells(**sampled, options, Job());
    REQUIRE(plain);
    REQUIRE(pruned);
    CHECK(plain->mesh.vertices.size() > 1000);
    CHECK(plain->mesh.vertices == pruned->mesh.vertices);
    CHECK(plain->mesh.triangles == pruned->mesh.triangles);
    REQUIRE(plain->mesh.normals.size() == pruned->mesh.normals.size());
    double worst = 0;
    for (std::size_t v = 0; v < plain->mesh.normals.size(); ++v)
        worst = std::max(worst, length(plain->mesh.normals[v] - pruned->mesh.normals[v]));
    CHECK(worst < 1e-9);
}
