// Tests of contour/thin_parts.h through contour_adaptive: walls, gaps, rods and balls between samples are
// told of wherever they lie, and solids whose parts all meet samples are not.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "unit/contour/adaptive_checks.h"
#include "unit/contour/csg_trees.h"

using namespace frep;
using namespace frep::test;

namespace {

using std::abs;
using std::max;
using std::min;

constexpr double cell = 2.0 / 32;

ContourResult contoured(FunctionField::Value f, int cells = 32, bool prune = true) {
    return adaptive(FunctionField(std::move(f)), {.bounds = Box3::cube(1), .cells = cells, .prune = prune});
}

/// A frame that is turned at random, and a point near the middle.
struct Pose {
    explicit Pose(Chance& chance) {
        const double turn = 2 * std::numbers::pi;
        const double a = chance.between(0, turn), b = chance.between(0, turn), c = chance.between(0, turn);
        const Vec3 u{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
        const Vec3 side{-std::sin(a), std::cos(a), 0};
        const Vec3 up = cross(u, side);
        axes[0] = u;
        axes[1] = std::cos(c) * side + std::sin(c) * up;
        axes[2] = cross(u, axes[1]);
        for (double* o : {&origin.x, &origin.y, &origin.z}) *o = chance.between(-0.2, 0.2);
    }
    Vec3 local(double x, double y, double z) const {
        const Vec3 d = Vec3{x, y, z} - origin;
        return {dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2])};
    }
    Vec3 axes[3], origin;
};

}  // namespace

TEST_CASE("walls along the lattice, wherever they lie between samples") {
    for (int axis = 0; axis < 3; ++axis) {
        for (int layer = 8; layer < 17; ++layer) {
            for (const double thickness : {0.6, 0.05, 0.002}) {
                CAPTURE(axis);
                CAPTURE(layer);
                CAPTURE(thickness);
                const double middle = -1 + cell * (layer + 0.37);
                const ContourResult r = contoured([=](double x, double y, double z) {
                    const double along[3] = {x, y, z};
                    const double d = along[axis], u = along[(axis + 1) % 3], v = along[(axis + 2) % 3];
                    return min(thickness * cell / 2 - abs(d - middle), min(.5 - abs(u), .6 - abs(v)));
                });
                CHECK(r.mesh.triangles.empty());
                CHECK(r.hidden_cells > 50);
                REQUIRE(r.first_hidden);
                const Vec3 p = *r.first_hidden;
                const double found = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
                CHECK(abs(found + cell / 2 - middle) < cell);
            }
        }
    }
}

TEST_CASE("thin parts in any direction") {
    Chance chance(5);
    for (int round = 0; round < 30; ++round) {
        CAPTURE(round);
        const Pose pose(chance);
        // A wall and a gap of a twentieth of a cell.
        const auto sheet = [=](double x, double y, double z) {
            const Vec3 p = pose.local(x, y, z);
            return min(.025 * cell - abs(p.x), .6 - max(abs(p.y), abs(p.z)));
        };
        CHECK(contoured(sheet).hidden_cells > 20);
        CHECK(contoured([=](double x, double y, double z) {
                  return min(.9 - max(max(abs(x), abs(y)), abs(z)), -sheet(x, y, z));
              }).hidden_cells > 20);
        // A shell, bent.
        CHECK(contoured([=](double x, double y, double z) {
                  const Vec3 p = pose.local(x, y, z);
                  return .02 * cell - abs(length(p) - .6);
              }).hidden_cells > 20);
        // A rod, by distance and by squares.
        CHECK(contoured([=](double x, double y, double z) {
                  const Vec3 p = pose.local(x, y, z);
                  return min(.1 * cell - std::sqrt(p.x * p.x + p.y * p.y), .7 - abs(p.z));
              }).hidden_cells > 2);
        CHECK(contoured([=](double x, double y, double z) {
                  const Vec3 p = pose.local(x, y, z);
                  return min(.04 * cell * cell - p.x * p.x - p.y * p.y, .7 - abs(p.z));
              }).hidden_cells > 2);
    }
}

TEST_CASE("small balls are found in most places") {
    Chance chance(6);
    std::size_t lost = 0, found = 0;
    for (int round = 0; round < 100; ++round) {
        const Pose pose(chance);
        const ContourResult r = contoured([=](double x, double y, double z) {
            const Vec3 p = pose.local(x, y, z);
            return .2 * cell - length(p);
        });
        if (!r.mesh.triangles.empty()) continue;
        ++lost;
        found += r.hidden_cells > 0;
    }
    CHECK(lost > 50);
    CHECK(found > 3 * lost / 4);
}

TEST_CASE("solids whose parts all meet samples hide nothing") {
    Chance chance(7);
    for (int round = 0; round < 30; ++round) {
        CAPTURE(round);
        const Pose pose(chance);
        const auto box = [=](double x, double y, double z) {
            const Vec3 p = pose.local(x, y, z);
            return .5 - max(max(abs(p.x), abs(p.y) * 1.2), abs(p.z) * .9);
        };
        CHECK(contoured(box).hidden_cells == 0);
        CHECK(contoured([=](double x, double y, double z) {
                  return min(.9 - max(max(abs(x), abs(y)), abs(z)), -box(x, y, z));
              }).hidden_cells == 0);
        CHECK(contoured([=](double x, double y, double z) {
                  const Vec3 p = pose.local(x, y, z);
                  const double d = std::sqrt(p.x * p.x + p.y * p.y) - .5;
                  return .04 - d * d - p.z * p.z;
              }).hidden_cells == 0);
        CHECK(contoured([=](double x, double y, double z) {
                  const Vec3 p = pose.local(x, y, z);
                  return min(1 - 2 * std::sqrt(p.x * p.x + p.y * p.y) - p.z, .4 - abs(p.z));
              }).hidden_cells == 0);
    }
}
