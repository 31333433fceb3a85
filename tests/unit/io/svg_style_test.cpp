// Which declaration wins, and what is left out of a style sheet.
#include <doctest/doctest.h>

#include "frep/io/svg_style.h"

using namespace frep;
using namespace frep::reading;

namespace {

/// The value of `fill` of <path .../> with these attributes, under a sheet.
std::string fill(const std::string& sheet, const std::string& attributes) {
    pugi::xml_document document;
    REQUIRE(document.load_string(("<s:path " + attributes + "/>").c_str()));
    StyleSheets sheets;
    REQUIRE(sheets.add(sheet));
    return std::string(sheets.of(document.document_element())[Property::fill]);
}

}  // namespace

TEST_CASE("style goes before ids, ids before classes, classes before kinds, kinds before attributes") {
    CHECK(fill("", "fill=' a '") == "a");
    CHECK(fill("*{fill:b}", "fill='a'") == "b");
    CHECK(fill("path{fill:c} *{fill:b}", "fill='a'") == "c");
    CHECK(fill(".k{fill:d} path{fill:c}", "class='k'") == "d");
    CHECK(fill("path.k{fill:e} .k{fill:d}", "class='k'") == "e");
    CHECK(fill("#i{fill:f} path.k{fill:e}", "class='k' id='i'") == "f");
    CHECK(fill("path#i{fill:g} #i{fill:f}", "id='i'") == "g");
    CHECK(fill("path#i{fill:g}", "id='i' style='stroke:x;fill: h !important;'") == "h");
    CHECK(fill("circle.k, #j {fill:e}", "class='k' id='i'").empty());
}

TEST_CASE("of equal ones the later wins, whatever the order of the classes") {
    CHECK(fill(".b{fill:1} .a{fill:2}", "class='a b'") == "2");
    CHECK(fill(".a{fill:1} .b{fill:2}", "class='a\n b'") == "2");
    CHECK(fill(".a{fill:1} .b{stroke:2} .a{stroke:3}", "class='b a'") == "1");
    CHECK(fill(".a{fill:1}.a{fill:2}.a{stroke:3}", "class='a'") == "2");
}

TEST_CASE("sheets with what is not read, and cut anywhere") {
    const std::string sheet =
        "@import 'x'; @media print { .a { fill: no } } /* .a{fill:no} */ g .a, .a:hover, .a , [x] { fill : 1 "
        "; } ";
    CHECK(fill(sheet, "class='a'") == "1");
    StyleSheets sheets;
    REQUIRE(sheets.add(sheet));
    CHECK(sheets.left_out().size() == 2);
    CHECK(sheets.left_out().at("@-rules of style sheets") == 2);
    for (std::size_t size = 0; size < sheet.size(); ++size) {
        const std::string found = fill(sheet.substr(0, size), "class='a'");
        CHECK((found.empty() || found == "1"));
    }
}

TEST_CASE("what is inherited") {
    pugi::xml_document document;
    REQUIRE(
        document.load_string("<g fill='none' stroke='red' stroke-linejoin='round' stroke-linecap='square' "
                             "stroke-miterlimit='2' fill-rule='evenodd' visibility='hidden'/>"));
    const StyleSheets sheets;
    const Style style = inherited(sheets.of(document.document_element()), {});
    CHECK(!style.is_filled);
    CHECK(style.is_stroked);
    CHECK(!style.is_visible);
    CHECK(style.rule == FillRule::even_odd);
    CHECK(style.pen.join == Pen::Join::round);
    CHECK(style.pen.cap == Pen::Cap::square);
    CHECK(style.pen.miter_limit == 2);
    const Style same = inherited({}, style);
    CHECK(same.is_stroked);
    CHECK(same.pen.cap == Pen::Cap::square);
}
