#include "frep/lang/annotations.h"

#include <doctest/doctest.h>

#include "lang_test.h"

using namespace frep::lang;
using namespace frep::lang::test;

namespace {

constexpr std::string_view object = "my_model(x[3], a[2])\n{\n  my_model = a[1];\n}\n";

Parse annotated(std::string_view lines) {
    return parse_text(std::string(lines) + "\n" + std::string(object));
}

}  // namespace

TEST_CASE("all keys") {
    const Parse parse = annotated(
        "--@ title    Lacquered sake pot  \n--@ Author  A. Maker\n--@ license CC0-1.0\n--@ source measured\n"
        "--@ units mm\n--@ bounds -60 60, -60,60  0 9e1\n--@ color 0.55 +0.04 0\n"
        "--@ param a[1] height 40..90 default 64 \"Height of the body\"\n--@param A[2] r_2 -1 .. 1.5");
    CHECK(findings(parse) == std::vector<std::string>{});
    const Annotations& found = parse.program.annotations;
    CHECK(found.title == "Lacquered sake pot");
    CHECK(found.author == "A. Maker");
    CHECK(found.license == "CC0-1.0");
    CHECK(found.source == "measured");
    CHECK(found.units == "mm");
    CHECK(found.bounds == std::vector<double>{-60, 60, -60, 60, 0, 90});
    CHECK(found.color == std::vector<double>{0.55, 0.04, 0});
    CHECK(found.dialect == 2);
    REQUIRE(found.parameters.size() == 2);
    const ParameterAnnotation& height = found.parameters[0];
    CHECK(height.index == 1);
    CHECK(height.name == "height");
    CHECK(height.has_range);
    CHECK(height.low == 40);
    CHECK(height.high == 90);
    CHECK(height.has_default);
    CHECK(height.value == 64);
    CHECK(height.description == "Height of the body");
    CHECK(parse.source.text(height.span).starts_with("a[1]"));
    CHECK(found.parameters[1].low == -1);
    CHECK(found.parameters[1].high == 1.5);
    CHECK(!found.parameters[1].has_default);
}

TEST_CASE("parts of a parameter may be left out") {
    const Parse parse = annotated("--@ param a[1] u default -2\n--@ param a[2] v \"only a text\"");
    CHECK(findings(parse) == std::vector<std::string>{});
    REQUIRE(parse.program.annotations.parameters.size() == 2);
    CHECK(parse.program.annotations.parameters[0].value == -2);
    CHECK(!parse.program.annotations.parameters[0].has_range);
    CHECK(parse.program.annotations.parameters[1].description == "only a text");
}

TEST_CASE("a wrong line leaves nothing behind") {
    const Parse parse = annotated(
        "--@ bounds 1 2 3\n--@ color 1 1 2\n--@ param a[1] u 9..1\n--@ param a[3] w\n--@ bounds 0 nan 0 1 0 "
        "1\n"
        "--@ param a[1] u 1..inf\n--@ param a[1] u \"open");
    CHECK(parse.program.annotations.bounds.empty());
    CHECK(parse.program.annotations.color.empty());
    CHECK(parse.program.annotations.parameters.empty());
    CHECK(!parse.diagnostics.has_errors());
    CHECK(parse.diagnostics.list().size() == 7);
}

TEST_CASE("the look of a model in pictures") {
    const Parse parse = annotated("--@ material Lacquer\n--@ view -30, 12.5");
    CHECK(findings(parse) == std::vector<std::string>{});
    CHECK(parse.program.annotations.material == "lacquer");
    CHECK(parse.program.annotations.view == std::vector<double>{-30, 12.5});
    const Parse wrong = annotated("--@ material red lacquer\n--@ view 30\n--@ view 0 91");
    CHECK(wrong.program.annotations.material.empty());
    CHECK(wrong.program.annotations.view.empty());
    CHECK(wrong.diagnostics.list().size() == 3);
}

TEST_CASE("the first of two lines counts") {
    const Parse parse =
        annotated("--@ title one\n--@ title two\n--@ param a[1] u\n--@ param a[1] v\n--@ param a[2] U");
    CHECK(parse.program.annotations.title == "one");
    CHECK(parse.program.annotations.parameters.size() == 1);
    CHECK(findings(parse) ==
          std::vector<std::string>{"warning HF085 at 2:5", "warning HF085 at 4:11", "warning HF085 at 5:16"});
}

TEST_CASE("annotations concern my_model, or the first object") {
    const std::string small = "b(x[2], a[1])\n{\n  b = 1;\n}\n";
    CHECK(findings("--@ param a[2] u\n--@ bounds 0 1 0 1 0 1\n" + small + std::string(object)).empty());
    CHECK(findings("--@ param a[2] u\n--@ bounds 0 1 0 1\n" + small) ==
          std::vector<std::string>{"warning HF084 at 1:11"});
}

TEST_CASE("the dialect") {
    const Parse parse = annotated("--@ hyperfun 3");
    CHECK(parse.program.annotations.dialect == 3);
    CHECK(findings(parse) == std::vector<std::string>{"warning HF087 at 1:14"});
    CHECK(annotated("--@ hyperfun 2").diagnostics.empty());
    CHECK(annotated("\n--@ hyperfun 3").program.annotations.dialect == 2);
    CHECK(annotated("\xEF\xBB\xBF--@ hyperfun 3").program.annotations.dialect == 3);
}

TEST_CASE("a title may hold anything but the end of its line") {
    const Parse parse = annotated("--@ title \xE5\xBD\xA2 \x1b[2J -- @ \"");
    CHECK(parse.diagnostics.empty());
    CHECK(parse.program.annotations.title == "\xE5\xBD\xA2 \x1b[2J -- @ \"");
}
