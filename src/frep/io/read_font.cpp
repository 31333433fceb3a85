// Text as areas. See read_font.h.
#include "frep/io/read_font.h"

#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_FONT_FORMATS_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

#include "frep/base/code_points.h"
#include "frep/io/curves.h"
#include "frep/io/read_formats.h"

namespace frep {

namespace {

using namespace reading;

constexpr std::size_t most_characters = 10'000;
constexpr double text_tolerance = 1e-4;
constexpr FT_Int32 load_flags = FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP;

struct LibraryEnd {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct FaceEnd {
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

Vec2 vec(const FT_Vector* v) { return {static_cast<double>(v->x), static_cast<double>(v->y)}; }
CurveWriter& writer(void* user) { return *static_cast<CurveWriter*>(user); }

int on_move(const FT_Vector* to, void* user) { return writer(user).move(vec(to)), 0; }
int on_line(const FT_Vector* to, void* user) { return writer(user).line(vec(to)), 0; }
int on_conic(const FT_Vector* control, const FT_Vector* to, void* user) {
    return writer(user).quadratic(vec(control), vec(to)), 0;
}
int on_cubic(const FT_Vector* c1, const FT_Vector* c2, const FT_Vector* to, void* user) {
    return writer(user).cubic(vec(c1), vec(c2), vec(to)), 0;
}

/// How high an H is, in font units.
double capital_height(FT_Face face) {
    const FT_UInt glyph = FT_Get_Char_Index(face, 'H');
    if (glyph != 0 && FT_Load_Glyph(face, glyph, load_flags) == 0 &&
        face->glyph->format == FT_GLYPH_FORMAT_OUTLINE) {
        FT_BBox box;
        FT_Outline_Get_CBox(&face->glyph->outline, &box);
        if (box.yMax > 0) return static_cast<double>(box.yMax);
    }
    const auto* table = static_cast<const TT_OS2*>(FT_Get_Sfnt_Table(face, FT_SFNT_OS2));
    if (table && table->version != 0xFFFF && table->version >= 2 && table->sCapHeight > 0)
        return static_cast<double>(table->sCapHeight);
    return 0.7 * face->units_per_EM;
}

/// An open font with outlines and a table of Unicode characters.
struct OpenFont {
    std::unique_ptr<FT_LibraryRec_, LibraryEnd> library;
    std::unique_ptr<FT_FaceRec_, FaceEnd> face;
};

Result<OpenFont> open_font(std::string_view font) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) return Error{ErrorKind::io, "FreeType does not start"};
    OpenFont out{std::unique_ptr<FT_LibraryRec_, LibraryEnd>(library), nullptr};
    FT_Face face = nullptr;
    if (FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font.data()),
                           static_cast<FT_Long>(font.size()), 0, &face) != 0)
        return Error{ErrorKind::io, "not a font, or a damaged one"};
    out.face.reset(face);
    if (!FT_IS_SCALABLE(face) || face->units_per_EM == 0)
        return Error{ErrorKind::io, "the font has no outlines"};
    if (FT_Select_Charmap(face, FT_ENCODING_UNICODE) != 0)
        return Error{ErrorKind::io, "the font has no table of Unicode characters"};
    return out;
}

}  // namespace

Result<FontFacts> font_facts(std::string_view font) {
    const auto open = open_font(font);
    if (!open) return open.error();
    const FT_Face face = open->face.get();
    FontFacts out;
    const auto text = [](const char* name) { return name ? reading::object_name(name) : std::string(); };
    out.format = text(FT_Get_Font_Format(face));
    out.family = text(face->family_name);
    out.style = text(face->style_name);
    out.faces = static_cast<std::size_t>(std::max<FT_Long>(1, face->num_faces));
    out.glyphs = static_cast<std::size_t>(std::max<FT_Long>(0, face->num_glyphs));
    constexpr std::size_t most_code_points = 0x110000;  // damaged tables may go round in circles
    FT_UInt glyph = 0;
    for (FT_ULong c = FT_Get_First_Char(face, &glyph); glyph != 0 && out.characters < most_code_points;
         c = FT_Get_Next_Char(face, c, &glyph))
        ++out.characters;
    out.capital_height = capital_height(face) / face->units_per_EM;
    out.has_kerning = FT_HAS_KERNING(face);
    return out;
}

Result<AreaFile> read_text(std::string_view font, std::string_view text) {
    const std::u32string line = code_points(text);
    if (line.size() > most_characters)
        return Error{ErrorKind::over_limit,
                     fmt::format("a text of more than {} characters", most_characters)};
    const auto open = open_font(font);
    if (!open) return open.error();
    const FT_Face face = open->face.get();
    const double unit = 1.0 / capital_height(face);
    FT_Outline_Funcs draw{};
    draw.move_to = on_move;
    draw.line_to = on_line;
    draw.conic_to = on_conic;
    draw.cubic_to = on_cubic;
    AreaFile out;
    out.area.parts.emplace_back();
    std::map<char32_t, int> missing;
    double at = 0;
    FT_UInt before = 0;
    std::size_t edges = 0;
    for (const char32_t character : line) {
        const FT_UInt glyph = FT_Get_Char_Index(face, character);
        if (glyph == 0) ++missing[character];
        FT_Vector kerning{0, 0};
        if (before != 0 && glyph != 0 && FT_HAS_KERNING(face) &&
            FT_Get_Kerning(face, before, glyph, FT_KERNING_UNSCALED, &kerning) == 0)
            at += static_cast<double>(kerning.x);
        before = glyph;
        if (FT_Load_Glyph(face, glyph, load_flags) != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
            return Error{ErrorKind::io, fmt::format("the font's glyph for U+{:04X} is damaged",
                                                    static_cast<std::uint32_t>(character))};
        CurveWriter curves({unit, 0, 0, unit, at * unit, 0});
        if (glyph != 0 && FT_Outline_Decompose(&face->glyph->outline, &draw, &curves) != 0)
            return Error{ErrorKind::io, fmt::format("the font's glyph for U+{:04X} is damaged",
                                                    static_cast<std::uint32_t>(character))};
        at += static_cast<double>(face->glyph->metrics.horiAdvance);
        for (auto& polygon : polygons_of(curves.contours(), text_tolerance, most_area_edges)) {
            edges += polygon.size();
            out.area.parts[0].contours.push_back(std::move(polygon));
        }
        if (edges > most_area_edges)
            return Error{ErrorKind::over_limit, fmt::format("more than {} edges", most_area_edges)};
    }
    for (const auto& [character, count] : missing)
        out.notes.push_back(fmt::format("the font has no glyph for U+{:04X} ({} times)",
                                        static_cast<std::uint32_t>(character), count));
    if (out.area.parts[0].contours.empty())
        return Error{ErrorKind::invalid_argument, out.notes.empty()
                                                      ? "the text shows nothing"
                                                      : "the text shows nothing: " + out.notes[0]};
    return out;
}

}  // namespace frep
