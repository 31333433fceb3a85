// Mosaics: where the tiles lie, captions, transparent tiles, refusals.
#include "frep/trace/mosaic.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using namespace frep;

namespace {

MosaicTile tile(int width, int height, std::array<std::uint8_t, 4> rgba, std::string caption = {}) {
    MosaicTile out{Image::sized(width, height), std::move(caption)};
    for (std::size_t i = 0; i < out.image.pixels.size(); ++i) out.image.pixels[i] = rgba[i % 4];
    return out;
}
std::array<int, 3> pixel(const Image& image, int x, int y) {
    const std::uint8_t* p = image.pixels.data() + 4 * (y * image.width + x);
    return {p[0], p[1], p[2]};
}

}  // namespace

TEST_CASE("tiles lie row by row, centred in equal cells") {
    const std::vector<MosaicTile> tiles = {tile(20, 10, {255, 0, 0, 255}), tile(20, 10, {0, 255, 0, 255}),
                                           tile(10, 6, {0, 0, 255, 255})};
    const auto image = mosaic(tiles, {.columns = 2, .gap = 4});
    REQUIRE(image);
    CHECK(image->width == 2 * 20 + 3 * 4);
    CHECK(image->height == 2 * 10 + 3 * 4);
    CHECK(pixel(*image, 4, 4) == std::array{255, 0, 0});
    CHECK(pixel(*image, 23, 13) == std::array{255, 0, 0});
    CHECK(pixel(*image, 25, 8) == std::array{255, 255, 255});
    CHECK(pixel(*image, 28, 4) == std::array{0, 255, 0});
    CHECK(pixel(*image, 4 + 5, 18 + 2) == std::array{0, 0, 255});
    CHECK(pixel(*image, 4 + 4, 18 + 2) == std::array{255, 255, 255});
    CHECK(pixel(*image, 40, 25) == std::array{255, 255, 255});
}

TEST_CASE("captions stand below their tiles") {
    const std::vector<MosaicTile> tiles = {tile(100, 20, {200, 200, 200, 255}, "t = -10"),
                                           tile(100, 20, {200, 200, 200, 255})};
    const auto image = mosaic(tiles, {.columns = 2, .gap = 0, .ink = {0, 0, 0}});
    REQUIRE(image);
    CHECK(image->height > 20 + 9);
    const auto ink_in = [&](int left, int right) {
        int dark = 0;
        for (int y = 20; y < image->height; ++y)
            for (int x = left; x < right; ++x) dark += pixel(*image, x, y)[0] < 128 ? 1 : 0;
        return dark;
    };
    CHECK(ink_in(0, 100) > 20);
    CHECK(ink_in(100, 200) == 0);
    CHECK(ink_in(0, 20) == 0);  // in the middle of the tile
}

TEST_CASE("transparent tiles show the paper") {
    const auto image =
        mosaic(std::vector<MosaicTile>{tile(4, 4, {0, 0, 0, 0})}, {.gap = 1, .paper = {1, 0, 0}});
    REQUIRE(image);
    CHECK(pixel(*image, 2, 2) == std::array{255, 0, 0});
}

TEST_CASE("nothing to show, or too much, is refused") {
    CHECK_FALSE(mosaic({}, {}));
    CHECK_FALSE(mosaic(std::vector<MosaicTile>{tile(1, 1, {})}, {.columns = 0}));
    std::vector<MosaicTile> many(300, tile(1, 1, {}));
    many[0] = tile(1000, 1000, {});
    const auto image = mosaic(many, {.columns = 10});
    REQUIRE_FALSE(image);
    CHECK(image.error().kind == ErrorKind::over_limit);
}
