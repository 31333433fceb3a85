// docs/library.md is what the library table says.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "frep/shapes/library_page.h"

namespace {

/// The bytes of a file of the source tree; empty when there is none.
std::string read(const std::string& path) {
    std::ifstream file(FREP_SOURCE_DIR "/" + path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string example(std::string_view name) { return read("examples/library/" + std::string(name) + ".hf"); }

}  // namespace

TEST_CASE("every function has an example that calls it") {
    for (const auto& f : frep::shapes::library()) {
        CAPTURE(f.name);
        CHECK(example(f.name).find(std::string(f.name) + "(") != std::string::npos);
    }
}

TEST_CASE("docs/library.md is up to date") {
    const std::string page = frep::shapes::library_page(example);
    if (std::getenv("FREP_UPDATE_DOCS"))
        std::ofstream(FREP_SOURCE_DIR "/docs/library.md", std::ios::binary) << page;
    CHECK_MESSAGE(read("docs/library.md") == page,
                  "run the test with FREP_UPDATE_DOCS=1 and commit the page");
}

TEST_CASE("every row is described in whole sentences") {
    for (const auto& f : frep::shapes::library()) {
        CAPTURE(f.name);
        CHECK(f.doc.ends_with('.'));
        CHECK((f.note.empty() || f.note.ends_with('.')));
        CHECK_FALSE(f.formula.empty());
    }
}
