// Tests of contour/contour_2d.h: known circles, orientation, hostile data, caps, planes, determinism.
#include "frep/contour/contour_2d.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "unit/contour/test_fields.h"

using namespace frep;
using test::FunctionField;
using test::generic_field;
using test::sphere_function;

namespace {

constexpr double pi = 3.14159265358979323846;

PlaneContour outlined(const SampledField& field, const PlaneContourOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    Result<PlaneContour> result = contour_plane(field, options, job);
    REQUIRE(static_cast<bool>(result));
    for (const Polyline& line : result->outlines) REQUIRE(line.points.size() >= (line.closed ? 3u : 2u));
    return std::move(*result);
}

bool same(const PlaneContour& a, const PlaneContour& b) {
    if (a.outlines.size() != b.outlines.size() || a.undefined_points != b.undefined_points) return false;
    for (std::size_t i = 0; i < a.outlines.size(); ++i) {
        if (a.outlines[i].closed != b.outlines[i].closed) return false;
        if (a.outlines[i].points != b.outlines[i].points) return false;
    }
    return a.first_undefined == b.first_undefined && a.touches == b.touches;
}

/// Uncorrelated values at the samples of the grid of `cells` cells on [-1, 1]^2, constant around.
FunctionField noise_field(std::uint64_t seed, int cells, double share_nan = 0) {
    return FunctionField([=](double x, double y, double) {
        const auto index = [=](double v) {
            return static_cast<std::uint64_t>(std::floor((v + 1) * 0.5 * cells + 0.5) + 100);
        };
        const std::uint64_t i = index(y) * 1000 + index(x);
        if (test::noise(seed + 77, i) < 2 * share_nan - 1) return test::undefined;
        return test::noise(seed, i);
    });
}

double turn(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Whether two pieces of outline that share no end have a common point.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x)) return false;
    if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return false;
    const auto across = [](double s, double t) { return (s <= 0 && t >= 0) || (s >= 0 && t <= 0); };
    return across(turn(a, b, c), turn(a, b, d)) && across(turn(c, d, a), turn(c, d, b));
}

/// Fails when outlines touch or cross themselves or each other.
void check_simple(const std::vector<Polyline>& lines) {
    struct Piece {
        Vec2 a, b;
    };
    std::vector<Piece> pieces;
    for (const Polyline& line : lines) {
        for (std::size_t i = 0; i + 1 < line.points.size() + (line.closed ? 1 : 0); ++i)
            pieces.push_back({line.points[i], line.points[(i + 1) % line.points.size()]});
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t k = i + 1; k < pieces.size(); ++k) {
            const Piece p = pieces[i], q = pieces[k];
            if (p.b == q.a || q.b == p.a) continue;
            REQUIRE_FALSE(meet(p.a, p.b, q.a, q.b));
        }
    }
}

std::size_t open_count(const std::vector<Polyline>& lines) {
    return static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [](const Polyline& line) { return !line.closed; }));
}

}  // namespace

TEST_CASE("a circle: points on it, counter-clockwise, the area of a fine polygon") {
    const FunctionField disk = generic_field(sphere_function(1));
    for (const int cells : {16, 64, 256}) {
        CAPTURE(cells);
        const PlaneContour r = outlined(disk, {.bounds = Box3::cube(1.3), .cells = cells});
        REQUIRE(r.outlines.size() == 1);
        CHECK(r.outlines[0].closed);
        for (const Vec2& p : r.outlines[0].points) {
            const double radius = std::sqrt(p.x * p.x + p.y * p.y);
            REQUIRE(std::abs(radius - 1) < 2e-4 * r.cell);  // nodes keep off the samples
            REQUIRE(radius <= 1 + 1e-15);                   // the inside end
        }
        const OutlineReport report = check(r.outlines);
        // Chords of at most sqrt(2) cells: each loses at most a sagitta h = c^2 / 8 of the radius.
        const double chord = std::sqrt(2.0) * r.cell;
        CHECK(report.area < pi);
        CHECK(report.area > pi - 2 * pi * chord * chord / 8);
        CHECK(report.length < 2 * pi);
        CHECK(report.closed == 1);
        CHECK(r.undefined_points == 0);
        CHECK(r.touches == std::array<bool, 6>{});
    }
}

