// Decoding, line ends and places.
#include <doctest/doctest.h>

#include "frep/base/source.h"

using frep::Source;

TEST_CASE("lines end with LF, CR LF or CR") {
    const Source source("m.hf", "one\ntwo\r\nthree\rfour");
    CHECK(source.line_count() == 4);
    CHECK(source.line(1) == "one");
    CHECK(source.line(2) == "two");
    CHECK(source.line(3) == "three");
    CHECK(source.line(4) == "four");
    CHECK(source.line(5).empty());
    CHECK(source.locate(4).line == 2);
    CHECK(source.locate(9).line == 3);
}

TEST_CASE("columns count code points") {
    const Source source("m.hf", "\xC3\xA4\xE6\x9C\xA8x");
    CHECK(source.locate(5).column == 3);
    CHECK(source.locate(1000).column == 4);
}

TEST_CASE("bytes that are not UTF-8 become U+FFFD, a byte order mark goes") {
    CHECK(Source("m", "\xEF\xBB\xBFx").text() == "x");
    CHECK(frep::to_valid_utf8("a\xE9z") == "a\xEF\xBF\xBDz");
    CHECK(frep::to_valid_utf8("\xC0\x80") == "\xEF\xBF\xBD\xEF\xBF\xBD");          // overlong
    CHECK(frep::to_valid_utf8("\xED\xA0\x80").find("\xED") == std::string::npos);  // surrogate
    CHECK(frep::to_valid_utf8("\xF4\x90\x80\x80").find("\xF4") == std::string::npos);
    CHECK(frep::to_valid_utf8("\xE2\x82\xAC") == "\xE2\x82\xAC");
}

TEST_CASE("control characters are never sent raw") {
    CHECK(frep::escape_controls("a\x1b[31mb") == "a\\x1b[31mb");
    CHECK(frep::escape_controls("a\tb\x7f") == "a b\\x7f");
    CHECK(frep::escape_controls("\xC2\x9B"
                                "31m") == "\\x9b31m");  // C1 control sequence introducer
    CHECK(frep::escape_controls("a\xE2\x80\xAE"
                                "b\xE2\x81\xA6") == "a\\u202eb\\u2066");  // direction overrides
    CHECK(frep::escape_controls("\xE2\x80\x93\xE2\x81\xAA") == "\xE2\x80\x93\xE2\x81\xAA");
    CHECK(frep::escape_controls("\xC2\xA0") == "\xC2\xA0");
}
