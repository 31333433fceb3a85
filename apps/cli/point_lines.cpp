// Implementation of point_lines.h.
#include "point_lines.h"

#include <fmt/format.h>

#include "frep/frep.h"
#include "values.h"

namespace frep::cli {

namespace {

constexpr std::size_t line_limit = std::size_t{1} << 16;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// Walks along one line.
class Cursor {
  public:
    Cursor(std::string_view line, LineContent& out) : line_(line), rest_(line), out_(out) {}

    void skip_blanks() {
        while (!rest_.empty() && is_blank(rest_[0])) rest_.remove_prefix(1);
    }
    bool at_end() const { return rest_.empty(); }
    bool take_comma() {
        if (!rest_.starts_with(',')) return false;
        rest_.remove_prefix(1);
        return true;
    }
    bool at_blank() const { return !rest_.empty() && is_blank(rest_[0]); }

    /// Takes a number; it must end at a blank, a comma or the end.
    bool take_number() {
        const std::string_view start = rest_;
        double value = 0;
        if (cli::take_number(rest_, value) && (rest_.empty() || is_blank(rest_[0]) || rest_[0] == ',')) {
            out_.numbers.push_back(value);
            return true;
        }
        rest_ = start;
        const std::string word = next_word();
        return word.empty() ? fail("a number is missing") : fail(fmt::format("`{}` is not a number", word));
    }

    bool fail(std::string message) {
        out_.error = std::move(message);
        out_.column = 1;
        for (const char c : line_.substr(0, line_.size() - rest_.size()))
            if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) ++out_.column;
        return false;
    }
    std::string next_word() const {
        std::size_t length = 0;
        while (length < rest_.size() && !is_blank(rest_[length]) && rest_[length] != ',') ++length;
        const std::string word = to_valid_utf8(rest_.substr(0, length < 40 ? length : 40));
        return length > 40 ? word + "..." : word;
    }

  private:
    std::string_view line_, rest_;
    LineContent& out_;
};

/// Clears `out`; true when the line holds something to read.
bool begin(std::string_view line, Cursor& cursor, LineContent& out) {
    out.numbers.clear();
    out.error.clear();
    if (line.size() > line_limit) return cursor.fail(fmt::format("more than {} bytes in a line", line_limit));
    cursor.skip_blanks();
    out.is_blank = cursor.at_end();
    out.is_comment = cursor.next_word().starts_with('#');
    return !out.is_blank && !out.is_comment;
}

}  // namespace

void parse_point(std::string_view line, LineContent& out) {
    Cursor cursor(line, out);
    if (!begin(line, cursor, out)) return;
    while (true) {
        if (!cursor.take_number()) return;
        cursor.skip_blanks();
        if (cursor.at_end()) return;
        if (cursor.take_comma()) cursor.skip_blanks();
    }
}

void parse_box(std::string_view line, LineContent& out) {
    Cursor cursor(line, out);
    if (!begin(line, cursor, out)) return;
    while (!cursor.at_end()) {
        if (!cursor.take_number()) return;
        cursor.skip_blanks();
        if (!cursor.take_comma()) {
            cursor.fail("an interval is lo,hi: a comma is missing");
            return;
        }
        cursor.skip_blanks();
        if (!cursor.take_number()) return;
        const std::size_t n = out.numbers.size();
        if (out.numbers[n - 2] > out.numbers[n - 1]) {
            cursor.fail(fmt::format("the interval {},{} ends before it begins",
                                    number_text(out.numbers[n - 2]), number_text(out.numbers[n - 1])));
            return;
        }
        if (!cursor.at_end() && !cursor.at_blank()) {
            cursor.fail("intervals are separated by blanks");
            return;
        }
        cursor.skip_blanks();
    }
}

}  // namespace frep::cli
