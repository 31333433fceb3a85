// Walks tests/lang/*.hf: every file says in comments what parse() must find in it, exactly:
//     -- expect error HF012 at 3:7
//     -- expect ok
#include <filesystem>

#include <doctest/doctest.h>

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

}  // namespace

TEST_CASE("the files of tests/lang give exactly what they say") {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(FREP_SOURCE_DIR "/tests/lang"))
        if (entry.path().extension() == ".hf") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    CHECK(files.size() >= 60);
    for (const std::string& file : files) {
        CAPTURE(file);
        const std::string text = read_file(file);
        std::vector<std::string> expected = expectations(text);
        CHECK(!expected.empty());
        if (expected == std::vector<std::string>{"ok"}) expected.clear();
        CHECK(findings(text) == expected);
    }
}
