// Runs the parser over the conformance cases of the old interpreter (tests/conformance/language): what must
// be refused is refused in the right line, what has a value is accepted.
#include <fstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "lang_test.h"

using namespace frep;
using namespace frep::lang::test;

namespace {

/// Line numbers of the old tool's messages: "line 2 pos 1: ...".
std::vector<unsigned> old_lines(const nlohmann::json& one) {
    std::vector<unsigned> lines;
    for (const char* key : {"parse_errors"})
        if (one.contains(key))
            for (const std::string message : one[key])
                lines.push_back(static_cast<unsigned>(std::stoul(message.substr(message.find(' ') + 1))));
    return lines;
}

bool is_index_finding(const Parse& parse) {
    for (const Diagnostic& d : parse.diagnostics.list())
        if (d.severity == Severity::error && d.code != "HF042") return false;
    return true;
}

}  // namespace

TEST_CASE("conformance cases parse as the old interpreter did, or as section 0 repairs it") {
    std::ifstream file(FREP_SOURCE_DIR "/tests/conformance/language/cases.jsonl");
    REQUIRE(file.good());
    int count = 0;
    for (std::string line; std::getline(file, line); ++count) {
        const auto one = nlohmann::json::parse(line);
        const std::string text = one["src"];
        const std::string expect = one["expect"];
        CAPTURE(text);
        const Parse parse = parse_text(text);
        if (expect == "value") CHECK(!parse.diagnostics.has_errors());
        // Also fits: refused at that place, because the value can never exist.
        if (expect == "undefined") CHECK(is_index_finding(parse));
        if (expect != "error") continue;
        CHECK(parse.diagnostics.has_errors());
        const auto lines = old_lines(one);
        const auto first = std::find_if(parse.diagnostics.list().begin(), parse.diagnostics.list().end(),
                                        [](const auto& d) { return d.severity == Severity::error; });
        if (lines.empty() || first == parse.diagnostics.list().end()) continue;
        // The old place may be the end of the file, ours is then the line of the construct.
        const unsigned ours = parse.source.locate(first->span.begin).line;
        CHECK(ours <= lines.front());
        CHECK(ours + 1 >= lines.front());
    }
    CHECK(count >= 170);
}
