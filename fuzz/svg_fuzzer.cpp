// libFuzzer target: an SVG drawing all the way: paths, strokes, style sheets, and the distance data of the
// area that comes out. What comes out must be finite and no larger than the limits allow.
#include <cstdint>
#include <cstdlib>

#include "frep/io/curves.h"
#include "frep/io/read_svg.h"
#include "frep/shapes/area.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = frep::read_svg({reinterpret_cast<const char*>(data), size});
    if (!file) return file.error().message.empty() ? std::abort(), 0 : 0;
    std::size_t edges = 0;
    for (const frep::FilledPart& part : file->area.parts)
        for (const auto& contour : part.contours) {
            edges += contour.size();
            for (const frep::Vec2& p : contour)
                if ((p.x - p.x) + (p.y - p.y) != 0) std::abort();
        }
    if (edges > frep::reading::most_area_edges) std::abort();
    if (edges > 2000) return 0;  // the search for crossings would take the fuzzer's time
    if (const auto distance = frep::shapes::area_data(file->area))
        for (const double number : *distance)
            if (number - number != 0) std::abort();
    return 0;
}
