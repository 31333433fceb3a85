// Tests of geom/print_check.h: solids whose walls, gaps, overhangs and standing are known by construction.
#include "frep/geom/print_check.h"

#include <doctest/doctest.h>

#include <cmath>

#include "frep/geom/mesh_check.h"
#include "unit/geom/shapes.h"

using namespace frep;
using doctest::Approx;
using test::together;

namespace {

PrintCheckOptions few_samples() {
    PrintCheckOptions options;
    options.samples = 3000;
    return options;
}

PrintReport checked(const Mesh& mesh, const PrintCheckOptions& options = few_samples()) {
    return print_check(mesh, options).value();
}

/// The part of a width report that is known exactly.
void check_widths(const WidthReport& report, double smallest, double area) {
    REQUIRE(report.smallest.has_value());
    CHECK(report.smallest->length_mm == Approx(smallest).epsilon(1e-9));
    CHECK(report.measured_area_mm2 == Approx(area).epsilon(1e-9));
}

/// The unit cube whose top is moved by `s` along x: the side at x = 1 leans out by atan(s).
Mesh leaning(double s) {
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    for (Vec3& v : mesh.vertices) v.x += v.z * s;
    return mesh;
}

}  // namespace

TEST_CASE("a box") {
    const PrintReport r = checked(test::box({0, 0, 0}, {10, 20, 30}));
    CHECK(r.size_mm == Vec3{10, 20, 30});
    CHECK(r.height_mm == 30);
    CHECK(r.components == 1);
    CHECK(r.samples > 2900);
    check_widths(r.walls, 10, 2200);  // edges of 90 degrees are no thin walls
    CHECK(r.walls.smallest->from.x + r.walls.smallest->to.x == Approx(10));
    CHECK(r.walls.smallest->from.y == r.walls.smallest->to.y);
    CHECK(r.walls.p01_mm == Approx(10));
    CHECK(r.walls.median_mm == Approx(10));  // 1200 of the 2200
    CHECK_FALSE(r.gaps.smallest);
    CHECK(r.gaps.measured_area_mm2 == 0);
    CHECK(r.overhang.area_mm2 == 0);
    CHECK_FALSE(r.overhang.worst);
    CHECK(r.stand.contact_area_mm2 == 200);
    CHECK(r.stand.margin_mm.value() == Approx(5));
    CHECK(r.stand.stable);
    CHECK(r.smallest_component->size_mm == 30);
}

TEST_CASE("a box with a cavity off the middle") {
    const Mesh mesh = together(test::box({0, 0, 0}, {10, 10, 10}),
                               test::turned_inside_out(test::box({1.5, 1, 3}, {9, 8, 9})));
    PrintCheckOptions options = few_samples();
    options.min_wall_mm = 1.25;
    options.min_gap_mm = 6.5;
    const PrintReport r = checked(mesh, options);
    CHECK(r.walls.smallest->length_mm == Approx(1));
    check_widths(r.gaps, 6, 2 * (7.5 * 7 + 7.5 * 6 + 7 * 6));  // of the cavity, along z
    CHECK(r.gaps.smallest->from.z + r.gaps.smallest->to.z == Approx(12));
    CHECK(r.gaps.below_limit_area_mm2 == Approx(2 * 7.5 * 7));
    // Walls of 1: y from 0 to 1 (7.5 x 6), x from 9 to 10 (7 x 6) and z from 9 to 10 (7.5 x 7), seen from
    // inside and from outside; the outside shares are sampled.
    const double inside = 7.5 * 6 + 7 * 6 + 7.5 * 7;
    CHECK(r.walls.below_limit_area_mm2 == Approx(2 * inside).epsilon(0.03));
    CHECK(r.overhang.area_mm2 == Approx(7.5 * 7));  // the cavity's ceiling
    CHECK(r.overhang.steepest == Approx(90));
    CHECK(r.overhang.worst->z == 9);
}

TEST_CASE("a hollow sphere with its cavity off the middle is thinnest on the axis") {
    const Mesh mesh =
        together(test::sphere({0, 0, 0}, 10, 5), test::turned_inside_out(test::sphere({2, 0, 0}, 6, 5)));
    const PrintReport r = checked(mesh);
    const MeasuredWidth thinnest = r.walls.smallest.value();
    CHECK(thinnest.length_mm == Approx(2).epsilon(0.01));
    CHECK(std::fabs(length(thinnest.to - thinnest.from) - thinnest.length_mm) < 1e-9);
    for (const Vec3& end : {thinnest.from, thinnest.to}) {
        CHECK(end.x > 7.5);
        CHECK(std::fabs(end.y) < 1.5);
        CHECK(std::fabs(end.z) < 1.5);
    }
    CHECK(r.walls.p01_mm > thinnest.length_mm);
    CHECK(r.walls.p01_mm < 2.2);
    CHECK(r.walls.median_mm > 3);
    CHECK(r.walls.median_mm < 5);
    CHECK(r.gaps.smallest->length_mm == Approx(12).epsilon(0.01));
}

