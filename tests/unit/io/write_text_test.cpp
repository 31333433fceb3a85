// Tests of io/text.h: what no format allows is gone, syntax is escaped, identifiers are identifiers.
#include "frep/io/text.h"

#include <doctest/doctest.h>

using namespace frep::encode;

namespace {

std::string xml(std::string_view text) {
    std::string out;
    append_xml(out, text);
    return out;
}

std::string quoted(std::string_view text) {
    std::string out;
    append_quoted(out, text);
    return out;
}

}  // namespace

TEST_CASE("control characters go, letters of all scripts stay") {
    CHECK(clean_text("a\tb\r\nc") == "a b  c");
    CHECK(clean_text(std::string_view("a\0b\x01\x1f\x7f", 6)) == "ab");
    CHECK(clean_text("\xc2\x85\xc2\xa0") == "\xc2\xa0");                          // C1 goes, U+00A0 stays
    CHECK(clean_text("\xef\xbf\xbe\xef\xbf\xbf\xef\xbf\xbd") == "\xef\xbf\xbd");  // U+FFFE, U+FFFF, U+FFFD
    CHECK(clean_text("\xe6\xbc\x86 \xf0\x9f\x8f\xba") == "\xe6\xbc\x86 \xf0\x9f\x8f\xba");
    CHECK(clean_text("a\xff") == "a\xef\xbf\xbd");  // not UTF-8
}

TEST_CASE("escapes of XML, JSON and VRML") {
    CHECK(xml("<a & \"b\" 'c'>]]>\n") == "&lt;a &amp; &quot;b&quot; &apos;c&apos;&gt;]]&gt; ");
    CHECK(quoted("say \"no\" \\ \n\x02") == "\"say \\\"no\\\" \\\\  \"");
    CHECK(quoted("") == "\"\"");
}

TEST_CASE("identifiers and words") {
    CHECK(identifier("Bowl 12", "x_") == "Bowl_12");
    CHECK(identifier("12", "x_") == "x_12");
    CHECK(identifier("", "x_") == "x_");
    CHECK(identifier("\xe6\xbc\x86\xe5\x99\xa8", "x") == "x_");
    CHECK(identifier("a<>&\"b", "x") == "a_b");
    CHECK(identifier(std::string(500, 'a'), "x").size() == 60);
    CHECK(word("a b\t#1", "none") == "a_b__1");
    CHECK(word("\x01", "none") == "none");
}

TEST_CASE("names become different") {
    UniqueNames names;
    CHECK(names.unique("a") == "a");
    CHECK(names.unique("a_2") == "a_2");
    CHECK(names.unique("a") == "a_3");
    CHECK(names.unique("a") == "a_4");
    CHECK(names.unique("b") == "b");
}
