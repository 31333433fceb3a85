// libFuzzer target: any bytes as a font, from which a line of text becomes an area. What comes out must be
// finite and no larger than the limits allow.
#include <cstdint>
#include <cstdlib>

#include "frep/io/curves.h"
#include "frep/io/read_font.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view font(reinterpret_cast<const char*>(data), size);
    static_cast<void>(frep::font_facts(font));
    const auto file = frep::read_text(font, "ROBOT \xC3\xA4H");
    if (!file) return file.error().message.empty() ? std::abort(), 0 : 0;
    std::size_t edges = 0;
    for (const auto& contour : file->area.parts.at(0).contours) {
        edges += contour.size();
        for (const frep::Vec2& p : contour)
            if ((p.x - p.x) + (p.y - p.y) != 0) std::abort();
    }
    if (edges > frep::reading::most_area_edges) std::abort();
    return 0;
}
