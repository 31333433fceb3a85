// Walks tests/lang/*.hf: every file says in comments what parse() must find in it, exactly:
//     -- expect error HF012 at 3:7
//     -- expect ok
// and tests/lang/lowered/*.hf, which say what lowering finds.
#include <filesystem>

#include <doctest/doctest.h>

#include "frep/lang/model.h"
#include "lang_test.h"

using namespace frep::lang::test;

namespace {

std::vector<std::string> expectations(std::string_view text) {
    constexpr std::string_view mark = "-- expect ";
    std::vector<std::string> list;
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at)) {
        at += mark.size();
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        list.emplace_back(text.substr(at, end - at));
    }
    return list;
}

/// The files of a folder with what they say and what `find` gives.
template <class Find>
void compare_files(const std::string& folder, std::size_t at_least, Find find) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(FREP_SOURCE_DIR "/tests/lang" + folder))
        if (entry.path().extension() == ".hf") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    CHECK(files.size() >= at_least);
    for (const std::string& file : files) {
        CAPTURE(file);
        const std::string text = read_file(file);
        std::vector<std::string> expected = expectations(text);
        CHECK(!expected.empty());
        if (expected == std::vector<std::string>{"ok"}) expected.clear();
        CHECK(find(text) == expected);
    }
}

}  // namespace

TEST_CASE("the files of tests/lang give exactly what they say") {
    compare_files("", 60, [](const std::string& text) { return findings(text); });
}

TEST_CASE("the files of tests/lang/lowered give exactly what they say") {
    compare_files("/lowered", 10, [](const std::string& text) {
        const frep::Model model(frep::Source("test.hf", text));
        REQUIRE(model.ok());
        Parse out{frep::Source("test.hf", text), {}, {}};
        const bool whole = model.lower(*model.find_object({}), {}, out.diagnostics).has_value();
        CHECK(whole != out.diagnostics.has_errors());
        return findings(out);
    });
}
