// Tests of geom/self_intersection.h: counts known by hand, all pairs against exact clipping on meshes with
// many degeneracies, and independence of order, axes and threads.
#include "frep/geom/self_intersection.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "unit/geom/exact_reference.h"
#include "unit/geom/shapes.h"

using namespace frep;
using test::Random;
using test::together;

namespace {

SelfIntersections found(const Mesh& mesh, const SelfIntersectionOptions& options = {}, int threads = 2) {
    Job job;
    job.threads = threads;
    return find_self_intersections(mesh, options, job).value();
}

/// Triangles with corners on a small grid, of which some are equal in position but not in number.
Mesh random_mesh(std::uint64_t seed, int triangles, int side, int depth) {
    Random random(seed);
    Mesh mesh;
    for (int v = 0; v < 3 * triangles; ++v) {
        mesh.vertices.push_back({static_cast<double>(random.below(side)),
                                 static_cast<double>(random.below(side)),
                                 static_cast<double>(random.below(depth))});
    }
    for (int t = 0; t < triangles; ++t) {
        const auto any = [&] { return static_cast<std::uint32_t>(random.below(3 * triangles)); };
        mesh.triangles.push_back({any(), any(), any()});
    }
    return mesh;
}

std::size_t count_all_pairs(const Mesh& raw) {
    const Mesh mesh = merge_equal_positions(raw);
    const auto corners = [&mesh](const Triangle& t) {
        return test::IntegerTriangle{test::integer_point(mesh.vertices[t[0]]),
                                     test::integer_point(mesh.vertices[t[1]]),
                                     test::integer_point(mesh.vertices[t[2]])};
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < mesh.triangles.size(); ++j)
            count +=
                test::meet_outside_shared(corners(mesh.triangles[i]), corners(mesh.triangles[j])) ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("sound meshes have none") {
    CHECK(found(Mesh{}).count == 0);
    CHECK(found(test::tetrahedron()).count == 0);
    CHECK(found(test::box({0, 0, 0}, {1, 2, 3})).count == 0);
    CHECK(found(test::sphere({0.1, 0.2, 0.3}, 1, 4)).count == 0);
    // A cavity that touches nothing, and a neighbor.
    CHECK(found(together(test::sphere({0, 0, 0}, 1, 3), test::sphere({0, 0, 0}, 0.9, 3))).count == 0);
    CHECK(found(together(test::sphere({0, 0, 0}, 1, 3), test::sphere({2.001, 0, 0}, 1, 3))).count == 0);
}

TEST_CASE("counts known by hand") {
    // A needle with three long faces through the bottom and the top of a box: each long face crosses one
    // triangle of each, and misses its diagonal.
    Mesh needle = test::tetrahedron();
    needle.vertices = {{3, 1, -1}, {3.25, 1, -1}, {3, 1.25, -1}, {3, 1, 3}};
    const SelfIntersections s = found(together(test::box({0, 0, 0}, {4, 4, 2}), needle));
    CHECK(s.count == 6);
    REQUIRE(s.listed.size() == 6);
    for (const IntersectingPair& pair : s.listed) {
        CHECK(pair.first < 4);     // bottom and top of the box
        CHECK(pair.second >= 13);  // not the needle's small face
        CHECK((pair.place.z == 0 || pair.place.z == 2));
        CHECK(pair.place.x >= 3);
        CHECK(pair.place.x <= 3.25);
    }
    CHECK(std::is_sorted(s.listed.begin(), s.listed.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
    }));
    // The same box twice: every triangle meets its twin; those with a common edge in one plane overlap, too
    // (2 per side: a side's triangles with the other's twin are side by side, no); and each triangle
    // touches its neighbors at common edges only.
    const Mesh box = test::box({0, 0, 0}, {1, 1, 1});
    CHECK(found(together(box, box)).count == 12);
    CHECK(found(together(box, test::turned_inside_out(box))).count == 12);
    // Two boxes with a whole face in common, triangulated alike: 2 pairs; merely touching along half of
    // it: counted by the oracle.
    CHECK(found(together(box, test::box({0, 0, 1}, {1, 1, 2}))).count == 2);
    const Mesh half = together(test::box({0, 0, 0}, {2, 2, 2}), test::box({1, 1, 2}, {3, 3, 4}));
    CHECK(found(half).count == count_all_pairs(half));
    CHECK(found(half).count > 2);
}

TEST_CASE("the written coordinates decide") {
    // The tip of the tetrahedron stays 1e-9 below the triangle; in binary32 it touches.
    Mesh mesh = test::tetrahedron({0, 0, 0});
    mesh.vertices.insert(mesh.vertices.end(), {{-1, -1, 1 + 1e-9}, {2, -1, 1 + 1e-9}, {-1, 2, 1 + 1e-9}});
    mesh.triangles.push_back({4, 5, 6});
    CHECK(found(mesh, {.as_float32 = false}).count == 0);
    const SelfIntersections s = found(mesh);
    CHECK(s.count == 3);  // the three faces at the tip
    CHECK(s.listed.at(0).place == Vec3{0, 0, 1});
}

TEST_CASE("indices are those of the mesh asked about") {
    Mesh mesh = test::tetrahedron();
    mesh.vertices.push_back({0, 0, 1});
    mesh.triangles.insert(mesh.triangles.begin(), {0, 3, 4});  // collapses
    mesh = together(mesh, test::tetrahedron({0.1, 0.1, 0.1}));
    const SelfIntersections s = found(mesh);
    REQUIRE(s.count > 0);
    for (const IntersectingPair& pair : s.listed) {
        CHECK(pair.first >= 1);
        CHECK(pair.first <= 4);
        CHECK(pair.second >= 5);
        CHECK(pair.second <= 8);
    }
}

TEST_CASE("random meshes on a grid, against all pairs by exact clipping") {
    std::size_t total = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const int side = 2 + static_cast<int>(seed % 5), depth = 1 + static_cast<int>(seed % 3);
        const Mesh mesh = random_mesh(seed, 24, side, depth);
        CAPTURE(seed);
        const std::size_t expected = count_all_pairs(mesh);
        CHECK(found(mesh).count == expected);
        total += expected;
    }
    CHECK(total > 1000);
}

