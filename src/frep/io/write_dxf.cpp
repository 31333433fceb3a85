// DXF of AutoCAD release 12 (AC1009, AutoCAD R12 Customization Manual, chapter 11): text, a POLYLINE with
// VERTEX and SEQEND an outline. Every CAD program and cutter reads this release; it has no variable for the
// unit, and readers take millimetres. See drawing_format.h.
#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/write_drawing.h"

namespace frep::encode {

namespace {

/// A group: its code on one line, its value on the next.
void append_group(std::string& out, int code, std::string_view value) {
    append_number(out, code);
    out.push_back('\n');
    out += value;
    out.push_back('\n');
}

void append_group(std::string& out, int code, double value) {
    append_number(out, code);
    out.push_back('\n');
    append_plain_real(out, value);
    out.push_back('\n');
}

void append_count(std::string& out, int code, int value) { append_group(out, code, std::to_string(value)); }

void append_point(std::string& out, const Vec2& p) {
    append_group(out, 10, p.x);
    append_group(out, 20, p.y);
    append_group(out, 30, 0.0);
}

/// A name of release 12: capitals, digits, _ and at most 31 characters; "0" for none.
std::string layer_name(std::string_view text) {
    if (text.empty()) return "0";
    std::string name = identifier(text, "L");
    if (name.size() > 31) name.resize(31);
    for (char& c : name) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return name;
}

void append_header(std::string& out, const Extent& extent) {
    append_group(out, 0, "SECTION");
    append_group(out, 2, "HEADER");
    append_group(out, 9, "$ACADVER");
    append_group(out, 1, "AC1009");
    append_group(out, 9, "$EXTMIN");
    append_point(out, extent.low);
    append_group(out, 9, "$EXTMAX");
    append_point(out, extent.high);
    append_group(out, 0, "ENDSEC");
}

void append_table_head(std::string& out, std::string_view name, int entries) {
    append_group(out, 0, "TABLE");
    append_group(out, 2, name);
    append_count(out, 70, entries);
}

void append_layer(std::string& out, const std::string& name) {
    append_group(out, 0, "LAYER");
    append_group(out, 2, name);
    append_count(out, 70, 0);
    append_count(out, 62, 7);  // black on white, white on black
    append_group(out, 6, "CONTINUOUS");
}

void append_tables(std::string& out, const std::string& layer) {
    append_group(out, 0, "SECTION");
    append_group(out, 2, "TABLES");
    append_table_head(out, "LTYPE", 1);
    append_group(out, 0, "LTYPE");
    append_group(out, 2, "CONTINUOUS");
    append_count(out, 70, 0);
    append_group(out, 3, "Solid line");
    append_count(out, 72, 65);
    append_count(out, 73, 0);
    append_group(out, 40, 0.0);
    append_group(out, 0, "ENDTAB");
    append_table_head(out, "LAYER", layer == "0" ? 1 : 2);
    append_layer(out, "0");
    if (layer != "0") append_layer(out, layer);
    append_group(out, 0, "ENDTAB");
    append_group(out, 0, "ENDSEC");
}

void append_line(std::string& out, const Polyline& line, const std::string& layer) {
    append_group(out, 0, "POLYLINE");
    append_group(out, 8, layer);
    append_count(out, 66, 1);  // vertices follow
    append_point(out, {0, 0});
    append_count(out, 70, line.closed ? 1 : 0);
    for (const Vec2& p : line.points) {
        append_group(out, 0, "VERTEX");
        append_group(out, 8, layer);
        append_point(out, p);
    }
    append_group(out, 0, "SEQEND");
    append_group(out, 8, layer);
}

}  // namespace

std::string write_dxf(const std::vector<Polyline>& lines, const DrawingOptions& options) {
    const std::string layer = layer_name(options.layer);
    std::string out;
    append_header(out, extent_of(lines));
    append_tables(out, layer);
    append_group(out, 0, "SECTION");
    append_group(out, 2, "ENTITIES");
    for (const Polyline& line : lines) append_line(out, line, layer);
    append_group(out, 0, "ENDSEC");
    append_group(out, 0, "EOF");
    return out;
}

}  // namespace frep::encode
