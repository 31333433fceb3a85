// The library functions that make areas of the plane from files. See area.h.
#include <fmt/format.h>

#include "frep/io/read_font.h"
#include "frep/io/read_svg.h"
#include "frep/shapes/area.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/outline_formula.h"

namespace frep::shapes {

namespace {

/// Where an area is to stand: as it is times `scale`, or its box about a centre with a height.
struct Place {
    Array center;  ///< empty: the area's own origin
    Expression size;
};

/// Signed distance to an area.
Result<Expression> distance_to(Build& build, const Area& area, Expression x, Expression y) {
    Result<std::vector<double>> data = area_data(area);
    if (!data) return data.error();
    const NodeId lead[] = {x.id(), y.id()};
    return Expression(build.graph, build.graph.make_block(Op::outline_distance, lead, std::move(*data)));
}
Result<Expression> formula_of(Build& build, const Area& area, Expression x, Expression y) {
    return area_formula(build.set_system, area, x, y);
}

/// The area of a file that `read` understands, as the function that `make` makes of it.
template <class Read>
Expression area_of(Build& build, Array x, std::string_view file, std::optional<Place> place, Read read,
                   Result<Expression> (*make)(Build&, const Area&, Expression, Expression) = distance_to) {
    if (x.size() < 2) return build.error("x must have 2 items or more");
    if (place && !place->center.empty() && place->center.size() < 2)
        return build.error("center must have 2 items or more");
    if (!build.read_file) return build.error("there is no file access here");
    const Result<std::string> bytes = build.read_file(file);
    if (!bytes) return build.constant(error_value);  // reported by who reads
    const Result<AreaFile> content = read(*bytes);
    const char* apart =
        content || content.error().message.empty() || content.error().message[0] > '9' ? ": " : ":";
    if (!content) return build.refused(fmt::format("{}{}{}", file, apart, content.error().message));
    if (build.left_out)
        for (const std::string& note : content->notes) build.left_out(fmt::format("{}: {}", file, note));

    Expression px = x[0], py = x[1], scale = build.constant(1.0);
    if (place && place->center.empty()) {
        scale = place->size;
        px = px / scale;
        py = py / scale;
    } else if (place) {
        const AreaBox box = box_of(content->area);
        scale = place->size / (box.high[1] - box.low[1]);
        px = (px - place->center[0]) / scale + 0.5 * (box.low[0] + box.high[0]);
        py = (py - place->center[1]) / scale + 0.5 * (box.low[1] + box.high[1]);
    }
    const Result<Expression> value = make(build, content->area, px, py);
    if (!value) return build.refused(fmt::format("{}: {}", file, value.error().message));
    if (!place) return *value;
    return guarded(build, less_equal(place->size, build.constant(0.0)), "the height must be above 0",
                   *value * scale);
}

Expression outline(Build& build, Array x, std::string_view file) {
    return area_of(build, x, file, std::nullopt, read_svg);
}
Expression placed_outline(Build& build, Array x, std::string_view file, Array center, Expression height) {
    if (center.empty()) return build.error("center must have 2 items or more");
    return area_of(build, x, file, Place{center, height}, read_svg);
}
Expression formula(Build& build, Array x, std::string_view file) {
    return area_of(build, x, file, std::nullopt, read_svg, formula_of);
}
Expression placed_formula(Build& build, Array x, std::string_view file, Array center, Expression height) {
    if (center.empty()) return build.error("center must have 2 items or more");
    return area_of(build, x, file, Place{center, height}, read_svg, formula_of);
}
Expression text(Build& build, Array x, std::string_view font, std::string_view text, Expression height) {
    return area_of(build, x, font, Place{{}, height},
                   [text](std::string_view bytes) { return read_text(bytes, text); });
}
Expression placed_text(Build& build, Array x, std::string_view font, std::string_view text, Array center,
                       Expression height) {
    if (center.empty()) return build.error("center must have 2 items or more");
    return area_of(build, x, font, Place{center, height},
                   [text](std::string_view bytes) { return read_text(bytes, text); });
}

}  // namespace

Rows outline_rows() {
    constexpr std::string_view svg_note =
        "Fills and strokes, holes included; one unit of the drawing is one unit here, or 1 mm where "
        "the drawing states its width in mm, cm, in or pt; y points up. docs/outlines.md says what is read.";
    constexpr std::string_view font_note =
        "One line of UTF-8 text; the font file lies in the model's folder. docs/outlines.md says more.";
    return {
        row<&outline>("hfOutline", "x, file",
                      {"Signed distance to the filled outlines of an SVG drawing, positive inside.",
                       "+-min over edges of the boundary of the distance to the edge",
                       {},
                       svg_note},
                      false),
        row<&placed_outline>("hfOutline", "x, file, center, height",
                             {"The same with the middle of the drawing at center and this height.",
                              "s d((x - center)/s + m), s = height/(height of the drawing), m its middle"},
                             false),
        row<&formula>(
            "hfOutlineFormula", "x, file",
            {"The outlines of an SVG drawing by the monotone formula, each edge's half-plane once.",
             "polygons as of hfPolygon, less those of their holes, joined by the file's system", "pasko1996",
             "For drawings of a few hundred straight edges; contours must not cross. Zero on the outlines "
             "only, "
             "and where shapes touch. docs/outlines.md says more."},
            false),
        row<&placed_formula>(
            "hfOutlineFormula", "x, file, center, height",
            {"The same with the middle of the drawing at center and this height.",
             "s f((x - center)/s + m), s = height/(height of the drawing), m its middle", "pasko1996"},
            false),
        row<&text>("hfText", "x, font, text, height",
                   {"Signed distance to a text in a TrueType or OpenType font, positive inside.",
                    "height d(x/height); a capital H stands from 0 to height, the text begins at 0",
                    {},
                    font_note},
                   false),
        row<&placed_text>("hfText", "x, font, text, center, height",
                          {"The same with the middle of the text's box at center and the box this high.",
                           "s d((x - center)/s + m), s = height/(height of the text), m its middle"},
                          false),
    };
}

}  // namespace frep::shapes