TEST_CASE("the arms of a T overhang; where its foot stands decides whether it does") {
    const auto is_t = [](int i, int, int k) { return k == 1 || i == 1; };
    const Mesh t = test::cell_solid({0, 4, 6, 10}, {0, 2}, {0, 5, 7}, is_t);
    REQUIRE(check(t).closed);
    const PrintReport r = checked(t);
    CHECK(r.overhang.area_mm2 == Approx(16));
    CHECK(r.overhang.share == Approx(16 / check(t).area));
    CHECK(r.overhang.steepest == Approx(90));
    CHECK(r.overhang.worst->z == 5);
    CHECK(r.stand.contact_area_mm2 == 4);
    CHECK(r.stand.margin_mm.value() == Approx(1));
    CHECK(r.stand.stable);
    CHECK(r.walls.smallest->length_mm == Approx(2));

    const Mesh gallows =
        test::cell_solid({0, 2, 10}, {0, 2}, {0, 5, 7}, [](int i, int, int k) { return k == 1 || i == 0; });
    const PrintReport g = checked(gallows);
    CHECK(g.stand.margin_mm.value() == Approx(2 - (20.0 * 1 + 40.0 * 5) / 60));
    CHECK_FALSE(g.stand.stable);
    // Upside down it lies on its bar and nothing overhangs.
    PrintCheckOptions options = few_samples();
    options.up = {0, 0, -3};
    const PrintReport u = checked(gallows, options);
    CHECK(u.overhang.area_mm2 == 0);
    CHECK(u.stand.contact_area_mm2 == 20);
    CHECK(u.stand.stable);
    CHECK(u.height_mm == 7);
}

TEST_CASE("the slope from which a face overhangs") {
    CHECK(checked(leaning(0)).overhang.area_mm2 == 0);
    CHECK(checked(leaning(1)).overhang.area_mm2 == 0);  // 45 degrees: not steeper
    const PrintReport r = checked(leaning(std::tan(1.0471975511965976)));
    CHECK(r.overhang.area_mm2 == Approx(2));
    CHECK(r.overhang.steepest == Approx(60));
    CHECK(r.overhang.worst->z > 0.3);
    PrintCheckOptions options = few_samples();
    options.overhang_angle = 40;
    CHECK(checked(leaning(1), options).overhang.area_mm2 == Approx(std::sqrt(2.0)));
}

TEST_CASE("two plates with a gap") {
    const Mesh plates = together(test::box({0, 0, 0}, {10, 10, 1}), test::box({0, 0, 1.5}, {8, 8, 2.5}));
    const PrintReport r = checked(plates);
    CHECK(r.gaps.smallest->length_mm == Approx(0.5));
    CHECK(r.gaps.measured_area_mm2 == Approx(128).epsilon(0.01));
    CHECK(r.gaps.median_mm == Approx(0.5));
    CHECK(r.walls.smallest->length_mm == Approx(1));
    CHECK(r.overhang.area_mm2 == 64);
    CHECK(r.components == 2);
    CHECK(r.smallest_component->size_mm == 8);
    CHECK(r.smallest_component->bounds.min.z == 1.5);
}

TEST_CASE("a groove is a gap, a sharp edge a thin wall") {
    const Mesh comb = test::cell_solid({0, 3, 3.75, 8}, {0, 5}, {0, 2, 6},
                                       [](int i, int, int k) { return k == 0 || i != 1; });
    const PrintReport r = checked(comb);
    check_widths(r.gaps, 0.75, 2 * 5 * 4);
    // A wedge of atan(1/4) = 14 degrees gets as thin as its samples near the edge; its long faces count.
    Mesh wedge = test::box({0, 0, 0}, {8, 8, 2});
    for (Vec3& v : wedge.vertices) {
        if (v.x == 8 && v.z == 2) v.z = 0.001;
    }
    CHECK(checked(wedge).walls.smallest->length_mm < 0.2);
    PrintCheckOptions options = few_samples();
    options.facing_angle = 10;
    CHECK(checked(wedge, options).walls.smallest->length_mm > 7);
}

