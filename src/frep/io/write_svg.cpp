// SVG 1.1 (W3C Recommendation, 2011): the closed outlines as one path filled by the even-odd rule, the open
// ones as another. One user unit is one millimetre; the viewBox keeps the model's own coordinates with Y
// negated, since SVG's Y points down. See drawing_format.h.
#include <algorithm>

#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/write_drawing.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

/// The visible rectangle in user units.
struct View {
    double x = 0, y = 0, width = 1, height = 1;
};

View view_of(const std::vector<Polyline>& lines, double border) {
    const Extent extent = extent_of(lines);
    if (extent.empty) return {};
    View view{extent.low.x - border, -extent.high.y - border, extent.high.x - extent.low.x + 2 * border,
              extent.high.y - extent.low.y + 2 * border};
    // A side without length would hide the drawing.
    if (!(view.width > 0)) view.x -= 0.5, view.width = 1;
    if (!(view.height > 0)) view.y -= 0.5, view.height = 1;
    return view;
}

void append_attribute(std::string& out, std::string_view name, double value, std::string_view unit = "") {
    out.push_back(' ');
    out += name;
    out += "=\"";
    append_plain_real(out, value);
    out += unit;
    out.push_back('"');
}

void append_element(std::string& out, std::string_view name, std::string_view text) {
    if (text.empty()) return;
    out.push_back('<');
    out += name;
    out.push_back('>');
    append_xml(out, text);
    out += "</";
    out += name;
    out += ">\n";
}

/// The path data of the lines that are closed, or of those that are open.
std::string path_data(const std::vector<Polyline>& lines, bool closed) {
    std::string out;
    for (const Polyline& line : lines) {
        if (line.closed != closed) continue;
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            out.push_back(i == 0 ? 'M' : 'L');
            append_plain_real(out, line.points[i].x);
            out.push_back(' ');
            append_plain_real(out, -line.points[i].y);
        }
        out += closed ? "Z\n" : "\n";
    }
    return out;
}

void append_color(std::string& out, std::string_view name, const std::optional<Color>& color) {
    out.push_back(' ');
    out += name;
    out += "=\"";
    if (color) {
        append_hex_color(out, color_bits(*color));
    } else {
        out += "none";
    }
    out.push_back('"');
}

void append_path(std::string& out, const std::string& data, const std::optional<Color>& fill,
                 const std::optional<Color>& stroke, double stroke_width) {
    if (data.empty()) return;
    out += "<path fill-rule=\"evenodd\"";
    append_color(out, "fill", fill);
    append_color(out, "stroke", stroke);
    if (stroke) {
        append_attribute(out, "stroke-width", stroke_width);
        out += " stroke-linejoin=\"round\" stroke-linecap=\"round\"";
    }
    out += " d=\"\n" + data + "\"/>\n";
}

}  // namespace

std::string write_svg(const std::vector<Polyline>& lines, const DrawingOptions& options) {
    const std::string closed = path_data(lines, true), open = path_data(lines, false);
    // Lines that are not filled have to be drawn.
    const Color ink = options.fill.value_or(Color{0, 0, 0});
    std::optional<Color> stroke = options.stroke;
    if (!stroke && !options.fill) stroke = ink;
    const bool any_stroke = stroke.has_value() || !open.empty();
    const View view = view_of(lines, options.margin + (any_stroke ? 0.5 * options.stroke_width : 0));
    std::string out =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"";
    append_attribute(out, "width", view.width, "mm");
    append_attribute(out, "height", view.height, "mm");
    out += " viewBox=\"";
    for (const double number : {view.x, view.y, view.width, view.height}) {
        append_plain_real(out, number);
        out.push_back(' ');
    }
    out.back() = '"';
    out += ">\n";
    append_element(out, "title", options.title);
    append_element(out, "desc", options.description);
    append_path(out, closed, options.fill, stroke, options.stroke_width);
    append_path(out, open, std::nullopt, stroke.value_or(ink), options.stroke_width);
    out += "</svg>\n";
    return out;
}

}  // namespace frep::encode
