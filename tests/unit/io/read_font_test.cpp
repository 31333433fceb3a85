// Texts as areas: the glyphs of examples/library/capitals.ttf, whose outlines are known numbers; kerning and
// missing glyphs; damaged fonts; a font of the system with composite glyphs and characters beyond ASCII.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "frep/io/read_font.h"

using namespace frep;
using doctest::Approx;

namespace {

std::string content_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}
const std::string& capitals() {
    static const std::string bytes = content_of(FREP_SOURCE_DIR "/examples/library/capitals.ttf");
    return bytes;
}

double area_of(const std::vector<Vec2>& v) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Vec2 a = v[i], b = v[(i + 1) % v.size()];
        sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return sum;
}
/// In font units of 700 to a capital; clockwise contours of TrueType count as positive.
double area_of(const AreaFile& file) {
    double sum = 0;
    for (const auto& contour : file.area.parts[0].contours) sum -= area_of(contour) * 700 * 700;
    return sum;
}
double right_end(const AreaFile& file) {
    double right = -1e9;
    for (const auto& contour : file.area.parts[0].contours)
        for (const Vec2& p : contour) right = std::max(right, p.x * 700);
    return right;
}

}  // namespace

TEST_CASE("glyphs are what the font says") {
    const auto e = read_text(capitals(), "E");
    REQUIRE(e);
    CHECK(e->notes.empty());
    REQUIRE(e->area.parts.size() == 1);
    REQUIRE(e->area.parts[0].contours.size() == 1);
    CHECK(e->area.parts[0].contours[0].size() == 12);
    CHECK(area_of(*e) == Approx(140 * 700 + 140 * (320 + 280 + 320)));
    // four quadratics in a box: the box less a third of each corner's quarter box
    const auto o = read_text(capitals(), "O");
    REQUIRE(o);
    CHECK(o->area.parts[0].contours.size() == 2);
    const double outer = 660 * 700 * (1 - 1.0 / 6), inner = 380 * 420 * (1 - 1.0 / 6);
    CHECK(area_of(*o) == Approx(outer - inner).epsilon(1e-3));
}

TEST_CASE("advances, kerning and blanks") {
    const double e = 540, h = 640, t = 620, blank = 280;
    CHECK(right_end(*read_text(capitals(), "EE")) == Approx(e + 460));
    CHECK(right_end(*read_text(capitals(), "H E")) == Approx(h + blank + 460));
    CHECK(right_end(*read_text(capitals(), "TO")) == Approx(t - 60 + 660));  // the pair is kerned
    CHECK(right_end(*read_text(capitals(), "T O")) == Approx(t + blank + 660));
}

TEST_CASE("characters that the font lacks") {
    const auto text = read_text(capitals(),
                                "E\xC3\x84"
                                "E\xC3\x84\xFF");
    REQUIRE(text);
    REQUIRE(text->notes.size() == 2);
    CHECK(text->notes[0] == "the font has no glyph for U+00C4 (2 times)");
    CHECK(text->notes[1] == "the font has no glyph for U+FFFD (1 times)");
    CHECK(right_end(*text) == Approx(540 + 600 + 460));  // 600 is the width of the missing glyph
    CHECK(text->area.parts[0].contours.size() == 2);
    CHECK(read_text(capitals(), "\xC3\x84").error().message ==
          "the text shows nothing: the font has no glyph for U+00C4 (1 times)");
    CHECK(read_text(capitals(), "").error().message == "the text shows nothing");
    CHECK(read_text(capitals(), std::string(10'001, 'E')).error().kind == ErrorKind::over_limit);
    CHECK(read_text(capitals(), std::string(9'000, 'R')).error().kind == ErrorKind::over_limit);
}

TEST_CASE("damaged fonts") {
    CHECK(!read_text("", "E"));
    CHECK(!read_text("wOFF", "E"));
    for (std::size_t size = 0; size < capitals().size(); ++size)
        if (const auto text = read_text(std::string_view(capitals()).substr(0, size), "HER"); !text)
            CHECK(!text.error().message.empty());
    for (std::size_t at = 0; at < capitals().size(); ++at)
        for (const char c : {'\0', '\x7f', '\xff'}) {
            std::string damaged = capitals();
            damaged[at] = c;
            if (const auto text = read_text(damaged, "HER"); !text) CHECK(!text.error().message.empty());
        }
}

TEST_CASE("a font of the system") {
    const std::string font = content_of(FREP_TEST_FONT);
    if (font.empty()) {
        std::puts("skipped: 1 (no DejaVu Sans)");
        return;
    }
    const auto text = read_text(font, "H\xC3\x84g\xE2\x82\xAC");  // H, A with dots, g, euro
    REQUIRE(text);
    CHECK(text->notes.empty());
    CHECK(text->area.parts[0].contours.size() == 1 + 4 + 2 + 1);
    double top = -1, bottom = 1;
    for (const Vec2& p : text->area.parts[0].contours[0]) {
        top = std::max(top, p.y);
        bottom = std::min(bottom, p.y);
    }
    CHECK(top == 1);
    CHECK(bottom == 0);
    CHECK(right_end(*read_text(font, "AV")) <
          right_end(*read_text(font, "A")) + right_end(*read_text(font, "V")));
}
