// Tests of contour/qef.h: eigenvalues, planes, edges, corners, boxes.
#include "frep/contour/qef.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/contour/test_fields.h"

using namespace frep;
using namespace frep::contouring;

namespace {

const Box3 unit_box{{0, 0, 0}, {1, 1, 1}};

bool near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) { return length(a - b) <= tolerance; }

Vec3 unit(const Vec3& v) { return v / length(v); }

}  // namespace

TEST_CASE("eigenvalues and eigenvectors of random symmetric matrices") {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        std::array<double, 6> m{};
        for (std::size_t i = 0; i < 6; ++i) m[i] = test::noise(seed, i) * (seed % 5 == 0 && i > 2 ? 1e-9 : 1);
        const SymmetricEigen eigen = eigen_of(m);
        CHECK(eigen.values[0] >= eigen.values[1]);
        CHECK(eigen.values[1] >= eigen.values[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& v = eigen.vectors[k];
            const Vec3 product{m[0] * v.x + m[1] * v.y + m[2] * v.z, m[1] * v.x + m[3] * v.y + m[4] * v.z,
                               m[2] * v.x + m[4] * v.y + m[5] * v.z};
            CHECK(near(product, v * eigen.values[k], 1e-12));
            for (std::size_t j = 0; j < 3; ++j)
                CHECK(std::abs(dot(v, eigen.vectors[j]) - (j == k ? 1 : 0)) < 1e-12);
        }
    }
}

TEST_CASE("one plane: the mean of its points") {
    QuadraticError error;
    const Vec3 n = unit({1, 2, 3});
    const Vec3 along = unit(cross(n, {0, 0, 1})), across = cross(n, along);
    const Vec3 at{0.5, 0.4, 0.5};
    error.add(at + along * 0.1, n);
    error.add(at - along * 0.1, n);
    error.add(at + across * 0.15, n);
    CHECK(near(error.minimum(unit_box), at + across * 0.05));
}

TEST_CASE("two planes: the nearest point of their line; three: their corner") {
    QuadraticError error;
    error.add({0.3, 0.2, 0.1}, {1, 0, 0});
    error.add({0.3, 0.4, 0.3}, {1, 0, 0});
    error.add({0.1, 0.6, 0.8}, {0, 1, 0});
    const Vec3 edge = error.minimum(unit_box);
    CHECK(near(edge, {0.3, 0.6, 0.4}));
    error.add({0.2, 0.5, 0.75}, {0, 0, 1});
    CHECK(near(error.minimum(unit_box), {0.3, 0.6, 0.75}));
    QuadraticError parts, more;
    parts.add({0.3, 0.2, 0.1}, {1, 0, 0});
    parts.add({0.3, 0.4, 0.3}, {1, 0, 0});
    more.add({0.1, 0.6, 0.8}, {0, 1, 0});
    more.add({0.2, 0.5, 0.75}, {0, 0, 1});
    parts.add(more);
    CHECK(parts.minimum(unit_box) == error.minimum(unit_box));
}

TEST_CASE("a corner outside of the box: the best point of the box") {
    // The line x = 0.5, y = 2 z - 1.2 leaves the box at z = 0.6 (y = 0) and z = 1 (y = 0.8).
    const Vec3 slope = unit({0, 1, -2});
    QuadraticError error;
    error.add({0.5, 0.1, 0.05}, {1, 0, 0});
    error.add({0.5, 0.2, 0.1}, {1, 0, 0});
    error.add({0.2, 0, 0.6}, slope);
    const Vec3 found = error.minimum(unit_box);
    CHECK(unit_box.contains(found));
    CHECK(std::abs(found.x - 0.5) < 1e-5);
    CHECK(std::abs(dot(slope, found - Vec3{0, 0, 0.6})) < 1e-5);
    // A corner at (2, 2, 2): the box's own corner is nearest to all three planes.
    QuadraticError far;
    far.add({2, 0.5, 0.5}, {1, 0, 0});
    far.add({0.5, 2, 0.5}, {0, 1, 0});
    far.add({0.5, 0.5, 2}, {0, 0, 1});
    CHECK(near(far.minimum(unit_box), {1, 1, 1}));
}

TEST_CASE("points without normals, and a mean outside of the box") {
    QuadraticError error;
    error.add({0.2, 0.2, 0}, {0, 0, 0});
    error.add({0.4, 0.2, 0}, {0, 0, 0});
    CHECK(near(error.minimum({{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}}), {0.3, 0.2, 0.1}));
    error.add({0, 0, 0}, {0, 0, 1});
    const Vec3 found = error.minimum({{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}});
    CHECK(found.z == 0.1);
}

TEST_CASE("random planes never leave the box") {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        QuadraticError error;
        const std::size_t planes = 1 + seed % 6;
        for (std::size_t i = 0; i < planes; ++i) {
            const auto r = [&](std::uint64_t k) { return test::noise(seed, 10 * i + k); };
            const double spread = seed % 3 == 0 ? 1e-3 : 1;
            const Vec3 n = unit(Vec3{1, 0.5, 0.2} + Vec3{r(0), r(1), r(2)} * spread);
            error.add({0.5 + 0.5 * r(3), 0.5 + 0.5 * r(4), 0.5 + 0.5 * r(5)}, n);
        }
        const Box3 box{{1e-4, 1e-4, 1e-4}, {1 - 1e-4, 1 - 1e-4, 1 - 1e-4}};
        CHECK(box.contains(error.minimum(box)));
    }
}
