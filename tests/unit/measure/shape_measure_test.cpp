// Sizes, centroids and moments of inertia of shapes with known ones.
#include "frep/measure/shape_measure.h"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;
using math::Interval;

namespace {

constexpr double pi = std::numbers::pi;

ShapeMeasure measured(const Field& field, const Box3& box, double error = 1e-3, std::size_t cells = 0,
                      int threads = 0) {
    ShapeMeasureOptions options;
    options.bounds = box;
    options.relative_error = error;
    options.max_cells = cells;
    Job job;
    job.threads = threads;
    const auto result = measure_shape(field, options, job);
    if (!result) FAIL(result.error().message);
    return *result;
}

ShapeMeasure measured_flat(const Field& field, const Box3& box, double error = 1e-3) {
    ShapeMeasureOptions options;
    options.bounds = box;
    options.axes = {true, true, false};
    options.relative_error = error;
    const auto result = measure_shape(field, options, {});
    if (!result) FAIL(result.error().message);
    return *result;
}

bool is_within(const Interval& v, double error) { return v.hi - v.lo <= error * (v.lo + v.hi); }

}  // namespace

TEST_CASE("known volumes lie in the interval, which is as narrow as asked") {
    struct Known {
        const char* body;
        double half, volume;
    };
    for (const Known& known : {
             Known{"my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;", 1.3, 4 * pi / 3},
             Known{"my_model = (1-x[1]^2) & (0.49-x[2]^2) & (0.25-x[3]^2);", 1.3, 2 * 1.4 * 1},
             Known{"array c[3]; c = [0,0,0]; my_model = hfTorusZ(x, c, 1, 0.4);", 1.7, 2 * pi * pi * 0.16},
             Known{"array c[3]; c = [0.1,0,0]; my_model = hfEllipsoid(x, c, 1.1, 0.5, 0.8);", 1.5,
                   4 * pi / 3 * 1.1 * 0.5 * 0.8},
             Known{"array c[3]; c = [0,0,0]; my_model = hfCylinderZ(x, c, 0.5) & (1-x[3]) & (x[3]+1);", 1.2,
                   2 * pi * 0.25},
             // Steinmetz's solid of two cylinders: 16/3 r^3
             Known{"my_model = min(1-x[1]^2-x[2]^2, 1-x[1]^2-x[3]^2);", 1.1, 16.0 / 3},
             // a ball with a quarter taken out
             Known{"my_model = (1-x[1]^2-x[2]^2-x[3]^2) \\ (x[1] & x[2]);", 1.2, pi},
         }) {
        CAPTURE(known.body);
        const ShapeMeasure m = measured(space_field_of(known.body), Box3::cube(known.half));
        CHECK(holds(m.size, known.volume));
        CHECK(m.is_reached);
        CHECK(is_within(m.size, 1e-3));
        CHECK(m.has_planes);
        CHECK(m.evaluated < 400'000);
        for (const bool side : m.cut) CHECK_FALSE(side);
    }
}

TEST_CASE("a flat side is exact, in few cells") {
    // a box whose sides are planes through no cell boundary, in min form
    const ShapeMeasure m =
        measured(space_field_of("my_model = min(min(0.71-abs(x[1]), 0.37-abs(x[2])), 0.53-abs(x[3]));"),
                 Box3::cube(1));
    CHECK(holds(m.size, 8 * 0.71 * 0.37 * 0.53));
    CHECK(m.evaluated < 40'000);
}

TEST_CASE("inertia of an ellipsoid about its centroid") {
    const double a = 1.1, b = 0.5, c = 0.8, x = 3, y = -2, z = 0.5;
    const ShapeMeasure m =
        measured(space_field_of("array c[3]; c = [3,-2,0.5]; my_model = hfEllipsoid(x, c, 1.1, 0.5, 0.8);"),
                 {{x - 1.2, y - 0.6, z - 0.9}, {x + 1.2, y + 0.6, z + 0.9}});
    const double mass = 4 * pi / 3 * a * b * c;
    CHECK(holds(m.centroid[0], x));
    CHECK(holds(m.centroid[1], y));
    CHECK(holds(m.centroid[2], z));
    for (const Interval& v : m.centroid) CHECK(v.hi - v.lo < 0.01);
    CHECK(holds(m.inertia[0], mass * (b * b + c * c) / 5));
    CHECK(holds(m.inertia[1], mass * (a * a + c * c) / 5));
    CHECK(holds(m.inertia[2], mass * (a * a + b * b) / 5));
    for (std::size_t k = 0; k < 3; ++k) CHECK(is_within(m.inertia[k], 5e-3));
    for (std::size_t k = 3; k < 6; ++k) {
        CHECK(holds(m.inertia[k], 0));
        CHECK(m.inertia[k].hi - m.inertia[k].lo < 0.005 * mass);
    }
}

TEST_CASE("products of inertia have their sign") {
    // a bar along the diagonal of x and y: xy > 0 on it, so that the product -xy is negative
    const ShapeMeasure m =
        measured(space_field_of("my_model = min(min(1-abs(x[1]+x[2]), 0.2-abs(x[1]-x[2])), 0.1-abs(x[3]));"),
                 Box3::cube(1));
    // u = x+y in -1..1, v = x-y in -0.2..0.2, dx dy = du dv/2, xy = (u^2-v^2)/4
    const double product = 0.2 / 8 * (0.4 * 2.0 / 3 - 2 * (2 * 0.008 / 3));
    CHECK(holds(m.size, 0.2 * 0.4));
    CHECK(holds(m.inertia[3], -product));
    CHECK(m.inertia[3].hi < 0);
}

TEST_CASE("the centroid of half a ball") {
    const ShapeMeasure m =
        measured(space_field_of("my_model = min(1-x[1]^2-x[2]^2-x[3]^2, x[3]);"), Box3::cube(1.25));
    CHECK(holds(m.centroid[2], 3.0 / 8));
    CHECK(m.centroid[2].hi - m.centroid[2].lo < 2e-3);
    CHECK(holds(m.centroid[0], 0));
}

TEST_CASE("a smaller error is reached too") {
    const ShapeMeasure m =
        measured(space_field_of("my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;"), Box3::cube(1.3), 3e-4);
    CHECK(holds(m.size, 4 * pi / 3));
    CHECK(is_within(m.size, 3e-4));
}

TEST_CASE("shapes of the plane") {
    const ShapeMeasure disk = measured_flat(space_field_of("my_model = 1 - x[1]^2 - (x[2]-2)^2;", 2),
                                            {{-1.5, 0.5, 0}, {1.5, 3.5, 0}}, 1e-5);
    CHECK(holds(disk.size, pi));
    CHECK(is_within(disk.size, 1e-5));
    CHECK(holds(disk.centroid[1], 2));
    CHECK(disk.centroid[2].lo == 0);
    CHECK(holds(disk.inertia[0], pi / 4));
    CHECK(holds(disk.inertia[2], pi / 2));
}

TEST_CASE("empty and full boxes") {
    const ShapeMeasure empty = measured(space_field_of("my_model = -1 - x[1]^2;"), Box3::cube(2));
    CHECK(empty.size.lo == 0);
    CHECK(empty.size.hi == 0);
    CHECK(empty.is_reached);
    const ShapeMeasure full = measured(space_field_of("my_model = 10 - x[1]^2;"), {{0, 0, 0}, {1, 2, 3}});
    CHECK(holds(full.size, 6));
    CHECK(full.size.hi - full.size.lo < 1e-12);
    CHECK(full.is_reached);
    for (const bool side : full.cut) CHECK(side);
    CHECK(holds(full.centroid[2], 1.5));
    CHECK(holds(full.inertia[0], 6 * (4.0 + 9.0) / 12));
    CHECK(full.evaluated == 1);
}

TEST_CASE("undefined parts count as outside") {
    // sqrt(x) has no value for x < 0: a quarter of the box, x > 0 and y < sqrt(x)... F >= 0 where y <=
    // sqrt(x)
    const ShapeMeasure m =
        measured_flat(space_field_of("my_model = sqrt(x[1]) - x[2];", 2), {{-1, 0, 0}, {1, 1, 0}}, 2e-3);
    CHECK(holds(m.size, 2.0 / 3));
    CHECK(m.is_reached);
    const ShapeMeasure none = measured(space_field_of("my_model = sqrt(-1-x[1]^2);"), Box3::cube(1));
    CHECK(none.size.hi == 0);
}

TEST_CASE("a function that jumps") {
    const ShapeMeasure m =
        measured_flat(space_field_of("f = -1; if (x[1] < 0.3) then f = 1; endif; my_model = f;", 2),
                      {{0, 0, 0}, {1, 1, 0}}, 1e-3);
    CHECK(holds(m.size, 0.3));
    CHECK(m.is_reached);
}

TEST_CASE("what cannot be reached is told with the interval that was") {
    const ShapeMeasure m =
        measured(space_field_of("my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;"), Box3::cube(1.3), 1e-5, 500);
    CHECK(holds(m.size, 4 * pi / 3));
    CHECK_FALSE(m.is_reached);
    CHECK(m.open <= 500);
}

TEST_CASE("a cancelled job gives what was reached") {
    ShapeMeasureOptions options;
    options.bounds = Box3::cube(1.3);
    Job job;
    int rounds = 0;
    job.on_progress = [&](double) {
        if (++rounds == 3) job.cancel();
    };
    const auto m = measure_shape(space_field_of("my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;"), options, job);
    REQUIRE(m);
    CHECK(m->is_cancelled);
    CHECK_FALSE(m->is_reached);
    CHECK(holds(m->size, 4 * pi / 3));
}

TEST_CASE("the same bytes for any number of threads") {
    const Field field = space_field_of(
        "array c[3]; c = [0,0,0]; my_model = hfTorusZ(x, c, 1, 0.4) | (0.36 - (x[1]-1)^2 - x[2]^2 - "
        "x[3]^2);");
    const ShapeMeasure one = measured(field, Box3::cube(2), 0.1, 0, 1);
    for (const int threads : {2, 5}) {
        const ShapeMeasure other = measured(field, Box3::cube(2), 0.1, 0, threads);
        CHECK(std::memcmp(&one.size, &other.size, sizeof(Interval)) == 0);
        CHECK(one.evaluated == other.evaluated);
        for (std::size_t k = 0; k < 6; ++k) {
            CHECK(one.inertia[k].lo == other.inertia[k].lo);
            CHECK(one.inertia[k].hi == other.inertia[k].hi);
        }
    }
}

TEST_CASE("the sides where the box cuts a shape") {
    const ShapeMeasure m = measured(space_field_of("my_model = -x[3];"), Box3::cube(2));
    CHECK(m.cut == std::array<bool, 6>{true, true, true, true, true, false});
    CHECK(holds(m.size, 32));
}

TEST_CASE("a part of the gallery: the volume of its mesh lies in the interval") {
    const auto model = compile_file(FREP_SOURCE_DIR "/examples/csg-part.hf");
    REQUIRE(model);
    const auto field = model->field();
    REQUIRE(field);
    const Box3 box{{-66, -40, -4}, {66, 40, 118}};
    const auto space = field_in_space(*field, AxisMap::standard(3));
    REQUIRE(space);
    const ShapeMeasure m = measured(*space, box, 0.05);
    CHECK(m.is_reached);
    ContourOptions options;
    options.bounds = box;
    const auto mesh = contour(*field, options);
    REQUIRE(mesh);
    const MeshReport report = check(mesh->mesh, {}, {});
    REQUIRE(report.volume);
    CHECK(holds(m.size, *report.volume));
}

TEST_CASE("wrong boxes are refused") {
    ShapeMeasureOptions options;
    options.bounds = {{0, 0, 0}, {1, 0, 1}};
    CHECK_FALSE(measure_shape(space_field_of("my_model = 1;"), options, {}));
    options.bounds = Box3::cube(1e308);
    CHECK_FALSE(measure_shape(space_field_of("my_model = 1;"), options, {}));
}