TEST_CASE("a ring: the hole runs clockwise and counts off the area") {
    const auto ring = [](auto x, auto y, auto z) {
        using math::min;
        return min(sphere_function(0.9)(x, y, z), -sphere_function(0.5)(x, y, z));
    };
    const PlaneContour r = outlined(generic_field(ring), {.bounds = Box3::cube(1), .cells = 200});
    REQUIRE(r.outlines.size() == 2);
    CHECK(signed_area(r.outlines[0]) == doctest::Approx(pi * 0.81).epsilon(1e-3));
    CHECK(signed_area(r.outlines[1]) == doctest::Approx(-pi * 0.25).epsilon(1e-3));
    CHECK(check(r.outlines).area == doctest::Approx(pi * 0.56).epsilon(1e-3));
}

TEST_CASE("noise gives outlines that never touch or cross; closed under the cap") {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        CAPTURE(seed);
        const double share_nan = seed % 2 == 0 ? 0 : 0.6;
        const FunctionField field = noise_field(seed, 21, share_nan);
        const PlaneContour open = outlined(field, {.bounds = Box3::cube(1), .cells = 21});
        const PlaneContour capped = outlined(field, {.bounds = Box3::cube(1), .cells = 21, .cap = true});
        check_simple(open.outlines);
        check_simple(capped.outlines);
        CHECK(open_count(open.outlines) > 0);
        CHECK(open_count(capped.outlines) == 0);
        CHECK(capped.outlines.size() > 20);
        CHECK(check(capped.outlines).area > 0.5);
        CHECK((capped.undefined_points > 0) == (share_nan > 0));
        CHECK(capped.touches == std::array<bool, 6>{true, true, true, true, false, false});
    }
}

TEST_CASE("the cap follows the sides of the box, with no more points than needed") {
    const FunctionField everything = generic_field([](auto x, auto, auto) { return x * 0.0 + 1.0; });
    for (const int cells : {1, 2, 13, 14, 15, 16, 40}) {
        CAPTURE(cells);
        const PlaneContourOptions options{.bounds = {{-1, -1, 0}, {1, 1, 0}}, .cells = cells, .cap = true};
        const PlaneContour r = outlined(everything, options);
        REQUIRE(r.outlines.size() == 1);
        CHECK(r.outlines[0].points.size() == 4);
        CHECK(check(r.outlines).area == doctest::Approx(4).epsilon(1e-14));
        PlaneContourOptions open = options;
        open.cap = false;
        CHECK(outlined(everything, open).outlines.empty());
    }
    // A half-plane: one open line upward at x = 0.25 (the solid to its left), or a closed rectangle.
    const FunctionField half = generic_field([](auto x, auto, auto) { return 0.25 - x; });
    const PlaneContour open = outlined(half, {.bounds = Box3::cube(1), .cells = 10});
    REQUIRE(open.outlines.size() == 1);
    CHECK_FALSE(open.outlines[0].closed);
    CHECK(open.outlines[0].points.front().y == -1);
    CHECK(open.outlines[0].points.back().y == doctest::Approx(1));
    CHECK(check(open.outlines).length == doctest::Approx(2));
    const PlaneContour capped = outlined(half, {.bounds = Box3::cube(1), .cells = 10, .cap = true});
    CHECK(check(capped.outlines).area == doctest::Approx(2.5).epsilon(1e-9));
}

TEST_CASE("planes: the axes, the height, and the side that is left") {
    const auto ball = [](auto x, auto y, auto z) {
        using math::min;
        return min(sphere_function(1, 0.1, 0.2, 0.3)(x, y, z), z * 1.0 + 10.0);
    };
    const FunctionField field = generic_field(ball);
    struct Row {
        Plane plane;
        Vec2 middle;
        double radius;
    };
    for (const Row& row : {Row{{0, 1, 0.5}, {0.1, 0.2}, std::sqrt(1 - 0.04)},
                           Row{{0, 2, -0.4}, {0.1, 0.3}, std::sqrt(1 - 0.36)},
                           Row{{1, 2, 0.1}, {0.2, 0.3}, 1}, Row{{2, 0, 0.2}, {0.3, 0.1}, 1}}) {
        const PlaneContour r = outlined(field, {.bounds = Box3::cube(1.5), .plane = row.plane, .cells = 100});
        REQUIRE(r.outlines.size() == 1);
        CHECK(signed_area(r.outlines[0]) > 0);
        for (const Vec2& p : r.outlines[0].points) {
            const Vec2 d = p - row.middle;
            REQUIRE(std::abs(std::sqrt(d.x * d.x + d.y * d.y) - row.radius) < 2e-4 * r.cell);
        }
    }
    const PlaneContour cut = outlined(field, {.bounds = Box3::cube(0.8), .plane = {0, 2, 0.2}, .cells = 100});
    CHECK(cut.touches == std::array<bool, 6>{true, true, false, false, false, true});
}

