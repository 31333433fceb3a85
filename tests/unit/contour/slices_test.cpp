// Tests of contour/slices.h: heights, the volume of a ball, empty ends, threads, limits.
#include "frep/contour/slices.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/contour/test_fields.h"

using namespace frep;
using test::generic_field;
using test::sphere_function;

namespace {

constexpr double pi = 3.14159265358979323846;

Slicing sliced(const SampledField& field, const SlicingOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    Result<Slicing> result = slice_layers(field, options, job);
    REQUIRE(static_cast<bool>(result));
    return std::move(*result);
}

SlicingOptions in_box(const Box3& box, double thickness, int cells = 100) {
    SlicingOptions options;
    options.contour.bounds = box;
    options.contour.cells = cells;
    options.thickness = thickness;
    return options;
}

}  // namespace

TEST_CASE("a ball on the plate: whole layers, the circles of their middles, the volume") {
    const auto ball = generic_field(sphere_function(1, 0, 0, 1));  // from z = 0 to z = 2
    for (const int count : {10, 40}) {
        CAPTURE(count);
        const double thickness = 2.0 / count;
        const Slicing s = sliced(ball, in_box({{-1.2, -1.2, -0.33}, {1.2, 1.2, 2.4}}, thickness));
        REQUIRE(s.slices.size() == static_cast<std::size_t>(count));
        double volume = 0;
        for (std::size_t i = 0; i < s.slices.size(); ++i) {
            const double top = static_cast<double>(i + 1) * thickness;
            CHECK(s.slices[i].z == doctest::Approx(top).epsilon(1e-14));
            const double height = top - 0.5 * thickness - 1;
            REQUIRE(s.slices[i].outlines.size() == 1);
            for (const Vec2& p : s.slices[i].outlines[0].points)
                REQUIRE(std::abs(p.x * p.x + p.y * p.y + height * height - 1) < 1e-5);
            volume += signed_area(s.slices[i].outlines[0]) * thickness;
        }
        // The middle rule: its error falls with the square of the thickness.
        CHECK(volume == doctest::Approx(4 * pi / 3).epsilon(thickness * thickness));
    }
}

TEST_CASE("empty layers between two parts stay, those at the ends go") {
    const auto two = [](auto x, auto y, auto z) {
        using math::max;
        return max(sphere_function(0.5, 0, 0, -2)(x, y, z), sphere_function(0.5, 0, 0, 2)(x, y, z));
    };
    const Slicing s = sliced(generic_field(two), in_box(Box3::cube(5), 0.5));
    REQUIRE(s.slices.size() == 10);
    CHECK(s.slices.front().z == -2);
    CHECK(s.slices.back().z == 2.5);
    CHECK(s.slices[4].outlines.empty());
    const auto nothing = generic_field([](auto x, auto, auto) { return x * 0.0 - 1.0; });
    CHECK(sliced(nothing, in_box(Box3::cube(1), 0.1)).slices.empty());
}

TEST_CASE("the same slices for every number of threads; sides that are touched") {
    const auto ball = generic_field(sphere_function(1, 0.1, 0.2, 0.3));
    const SlicingOptions options = in_box({{-0.7, -2, -2}, {2, 2, 2}}, 0.07);
    const Slicing one = sliced(ball, options);
    CHECK(one.touches == std::array<bool, 6>{true, false, false, false, false, false});
    for (const int threads : {2, 8}) {
        const Slicing many = sliced(ball, options, threads);
        REQUIRE(many.slices.size() == one.slices.size());
        for (std::size_t i = 0; i < one.slices.size(); ++i) {
            REQUIRE(many.slices[i].z == one.slices[i].z);
            REQUIRE(many.slices[i].outlines.size() == one.slices[i].outlines.size());
            for (std::size_t k = 0; k < one.slices[i].outlines.size(); ++k)
                REQUIRE(many.slices[i].outlines[k].points == one.slices[i].outlines[k].points);
        }
    }
}

TEST_CASE("limits of slices") {
    const auto ball = generic_field(sphere_function(1));
    const auto kind = [&](const SlicingOptions& options) {
        const Result<Slicing> result = slice_layers(ball, options, Job{});
        REQUIRE_FALSE(static_cast<bool>(result));
        return result.error().kind;
    };
    CHECK(kind(in_box(Box3::cube(1), 0)) == ErrorKind::invalid_argument);
    CHECK(kind(in_box(Box3::cube(1), 1e-9)) == ErrorKind::over_limit);
    CHECK(kind(in_box(Box3::cube(1), 0.1, 0)) == ErrorKind::invalid_argument);
    SlicingOptions small = in_box(Box3::cube(1.1), 0.01);
    small.contour.memory_limit = 200'000;
    CHECK(kind(small) == ErrorKind::over_limit);
}
