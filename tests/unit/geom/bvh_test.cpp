// Tests of geom/bvh.h: the tree's shape, nearest points and rays against all triangles one by one.
#include "frep/geom/bvh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "unit/geom/exact_reference.h"
#include "unit/geom/shapes.h"

using namespace frep;
using test::Random;

namespace {

Vec3 random_point(Random& random, double half) {
    return {(2 * random.unit() - 1) * half, (2 * random.unit() - 1) * half, (2 * random.unit() - 1) * half};
}

Mesh random_triangles(std::uint64_t seed, int count, double size) {
    Random random(seed);
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3 middle = random_point(random, 1);
        const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int k = 0; k < 3; ++k) mesh.vertices.push_back(middle + random_point(random, size));
        mesh.triangles.push_back({base, base + 1, base + 2});
    }
    return mesh;
}

/// Distance by a fine subdivision of the triangle: an upper bound that is close.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    double best = 1e300;
    constexpr int n = 60;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j)
            best = std::min(best, length(a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n) - p));
    }
    return best;
}

}  // namespace

TEST_CASE("every triangle is in one leaf, every box holds what is below") {
    for (const int count : {1, 4, 5, 8, 9, 17, 1000, 9001}) {
        const Mesh mesh = random_triangles(3, count, 0.1);
        const TriangleBvh tree(mesh);
        CAPTURE(count);
        std::vector<std::uint32_t> order = tree.order();
        std::sort(order.begin(), order.end());
        for (std::size_t i = 0; i < order.size(); ++i) REQUIRE(order[i] == i);
        std::size_t in_leaves = 0;
        for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
            const TriangleBvh::Node& node = tree.nodes()[i];
            for (std::uint32_t k = node.begin; k < node.end; ++k) {
                const Box3 box = tree.box(tree.order()[k]);
                REQUIRE(node.box.contains(box.min));
                REQUIRE(node.box.contains(box.max));
            }
            if (TriangleBvh::is_leaf(node)) {
                in_leaves += node.end - node.begin;
                continue;
            }
            REQUIRE(tree.nodes()[TriangleBvh::left_child(i)].begin == node.begin);
            REQUIRE(tree.nodes()[TriangleBvh::left_child(i)].end == tree.nodes()[tree.right_child(i)].begin);
            REQUIRE(tree.nodes()[tree.right_child(i)].end == node.end);
        }
        CHECK(in_leaves == static_cast<std::size_t>(count));
    }
}

TEST_CASE("the same tree for any number of threads; bad coordinates are left out") {
    Mesh mesh = random_triangles(5, 20000, 0.05);
    for (Vec3& v : mesh.vertices) v.x = std::floor(v.x * 8) / 8;  // many equal centroids
    Job one, three;
    one.threads = 1;
    three.threads = 3;
    CHECK(TriangleBvh(mesh, one).order() == TriangleBvh(mesh, three).order());
    mesh.vertices[0].y = std::nan("");
    mesh.vertices[5].z = HUGE_VAL;
    const TriangleBvh tree(mesh);
    CHECK(tree.order().size() == 19998);
    CHECK(std::count(tree.order().begin(), tree.order().end(), 0u) == 0);
    CHECK_FALSE(TriangleBvh(Mesh{}).nearest({0, 0, 0}));
    CHECK_FALSE(TriangleBvh(Mesh{}).first_hit({{0, 0, 0}, {1, 0, 0}}));
}

TEST_CASE("the nearest point of a triangle") {
    const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
    CHECK(nearest_point_of_triangle({1, 1, 5}, a, b, c) == Vec3{1, 1, 0});
    CHECK(nearest_point_of_triangle({-1, -2, 1}, a, b, c) == a);
    CHECK(nearest_point_of_triangle({2, -3, 1}, a, b, c) == Vec3{2, 0, 0});
    CHECK(nearest_point_of_triangle({4, 4, 1}, a, b, c) == Vec3{2, 2, 0});
    CHECK(nearest_point_of_triangle({3, 1, 0}, a, {2, 0, 0}, b) == Vec3{3, 0, 0});  // without area
    Random random(11);
    for (int i = 0; i < 300; ++i) {
        const Vec3 p = random_point(random, 2), q = random_point(random, 1), r = random_point(random, 1),
                   s = random_point(random, 1);
        const double distance = length(nearest_point_of_triangle(p, q, r, s) - p);
        const double sampled = sampled_distance(p, q, r, s);
        CHECK(distance <= sampled + 1e-12);
        CHECK(distance >= sampled - 0.06);
    }
}

