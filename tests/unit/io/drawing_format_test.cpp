// Tests of io/drawing_format.h: the very bytes of a square with a hole.
#include "frep/io/drawing_format.h"

#include <limits>

#include "unit/io/scenes.h"

using namespace frep;
using frep::test::contains;
using frep::test::count_of;

namespace {

const Polyline square{{{-1, 0}, {1, 0}, {1, 2}, {-1, 2}}, true};
const Polyline hole{{{0, 0.5}, {0, 1}, {0.5, 1}}, true};
const Polyline open_line{{{0, 3}, {1, 3}}, false};

std::string drawn(const std::vector<Polyline>& lines, DrawingFormat format,
                  const DrawingOptions& options = {}) {
    const auto bytes = encode_drawing(lines, format, options);
    REQUIRE(static_cast<bool>(bytes));
    return *bytes;
}

}  // namespace

TEST_CASE("the extension names the drawing format") {
    CHECK(*drawing_format_from_path("a.SVG") == DrawingFormat::svg);
    CHECK(*drawing_format_from_path("a/b.dxf") == DrawingFormat::dxf);
    CHECK_FALSE(static_cast<bool>(drawing_format_from_path("svg")));
    CHECK_FALSE(static_cast<bool>(drawing_format_from_path("a.svg/b")));
}

TEST_CASE("SVG: one path, even-odd, real size, Y turned down") {
    DrawingOptions options;
    options.title = "a<b";
    options.description = "c&d";
    CHECK(drawn({square, hole}, DrawingFormat::svg, options) ==
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"2mm\" height=\"2mm\" "
          "viewBox=\"-1 -2 2 2\">\n"
          "<title>a&lt;b</title>\n<desc>c&amp;d</desc>\n"
          "<path fill-rule=\"evenodd\" fill=\"#000000\" stroke=\"none\" d=\"\n"
          "M-1 0L1 0L1 -2L-1 -2Z\nM0 -0.5L0 -1L0.5 -1Z\n\"/>\n</svg>\n");
}

TEST_CASE("SVG: units, strokes, open lines, margins") {
    DrawingOptions options;
    options.unit = *length_unit("inch");
    options.margin = 1;
    std::string text = drawn({square}, DrawingFormat::svg, options);
    CHECK(contains(text, "width=\"52.8mm\" height=\"52.8mm\" viewBox=\"-26.4 -51.8 52.8 52.8\""));
    CHECK(contains(text, "M-25.4 0L25.4 0L25.4 -50.8L-25.4 -50.8Z"));
    options = {};
    options.fill.reset();
    text = drawn({square, open_line}, DrawingFormat::svg, options);
    CHECK(contains(text, "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.1\""));
    CHECK(contains(text, "viewBox=\"-1.05 -3.05 2.1 3.1\""));
    options.fill = Color{1, 0, 0};
    text = drawn({square, open_line}, DrawingFormat::svg, options);
    CHECK(contains(text, "fill=\"#FF0000\" stroke=\"none\""));
    CHECK(contains(text,
                   "fill=\"none\" stroke=\"#FF0000\" stroke-width=\"0.1\" stroke-linejoin=\"round\" "
                   "stroke-linecap=\"round\" d=\"\nM0 -3L1 -3\n\""));
}

TEST_CASE("SVG: never an exponent, never a side without length") {
    const Polyline tiny{{{0, 1e-9}, {0, 3e-9}}, true};
    const std::string text = drawn({tiny}, DrawingFormat::svg);
    CHECK(contains(text, "M0 -0.000000001L0 -0.000000003Z"));
    CHECK(contains(text, "width=\"1mm\""));
    CHECK(
        contains(drawn({}, DrawingFormat::svg), "width=\"1mm\" height=\"1mm\" viewBox=\"0 0 1 1\">\n</svg>"));
}

TEST_CASE("DXF: a closed polyline on its layer") {
    DrawingOptions options;
    options.layer = "Cut 1";
    const Polyline triangle{{{0, 0}, {1.5, 0}, {0, 2}}, true};
    const std::string text = drawn({triangle, open_line}, DrawingFormat::dxf, options);
    CHECK(contains(
        text,
        "9\n$ACADVER\n1\nAC1009\n9\n$EXTMIN\n10\n0\n20\n0\n30\n0\n9\n$EXTMAX\n10\n1.5\n20\n3\n30\n0\n"));
    CHECK(contains(text, "0\nLAYER\n2\nCUT_1\n70\n0\n62\n7\n6\nCONTINUOUS\n"));
    CHECK(contains(text,
                   "0\nPOLYLINE\n8\nCUT_1\n66\n1\n10\n0\n20\n0\n30\n0\n70\n1\n"
                   "0\nVERTEX\n8\nCUT_1\n10\n0\n20\n0\n30\n0\n"
                   "0\nVERTEX\n8\nCUT_1\n10\n1.5\n20\n0\n30\n0\n"
                   "0\nVERTEX\n8\nCUT_1\n10\n0\n20\n2\n30\n0\n0\nSEQEND\n8\nCUT_1\n"));
    CHECK(contains(text, "66\n1\n10\n0\n20\n0\n30\n0\n70\n0\n0\nVERTEX"));  // the open one
    CHECK(text.substr(text.size() - 15) == "0\nENDSEC\n0\nEOF\n");
    CHECK(contains(drawn({}, DrawingFormat::dxf), "2\nENTITIES\n0\nENDSEC\n0\nEOF\n"));
    CHECK(count_of(drawn({}, DrawingFormat::dxf), "\nLAYER\n2\n") == 1);
}

TEST_CASE("DXF: lengths are millimetres") {
    DrawingOptions options;
    options.unit = *length_unit("cm");
    CHECK(contains(drawn({open_line}, DrawingFormat::dxf, options), "VERTEX\n8\n0\n10\n10\n20\n30\n30\n0\n"));
}

TEST_CASE("drawings: what is refused and what is left out") {
    Polyline bad = square;
    bad.points[2].y = std::numeric_limits<double>::infinity();
    for (const DrawingFormat format : {DrawingFormat::svg, DrawingFormat::dxf}) {
        const auto bytes = encode_drawing({square, bad}, format);
        REQUIRE_FALSE(static_cast<bool>(bytes));
        CHECK(bytes.error().message.find("line 1") != std::string::npos);
        CHECK(drawn({Polyline{{{1, 1}}, true}, Polyline{}}, format) == drawn({}, format));
        DrawingOptions options;
        options.unit.metres = 0;
        CHECK_FALSE(static_cast<bool>(encode_drawing({square}, format, options)));
        options = {};
        options.stroke_width = 0;
        CHECK_FALSE(static_cast<bool>(encode_drawing({square}, format, options)));
        options = {};
        options.margin = std::numeric_limits<double>::quiet_NaN();
        CHECK_FALSE(static_cast<bool>(encode_drawing({square}, format, options)));
    }
    bad.points[2].y = 1e38;  // metres: beyond binary32 in millimetres
    DrawingOptions metres;
    metres.unit = *length_unit("m");
    CHECK_FALSE(static_cast<bool>(encode_drawing({bad}, DrawingFormat::svg, metres)));
}
