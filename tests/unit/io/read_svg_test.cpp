// SVG drawings: shapes against their areas, transforms and groups, units, inheritance, use; messages with
// their places; files cut anywhere, bombs and cycles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "frep/io/read_svg.h"

using namespace frep;
using doctest::Approx;

namespace {

std::string svg(std::string_view content, std::string_view attributes = "") {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + std::string(attributes) + ">" +
           std::string(content) + "</svg>";
}

Area read(std::string_view content, std::string_view attributes = "") {
    const auto file = read_svg(svg(content, attributes));
    if (!file) {
        FAIL_CHECK(std::string(content), ": ", file.error().message);
        return {};
    }
    return file->area;
}

/// The signed areas of all contours, added up.
double area_of(const Area& area) {
    double sum = 0;
    for (const FilledPart& part : area.parts)
        for (const auto& v : part.contours)
            for (std::size_t i = 0; i < v.size(); ++i) {
                const Vec2 a = v[i], b = v[(i + 1) % v.size()];
                sum += 0.5 * (a.x * b.y - a.y * b.x);
            }
    return sum;
}

struct Extent {
    double left = 1e9, bottom = 1e9, right = -1e9, top = -1e9;
};
Extent extent_of(const Area& area) {
    Extent e;
    for (const FilledPart& part : area.parts)
        for (const auto& contour : part.contours)
            for (const Vec2& p : contour) {
                e.left = std::min(e.left, p.x), e.right = std::max(e.right, p.x);
                e.bottom = std::min(e.bottom, p.y), e.top = std::max(e.top, p.y);
            }
    return e;
}
void check_extent(const Area& area, double left, double bottom, double right, double top) {
    const Extent e = extent_of(area);
    CHECK(e.left == Approx(left).epsilon(1e-6));
    CHECK(e.bottom == Approx(bottom).epsilon(1e-6));
    CHECK(e.right == Approx(right).epsilon(1e-6));
    CHECK(e.top == Approx(top).epsilon(1e-6));
}

std::string message_of(std::string_view text) {
    const auto file = read_svg(text);
    return file ? "no error" : file.error().message;
}

constexpr double pi = 3.14159265358979323846;

}  // namespace

TEST_CASE("basic shapes, y up") {
    check_extent(read("<rect x='1' y='2' width='3' height='4'/>"), 1, -6, 4, -2);
    CHECK(std::fabs(area_of(read("<rect width='3' height='4'/>"))) == Approx(12));
    CHECK(std::fabs(area_of(read("<rect width='10' height='6' rx='2'/>"))) ==
          Approx(60 - (4 - pi) * 4).epsilon(1e-4));
    CHECK(std::fabs(area_of(read("<rect width='10' height='6' rx='2' ry='1'/>"))) ==
          Approx(60 - (4 - pi) * 2).epsilon(1e-4));
    CHECK(std::fabs(area_of(read("<rect width='4' height='4' rx='9'/>"))) == Approx(4 * pi).epsilon(1e-4));
    check_extent(read("<circle cx='5' cy='5' r='2'/>"), 3, -7, 7, -3);
    CHECK(std::fabs(area_of(read("<circle r='2'/>"))) == Approx(4 * pi).epsilon(1e-4));
    CHECK(std::fabs(area_of(read("<ellipse rx='3' ry='2'/>"))) == Approx(6 * pi).epsilon(1e-4));
    CHECK(std::fabs(area_of(read("<polygon points='0,0 4,0 4,3'/>"))) == Approx(6));
    CHECK(std::fabs(area_of(read("<polyline points='0 0 4 0 4 3'/>"))) == Approx(6));  // closed to be filled
    check_extent(read("<path d='M1 1h2v2z'/>"), 1, -3, 3, -1);
}

TEST_CASE("groups and transforms nest, the inner one first") {
    check_extent(read("<g transform='translate(10 0)'><g transform='scale(2)'><rect width='1' height='1' "
                      "transform='translate(1 1)'/></g></g>"),
                 12, -4, 14, -2);
    check_extent(read("<g transform='rotate(90)'><rect width='2' height='1'/></g>"), -1, -2, 0, 0);
    CHECK(std::fabs(area_of(read("<g transform='matrix(2 1 0 3 0 0)'><circle r='1'/></g>"))) ==
          Approx(6 * pi).epsilon(1e-4));
}

