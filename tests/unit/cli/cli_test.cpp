// Runs every tests/cli/*.txt against the command: its output, messages, exit code and files.
#include <algorithm>

#include <doctest/doctest.h>

#include "case_file.h"
#include "process.h"

namespace {

using namespace frep::test;
namespace fs = std::filesystem;

std::string place(const fs::path& file, const Section& section) {
    return file.filename().string() + ":" + std::to_string(section.line);
}

/// One `=== run` with the sections that follow it.
struct Run {
    Section head;
    std::string input, out, err;
    int exit = 0;
    std::vector<Section> files;
};

void perform(const fs::path& file, const Run& run, const fs::path& folder,
             const std::vector<std::string>& environment) {
    INFO(place(file, run.head), ": frep ", run.head.rest);
    Process process(split_words(run.head.rest), folder, run.input, environment);
    const Outcome outcome = process.wait();
    INFO("--- stdout\n", outcome.out, "--- stderr\n", outcome.err, "---");
    CHECK(outcome.exit == run.exit);
    CHECK_MESSAGE(text_matches(run.out, outcome.out), "standard output, expected:\n", run.out);
    CHECK_MESSAGE(text_matches(run.err, outcome.err), "standard error, expected:\n", run.err);
    for (const Section& section : run.files) {
        const fs::path path = folder / section.rest;
        INFO(place(file, section));
        CHECK(fs::exists(path) == (section.word == "written"));
        if (section.word != "written") continue;
        const std::string bytes = read_bytes(path);
        CHECK_MESSAGE(text_matches(section.text, bytes), section.rest, " holds:\n", bytes);
    }
}

void run_file(const fs::path& file) {
    const ScratchFolder folder;
    std::vector<std::string> environment;
    std::vector<Run> open;  // the run whose sections are being read, if any
    const auto finish = [&] {
        for (const Run& run : open) perform(file, run, folder.path(), environment);
        open.clear();
    };
    for (const Section& section : read_sections(read_bytes(file))) {
        const std::string& word = section.word;
        if (word == "run" || word == "file" || word == "bytes" || word == "env") finish();
        if (word == "note") continue;
        if (word == "run") {
            open.push_back(Run{section, {}, {}, {}, 0, {}});
        } else if (word == "file") {
            write_bytes(folder.path() / section.rest, section.text);
        } else if (word == "bytes") {
            std::string text = section.text;
            text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
            write_bytes(folder.path() / section.rest, decode_escapes(text));
        } else if (word == "env") {
            environment = split_words(section.rest);
        } else if (open.empty()) {
            FAIL(place(file, section), ": `", word, "` before a run");
        } else if (word == "stdin") {
            open.back().input = section.text;
        } else if (word == "stdout") {
            open.back().out = section.text;
        } else if (word == "stderr") {
            open.back().err = section.text;
        } else if (word == "exit") {
            open.back().exit = std::stoi(section.rest);
        } else if (word == "written" || word == "absent") {
            open.back().files.push_back(section);
        } else {
            FAIL(place(file, section), ": unknown section `", word, "`");
        }
    }
    finish();
}

}  // namespace

TEST_CASE("text files of the command") {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(FREP_SOURCE_DIR "/tests/cli"))
        if (entry.path().extension() == ".txt") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    REQUIRE(files.size() >= 8);
    for (const fs::path& file : files) run_file(file);
}

TEST_CASE("expectations") {
    CHECK(text_matches("a\n", "a\n"));
    CHECK(!text_matches("a\n", "a"));
    CHECK(!text_matches("", "a\n"));
    CHECK(!text_matches("a\n", ""));
    CHECK(text_matches("...\n", ""));
    CHECK(text_matches("a\n...\nz\n", "a\nb\nc\nz\n"));
    CHECK(!text_matches("a\n...\nz\n", "a\nb\nc\n"));
    CHECK(text_matches("a{*}c {*}\n", "abbc d\n"));
    CHECK(!text_matches("a{*}c\n", "abbc d\n"));
}
