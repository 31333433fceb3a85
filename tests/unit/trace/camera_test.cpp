// The camera: frames of views, what a picture holds, the size of a pixel.
#include "frep/trace/camera.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace frep;
using namespace frep::tracing;

namespace {

void check_equal(Vec3 a, Vec3 b) {
    CHECK(std::fabs(a.x - b.x) < 1e-12);
    CHECK(std::fabs(a.y - b.y) < 1e-12);
    CHECK(std::fabs(a.z - b.z) < 1e-12);
}

std::vector<Vec3> corners() {
    std::vector<Vec3> out;
    for (int k = 0; k < 8; ++k)
        out.push_back({(k & 1) != 0 ? 3.0 : -1.0, (k & 2) != 0 ? 2.5 : 2.0, (k & 4) != 0 ? 9.0 : 7.5});
    return out;
}

}  // namespace

TEST_CASE("named directions") {
    const ViewFrame front = view_frame({.azimuth = 0, .elevation = 0});
    check_equal(front.forward, {0, 1, 0});
    check_equal(front.right, {1, 0, 0});
    check_equal(front.up, {0, 0, 1});
    const ViewFrame right = view_frame({.azimuth = 90, .elevation = 0});  // stands at +X
    check_equal(right.forward, {-1, 0, 0});
    check_equal(right.right, {0, 1, 0});
    const ViewFrame top = view_frame({.azimuth = 0, .elevation = 90});
    check_equal(top.forward, {0, 0, -1});
    check_equal(top.up, {0, 1, 0});
}

TEST_CASE("a frame is orthonormal and right-handed for every view") {
    for (int azimuth = -720; azimuth <= 720; azimuth += 35) {
        for (int elevation = -90; elevation <= 90; elevation += 15) {
            const ViewFrame f = view_frame({.azimuth = double(azimuth), .elevation = double(elevation)});
            CHECK(std::fabs(dot(f.right, f.right) - 1) < 1e-12);
            CHECK(std::fabs(dot(f.up, f.up) - 1) < 1e-12);
            CHECK(std::fabs(dot(f.right, f.up)) < 1e-12);
            check_equal(cross(f.right, f.forward), f.up);
            CHECK(std::fabs(f.right.z) < 1e-12);  // the horizon is level
        }
    }
}

TEST_CASE("all points are in the picture, and nearly fill it, for every view and shape") {
    const int sizes[3][2] = {{400, 300}, {300, 400}, {1000, 50}};
    for (const double field_of_view : {0.0, 20.0, 90.0}) {
        for (const auto& size : sizes) {
            for (int azimuth = 0; azimuth < 360; azimuth += 40) {
                const View view{
                    .azimuth = double(azimuth), .elevation = 25, .field_of_view = field_of_view, .zoom = 1};
                const Camera camera(view, corners(), size[0], size[1]);
                const ViewFrame& f = camera.frame();
                const Ray a = camera.ray(0, 0), b = camera.ray(size[0], size[1]);
                // Where a point or a ray lies across the picture: by its place, or by its slope.
                const auto place = [&](Vec3 origin, Vec3 direction, Vec3 axis) {
                    return field_of_view == 0 ? dot(origin, axis)
                                              : dot(direction, axis) / dot(direction, f.forward);
                };
                double reach = 0;
                for (const Vec3 axis : {f.right, f.up}) {
                    const double from = place(a.origin, a.direction, axis),
                                 to = place(b.origin, b.direction, axis), middle = (from + to) / 2;
                    for (const Vec3& p : corners()) {
                        const double share =
                            (place(p, p - a.origin, axis) - middle) / (std::fabs(to - from) / 2);
                        CHECK(std::fabs(share) <= 1);
                        reach = std::fmax(reach, std::fabs(share));
                    }
                }
                CHECK(reach > 0.75);
            }
        }
    }
}

TEST_CASE("rays have unit length, and neighbours lie a pixel apart") {
    for (const double field_of_view : {0.0, 30.0}) {
        const Camera camera({.azimuth = 30, .elevation = 20, .field_of_view = field_of_view, .zoom = 1},
                            corners(), 200, 150);
        const Ray a = camera.ray(100, 75), b = camera.ray(101, 75), c = camera.ray(3, 149);
        CHECK(std::fabs(dot(c.direction, c.direction) - 1) < 1e-12);
        // At the distance of the middle of the points.
        const Vec3 middle{1, 2.25, 8.25};
        const double t = dot(middle - a.origin, a.direction);
        const Vec3 gap = (b.origin + t * b.direction) - (a.origin + t * a.direction);
        CHECK(std::sqrt(dot(gap, gap)) == doctest::Approx(camera.pixel_size()).epsilon(0.05));
    }
}

TEST_CASE("zoom comes closer: a pixel is smaller by the factor") {
    const Camera one({.azimuth = 30, .elevation = 20, .field_of_view = 0, .zoom = 1}, corners(), 200, 150);
    const Camera two({.azimuth = 30, .elevation = 20, .field_of_view = 0, .zoom = 2}, corners(), 200, 150);
    CHECK(two.pixel_size() == doctest::Approx(one.pixel_size() / 2));
}
