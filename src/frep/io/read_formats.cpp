// Implementation of read_formats.h.
#include "frep/io/read_formats.h"

#include <fmt/format.h>

#include <limits>

#include "frep/base/source.h"

namespace frep::reading {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

/// True when a number that leaves the range does so at the large end: by its decimal exponent.
bool is_large(std::string_view digits) {
    std::int64_t magnitude = 0;  // places before the point of the first digit that is not 0
    bool point = false, found = false;
    std::size_t i = 0;
    for (; i < digits.size() && (is_digit(digits[i]) || digits[i] == '.'); ++i) {
        if (digits[i] == '.') {
            point = true;
        } else if (found || digits[i] != '0') {
            found = true;
            if (!point) ++magnitude;
        } else if (point) {
            --magnitude;
        }
    }
    if (i + 1 >= digits.size()) return magnitude > 0;
    const std::string_view exponent = digits.substr(i + 1);
    const std::optional<std::int64_t> value = parse_integer(exponent);
    if (!value || *value > 1'000'000'000 || *value < -1'000'000'000) return exponent.front() != '-';
    return magnitude + *value > 0;
}

}  // namespace

Error malformed_line(std::size_t line, std::string_view message) {
    return {ErrorKind::io, fmt::format("line {}: {}", line, message)};
}

Error malformed_byte(std::size_t offset, std::string_view message) {
    return {ErrorKind::io, fmt::format("byte {}: {}", offset, message)};
}

std::string quoted(std::string_view text) {
    const bool clipped = text.size() > 40;
    return fmt::format("`{}{}`", to_valid_utf8(text.substr(0, 40)), clipped ? "..." : "");
}

std::string object_name(std::string_view text) { return to_valid_utf8(trimmed(text).substr(0, 200)); }

void note_dropped(ReadReport& report, std::size_t count, std::string_view what) {
    if (count == 0) return;
    report.dropped.push_back(fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"));
}

void scale_colors(std::vector<Color>& colors) {
    bool bytes = false;
    for (const Color& c : colors) bytes = bytes || c.r > 1 || c.g > 1 || c.b > 1;
    const auto component = [bytes](double value) {
        const double scaled = bytes ? value / 255 : value;
        return scaled > 0 ? (scaled < 1 ? scaled : 1.0) : 0.0;
    };
    for (Color& c : colors) c = {component(c.r), component(c.g), component(c.b)};
}

template <class Number>
std::optional<Number> parse_number(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    Number value = 0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end.ptr != word.data() + word.size() || end.ec == std::errc::invalid_argument) return std::nullopt;
    if (end.ec == std::errc()) return value;
    const bool negative = word[0] == '-';
    if (!is_large(word.substr(negative ? 1 : 0))) return Number{0};
    return negative ? -std::numeric_limits<Number>::infinity() : std::numeric_limits<Number>::infinity();
}

template std::optional<double> parse_number<double>(std::string_view);
template std::optional<float> parse_number<float>(std::string_view);

std::size_t Words::line_end_length(std::size_t at) const {
    if (at >= text_.size()) return 0;
    if (text_[at] == '\r') return at + 1 < text_.size() && text_[at + 1] == '\n' ? 2 : 1;
    return text_[at] == '\n' ? 1 : 0;
}

void Words::skip_line_end() {
    at_ += line_end_length(at_);
    ++line_;
}

void Words::skip_blanks() {
    while (at_ < text_.size()) {
        if (is_blank(text_[at_])) {
            ++at_;
        } else if (continued_ && text_[at_] == '\\' && line_end_length(at_ + 1) > 0) {
            ++at_;
            skip_line_end();
        } else if (comments_ && text_[at_] == '#') {
            while (!at_line_end()) ++at_;
        } else {
            return;
        }
    }
}

bool Words::next_in_line(std::string_view& word) {
    skip_blanks();
    if (at_line_end()) return false;
    const std::size_t begin = at_;
    while (!at_line_end() && !is_blank(text_[at_]) && !(comments_ && text_[at_] == '#') &&
           !(continued_ && text_[at_] == '\\' && line_end_length(at_ + 1) > 0))
        ++at_;
    word = text_.substr(begin, at_ - begin);
    return true;
}

bool Words::next(std::string_view& word) {
    while (!next_in_line(word)) {
        if (at_ >= text_.size()) return false;
        skip_line_end();
    }
    return true;
}

std::string_view Words::rest_of_line() {
    const std::size_t begin = at_;
    while (!at_line_end()) ++at_;
    return trimmed(text_.substr(begin, at_ - begin));
}

bool Words::next_line() {
    std::string_view word;
    while (next_in_line(word)) {
    }
    if (at_ >= text_.size()) return false;
    skip_line_end();
    return true;
}

}  // namespace frep::reading
