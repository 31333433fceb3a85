// Text in a TrueType or OpenType font as an area, by FreeType: the outlines in font units, without hinting,
// so that every version of the library gives the same. Tested by tests/unit/io/read_font_test.cpp; the page:
// docs/outlines.md.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "frep/base/result.h"
#include "frep/io/read_svg.h"

namespace frep {

/// `text` (UTF-8) as one line from the origin along +x, its baseline at y = 0, a capital H 1 unit high (of a
/// font without H: its stated capital height, or 0.7 em). Pairs are kerned by the font's `kern` table. Notes
/// name characters that the font lacks; their place is that of its glyph for missing characters. Curves
/// become polygons within 1e-4. `font` is the content of any font file of FreeType with outlines; a
/// collection gives its first font. Errors: io for a file that is none; invalid_argument when the text shows
/// nothing; over_limit beyond 10,000 characters or 200,000 edges.
Result<AreaFile> read_text(std::string_view font, std::string_view text);

/// What a font file is.
struct FontFacts {
    std::string format;         ///< "TrueType", "CFF", ...
    std::string family, style;  ///< "DejaVu Sans", "Bold"; may be empty
    std::size_t faces = 1;      ///< fonts in the file; the others tell of the first one
    std::size_t glyphs = 0;
    std::size_t characters = 0;  ///< of Unicode that it has glyphs for
    double capital_height = 0;   ///< of an H, in parts of the em
    bool has_kerning = false;    ///< a `kern` table
};

/// Errors: those of read_text() for the font.
Result<FontFacts> font_facts(std::string_view font);

}  // namespace frep
