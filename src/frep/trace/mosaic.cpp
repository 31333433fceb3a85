// Implementation of mosaic.h.
#include "frep/trace/mosaic.h"

#include <algorithm>

#include "frep/trace/plane_canvas.h"

namespace frep {

namespace {

/// Height of a caption's letters and of its line, as shares of the tile's width; bounded in pixels.
double letter_height(int tile_width) { return std::clamp(tile_width / 26.0, 9.0, 28.0); }

void copy_onto(drawing::Canvas& canvas, const Image& image, int left, int top) {
    const std::uint8_t* p = image.pixels.data();
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, p += 4) {
            const Color under = canvas.get(left + x, top + y);
            const double a = p[3] / 255.0;
            const auto mixed = [&](std::uint8_t over, double below) {
                return a * (over / 255.0) + (1 - a) * below;
            };
            canvas.set(left + x, top + y, {mixed(p[0], under.r), mixed(p[1], under.g), mixed(p[2], under.b)});
        }
}

}  // namespace

Result<Image> mosaic(std::span<const MosaicTile> tiles, const MosaicOptions& options) {
    if (tiles.empty() || options.columns < 1 || options.gap < 0)
        return Error{ErrorKind::invalid_argument, "a mosaic needs tiles and columns"};
    int width = 0, height = 0;
    bool has_captions = false;
    for (const MosaicTile& tile : tiles) {
        width = std::max(width, tile.image.width);
        height = std::max(height, tile.image.height);
        has_captions = has_captions || !tile.caption.empty();
    }
    const double letters = letter_height(width);
    const int line = has_captions ? static_cast<int>(2 * letters) : 0;
    const int columns =
        std::min(options.columns, static_cast<int>(std::min<std::size_t>(tiles.size(), 1 << 20)));
    const std::size_t rows =
        (tiles.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
    const auto side = [&](std::size_t count, int tile) {
        return count * static_cast<std::size_t>(tile + options.gap) + static_cast<std::size_t>(options.gap);
    };
    const std::size_t across = side(static_cast<std::size_t>(columns), width),
                      down = side(rows, height + line);
    if (across > MosaicOptions::most_pixels / down)
        return Error{ErrorKind::over_limit, "the picture of all views would be too large"};
    drawing::Canvas canvas(static_cast<int>(across), static_cast<int>(down), options.paper);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
        const int left = options.gap + column * (width + options.gap);
        const int top = options.gap + row * (height + line + options.gap);
        const Image& image = tiles[i].image;
        copy_onto(canvas, image, left + (width - image.width) / 2, top + (height - image.height) / 2);
        if (tiles[i].caption.empty()) continue;
        canvas.text(drawing::fitted_text(tiles[i].caption, letters, width),
                    {left + 0.5 * width, top + height + 1.5 * letters}, drawing::TextAnchor::middle,
                    {.height = letters}, options.ink);
    }
    return std::move(canvas).image();
}

}  // namespace frep