TEST_CASE("fill rules and visibility are inherited; style goes before attributes") {
    const Area area = read(
        "<g fill-rule='evenodd'><path d='M0 0h3v3z'/><path style='fill-rule: nonzero' d='M0 0h3v3z'/></g>");
    REQUIRE(area.parts.size() == 2);
    CHECK(area.parts[0].rule == FillRule::even_odd);
    CHECK(area.parts[1].rule == FillRule::nonzero);
    const std::string box = "<rect width='1' height='1'/>";
    CHECK(read("<g fill='none'>" + box + "<rect x='5' width='1' height='1' fill='red'/></g>").parts.size() ==
          1);
    CHECK(read(box + "<g style='display:none'>" + box +
               "</g><rect width='1' height='1' style='fill : none ; x:y'/>")
              .parts.size() == 1);
    CHECK(
        read(box + "<g visibility='hidden'>" + box + "<rect width='2' height='2' visibility='visible'/></g>")
            .parts.size() == 2);
    CHECK(read(box + "<defs>" + box + "</defs><symbol>" + box + "</symbol><clipPath>" + box + "</clipPath>")
              .parts.size() == 1);
    const auto notes =
        read_svg(svg(box + "<text>hello</text><text>again</text><path fill='none' d='M0 0L1 1'/>"))->notes;
    REQUIRE(notes.size() == 2);
    CHECK(notes[0] == "not read: `text` (2 times)");
    CHECK(notes[1] == "1 shapes have neither fill nor stroke and count for nothing");
}

TEST_CASE("used elements stand where they are used") {
    const std::string defs = "<defs><rect id='a' width='1' height='1'/><g id='b'><use href='#a'/></g></defs>";
    check_extent(read(defs + "<use href='#a' x='5' y='6'/>"), 5, -7, 6, -6);
    check_extent(read(defs + "<g transform='scale(2)'><use xlink:href='#b' x='5'/></g>"), 10, -2, 12, 0);
    check_extent(read("<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol><use "
                      "href='#s' x='3'/>"),
                 3, -10, 13, 0);
    check_extent(
        read("<svg x='10' y='20' width='40' height='20' viewBox='1 1 2 2'><rect x='1' y='1' width='2' "
             "height='2'/></svg>"),
        20, -40, 40, -20);  // 20 by 20 in the middle of 40 by 20
}

TEST_CASE("units of the root") {
    const std::string box = "<rect width='10' height='10'/>";
    check_extent(read(box, "viewBox='0 0 100 100'"), 0, -10, 10, 0);
    check_extent(read(box, "width='200' height='200' viewBox='0 0 100 100'"), 0, -10, 10, 0);
    check_extent(read(box, "width='50mm' height='50mm' viewBox='0 0 100 100'"), 0, -5, 5, 0);
    check_extent(read(box, "width='1in' viewBox='-5 -5 100 100'"), 0, -2.54, 2.54, 0);
    check_extent(read(box, "width='20cm' height='1cm' viewBox='0 0 100 100'"), 0, -1, 1,
                 0);                                                                 // the smaller scale
    check_extent(read(box, "width='96mm'"), 0, -10 * 25.4 / 96, 10 * 25.4 / 96, 0);  // px
    check_extent(read("<rect width='1in' height='50%'/>", "viewBox='0 0 100 80'"), 0, -40, 96, 0);
}

