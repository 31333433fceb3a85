// Tests of trace/stroke_font.h: every printable character has strokes that stay within its width.
#include "frep/trace/stroke_font.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace frep;
using namespace frep::drawing;

namespace {

std::vector<Segment> strokes_of(std::string_view text, TextAnchor anchor = TextAnchor::start,
                                const TextStyle& style = {}) {
    std::vector<Segment> out;
    append_text(out, text, {0, 0}, anchor, style);
    return out;
}

struct Extent {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};

Extent extent_of(const std::vector<Segment>& strokes) {
    Extent e;
    for (const Segment& s : strokes) {
        for (const Vec2 p : {s.a, s.b}) {
            e.left = std::min(e.left, p.x);
            e.right = std::max(e.right, p.x);
            e.top = std::min(e.top, p.y);
            e.bottom = std::max(e.bottom, p.y);
        }
    }
    return e;
}

}  // namespace

TEST_CASE("all of ASCII has a glyph, and its ink stays within its width and the line") {
    for (char c = ' '; c <= '~'; ++c) {
        const std::string text(1, c);
        CAPTURE(text);
        REQUIRE(has_glyphs(text));
        const std::vector<Segment> strokes = strokes_of(text);
        CHECK(strokes.empty() == (c == ' '));
        if (strokes.empty()) continue;
        const Extent e = extent_of(strokes);
        CHECK(e.left >= -0.01);
        CHECK(e.right <= text_width(text, 10) + 0.4);
        CHECK(e.top >= -12);
        CHECK(e.bottom <= 3.2);
    }
}

TEST_CASE("capitals are as high as stated and stand on the line") {
    for (char c = 'A'; c <= 'Z'; ++c) {
        CAPTURE(c);
        const Extent e = extent_of(strokes_of(std::string(1, c), TextAnchor::start, {20, true}));
        CHECK(e.top == doctest::Approx(-20));
        CHECK(e.bottom >= -1e-9);
        CHECK(e.bottom <= (c == 'Q' ? 1.5 : 1e-9));
    }
}

TEST_CASE("all characters are different") {
    std::vector<std::vector<Segment>> seen;
    for (char c = '!'; c <= '~'; ++c) {
        const std::vector<Segment> strokes = strokes_of(std::string(1, c));
        for (const auto& other : seen) {
            const bool same =
                other.size() == strokes.size() &&
                std::equal(other.begin(), other.end(), strokes.begin(),
                           [](const Segment& a, const Segment& b) { return a.a == b.a && a.b == b.b; });
            CHECK_FALSE(same);
        }
        seen.push_back(strokes);
    }
}

TEST_CASE("a text is as long as its ink; anchors and turns move it") {
    const std::string text = "Hx = 12";
    const double width = text_width(text, 10);
    const Extent start = extent_of(strokes_of(text));
    CHECK(start.left == doctest::Approx(0));
    CHECK(start.right == doctest::Approx(width).epsilon(0.02));
    CHECK(text_width(text, 20) == doctest::Approx(2 * width));
    const Extent end = extent_of(strokes_of(text, TextAnchor::end));
    CHECK(end.left == doctest::Approx(-width));
    const Extent middle = extent_of(strokes_of(text, TextAnchor::middle));
    CHECK(middle.left == doctest::Approx(-width / 2));
    const Extent turned = extent_of(strokes_of(text, TextAnchor::start, {10, false}));
    CHECK(turned.bottom == doctest::Approx(0));
    CHECK(turned.top == doctest::Approx(start.left - start.right));
    CHECK(turned.right == doctest::Approx(start.bottom));
    CHECK(turned.left == doctest::Approx(start.top));
}

TEST_CASE("accents, superscripts and unknown characters") {
    CHECK(
        has_glyphs("Schr\xc3\xb6"
                   "der, \xc3\x89tude, \xc2\xb5m, 10\xe2\x81\xbb\xc2\xb3, \xe2\x88\x92"
                   "1"));
    CHECK(extent_of(strokes_of("\xc3\xa9")).top < extent_of(strokes_of("e")).top);
    CHECK(extent_of(strokes_of("\xc3\x89")).top < extent_of(strokes_of("\xc3\xa9")).top);
    CHECK(text_width("\xc3\xa9", 10) == text_width("e", 10));
    CHECK(text_width("\xc2\xb2", 10) < text_width("2", 10));
    CHECK(extent_of(strokes_of("\xc2\xb2")).bottom < -3);
    CHECK_FALSE(has_glyphs("\xe4\xbc\x9a"));
    CHECK(strokes_of("\xe4\xbc\x9a").size() == 4);
    CHECK(strokes_of("\xff").size() == 4);
    CHECK(strokes_of("").empty());
    CHECK(text_width("", 10) == 0);
}

TEST_CASE("a text is cut to fit") {
    const std::string text = "a l\xc3\xb6ng title that goes on and on";
    CHECK(fitted_text(text, 10, 1e6) == text);
    for (double width = 0; width < text_width(text, 10); width += 3) {
        const std::string cut = fitted_text(text, 10, width);
        CHECK(text_width(cut, 10) <= width);
        CHECK((cut.empty() || cut.ends_with("...")));
        CHECK(has_glyphs(cut));
    }
    CHECK(fitted_text("l\xc3\xb6ngest", 10, text_width("l\xc3\xb6...", 10)) == "l\xc3\xb6...");
}
