// The light on solids, seen in pictures: what does not depend on scale, on the slope of F or on the azimuth,
// where it is brighter, and how evenly edges are covered.
#include "frep/trace/shading.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "frep/trace/solid_picture.h"
#include "solid_fields.h"

using namespace frep;
using namespace frep::test;

namespace {

constexpr int side = 96;

/// A square picture without a table, from the front, with parallel rays.
PictureOptions front() {
    PictureOptions options;
    options.width = options.height = side;
    options.view = {.azimuth = 0, .elevation = 0, .field_of_view = 0};
    options.backdrop = Backdrop::transparent;
    options.ground = false;
    return options;
}

Image picture(const SampledField& field, double half, const PictureOptions& options) {
    SceneOptions scene;
    scene.bounds = Box3::cube(half);
    scene.quality = PictureQuality::draft;
    scene.longest_side = side;
    auto image = render_solid(field, scene, options, Job());
    REQUIRE(image);
    return std::move(*image);
}

/// Pixels whose channels differ by more than `most`.
int different(const Image& a, const Image& b, int most) {
    int count = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            int worst = 0;
            for (int c = 0; c < 4; ++c)
                worst = std::max(worst, std::abs(int{pixel(a, x, y)[c]} - int{pixel(b, x, y)[c]}));
            count += worst > most ? 1 : 0;
        }
    }
    return count;
}

const auto ball = [](auto x, auto y, auto z) { return 1.0 - sqrt(x * x + y * y + z * z); };

}  // namespace

TEST_CASE("the light does not depend on the unit of length nor on the slope of F") {
    const Image image = picture(*solid(ball), 1.5, front());
    const auto large = solid([](auto x, auto y, auto z) { return 1000.0 - sqrt(x * x + y * y + z * z); });
    CHECK(different(image, picture(*large, 1500, front()), 3) < 20);
    const auto small = solid([](auto x, auto y, auto z) { return 0.001 - sqrt(x * x + y * y + z * z); });
    CHECK(different(image, picture(*small, 0.0015, front()), 3) < 20);
    const auto steep = solid([](auto x, auto y, auto z) { return 1e4 * (1.0 - (x * x + y * y + z * z)); });
    CHECK(different(image, picture(*steep, 1.5, front()), 6) < 60);
}

TEST_CASE("the lights turn with the camera: a ball looks the same from everywhere around") {
    PictureOptions options = front();
    const Image image = picture(*solid(ball), 1.5, options);
    for (const double azimuth : {90.0, 137.0, 270.0}) {
        options.view.azimuth = azimuth;
        const Image turned = picture(*solid(ball), 1.5, options);
        int worst = 0;
        for (int y = side / 4; y < side * 3 / 4; ++y)
            for (int x = side / 4; x < side * 3 / 4; ++x)
                worst = std::max(worst, std::abs(brightness(image, x, y) - brightness(turned, x, y)));
        CHECK(worst < 24);
    }
}

TEST_CASE("the key light comes from the upper left") {
    for (const char* name : {"clay", "porcelain", "stone"}) {
        PictureOptions options = front();
        options.material = find_material(name);
        REQUIRE(options.material);
        const Image image = picture(*solid(ball), 1.5, options);
        const int near = side * 3 / 8, far = side * 5 / 8;
        CHECK(brightness(image, near, near) > brightness(image, far, far) + 30);
        CHECK(brightness(image, side / 2, side / 4) > brightness(image, side / 2, side * 3 / 4) + 30);
    }
}

TEST_CASE("a flat face is lit evenly: neighbouring pixels hardly differ") {
    const auto cube = solid([](auto x, auto y, auto z) { return 1.0 - max(abs(x), max(abs(y), abs(z))); });
    const Image image = picture(*cube, 1.5, front());
    for (int y = side / 4; y < side * 3 / 4; ++y)
        for (int x = side / 4; x < side * 3 / 4; ++x) {
            CHECK(std::abs(brightness(image, x, y) - brightness(image, x + 1, y)) < 12);
            CHECK(std::abs(brightness(image, x, y) - brightness(image, x, y + 1)) < 12);
        }
}

TEST_CASE("the bottom of a deep hole is darker than the face around it") {
    const auto block = solid([](auto x, auto y, auto z) {
        const auto cube = 1.0 - max(abs(x), max(abs(y), abs(z)));
        const auto hole = 0.25 - max(abs(x), max(abs(z), y + 0.5));
        return min(cube, -hole);
    });
    const Image image = picture(*block, 1.5, front());
    CHECK(brightness(image, side / 2, side / 2) * 4 < brightness(image, side / 4, side / 4) * 3);
}

TEST_CASE("transparent pictures: 255 inside, 0 outside, and the edge covers the circle's area") {
    const Image image = picture(*solid(ball), 1.5, front());
    double area = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) area += image.pixels[i] / 255.0;
    const double radius = std::sqrt(area / 3.14159265358979);
    CHECK(radius > 0.35 * side);
    int partial = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double dx = x + 0.5 - side / 2.0, dy = y + 0.5 - side / 2.0;
            const double r = std::sqrt(dx * dx + dy * dy);
            const int alpha = pixel(image, x, y)[3];
            if (r < radius - 1.5) CHECK(alpha == 255);
            if (r > radius + 1.5) CHECK(alpha == 0);
            partial += alpha > 0 && alpha < 255 ? 1 : 0;
        }
    }
    CHECK(partial > 2 * radius);  // a circle crosses about 8 r pixels
    CHECK(partial < 10 * radius);
}
