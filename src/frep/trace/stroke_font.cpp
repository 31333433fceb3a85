// Implementation of stroke_font.h.
#include "frep/trace/stroke_font.h"

#include <charconv>
#include <cstdint>
#include <optional>

#include "frep/base/code_points.h"
#include "frep/base/source.h"

namespace frep::drawing {

namespace {

/// How a character of a text is drawn: a glyph of the table, perhaps small and raised, perhaps with a mark.
struct Drawn {
    const glyphs::Glyph* glyph = nullptr;  ///< nullptr: a box
    double scale = 1, raise = 0;           ///< of superscripts; raise in units of the grid
    char mark = 0;
};

constexpr glyphs::Glyph missing{0, 8, "M0 0 L8 0 L8 14 L0 14 L0 0"};
constexpr int curve_pieces = 8;

/// The character that a superscript raises, or 0.
char32_t superscript_base(char32_t code) {
    switch (code) {
        case 0xb2:
            return U'2';
        case 0xb3:
            return U'3';
        case 0xb9:
            return U'1';
        case 0x207b:
            return 0x2212;
        default:
            return code == 0x2070 || (code >= 0x2074 && code <= 0x2079) ? U'0' + (code - 0x2070) : 0;
    }
}

Drawn drawn(char32_t code) {
    Drawn out;
    if (const char32_t base = superscript_base(code)) {
        out = {glyphs::find(base), 0.64, 7, 0};
    } else if (const glyphs::Composed* composed = glyphs::find_composed(code)) {
        out = {glyphs::find(composed->base), 1, 0, composed->mark};
    } else {
        out.glyph = glyphs::find(code);
    }
    return out;
}

const glyphs::Glyph& glyph_of(const Drawn& character) { return character.glyph ? *character.glyph : missing; }

/// The width of the ink in units of the grid.
double grid_width(const std::u32string& text) {
    double width = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const Drawn character = drawn(text[i]);
        if (i > 0) width += glyphs::spacing * character.scale;
        width += glyph_of(character).width * character.scale;
    }
    return width;
}

/// Reads "M x y L x y Q cx cy x y" and hands every straight piece on.
template <class Put>
void for_each_piece(std::string_view path, Put&& put) {
    const char* at = path.data();
    const char* const end = at + path.size();
    const auto number = [&] {
        while (at < end && *at == ' ') ++at;
        double value = 0;
        at = std::from_chars(at, end, value).ptr;
        return value;
    };
    const auto point = [&] {
        const double x = number();
        return Vec2{x, number()};
    };
    Vec2 pen;
    while (at < end) {
        const char command = *at++;
        if (command == 'M') {
            pen = point();
        } else if (command == 'L') {
            const Vec2 to = point();
            put(pen, to);
            pen = to;
        } else if (command == 'Q') {
            const Vec2 control = point(), to = point(), from = pen;
            for (int i = 1; i <= curve_pieces; ++i) {
                const double t = static_cast<double>(i) / curve_pieces;
                const Vec2 next = from * ((1 - t) * (1 - t)) + control * (2 * t * (1 - t)) + to * (t * t);
                put(pen, next);
                pen = next;
            }
        }
    }
}

/// Puts points of the grid on the picture.
struct Placement {
    Vec2 at;
    double unit;  ///< pixels for a step of the grid
    bool upright;

    Vec2 operator()(Vec2 p) const {
        return upright ? Vec2{at.x + p.x * unit, at.y - p.y * unit}
                       : Vec2{at.x - p.y * unit, at.y - p.x * unit};
    }
};

}  // namespace

double text_width(std::string_view utf8, double height) {
    return grid_width(code_points(utf8)) * height / glyphs::cap_height;
}

bool has_glyphs(std::string_view utf8) {
    for (const char32_t code : code_points(utf8)) {
        if (!drawn(code).glyph) return false;
    }
    return true;
}

double text_pen(double height) { return 0.9 + 0.055 * height; }

void append_text(std::vector<Segment>& out, std::string_view utf8, Vec2 at, TextAnchor anchor,
                 const TextStyle& style) {
    const std::u32string text = code_points(utf8);
    const Placement place{at, style.height / glyphs::cap_height, style.upright};
    const double length = grid_width(text);
    double x = anchor == TextAnchor::start ? 0 : anchor == TextAnchor::middle ? -length / 2 : -length;
    for (const char32_t code : text) {
        const Drawn character = drawn(code);
        const glyphs::Glyph& glyph = glyph_of(character);
        const auto put = [&](Vec2 offset) {
            return [&, offset](Vec2 a, Vec2 b) {
                const auto on_grid = [&](Vec2 p) {
                    return Vec2{x, character.raise} + (p + offset) * character.scale;
                };
                out.push_back({place(on_grid(a)), place(on_grid(b))});
            };
        };
        for_each_piece(glyph.path, put({}));
        const bool capital = glyph.code < U'a';
        const double above = capital && character.mark != ',' ? 4 : 0;
        for_each_piece(glyphs::mark_path(character.mark), put({glyph.width / 2, above}));
        x += (glyph.width + glyphs::spacing) * character.scale;
    }
}

std::string fitted_text(std::string_view utf8, double height, double width) {
    if (text_width(utf8, height) <= width) return std::string(utf8);
    std::string text = to_valid_utf8(utf8);
    while (!text.empty()) {
        while ((static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
        text.pop_back();
        while (!text.empty() && text.back() == ' ') text.pop_back();
        if (text_width(text + "...", height) <= width) return text + "...";
    }
    return {};
}

}  // namespace frep::drawing
