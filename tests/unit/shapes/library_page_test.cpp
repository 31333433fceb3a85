// docs/library.md is what the library table says.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "frep/shapes/library_page.h"

TEST_CASE("docs/library.md is up to date") {
    const std::string path = FREP_SOURCE_DIR "/docs/library.md";
    const std::string page = frep::shapes::library_page();
    if (std::getenv("FREP_UPDATE_DOCS")) std::ofstream(path, std::ios::binary) << page;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    CHECK_MESSAGE(text.str() == page, "run the test with FREP_UPDATE_DOCS=1 and commit the page");
}

TEST_CASE("every row is described in whole sentences") {
    for (const auto& f : frep::shapes::library()) {
        CAPTURE(f.name);
        CHECK(f.doc.ends_with('.'));
        CHECK((f.note.empty() || f.note.ends_with('.')));
        CHECK_FALSE(f.formula.empty());
    }
}
