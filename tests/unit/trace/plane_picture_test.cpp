// Tests of trace/plane_picture.h: what is drawn where, the layout for all shapes, undefined areas, threads.
#include "frep/trace/plane_picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "frep/trace/plane_layout.h"
#include "plane_fields.h"

using namespace frep;
using frep::test::DiskField;
using frep::test::FunctionField;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

FieldPicture draw(const SampledField& field, const FieldPictureOptions& options, int threads = 2) {
    Job job;
    job.threads = threads;
    const auto out = field_picture(field, options, job);
    REQUIRE(static_cast<bool>(out));
    return *out;
}

FieldPictureOptions over(const Rectangle& part) {
    FieldPictureOptions options;
    options.part = part;
    options.title = "A title";
    options.right_name = "x, mm";
    options.up_name = "y, mm";
    return options;
}

struct Rgb {
    int r, g, b;
    bool is_dark() const { return r + g + b < 250; }
    bool is_white() const { return r + g + b == 765; }
    bool is_grey() const { return r == g && g == b; }
};
Rgb at(const Image& image, int x, int y) {
    const std::uint8_t* p =
        &image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x))];
    return {p[0], p[1], p[2]};
}
/// The color at a point of the plane.
Rgb at_point(const FieldPicture& picture, Vec2 p) {
    const Window& w = picture.window;
    return at(picture.image, picture.left + static_cast<int>((p.x - w.left) / w.step),
              picture.top + static_cast<int>((w.top - p.y) / w.step));
}

}  // namespace

TEST_CASE("inside is warm, outside cool, the zero line dark and on the circle") {
    const DiskField disk({0.1, -0.2}, 0.8);
    const FieldPicture picture = draw(disk, over({{-1, -1.2}, {1.2, 1}}));
    CHECK(at_point(picture, {0.1, -0.2}).r > at_point(picture, {0.1, -0.2}).b);
    CHECK(at_point(picture, {1.1, 0.9}).b > at_point(picture, {1.1, 0.9}).r);
    for (int k = 0; k < 100; ++k) {
        const double angle = 0.0628 * k;
        CHECK(at_point(picture, {0.1 + 0.8 * std::cos(angle), -0.2 + 0.8 * std::sin(angle)}).is_dark());
    }
    CHECK(std::count(picture.levels.begin(), picture.levels.end(), 0.0) == 1);
    CHECK(picture.highest == doctest::Approx(0.64).epsilon(1e-3));
    CHECK(picture.undefined == 0);
}

TEST_CASE("the dark ring encloses pi r^2") {
    const DiskField disk({0, 0}, 0.8);
    FieldPictureOptions options = over({{-1, -1}, {1, 1}});
    options.levels = {-100, 100};
    const FieldPicture picture = draw(disk, options);
    // The line is 2.6 pixels wide and dark: its outer and inner borders enclose pi (r +- 1.3 pixels)^2.
    double warm = 0, dark = 0;
    for (int y = 0; y < picture.window.rows; ++y) {
        for (int x = 0; x < picture.window.columns; ++x) {
            const Rgb c = at(picture.image, picture.left + x, picture.top + y);
            const Rgb inside = at_point(picture, {0, 0});
            const double ink = std::clamp((inside.g - c.g) / (inside.g - 25.0), 0.0, 1.0);
            const double distance = std::hypot(picture.window.x(x + 0.5), picture.window.y(y + 0.5));
            if (distance < 0.8) warm += 1 - ink;
            if (std::fabs(distance - 0.8) < 0.02) dark += ink;
        }
    }
    const double pixel = picture.window.step, r = 0.8 / pixel;
    CHECK(warm == doctest::Approx(3.14159265 * (r - 1.3) * (r - 1.3)).epsilon(0.001));
    CHECK(dark == doctest::Approx(3.14159265 * 2 * r * 2.6).epsilon(0.05));
}

TEST_CASE("undefined parts are hatched in grey and counted") {
    const FunctionField field([](Vec3 p) { return p.x < 0 ? undefined : 1 - p.x - p.y; });
    const FieldPicture picture = draw(field, over({{-1, -1}, {1, 1}}));
    CHECK(static_cast<double>(picture.undefined) / static_cast<double>(picture.samples) ==
          doctest::Approx(0.5).epsilon(0.01));
    int dark = 0, light = 0;
    for (double x = -0.9; x < -0.1; x += 0.01) {
        const Rgb c = at_point(picture, {x, 0.3});
        CHECK(c.is_grey());
        (c.r < 200 ? dark : light) += 1;
    }
    CHECK(dark > 5);
    CHECK(light > 2 * dark);
    CHECK_FALSE(at_point(picture, {0.5, 0.3}).is_grey());
    const FieldPicture nothing =
        draw(FunctionField([](Vec3) { return undefined; }), over({{-1, -1}, {1, 1}}));
    CHECK(nothing.undefined == nothing.samples);
    CHECK(nothing.lowest == 0);
}

