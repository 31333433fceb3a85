// Tests of contour/grid.h: whole cells around a box, refusals, block codes.
#include "frep/contour/grid.h"

#include <doctest/doctest.h>

#include "unit/contour/test_fields.h"

using namespace frep;

TEST_CASE("cells along the longest side, the others widened symmetrically") {
    const Grid grid = *make_grid({{-1, 0, -5}, {2, 1, 5}}, 20);
    CHECK(grid.cell == 0.5);
    CHECK(grid.cells == std::array<std::uint32_t, 3>{6, 2, 20});
    CHECK(grid.origin == Vec3{-1, 0, -5});
    const Grid widened = *make_grid({{0, 0, 0}, {10, 1, 2.5}}, 5);
    CHECK(widened.cells == std::array<std::uint32_t, 3>{5, 1, 2});
    CHECK(widened.bounds() == Box3{{0, -0.5, -0.75}, {10, 1.5, 3.25}});
    CHECK(make_grid(Box3::cube(1.3), 8)->cells == std::array<std::uint32_t, 3>{8, 8, 8});
    CHECK(make_grid(Box3::cube(0.1), 7)->cells == std::array<std::uint32_t, 3>{7, 7, 7});
    CHECK(make_grid({{0, 0, 0}, {1, 0, 0}}, 4)->cells == std::array<std::uint32_t, 3>{4, 1, 1});
}

TEST_CASE("the length of a cell may be given instead") {
    const Grid grid = *make_grid({{0, 0, 0}, {1, 0.95, 0.3}}, 99, 0.1);
    CHECK(grid.cells == std::array<std::uint32_t, 3>{10, 10, 3});
    CHECK(grid.cell == 0.1);
}

TEST_CASE("bad grids are refused") {
    using test::infinity;
    using test::undefined;
    const auto kind = [](const Box3& box, int cells, double length = 0) {
        const Result<Grid> grid = make_grid(box, cells, length);
        REQUIRE_FALSE(static_cast<bool>(grid));
        return grid.error().kind;
    };
    CHECK(kind(Box3::cube(1), 0) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(0), 4) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(-1), 4) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(infinity), 4) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(1e308), 4) == ErrorKind::invalid_argument);
    CHECK(kind({{undefined, 0, 0}, {1, 1, 1}}, 4) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(1), 4, undefined) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(1), 4, -1) == ErrorKind::invalid_argument);
    CHECK(kind(Box3::cube(1), 1'000'001) == ErrorKind::over_limit);
    CHECK(kind(Box3::cube(1), 4, 1e-9) == ErrorKind::over_limit);
    CHECK(kind({{1e15, 0, 0}, {1e15 + 1, 1, 1}}, 1000) == ErrorKind::invalid_argument);
    CHECK(static_cast<bool>(make_grid(Box3::cube(1), 1'000'000)));
}

TEST_CASE("block codes keep the order of an octree") {
    using namespace contouring;
    CHECK(morton_code({0, 0, 0}) == 0);
    CHECK(morton_code({1, 0, 0}) == 1);
    CHECK(morton_code({0, 1, 0}) == 2);
    CHECK(morton_code({0, 0, 1}) == 4);
    CHECK(morton_code({2, 0, 0}) == 8);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const std::array<std::uint32_t, 3> block{i * 2087 % 2097152, i * 911 % 2097152, i * 77777 % 2097152};
        CHECK(morton_decode(morton_code(block)) == block);
    }
}