TEST_CASE("strokes are shapes of their own, in the coordinates of their element") {
    check_extent(read("<line x1='1' y1='2' x2='5' y2='2' stroke='red' stroke-width='2'/>"), 1, -3, 5, -1);
    check_extent(read("<path d='M0 0H4' fill='none' stroke='#000'/>"), 0, -0.5, 4, 0.5);
    const Area both = read("<rect width='4' height='4' stroke='red' stroke-width='1'/>");
    REQUIRE(both.parts.size() == 2);
    check_extent(both, -0.5, -4.5, 4.5, 0.5);
    CHECK(std::fabs(area_of(Area{{both.parts[1]}})) == Approx(25 - 9 + 4 * 0.125));  // corners count twice
    // the width is scaled with the element, and differently along x and y
    check_extent(read("<g stroke='red' stroke-width='1'><path transform='scale(3 1)' d='M0 0V4'/></g>"), -1.5,
                 -4, 1.5, 0);
    CHECK(std::fabs(area_of(read("<polyline points='0 0 10 0' stroke='red' stroke-width='2' "
                                 "style='stroke-linecap:round'/>"))) == Approx(20 + pi).epsilon(1e-4));
    check_extent(
        read("<path d='M0 0H4V4' fill='none' stroke='red' stroke-width='10%'/>", "viewBox='0 0 10 10'"), 0,
        -4, 4.5, 0.5);
    const auto notes = read_svg(svg("<path d='M0 0H4' stroke='red' stroke-dasharray='1 2' "
                                    "style='marker-end:url(#a);vector-effect:non-scaling-stroke'/>"))
                           ->notes;
    REQUIRE(notes.size() == 3);
    CHECK(notes[0] == "not read: `marker-end` (1 times)");
    CHECK(notes[1] == "not read: `non-scaling-stroke` (1 times)");
    CHECK(notes[2] == "not read: `stroke-dasharray` (1 times)");
}

TEST_CASE("style sheets paint what they select") {
    const std::string sheet =
        "<defs><style><![CDATA[ .off { fill : none } /* } */ rect.on,#q{fill:red;}\n@media "
        "print{.on{fill:none}}"
        " g > path { fill: none } ]]></style></defs>";
    CHECK(
        read(sheet + "<rect class='off' width='1' height='1'/><rect width='2' height='2' class='a off on'/>")
            .parts.size() == 1);
    CHECK(read(sheet + "<rect class='off' id='q' width='1' height='1'/><circle r='1' class='on'/>")
              .parts.size() == 2);
    const auto notes = read_svg(svg(sheet + "<circle r='1'/>"))->notes;
    REQUIRE(notes.size() == 2);
    CHECK(notes[0] == "not read: @-rules of style sheets (1 times)");
    CHECK(notes[1] == "not read: style sheets' selectors other than `path`, `.class`, `#id` (1 times)");
}

TEST_CASE("what is wrong, and where") {
    CHECK(message_of("") == "1:1: No document element found");
    CHECK(message_of("<html/>") == "1:2: the root element is no `svg`");
    CHECK(message_of("<svg>\n <path d='M0 0\n  L1 x'/>\n</svg>") == "3:6: expected a number, found `x`");
    CHECK(message_of("<svg>\n <path d='M0 0\n  L1 1'>\n</svg>").substr(0, 2) == "4:");
    CHECK(message_of("<svg><g transform='scale(0 a)'/></svg>") ==
          "1:28: expected a number or `)`, found `a)`");
    CHECK(message_of("<svg><rect width='2em' height='1'/></svg>") == "1:19: expected a length, found `2em`");
    CHECK(message_of("<svg><rect width='-2' height='1'/></svg>") == "1:7: a width or height below 0");
    CHECK(message_of("<svg viewBox='0 0 1'/>") ==
          "1:15: a viewBox has four numbers, its width and height above 0");
    CHECK(message_of("<svg><polygon points='1 2 3'/></svg>") == "1:23: points are pairs of numbers");
    CHECK(message_of("<svg><use href='#q'/></svg>") == "1:17: there is no element `#q`");
    CHECK(message_of("<svg><path d='M0 0'/></svg>") == "1:2: there is no path or shape");
    CHECK(message_of("<svg><path d='M0 0L1 1'/></svg>") == "1:2: the painted shapes have no area");
    CHECK(message_of("<svg><path fill='none' d='M0 0L1 1'/></svg>") ==
          "1:2: nothing is painted: all shapes have neither fill nor stroke");
    CHECK(message_of("<svg>\n<path stroke='red' style='stroke-width:2em' d='M0 0L1 1'/></svg>") ==
          "2:2: stroke-width: expected a length, found `2em`");
    CHECK(message_of(
              "<svg><g transform='scale(1e9)'><g transform='scale(1e9)'><circle r='1'/></g></g></svg>") ==
          "1:2: after all transforms coordinates are beyond 1e12, or not finite");
}