TEST_CASE("order, axes, threads and the length of the list change nothing") {
    for (std::uint64_t seed = 100; seed < 103; ++seed) {
        const Mesh mesh = random_mesh(seed, 500, 40, 40);
        const SelfIntersections s = found(mesh, {.max_listed = 20});
        CAPTURE(seed);
        REQUIRE(s.count > 1000);
        CHECK(s.listed.size() == 20);
        for (const int threads : {1, 3}) {
            const SelfIntersections t = found(mesh, {.max_listed = 20}, threads);
            CHECK(t.count == s.count);
            CHECK(t.listed == s.listed);
        }
        const SelfIntersections longer = found(mesh, {.max_listed = s.count + 5});
        CHECK(longer.listed.size() == s.count);
        CHECK(std::equal(s.listed.begin(), s.listed.end(), longer.listed.begin()));

        Random random(seed);
        Mesh other = mesh;
        for (Vec3& v : other.vertices) v = {v.y, v.z, -v.x};
        for (std::size_t i = other.triangles.size(); i > 1; --i)
            std::swap(other.triangles[i - 1],
                      other.triangles[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
        for (Triangle& t : other.triangles) {
            std::rotate(t.begin(), t.begin() + random.below(3), t.end());
            if (random.below(2) == 0) std::swap(t[0], t[1]);
        }
        CHECK(found(other).count == s.count);
    }
}

TEST_CASE("a cancelled search says so") {
    Job job;
    job.cancel();
    const auto result = find_self_intersections(test::sphere({0, 0, 0}, 1, 3), {}, job);
    REQUIRE_FALSE(result);
    CHECK(result.error().kind == ErrorKind::cancelled);
}
