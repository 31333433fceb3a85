// Decodes UTF-8. See code_points.h.
#include "frep/base/code_points.h"

#include "frep/base/source.h"

namespace frep {

std::u32string code_points(std::string_view bytes) {
    const std::string text = to_valid_utf8(bytes);
    std::u32string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
        const unsigned lead = byte(0);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
        char32_t code = length == 1 ? lead : lead & (0x7fu >> length);
        for (std::size_t k = 1; k < length; ++k) code = code << 6 | (byte(k) & 0x3fu);
        out.push_back(code);
        i += length;
    }
    return out;
}

}  // namespace frep
