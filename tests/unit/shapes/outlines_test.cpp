// hfOutline and hfText: files by name, places and sizes, and what is reported.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

/// A sketch with files.
struct Files : Sketch {
    Files() {
        build.read_file = [](std::string_view name) -> Result<std::string> {
            if (name == "ring.svg")
                return std::string(
                    "<svg><path fill-rule='evenodd' d='M10 10h40v20h-40zM20 15h20v10h-20z'/><text/></svg>");
            if (name == "bad.svg") return std::string("<svg>\n<path d='M0 0 J'/></svg>");
            if (name == "flat.svg") return std::string("<svg><path d='M0 0h1h1'/></svg>");
            if (name == "capitals.ttf") return content_of(FREP_SOURCE_DIR "/examples/library/capitals.ttf");
            return Error{ErrorKind::io, "no such file"};
        };
        build.refuse = [this](const std::string& message) { errors.push_back(message); };
        build.left_out = [this](const std::string& message) { notes.push_back(message); };
    }
    std::vector<std::string> errors, notes;
};

}  // namespace

TEST_CASE("hfOutline") {
    Files s;
    const Expression f = s.call("hfOutline", {s.x, "ring.svg"});
    CHECK(s.errors.empty());
    REQUIRE(s.notes.size() == 1);
    CHECK(s.notes[0] == "ring.svg: not read: `text` (1 times)");
    CHECK(at(f, 30, -20, 0) == -5);  // the middle of the hole, y up
    CHECK(at(f, 15, -20, 0) == 5);
    CHECK(at(f, 10, -20, 7) == 0);
    CHECK(at(f, 0, -20, 0) == -10);
    CHECK(at(f, 30, 20, 0) < -25);

    Items center = s.list({100, 50});
    const Expression g = s.call("hfOutline", {s.x, "ring.svg", center, 40.0});  // twice as large
    CHECK(at(g, 100, 50, 0) == Approx(-10));
    CHECK(at(g, 140, 50, 0) == Approx(0));
    CHECK(at(g, 140, 71, 0) == Approx(-1));
    CHECK(gradient_at(g, 139, 50, 0).d[0] == Approx(-1));
}

TEST_CASE("hfText") {
    Files s;
    // E of capitals.ttf: a stem of 140 and bars to 460, 420, 460 of 700
    const Expression f = s.call("hfText", {s.x, "capitals.ttf", "E", 70.0});
    REQUIRE(s.errors.empty());
    CHECK(at(f, 7, 35, 0) == Approx(7));
    CHECK(at(f, 43, 35, 0) == Approx(-1));
    CHECK(at(f, 30, 21, 0) == Approx(-7));
    CHECK(at(f, 23, 72, 0) == Approx(-2));
    Items center = s.list({0, 0});
    const Expression g = s.call("hfText", {s.x, "capitals.ttf", "E", center, 7.0});
    CHECK(at(g, -2.3, 0, 0) == Approx(0));
    CHECK(at(g, 2.3, 3.5, 0) == Approx(0));
    CHECK(at(g, -2.3 + 0.7, 0, 0) == Approx(0.7));
}

TEST_CASE("what the file functions refuse") {
    Files s;
    Items center = s.list({0, 0}), short_x = {s.x[0]}, short_center = s.list({0});
    CHECK(at(s.call("hfOutline", {s.x, "bad.svg"}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfOutline", {s.x, "flat.svg"}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfText", {s.x, "ring.svg", "E", 1.0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfText", {s.x, "capitals.ttf", " ", 1.0}), 0, 0, 0) == shapes::error_value);
    REQUIRE(s.errors.size() == 4);
    CHECK(s.errors[0] == "bad.svg:2:15: expected a path command, found `J`");
    CHECK(s.errors[1] == "flat.svg: the contours enclose no area");
    CHECK(s.errors[2] == "ring.svg: not a font, or a damaged one");
    CHECK(s.errors[3] == "capitals.ttf: the text shows nothing");
    CHECK(at(s.call("hfOutline", {s.x, "none.svg"}), 0, 0, 0) == shapes::error_value);
    CHECK(s.errors.size() == 4);  // who reads has said so
    CHECK(s.warnings.empty());
    CHECK(at(s.call("hfOutline", {s.x, "ring.svg", center, 0.0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfOutline", {short_x, "ring.svg"}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfOutline", {s.x, "ring.svg", short_center, 1.0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfText", {s.x, "capitals.ttf", "E", -1.0}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 4);
    s.notes.clear();
    CHECK(at(s.call("hfText", {s.x, "capitals.ttf", "EQ", 1.0}), 0.1, 0.5, 0) > 0);
    REQUIRE(s.notes.size() == 1);
    CHECK(s.notes[0] == "capitals.ttf: the font has no glyph for U+0051 (1 times)");
}
