// The examples in the documentation: every block marked ```hyperfun of README.md and docs/ compiles without a
// diagnostic; one marked ```hyperfun HF012 gives just that code. The C++ example of README.md is a test of
// its own (test.cmake).
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "frep/frep.h"
#include "support/evaluate.h"

using namespace frep;

namespace {

struct Example {
    std::string place;
    std::string code;  ///< expected diagnostic, or empty
    std::string text;
};

/// The fenced blocks of a page whose first word is `hyperfun`.
std::vector<Example> examples_of(const std::filesystem::path& path) {
    const std::string page = test::read_text(path.string());
    std::vector<Example> out;
    const std::string fence = "\n```hyperfun";
    for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
        const std::size_t line_end = page.find('\n', at + 1);
        const std::size_t end = page.find("\n```", line_end);
        REQUIRE(end != std::string::npos);
        std::string code = page.substr(at + fence.size(), line_end - at - fence.size());
        code.erase(std::remove(code.begin(), code.end(), ' '), code.end());
        const auto line = std::count(page.begin(), page.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 2;
        out.push_back({path.filename().string() + ":" + std::to_string(line), code,
                       page.substr(line_end + 1, end - line_end)});
        at = end;
    }
    return out;
}

void check_example(const Example& example) {
    CAPTURE(example.place);
    const Model model(Source(example.place, example.text));
    Diagnostics found = model.diagnostics();
    if (model.ok()) {
        const auto object = model.find_object("");
        REQUIRE(object);
        Diagnostics of_lowering;
        CHECK(model.lower(*object, model.complete_parameters(*object, {}), of_lowering).has_value());
        found.append(of_lowering);
    }
    std::set<std::string> codes;
    for (const Diagnostic& diagnostic : found.list())
        if (diagnostic.severity != Severity::note) codes.insert(diagnostic.code);
    INFO(render(found, model.source()));
    if (example.code.empty())
        CHECK(codes.empty());
    else
        CHECK(codes == std::set<std::string>{example.code});
}

}  // namespace

TEST_CASE("the HyperFun examples of the documentation compile") {
    const std::filesystem::path root = FREP_SOURCE_DIR;
    std::vector<std::filesystem::path> pages{root / "README.md", root / "CONTRIBUTING.md"};
    for (const auto& entry : std::filesystem::directory_iterator(root / "docs"))
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    std::sort(pages.begin(), pages.end());
    std::size_t count = 0;
    for (const auto& page : pages) {
        for (const Example& example : examples_of(page)) {
            check_example(example);
            ++count;
        }
    }
    CHECK(count >= 9);
}

TEST_CASE("links between the pages lead somewhere") {
    const std::filesystem::path root = FREP_SOURCE_DIR;
    std::vector<std::filesystem::path> pages{root / "README.md", root / "CONTRIBUTING.md"};
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "docs"))
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    for (const auto& page : pages) {
        const std::string text = test::read_text(page.string());
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
            std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
            target = target.substr(0, target.find('#'));
            if (target.empty() || target.find(':') != std::string::npos) continue;
            INFO(page.string(), ": ", target);
            CHECK(std::filesystem::exists(page.parent_path() / target));
        }
    }
}