TEST_CASE("files that try to be too much") {
    std::string scale = "<svg><path transform='";
    for (int i = 0; i < 40; ++i) scale += "scale(1e9)";
    CHECK(message_of(scale + "' d='M0 0C0 0 0 0 0 0z'/></svg>") ==
          "1:7: the transforms lead beyond all bounds");
    for (int i = 0; i < 40; ++i) scale += "translate(1e9)scale(1e-9)";
    CHECK(message_of(scale + "' d='M0 0h1v1'/></svg>") == "1:7: the transforms lead beyond all bounds");
    CHECK(message_of("<svg><path stroke='red' stroke-width='1e9' stroke-miterlimit='1e300' "
                     "d='M0 0L1 0L0 1e-9L1e9 0'/></svg>")
              .find("error") != std::string::npos);
    std::string deep;
    for (int i = 0; i < 200'000; ++i) deep += "<g>";
    CHECK(!read_svg("<svg>" + deep));
    std::string closed = deep;
    for (int i = 0; i < 200'000; ++i) closed += "</g>";
    CHECK(message_of("<svg>" + closed + "</svg>").find("elements nest deeper than 100") != std::string::npos);
    CHECK(message_of("<svg><g id='a'><use href='#a'/></g></svg>").find("nest deeper") != std::string::npos);
    std::string bomb = "<svg><g id='x0'/>";
    for (int i = 1; i < 30; ++i) {
        const std::string before = "<use href='#x" + std::to_string(i - 1) + "'/>";
        bomb += "<g id='x" + std::to_string(i) + "'>" + before + before + "</g>";
    }
    CHECK(message_of(bomb + "</svg>") == "more than 200000 elements");
    const std::string entities =
        "<!DOCTYPE svg [<!ENTITY a 'M0 0'><!ENTITY b '&a;&a;&a;'>]><svg><path d='&b;'/></svg>";
    CHECK(message_of(entities).find("expected a path command") != std::string::npos);
    std::string many = "<svg><path d='M0 0";
    for (int i = 0; i < 250'000; ++i) many += " 1 2";
    CHECK(message_of(many + "'/></svg>") == "more than 200000 edges");
    // few segments, each of which could become hundreds of edges
    std::string curves = "<svg><path stroke='red' d='M0 0";
    for (int i = 0; i < 100'000; ++i) curves += "c9 9 -9 9 0 0";
    CHECK(message_of(curves + "'/></svg>") == "more than 200000 edges");
    std::string tags = "<svg>";
    for (int i = 0; i < 4'000'001; ++i) tags += "<a/>";
    CHECK(message_of(tags + "</svg>") == "more than 4000000 tags and attributes");
    std::string selectors = "<svg><style>";
    for (int i = 0; i < 10'001; ++i) selectors += ".a,";
    CHECK(message_of(selectors + "b{fill:red}</style></svg>") == "more than 10000 selectors of style sheets");
}

TEST_CASE("a file cut anywhere gives an area or a message") {
    const std::string whole = svg(
        "<g transform='rotate(30 1 2)'><path style='fill:red' d='M0 0C1 2 3 4 5 6Q1 2 9 9A4 3 20 0 1 7 7z'/>"
        "<use href='#e'/><ellipse id='e' rx='3' ry='20%'/></g>",
        "viewBox='0 0 10 10' width='3cm'");
    REQUIRE(read_svg(whole));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto file = read_svg(std::string_view(whole).substr(0, size));
        REQUIRE(!file);
        CHECK(file.error().message.find(':') != std::string::npos);
    }
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const char c : {'\0', '"', '<', '9', 'e', '-', '\xff'}) {
            std::string damaged = whole;
            damaged[at] = c;
            if (const auto file = read_svg(damaged); !file) CHECK(!file.error().message.empty());
        }
}
