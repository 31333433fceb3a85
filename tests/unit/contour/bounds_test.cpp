// Tests of contour/bounds.h: tight boxes, growth, unbounded and empty shapes.
#include "frep/contour/bounds.h"

#include <doctest/doctest.h>

#include "unit/contour/test_fields.h"

using namespace frep;
using test::generic_field;
using test::sphere_function;

namespace {

AutomaticBounds bounds_of(test::FunctionField field, const BoundsOptions& options = {}) {
    Result<AutomaticBounds> result = automatic_bounds(field, options, Job{});
    REQUIRE(static_cast<bool>(result));
    return *result;
}

}  // namespace

TEST_CASE("a small, a large and a far sphere get a tight box") {
    struct Ball {
        double radius, x;
    };
    for (const Ball ball : {Ball{1, 0}, {0.05, 3}, {9.99, 0}, {700, 100}, {2, 9}}) {
        const double radius = ball.radius, x = ball.x;
        CAPTURE(radius);
        const AutomaticBounds b = bounds_of(generic_field(sphere_function(radius, x)));
        CHECK_FALSE(b.unbounded);
        CHECK_FALSE(b.empty);
        CHECK(b.box.min.x < x - radius);
        CHECK(b.box.max.x > x + radius);
        CHECK(b.box.min.z < -radius);
        CHECK(b.box.max.x - b.box.min.x < 2.2 * radius);
        CHECK(b.box.max.y - b.box.min.y < 2.2 * radius);
        CHECK(b.evaluations < 20000);
    }
}

TEST_CASE("a flat box and a thin plate") {
    const auto plate = [](auto x, auto y, auto z) {
        using math::abs;
        using math::min;
        return min(min(3.0 - abs(x), 2.0 - abs(y)), 0.001 - abs(z));
    };
    const AutomaticBounds b = bounds_of(generic_field(plate));
    CHECK_FALSE(b.unbounded);
    CHECK(b.box.max.x > 3);
    CHECK(b.box.max.x < 3.5);
    CHECK(b.box.max.z > 0.001);
    CHECK(b.box.max.z < 0.5);
}

TEST_CASE("an unbounded shape stays at the first cube and says so") {
    const AutomaticBounds b = bounds_of(generic_field([](auto x, auto, auto) { return x - 3.0; }));
    CHECK(b.unbounded);
    CHECK(b.box == Box3::cube(10));
    CHECK(b.reaches == std::array<bool, 6>{false, true, true, true, true, true});
    // Nothing known about boxes: the same.
    CHECK(bounds_of(test::FunctionField(sphere_function(1))).unbounded);
}

TEST_CASE("an axis that the model does not use neither grows nor counts") {
    const auto disk = [](auto x, auto y, auto) { return 4.0 - math::square(x) - math::square(y); };
    const AutomaticBounds b = bounds_of(generic_field(disk), {.axes = {true, true, false}});
    CHECK_FALSE(b.unbounded);
    CHECK(b.box.max.x > 2);
    CHECK(b.box.max.x < 2.2);
    CHECK(b.box.max.z == 10);
}

TEST_CASE("an empty shape and one that is undefined outside itself") {
    CHECK(bounds_of(generic_field([](auto x, auto, auto) { return -1.0 - math::square(x); })).empty);
    CHECK(bounds_of(generic_field(sphere_function(1, 50))).empty);
    const auto ball = [](auto x, auto y, auto z) {
        return math::sqrt(1.0 - math::square(x) - math::square(y) - math::square(z));
    };
    const AutomaticBounds b = bounds_of(generic_field(ball));
    CHECK_FALSE(b.unbounded);
    CHECK(b.box.max.y > 1);
    CHECK(b.box.max.y < 1.1);
}

TEST_CASE("a cancelled search") {
    Job job;
    job.cancel();
    test::FunctionField field = generic_field(sphere_function(1));
    const Result<AutomaticBounds> result = automatic_bounds(field, {}, job);
    REQUIRE_FALSE(static_cast<bool>(result));
    CHECK(result.error().kind == ErrorKind::cancelled);
}
