// Image: a picture of 8-bit pixels, plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frep {

/// Rows from top to bottom; four bytes a pixel: R, G, B (sRGB), A (0 transparent; colors not premultiplied).
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  ///< width * height * 4 bytes

    static Image sized(int width, int height) {
        return {width, height,
                std::vector<std::uint8_t>(std::size_t{4} * static_cast<std::size_t>(width) *
                                          static_cast<std::size_t>(height))};
    }
};

}  // namespace frep
