// Tests of trace/plane_render.h: covered areas, colors, thin parts, the same bytes for all threads and with
// and without intervals.
#include "frep/trace/plane_render.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "plane_fields.h"

using namespace frep;
using frep::test::DiskField;
using frep::test::FunctionField;

namespace {

constexpr double pi = 3.14159265358979323846;

PlaneRender render(const SampledField& field, const PlaneRenderOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    const auto out = render_plane(field, options, job);
    REQUIRE(static_cast<bool>(out));
    return *out;
}

PlaneRenderOptions over(const Rectangle& part, int width, int height) {
    PlaneRenderOptions options;
    options.part = part;
    options.margin = 0;
    options.width = width;
    options.height = height;
    options.background.reset();
    return options;
}

/// The covered area in pixels, from the alpha of a transparent picture.
double alpha_area(const Image& image) {
    double sum = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) sum += image.pixels[i] / 255.0;
    return sum;
}

const std::uint8_t* pixel(const Image& image, int x, int y) {
    return &image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x))];
}

}  // namespace

TEST_CASE("a disk covers pi r^2") {
    for (const double r : {0.31, 0.77, 0.9}) {
        const PlaneRender out = render(DiskField({0.013, -0.027}, r), over({{-1, -1}, {1, 1}}, 200, 200));
        CHECK(out.area == doctest::Approx(pi * r * r).epsilon(0.001));
        CHECK(alpha_area(out.image) * 1e-4 == doctest::Approx(pi * r * r).epsilon(0.001));
        CHECK(out.undefined == 0);
    }
}

TEST_CASE("intervals change no byte and save most of the work; nor do threads") {
    const DiskField disk({0.1, 0.2}, 0.6);
    PlaneRenderOptions options = over({{-1, -1}, {1, 1}}, 333, 257);
    const PlaneRender pruned = render(disk, options);
    for (const int threads : {2, 4})
        CHECK(render(disk, options, threads).image.pixels == pruned.image.pixels);
    options.prune = false;
    const PlaneRender full = render(disk, options);
    CHECK(full.image.pixels == pruned.image.pixels);
    CHECK(full.area == pruned.area);
    CHECK(pruned.sampled * 4 < full.sampled);
}

TEST_CASE("the edge is even: a half plane at any angle covers each pixel by its share") {
    for (const double slope : {0.0, 0.1, 0.5, 1.0}) {
        const FunctionField half([=](Vec3 p) { return slope * p.x + 0.013 - p.y; });
        const PlaneRender out = render(half, over({{-1, -1}, {1, 1}}, 64, 64));
        for (int x = 0; x < 64; ++x) {
            double column = 0;
            for (int y = 0; y < 64; ++y) column += pixel(out.image, x, y)[3] / 255.0;
            const double middle = -1 + (x + 0.5) / 32;
            CHECK(std::fabs(column - (slope * middle + 0.013 + 1) * 32) < 0.125);
        }
    }
}

TEST_CASE("colors over a background are mixed as linear light") {
    PlaneRenderOptions options = over({{-1, -1}, {1, 1}}, 64, 64);
    options.color = {1, 1, 1};
    options.background = Color{0, 0, 0};
    const FunctionField half([](Vec3 p) { return 1.0 / 64 - p.x; });  // ends in the middle of a pixel
    const PlaneRender out = render(half, options);
    CHECK(int{pixel(out.image, 10, 10)[0]} == 255);
    CHECK(int{pixel(out.image, 50, 10)[0]} == 0);
    CHECK(int{pixel(out.image, 32, 10)[0]} == 188);  // half of the light
    CHECK(int{pixel(out.image, 32, 10)[3]} == 255);
    options.background = Color{0.2, 0.4, 0.6};
    options.color = {0.8, 0.4, 0.2};
    const PlaneRender two = render(half, options);
    CHECK(int{pixel(two.image, 63, 0)[0]} == 51);
    CHECK(int{pixel(two.image, 0, 63)[0]} == 204);
    CHECK(int{pixel(two.image, 32, 32)[1]} == 102);
}

TEST_CASE("attributes color the shape, with soft borders; undefined ones leave its own color") {
    const double undefined = std::numeric_limits<double>::quiet_NaN();
    const DiskField disk({0, 0}, 0.9, [=](Vec3 p) {
        return p.y < -0.5 ? Vec3{undefined, 0, 0} : p.x < 0.0078125 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    });
    PlaneRenderOptions options = over({{-1, -1}, {1, 1}}, 128, 128);
    options.attribute_colors = true;
    options.color = {0, 1, 0};
    const PlaneRender out = render(disk, options);
    const auto channel = [&](int x, int y, int c) { return int{pixel(out.image, x, y)[c]}; };
    CHECK(channel(40, 64, 0) == 255);
    CHECK(channel(40, 64, 2) == 0);
    CHECK(channel(90, 64, 2) == 255);
    CHECK(channel(64, 64, 0) == 188);
    CHECK(channel(64, 64, 2) == 188);
    CHECK(channel(64, 110, 1) == 255);
    CHECK(channel(0, 0, 3) == 0);
}

TEST_CASE("undefined points are outside and counted") {
    const double undefined = std::numeric_limits<double>::quiet_NaN();
    const FunctionField field([=](Vec3 p) { return p.x < 0 ? undefined : 1.0; });
    const PlaneRender out = render(field, over({{-1, -1}, {1, 1}}, 50, 50));
    CHECK(out.area == doctest::Approx(2).epsilon(0.001));
    CHECK(out.undefined > 1000);
}

TEST_CASE("a plane section, margins, and errors") {
    const FunctionField ball([](Vec3 p) { return 1 - p.x * p.x - p.y * p.y - p.z * p.z; });
    PlaneRenderOptions options = over({{-1, -1}, {1, 1}}, 200, 100);
    options.plane = Plane::across(1, 0.6);
    options.margin = 0.1;
    CHECK(render(ball, options).area == doctest::Approx(pi * 0.64).epsilon(0.002));
    const auto refused = [&](PlaneRenderOptions wrong) {
        const auto out = render_plane(ball, wrong, {});
        return !out && out.error().kind == ErrorKind::invalid_argument;
    };
    PlaneRenderOptions wrong = options;
    wrong.width = 0;
    CHECK(refused(wrong));
    wrong = options;
    wrong.margin = 0.5;
    CHECK(refused(wrong));
    wrong = options;
    wrong.attribute_colors = true;
    CHECK(refused(wrong));
    wrong = options;
    wrong.part = {{0, 0}, {0, 0}};
    CHECK(refused(wrong));
}
