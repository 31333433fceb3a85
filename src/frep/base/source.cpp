#include "frep/base/source.h"

#include <algorithm>

namespace frep {
namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

bool is_continuation(unsigned char byte) { return (byte & 0xC0) == 0x80; }

/// Length of the well-formed UTF-8 sequence at the start of `s` (Unicode 15, table 3-7), or 0.
std::size_t sequence_length(std::string_view s) {
    auto at = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const unsigned char lead = at(0);
    if (lead < 0x80) return 1;
    if (lead < 0xC2 || lead > 0xF4) return 0;
    const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if (s.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if (!is_continuation(at(i))) return 0;
    const unsigned char second = at(1);
    const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
    const bool surrogate = lead == 0xED && second > 0x9F;
    const bool beyond = lead == 0xF4 && second > 0x8F;
    return overlong || surrogate || beyond ? 0 : length;
}

/// U+200E, U+200F, U+202A..U+202E, U+2066..U+2069: characters that change the direction of the text around
/// them. Answers the last byte of the code point, or 0 for any other text.
unsigned direction_control(std::string_view text) {
    if (text.size() < 3 || !text.starts_with("\xE2")) return 0;
    const auto second = static_cast<unsigned char>(text[1]);
    const auto third = static_cast<unsigned char>(text[2]);
    if (second == 0x80 && (third == 0x8E || third == 0x8F)) return third - 0x80u;
    if (second == 0x80 && third >= 0xAA && third <= 0xAE) return third - 0x80u;
    if (second == 0x81 && third >= 0xA6 && third <= 0xA9) return third - 0x80u + 0x40u;
    return 0;
}

}  // namespace

std::string to_valid_utf8(std::string_view bytes) {
    std::string out;
    out.reserve(bytes.size());
    while (!bytes.empty()) {
        std::size_t plain = 0;  // bytes that need no change
        std::size_t length = 1;
        while (plain < bytes.size() && length > 0) {
            const bool ascii = static_cast<unsigned char>(bytes[plain]) < 0x80;
            length = ascii ? 1 : sequence_length(bytes.substr(plain));
            plain += length;
        }
        out.append(bytes.substr(0, plain));
        bytes.remove_prefix(plain);
        if (bytes.empty()) break;
        out.append(replacement_character);
        bytes.remove_prefix(1);
    }
    return out;
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

std::string escape_controls(std::string_view text) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        // U+0080..U+009F are control characters too (C1); in UTF-8 they are C2 80 .. C2 9F.
        const bool c1 = byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
        if (const unsigned low = direction_control(text.substr(i))) {
            out += "\\u20";
            out += digits[low >> 4];
            out += digits[low & 15];
            i += 2;
        } else if (byte == '\t') {
            out += ' ';
        } else if (byte < 0x20 || byte == 0x7F || c1) {
            const unsigned code = c1 ? static_cast<unsigned char>(text[++i]) : byte;
            out += "\\x";
            out += digits[code >> 4];
            out += digits[code & 15];
        } else {
            out += text[i];
        }
    }
    return out;
}

Source::Source(std::string name, std::string_view bytes) : name_(std::move(name)) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    text_ = to_valid_utf8(bytes);
    for (std::size_t i = 0; i < text_.size(); ++i) {
        if (text_[i] > '\r') continue;
        const bool crlf = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
        if (text_[i] == '\n' || (text_[i] == '\r' && !crlf))
            line_starts_.push_back(static_cast<std::uint32_t>(i + 1));
    }
}

LineColumn Source::locate(std::uint32_t offset) const {
    offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    const auto line = static_cast<std::uint32_t>(after - line_starts_.begin());
    std::uint32_t column = 1;
    for (std::uint32_t i = line_starts_[line - 1]; i < offset; ++i)
        column += !is_continuation(static_cast<unsigned char>(text_[i]));
    return {line, column};
}

std::string_view Source::line(std::uint32_t number) const {
    if (number < 1 || number > line_starts_.size()) return {};
    const std::uint32_t begin = line_starts_[number - 1];
    const std::size_t end = number < line_starts_.size() ? line_starts_[number] : text_.size();
    std::string_view view = text().substr(begin, end - begin);
    while (!view.empty() && (view.back() == '\n' || view.back() == '\r')) view.remove_suffix(1);
    return view;
}

}  // namespace frep
