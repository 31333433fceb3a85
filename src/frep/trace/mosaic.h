// A mosaic: several pictures in rows in one, each with a caption below it. Tested by
// tests/unit/trace/mosaic_test.cpp.
#pragma once

#include <span>
#include <string>

#include "frep/base/result.h"
#include "frep/geom/color.h"
#include "frep/geom/image.h"

namespace frep {

struct MosaicTile {
    Image image;
    std::string caption;  ///< UTF-8; shortened to the width of the tile, characters without a glyph as boxes
};

struct MosaicOptions {
    /// Pixels of one picture, 4 bytes each, that may be made.
    static constexpr std::size_t most_pixels = std::size_t{1} << 28;

    int columns = 1;
    int gap = 8;  ///< pixels between tiles and around them
    Color paper{1, 1, 1}, ink{0.2, 0.2, 0.2};
};

/// The tiles row by row, first at the top left, each in a cell of the largest tile's size. Transparent parts
/// show the paper. Errors: invalid_argument without tiles or columns, over_limit beyond most_pixels.
Result<Image> mosaic(std::span<const MosaicTile> tiles, const MosaicOptions& options);

}  // namespace frep
