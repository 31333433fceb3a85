// Pictures to and from PNG files (ISO/IEC 15948), through libpng, in memory. The same picture and options
// give the same bytes: no time is written. Tested by tests/unit/io/png_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "frep/base/result.h"
#include "frep/geom/image.h"

namespace frep {

struct PngOptions {
    /// Text about the picture, UTF-8; empty ones are not written. ASCII becomes a tEXt chunk, other text an
    /// iTXt chunk; malformed UTF-8 and control characters become U+FFFD. The keywords are the predefined
    /// ones: Title, Author, Copyright, Software.
    std::string title, author, license, software;
    /// Resolution for print, pixels a meter; 0 writes none.
    int pixels_per_meter = 0;
    /// zlib's level, 0 (none) to 9 (smallest).
    int compression = 6;
};

/// True when no pixel lets anything through: alpha 255 everywhere.
bool is_opaque(const Image& image);

/// The picture as a PNG file's bytes: 8-bit sRGB, RGB when every pixel is opaque, else RGBA. Errors:
/// invalid_argument for a picture without pixels, one whose array has not width * height * 4 bytes, a side
/// beyond 1e6 (libpng's limit), or an option out of range; over_limit when memory does not suffice.
Result<std::string> encode_png(const Image& image, const PngOptions& options = {});

/// The picture of a PNG file of any color type, as 8-bit sRGB with alpha. Errors: invalid_argument for bytes
/// that are no PNG file or a broken one; over_limit for more than `most_pixels`, or when memory does not
/// suffice.
Result<Image> decode_png(std::string_view bytes, std::int64_t most_pixels = std::int64_t{1} << 26);

}  // namespace frep