TEST_CASE("lengths are in millimetres, places in model units") {
    PrintCheckOptions options = few_samples();
    options.unit = length_unit("inch").value();
    options.min_wall_mm = 25;
    const PrintReport r = checked(test::box({1, 1, 1}, {2, 3, 4}), options);
    CHECK(r.mm_per_unit == Approx(25.4));
    CHECK(r.size_mm.y == Approx(50.8));
    CHECK(r.walls.smallest->length_mm == Approx(25.4));
    CHECK(r.walls.smallest->from.x + r.walls.smallest->to.x == Approx(3));
    CHECK(r.walls.measured_area_mm2 == Approx(22 * 25.4 * 25.4));
    CHECK(r.walls.below_limit_area_mm2 == 0);
    CHECK(r.stand.margin_mm.value() == Approx(12.7));
    CHECK(r.stand.contact_area_mm2 == Approx(2 * 25.4 * 25.4));
}

TEST_CASE("a ball touches the plate in a point") {
    const PrintReport r = checked(test::sphere({0, 0, 0}, 5, 4));
    CHECK(r.stand.contact_area_mm2 == 0);
    CHECK(r.stand.margin_mm.value() == Approx(0));
    CHECK_FALSE(r.stand.stable);
    // Below the latitude where the slope is 45 degrees lies the share (1 - cos 45) / 2.
    CHECK(r.overhang.share == Approx((1 - std::sqrt(0.5)) / 2).epsilon(0.05));
    CHECK(r.walls.smallest->length_mm == Approx(10).epsilon(0.02));
}

TEST_CASE("the same figures for any number of threads and any direction") {
    const Mesh mesh =
        together(test::sphere({0, 0, 0}, 10, 4), test::turned_inside_out(test::sphere({2, 0, 0}, 6, 4)));
    Job one, three;
    one.threads = 1;
    three.threads = 3;
    const PrintReport a = print_check(mesh, few_samples(), one).value();
    const PrintReport b = print_check(mesh, few_samples(), three).value();
    CHECK(a.walls.smallest->length_mm == b.walls.smallest->length_mm);
    CHECK(a.walls.smallest->from == b.walls.smallest->from);
    CHECK(a.walls.p01_mm == b.walls.p01_mm);
    CHECK(a.walls.measured_area_mm2 == b.walls.measured_area_mm2);
    CHECK(a.gaps.median_mm == b.gaps.median_mm);

    Mesh turned = test::box({0, 0, 0}, {2, 3, 4});
    PrintCheckOptions options = few_samples();
    options.up = {1, 0, 0};
    CHECK(checked(turned, options).stand.contact_area_mm2 == 12);
    CHECK(checked(turned, options).stand.margin_mm.value() == Approx(1.5));
    options.up = {0, 1, 0};
    CHECK(checked(turned, options).height_mm == 3);
    options.up = {1, 1, 1};
    CHECK(checked(turned, options).stand.contact_area_mm2 == 0);
    CHECK(checked(turned, options).stand.margin_mm.value() <= 0);
}

TEST_CASE("empty and open meshes, wrong options, cancellation") {
    const PrintReport empty = checked(Mesh{});
    CHECK(empty.components == 0);
    CHECK_FALSE(empty.walls.smallest);
    CHECK_FALSE(empty.stand.margin_mm);
    Mesh open = test::box({0, 0, 0}, {1, 1, 1});
    open.triangles.pop_back();
    CHECK_FALSE(checked(open).stand.margin_mm);
    CHECK(checked(open).walls.smallest->length_mm == Approx(1));

    const auto error_of = [](auto change) {
        PrintCheckOptions options = few_samples();
        change(options);
        const auto result = print_check(test::tetrahedron(), options);
        REQUIRE_FALSE(result);
        return result.error().kind;
    };
    CHECK(error_of([](PrintCheckOptions& o) { o.up = {0, 0, 0}; }) == ErrorKind::invalid_argument);
    CHECK(error_of([](PrintCheckOptions& o) { o.unit.metres = 0; }) == ErrorKind::invalid_argument);
    CHECK(error_of([](PrintCheckOptions& o) { o.overhang_angle = 91; }) == ErrorKind::invalid_argument);
    CHECK(error_of([](PrintCheckOptions& o) { o.facing_angle = std::nan(""); }) ==
          ErrorKind::invalid_argument);
    Job job;
    job.cancel();
    const auto result = print_check(test::tetrahedron(), {}, job);
    REQUIRE_FALSE(result);
    CHECK(result.error().kind == ErrorKind::cancelled);
}
