// The text form of the command's tests (tests/cli/README.md): reading it, and comparing outputs with
// expectations that have wildcards.
#pragma once

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace frep::test {

/// `===` and a word begin a section; the text up to the next one belongs to it.
struct Section {
    std::string word, rest, text;
    int line = 0;
};

inline std::vector<Section> read_sections(const std::string& text) {
    std::vector<Section> out;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (line.starts_with("=== ")) {
            const std::string head = line.substr(4);
            const std::size_t blank = head.find(' ');
            const std::string rest = blank == std::string::npos ? "" : head.substr(blank + 1);
            out.push_back({head.substr(0, blank), rest, "", number});
        } else if (!out.empty()) {
            out.back().text += line + "\n";
        }
    }
    return out;
}

/// `\xNN`, `\r`, `\n`, `\\` decoded.
inline std::string decode_escapes(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("\\x") && rest.size() >= 4) {
            out += static_cast<char>(std::stoi(std::string(rest.substr(2, 2)), nullptr, 16));
            i += 3;
        } else if (rest.starts_with("\\r") || rest.starts_with("\\n") || rest.starts_with("\\\\")) {
            out += rest[1] == 'r' ? '\r' : rest[1] == 'n' ? '\n' : '\\';
            ++i;
        } else {
            out += text[i];
        }
    }
    return out;
}

/// Words separated by blanks; '...' keeps blanks together; escapes are decoded.
inline std::vector<std::string> split_words(const std::string& line) {
    std::vector<std::string> out;
    std::string word;
    bool quoted = false, begun = false;
    for (const char c : line + " ") {
        if (c == '\'') {
            quoted = !quoted;
            begun = true;
        } else if (c == ' ' && !quoted) {
            if (begun) out.push_back(decode_escapes(word));
            word.clear();
            begun = false;
        } else {
            word += c;
            begun = true;
        }
    }
    return out;
}

/// `{*}` in the pattern stands for any text.
inline bool line_matches(std::string_view pattern, std::string_view line) {
    const std::size_t star = pattern.find("{*}");
    if (star == std::string_view::npos) return pattern == line;
    if (!line.starts_with(pattern.substr(0, star))) return false;
    line.remove_prefix(star);
    pattern.remove_prefix(star + 3);
    for (std::size_t i = 0; i <= line.size(); ++i)
        if (line_matches(pattern, line.substr(i))) return true;
    return false;
}

inline std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> out;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        out.push_back(text.substr(0, end));
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + 1);
    }
    return out;
}

/// A line `...` in the expectation stands for any number of lines.
inline bool text_matches(const std::string& expected, const std::string& actual) {
    if (!expected.empty() && !actual.empty() && !actual.ends_with('\n') && !expected.ends_with("...\n"))
        return false;
    const auto wanted = split_lines(expected), got = split_lines(actual);
    // reachable[j]: the expectation so far matches the first j lines.
    std::vector<char> reachable(got.size() + 1, 0);
    reachable[0] = 1;
    for (const std::string_view pattern : wanted) {
        std::vector<char> next(got.size() + 1, 0);
        bool any = false;
        for (std::size_t j = 0; j <= got.size(); ++j) {
            any = any || reachable[j] != 0;
            if (pattern == "...") {
                next[j] = any ? 1 : 0;
            } else if (j > 0 && reachable[j - 1] != 0) {
                next[j] = line_matches(pattern, got[j - 1]) ? 1 : 0;
            }
        }
        reachable = next;
    }
    return reachable.back() != 0;
}

}  // namespace frep::test
