// The printed shape of diagnostics and the search for near names.
#include <doctest/doctest.h>

#include "frep/base/diagnostic.h"

using namespace frep;

namespace {

std::string rendered(const std::string& text, Diagnostic diagnostic, RenderOptions options = {}) {
    const Source source("pot.hf", text);
    Diagnostics list;
    list.add(std::move(diagnostic));
    return render(list, source, options);
}

}  // namespace

TEST_CASE("a diagnostic has code, place, source line, caret and help") {
    const std::string out = rendered(
        "a;\n  b = sqr(2);\n",
        {Severity::error, "HF012", "unknown name `sqr`", {9, 12}, "not found here", "did you mean `sqrt`?"});
    CHECK(out ==
          "error[HF012]: unknown name `sqr`\n"
          " --> pot.hf:2:7\n"
          "  |\n"
          "2 |   b = sqr(2);\n"
          "  |       ^^^ not found here\n"
          "  = help: did you mean `sqrt`?\n\n");
}

TEST_CASE("a message without a code has no brackets") {
    CHECK(rendered("x", {Severity::warning, "", "m", {0, 1}, "", ""}).starts_with("warning: m\n"));
}

TEST_CASE("a place at the end of the file is shown") {
    CHECK(rendered("ab", {Severity::error, "HF001", "m", {2, 2}, "here", ""}).find("  |   ^ here\n") !=
          std::string::npos);
}

TEST_CASE("long lines are clipped around the caret") {
    std::string line(5000, 'x');
    line[3000] = 'Y';
    const std::string out = rendered(line, {Severity::error, "HF001", "m", {3000, 3001}, "", ""});
    CHECK(out.size() < 600);
    CHECK(out.find('Y') != std::string::npos);
}

TEST_CASE("a flood is cut and counted") {
    const Source source("m", "x");
    Diagnostics list;
    for (int i = 0; i < 25; ++i) list.add({Severity::error, "HF001", "m", {0, 1}, "", ""});
    CHECK(render(list, source, {}).ends_with("... and 5 more\n"));
    CHECK(list.error_count() == 25);
}

TEST_CASE("near names are found, far ones are not") {
    CHECK(nearest_name("hfSpere", {"hfBlock", "hfSphere"}) == "hfSphere");
    CHECK(nearest_name("HFSHPERE", {"hfBlock", "hfSphere"}) == "hfSphere");
    CHECK(nearest_name("teapot", {"hfBlock", "hfSphere"}).empty());
}
