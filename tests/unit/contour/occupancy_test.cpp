// Occupancy of boxes: sizes, parts and differences of disks, balls and rings against their formulas.
#include "frep/contour/occupancy.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/contour/test_fields.h"

using namespace frep;
using doctest::Approx;
using frep::test::FunctionField;

namespace {

constexpr double pi = 3.141592653589793;

Occupancy sampled(FunctionField::Value f, const Box3& box, int longest, int threads = 2) {
    const FunctionField field(std::move(f));
    FieldPool pool(field);
    Job job;
    job.threads = threads;
    auto result = sample_occupancy(pool, box, longest, job);
    REQUIRE(result);
    return std::move(*result);
}

double disk(double x, double y, double r) { return r - std::hypot(x, y); }

}  // namespace

TEST_CASE("area and volume of a disk and a ball") {
    const Box3 square{{-2, -1.5, 0.7}, {2, 1.5, 0.7}};
    const Occupancy a =
        sampled([](double x, double y, double z) { return z == 0.7 ? disk(x, y, 1) : 1; }, square, 256);
    CHECK(a.cells == std::array<int, 3>{256, 192, 1});
    CHECK(a.size() == Approx(pi).epsilon(2e-3));
    CHECK(a.components() == 1);
    const Box3 cube{{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}};
    const Occupancy b =
        sampled([](double x, double y, double z) { return 1 - std::hypot(x, y, z); }, cube, 64);
    CHECK(b.size() == Approx(4 * pi / 3).epsilon(5e-3));
    CHECK(b.components() == 1);
    CHECK(sampled([](double, double, double) { return -1; }, cube, 16).size() == 0);
    CHECK(sampled([](double, double, double) { return NAN; }, cube, 16).components() == 0);
}

TEST_CASE("parts that do not touch are counted") {
    const Box3 box{{-4, -4, -1}, {4, 4, 1}};
    const auto rings = [](double x, double y, double z) {
        const double r = std::hypot(x, y);
        return std::max(0.3 - std::hypot(r - 2, z),
                        std::max(0.5 - std::hypot(x, y, z), 0.4 - std::hypot(x - 3.3, y - 3.3, z)));
    };
    CHECK(sampled(rings, box, 128).components() == 3);
    // a ring is one part, whatever the order of cells
    const Box3 flat{{-4, 0, -4}, {4, 0, 4}};
    const auto ring = [](double x, double, double z) { return 0.2 - std::abs(std::hypot(x, z) - 3); };
    CHECK(sampled(ring, flat, 100).components() == 1);
    const auto board = [](double x, double, double z) {
        return static_cast<int>(std::floor(x) + std::floor(z)) % 2 == 0 ? 1.0 : -1.0;
    };
    CHECK(sampled(board, flat, 64).components() == 32);  // corners do not join
}

TEST_CASE("the difference of two disks is that of their lens") {
    const Box3 box{{-2, -2, 0}, {2, 2, 0}};
    const Occupancy a = sampled([](double x, double y, double) { return disk(x, y, 1); }, box, 256);
    const Occupancy b = sampled([](double x, double y, double) { return disk(x - 0.5, y, 1); }, box, 256);
    const double lens = 2 * std::acos(0.25) - 0.5 * std::sqrt(1 - 0.0625);
    CHECK(difference(a, b) == Approx(2 * pi - 2 * lens).epsilon(1e-2));
    CHECK(difference(a, a) == 0);
}

TEST_CASE("threads change nothing; impossible grids are refused") {
    const Box3 cube{{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}};
    const auto f = [](double x, double y, double z) { return 1 - std::hypot(x, y, z); };
    CHECK(sampled(f, cube, 40, 1).inside == sampled(f, cube, 40, 3).inside);
    const FunctionField field(f);
    FieldPool pool(field);
    CHECK(!sample_occupancy(pool, cube, 7, {}));
    CHECK(!sample_occupancy(pool, cube, 513, {}));
    CHECK(!sample_occupancy(pool, {{0, 0, 0}, {1, 0, 0}}, 64, {}));
    CHECK(!sample_occupancy(pool, {{0, 0, 0}, {1, INFINITY, 1}}, 64, {}));
}