TEST_CASE("the picture is the same for all threads") {
    const FunctionField field([](Vec3 p) { return p.y < -0.7 ? undefined : p.x * p.x * p.x - p.y * p.x; });
    FieldPictureOptions options = over({{-1, -1}, {1, 1}});
    options.width = 400;
    options.height = 300;
    const FieldPicture one = draw(field, options, 1);
    for (const int threads : {2, 3, 7}) CHECK(draw(field, options, threads).image.pixels == one.image.pixels);
}

TEST_CASE("the margins hold the texts: nothing is drawn on the picture's edge, for any size and shape") {
    const FunctionField field([](Vec3 p) { return p.x < 0 ? undefined : 1e7 * (1 - p.x * p.x - p.y); });
    const Rectangle parts[] = {{{-1, -1}, {1, 1}},
                               {{-100000, -1}, {100000, 1}},
                               {{-1, -1e-5}, {1e-7, 3e4}},
                               {{1000000, 1000000}, {1000000.01, 1000000.02}}};
    const std::pair<int, int> sizes[] = {{0, 0}, {240, 160}, {300, 900}, {1500, 260}};
    for (const Rectangle& part : parts) {
        for (const auto& size : sizes) {
            FieldPictureOptions options = over(part);
            options.title =
                "A rather long title that has to be cut somewhere before the end, even of wide pictures";
            options.right_name = options.up_name = "a long caption of an axis, mm";
            options.width = size.first;
            options.height = size.second;
            const FieldPicture picture = draw(field, options);
            const Image& image = picture.image;
            CAPTURE(image.width);
            CAPTURE(image.height);
            CAPTURE(part.max.y);
            int marks = 0;
            for (int x = 0; x < image.width; ++x)
                marks += !at(image, x, 0).is_white() + !at(image, x, image.height - 1).is_white();
            for (int y = 0; y < image.height; ++y)
                marks += !at(image, 0, y).is_white() + !at(image, image.width - 1, y).is_white();
            CHECK(marks == 0);
        }
    }
}

TEST_CASE("the labels of an axis leave space between them") {
    for (const double scale : {1e-9, 0.003, 1.0, 7.7, 12345.0, 1e12}) {
        for (const int side : {240, 500, 1400}) {
            FieldPictureOptions options = over({{-0.7 * scale, 0.1 * scale}, {scale, scale}});
            options.width = side;
            options.height = side;
            const auto layout = drawing::make_layout(options);
            REQUIRE(static_cast<bool>(layout));
            const auto& axis = layout->right;
            REQUIRE(axis.ticks.values.size() >= 1);
            for (std::size_t i = 1; i < axis.ticks.values.size(); ++i) {
                const double apart = (axis.ticks.values[i] - axis.ticks.values[i - 1]) / layout->window.step;
                const double half = drawing::text_width(axis.labels.texts[i - 1], layout->letter) / 2 +
                                    drawing::text_width(axis.labels.texts[i], layout->letter) / 2;
                CHECK(apart > half + 0.5 * layout->letter);
            }
            for (std::size_t i = 1; i < layout->up.ticks.values.size(); ++i)
                CHECK((layout->up.ticks.values[i] - layout->up.ticks.values[i - 1]) / layout->window.step >
                      1.6 * layout->letter);
        }
    }
}

TEST_CASE("given levels, a constant function, and errors") {
    const FunctionField five([](Vec3) { return 5.0; });
    FieldPictureOptions options = over({{-1, -1}, {1, 1}});
    options.width = 300;
    options.height = 250;
    CHECK(draw(five, options).levels == std::vector<double>{0});
    options.levels = {4, 6, 5.5};
    CHECK(draw(five, options).levels == std::vector<double>{4, 5.5, 6});
    const auto refused = [&](FieldPictureOptions wrong) {
        const auto out = field_picture(five, wrong, {});
        return !out && out.error().kind == ErrorKind::invalid_argument;
    };
    FieldPictureOptions wrong = options;
    wrong.levels = {undefined};
    CHECK(refused(wrong));
    wrong.levels.clear();
    wrong.level_count = 0;
    CHECK(refused(wrong));
    wrong.level_count = 5;
    wrong.width = 100;
    CHECK(refused(wrong));
    wrong = options;
    wrong.part = {{0, 0}, {1, 0}};
    CHECK(refused(wrong));
    wrong.part = {{1, 1}, {1 + 1e-13, 1 + 1e-13}};
    CHECK(refused(wrong));
}