TEST_CASE("nearest points agree with a search of all triangles") {
    const Mesh mesh = random_triangles(17, 800, 0.1);
    const TriangleBvh tree(mesh);
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point(random, 1.5);
        double best = 1e300;
        std::uint32_t nearest = 0;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const Triangle& tri = mesh.triangles[t];
            const Vec3 q = nearest_point_of_triangle(p, mesh.vertices[tri[0]], mesh.vertices[tri[1]],
                                                     mesh.vertices[tri[2]]);
            if (dot(q - p, q - p) < best) {
                best = dot(q - p, q - p);
                nearest = t;
            }
        }
        const auto found = tree.nearest(p);
        REQUIRE(found);
        CHECK(found->triangle == nearest);
        CHECK(found->distance == std::sqrt(best));
        CHECK(tree.nearest(p, found->distance * 1.001).has_value());
        CHECK_FALSE(tree.nearest(p, found->distance * 0.999).has_value());
    }
}

TEST_CASE("rays agree with a search of all triangles") {
    const Mesh mesh = random_triangles(23, 600, 0.15);
    const TriangleBvh tree(mesh);
    Random random(4);
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        Vec3 direction = random_point(random, 1);
        if (i % 4 == 0) direction = {0, i % 8 == 0 ? 1.0 : -1.0, 0};
        const TriangleBvh::Ray ray{random_point(random, 1.5), direction};
        // Cramer's rule, another way than the code under test.
        double best = 1e300;
        std::uint32_t first = 0;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3 a = mesh.vertices[mesh.triangles[t][0]];
            const Vec3 u = mesh.vertices[mesh.triangles[t][1]] - a;
            const Vec3 v = mesh.vertices[mesh.triangles[t][2]] - a;
            const double det = dot(u, cross(ray.direction, v));
            const Vec3 s = ray.origin - a;
            const double x = dot(s, cross(ray.direction, v)) / det;
            const double y = dot(ray.direction, cross(s, u)) / det;
            const double at = dot(v, cross(s, u)) / det;
            if (x >= 0 && y >= 0 && x + y <= 1 && at >= 0 && at < best) {
                best = at;
                first = t;
            }
        }
        const auto hit = tree.first_hit(ray);
        CAPTURE(i);
        REQUIRE(hit.has_value() == (best < 1e300));
        if (!hit) continue;
        ++hits;
        CHECK(hit->triangle == first);
        CHECK(hit->t == doctest::Approx(best).epsilon(1e-9));
        const auto next = tree.first_hit(ray, [first](std::uint32_t t) { return t != first; });
        if (next) CHECK(next->t >= hit->t);
        CHECK_FALSE(tree.first_hit({ray.origin, direction, 0, hit->t * 0.999}));
    }
    CHECK(hits > 100);
}

TEST_CASE("no ray slips through a common edge or vertex") {
    const Mesh mesh = merge_equal_positions(test::sphere({0, 0, 0}, 1, 2));
    const TriangleBvh tree(mesh);
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = mesh.vertices[t[static_cast<std::size_t>(k)]];
            const Vec3 b = mesh.vertices[t[static_cast<std::size_t>((k + 1) % 3)]];
            for (const Vec3& through : {a, (a + b) * 0.5, a * 0.75 + b * 0.25}) {
                CHECK(tree.first_hit({{0, 0, 0}, through}).has_value());
                CHECK(tree.first_hit({through * 2, -through}).has_value());
            }
        }
    }
}