TEST_CASE("undefined points are counted, and the first named") {
    const FunctionField half([](double x, double y, double) {
        return y < 0.05 ? test::undefined : sphere_function(0.8)(x, y, 0.0);
    });
    const PlaneContour r = outlined(half, {.bounds = Box3::cube(1), .cells = 20});
    CHECK(r.undefined_points == 21 * 11);
    CHECK(r.first_undefined == Vec3{-1, -1, 0});
    REQUIRE(r.outlines.size() == 1);
    CHECK(check(r.outlines).min.y == doctest::Approx(0.05).epsilon(1e-3));
    const FunctionField nowhere =
        generic_field([](auto x, auto, auto) { return math::sqrt(-1.0 - math::square(x)); });
    const PlaneContour none = outlined(nowhere, {.bounds = Box3::cube(1), .cells = 40});
    CHECK(none.sampled_blocks == 0);
    CHECK(none.undefined_points == 41 * 41);
    CHECK(none.first_undefined == Vec3{-1, -1, 0});
}

TEST_CASE("pruning and threads change nothing") {
    const auto rings = [](auto x, auto y, auto z) {
        using math::max;
        return max(max(sphere_function(0.6, 0.3)(x, y, z), sphere_function(0.2, -0.7, 0.1)(x, y, z)),
                   sphere_function(0.31, 0.1, 0.9)(x, y, z)) *
               math::sqrt(x + 0.8);
    };
    const FunctionField field = generic_field(rings);
    for (const bool cap : {false, true}) {
        for (const int cells : {3, 15, 100, 333}) {
            CAPTURE(cells);
            PlaneContourOptions options{
                .bounds = {{-1.1, -0.9, 0}, {0.8, 1.0, 0}}, .cells = cells, .cap = cap, .prune = false};
            const PlaneContour plain = outlined(field, options);
            options.prune = true;
            const PlaneContour pruned = outlined(field, options);
            CHECK(same(plain, pruned));
            CHECK_FALSE(plain.outlines.empty());
            if (cells == 333) CHECK(3 * pruned.sampled_blocks < plain.sampled_blocks);
            for (const int threads : {2, 8}) CHECK(same(plain, outlined(field, options, threads)));
        }
    }
}

TEST_CASE("limits, bad planes and cancellation are errors") {
    const FunctionField disk = generic_field(sphere_function(1));
    const auto kind = [&](const PlaneContourOptions& options, const Job& job) {
        const Result<PlaneContour> result = contour_plane(disk, options, job);
        REQUIRE_FALSE(static_cast<bool>(result));
        return result.error().kind;
    };
    CHECK(kind({.plane = {0, 0, 0}}, Job{}) == ErrorKind::invalid_argument);
    CHECK(kind({.plane = {0, 1, test::infinity}}, Job{}) == ErrorKind::invalid_argument);
    CHECK(kind({.cells = 0}, Job{}) == ErrorKind::invalid_argument);
    CHECK(kind({.cells = 2'000'000}, Job{}) == ErrorKind::over_limit);
    CHECK(kind({.bounds = Box3::cube(2), .cells = 5000, .memory_limit = 100'000}, Job{}) ==
          ErrorKind::over_limit);
    Job cancelled;
    cancelled.cancel();
    CHECK(kind({}, cancelled) == ErrorKind::cancelled);
    // The range denies the right half of the disk.
    const FunctionField liar(sphere_function(1), [](test::Interval x, test::Interval, test::Interval) {
        return x.lo > 0 ? test::Interval(-2, -1) : test::Interval(-2, 1);
    });
    const Result<PlaneContour> wrong = contour_plane(liar, {.bounds = Box3::cube(1.3)}, Job{});
    REQUIRE_FALSE(static_cast<bool>(wrong));
    CHECK(wrong.error().message.find("pruning") != std::string::npos);
}
