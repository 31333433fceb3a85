// Moving pictures as GIF files (GIF89a, CompuServe 1990), in memory: one palette for all frames, ordered
// dithering that stays in its place from frame to frame, and of each frame only the rectangle that changed.
// The same frames and options give the same bytes. Tested by tests/unit/io/gif_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/image.h"

namespace frep {

/// Up to 255 colors, sRGB; number 255 is left for "nothing".
struct GifPalette {
    static constexpr std::size_t most_colors = 255;
    std::vector<std::array<std::uint8_t, 3>> colors;
};

/// A palette for pictures like these, by median cut (Heckbert 1982): boxes of 5-bit colors are divided at the
/// median of their longest side, weighted with the number of pixels, until there are enough. Pixels of less
/// than half opacity do not count.
GifPalette gif_palette(std::span<const Image> examples);

struct GifOptions {
    int hundredths = 4;  ///< of a second that a frame is shown, 1..65535; browsers slow down below 2
    bool loops = true;   ///< for ever; else once
    bool dither = true;
};

/// Takes frames of one size, one after the other.
class GifWriter {
  public:
    /// Errors: invalid_argument for sides out of 1..65535, an empty palette or a delay out of range.
    static Result<GifWriter> make(int width, int height, GifPalette palette, const GifOptions& options = {});

    /// Errors: invalid_argument for a picture of another size.
    Status add(const Image& frame);
    /// The bytes of the whole file; the writer is spent.
    std::string finish();

  private:
    GifWriter(int width, int height, GifPalette palette, const GifOptions& options);
    std::uint8_t nearest(int r, int g, int b);
    void quantize(const Image& frame, std::vector<std::uint8_t>& out);
    void write_frame(const std::vector<std::uint8_t>& indexes, bool clears);

    int width_, height_;
    GifPalette palette_;
    GifOptions options_;
    std::vector<std::int16_t> cache_;  ///< nearest color of each 6-bit color, -1 unknown
    std::vector<std::uint8_t> shown_;  ///< the frame before; empty before the first
    bool see_through_ = false;         ///< the frame before had transparent pixels
    std::string bytes_;
};

}  // namespace frep
