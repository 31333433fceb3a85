// Path data, transforms and lengths of SVG. See svg_data.h.
#include "frep/io/svg_data.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "frep/io/read_formats.h"
#include "frep/math/functions.h"
#include "frep/math/number.h"

namespace frep::reading {

namespace {

constexpr double degree = 3.14159265358979323846 / 180;
/// Larger coordinates are refused: they would leave no place for the drawing's detail.
constexpr double most_coordinate = 1e9;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Reads numbers, flags and words one after another.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    bool at_end() {
        skip_blanks();
        return at_ >= text_.size();
    }
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void advance() { ++at_; }
    std::size_t offset() const { return at_; }

    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }
    /// Blanks with at most one comma among them.
    void skip_comma() {
        skip_blanks();
        if (peek() != ',') return;
        ++at_;
        skip_blanks();
    }

    /// sign? (digits (. digits?)? | . digits) (e sign? digits)?: no "inf", no "0x".
    bool number(double& value) {
        std::size_t end = at_;
        const auto sign = [&] {
            if (end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
        };
        const auto digits = [&] {
            const std::size_t begin = end;
            while (end < text_.size() && is_digit(text_[end])) ++end;
            return end - begin;
        };
        sign();
        std::size_t count = digits();
        if (end < text_.size() && text_[end] == '.') {
            ++end;
            count += digits();
        }
        if (count == 0) return false;
        if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
            const std::size_t mantissa = end++;
            sign();
            if (digits() == 0) end = mantissa;  // "2em" is 2 with the unit em
        }
        const auto read = parse_number<double>(text_.substr(at_, end - at_));
        if (!read || !(std::fabs(*read) <= most_coordinate)) return false;
        value = *read;
        at_ = end;
        return true;
    }

    /// 0 or 1; the next number may follow at once.
    bool flag(bool& value) {
        if (peek() != '0' && peek() != '1') return false;
        value = text_[at_++] == '1';
        return true;
    }

    std::string_view word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    DataError error(std::string_view expected) const {
        if (at_ >= text_.size()) return {at_, fmt::format("expected {}, found the end", expected)};
        std::size_t end = at_ + 1;
        while (end < text_.size() && end < at_ + 20 && !is_blank(text_[end]) && text_[end] != ',') ++end;
        return {at_, fmt::format("expected {}, found {}", expected, quoted(text_.substr(at_, end - at_)))};
    }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
};

class PathReader {
  public:
    PathReader(std::string_view data, CurveWriter& out) : scan_(data), out_(out) {}

    std::optional<DataError> read() {
        while (!scan_.at_end()) {
            const char letter = scan_.peek();
            if (!is_letter(letter) ||
                std::string_view("MmLlHhVvCcSsQqTtAaZz").find(letter) == std::string_view::npos)
                return scan_.error("a path command");
            if (!begun_ && letter != 'M' && letter != 'm') return scan_.error("`M`, as every path begins");
            scan_.advance();
            if (const auto error = command(letter)) return error;
        }
        return std::nullopt;
    }

  private:
    std::optional<DataError> command(char letter) {
        const bool relative = letter >= 'a';
        char kind = relative ? static_cast<char>(letter - 'a' + 'A') : letter;
        if (kind == 'Z') {
            close();
            return std::nullopt;
        }
        do {
            scan_.skip_blanks();
            if (const auto error = step(kind, relative)) return error;
            if (kind == 'M') kind = 'L';  // further pairs are lines
            before_ = kind;
            scan_.skip_comma();
        } while (scan_.peek() == '.' || scan_.peek() == '-' || scan_.peek() == '+' || is_digit(scan_.peek()));
        return std::nullopt;
    }

    void close() {
        out_.close();
        at_ = start_;
        closed_ = true;
        before_ = 'Z';
    }

    bool point(Vec2& p, bool relative) {
        scan_.skip_comma();
        if (!scan_.number(p.x)) return false;
        scan_.skip_comma();
        if (!scan_.number(p.y)) return false;
        if (relative) p = at_ + p;
        return true;
    }

    /// One set of numbers of a command.
    std::optional<DataError> step(char kind, bool relative) {
        const auto number_error = [&] { return scan_.error("a number"); };
        if (kind == 'M') {
            Vec2 p;
            if (!point(p, relative)) return number_error();
            out_.move(p);
            at_ = start_ = p;
            begun_ = true;
            closed_ = false;
            return std::nullopt;
        }
        if (closed_) {  // goes on from where the closed contour began
            out_.move(start_);
            closed_ = false;
        }
        if (kind == 'H' || kind == 'V') return straight(kind, relative);
        if (kind == 'A') return arc(relative);
        Vec2 c1 = at_, c2, p;
        const bool smooth_cubic = kind == 'S', smooth_quadratic = kind == 'T';
        if (kind == 'C' && !point(c1, relative)) return number_error();
        if (smooth_cubic && (before_ == 'C' || before_ == 'S')) c1 = at_ * 2.0 - handle_;
        if (smooth_quadratic && (before_ == 'Q' || before_ == 'T')) c1 = at_ * 2.0 - handle_;
        if (kind == 'Q' && !point(c1, relative)) return number_error();
        if ((kind == 'C' || kind == 'S') && !point(c2, relative)) return number_error();
        if (!point(p, relative)) return number_error();
        if (kind == 'L') {
            out_.line(p);
        } else if (kind == 'Q' || kind == 'T') {
            out_.quadratic(c1, p);
            handle_ = c1;
        } else {
            out_.cubic(c1, c2, p);
            handle_ = c2;
        }
        at_ = p;
        return std::nullopt;
    }

    std::optional<DataError> straight(char kind, bool relative) {
        double value;
        if (!scan_.number(value)) return scan_.error("a number");
        Vec2 p = at_;
        double& moved = kind == 'H' ? p.x : p.y;
        moved = relative ? moved + value : value;
        out_.line(p);
        at_ = p;
        return std::nullopt;
    }

    std::optional<DataError> arc(bool relative) {
        ArcShape shape{};
        for (double* value : {&shape.rx, &shape.ry, &shape.turn}) {
            scan_.skip_comma();
            if (!scan_.number(*value)) return scan_.error("a number");
        }
        for (bool* flag : {&shape.large, &shape.sweep}) {
            scan_.skip_comma();
            if (!scan_.flag(*flag)) return scan_.error("a flag, 0 or 1");
        }
        Vec2 p;
        if (!point(p, relative)) return scan_.error("a number");
        out_.arc(shape, p);
        at_ = p;
        return std::nullopt;
    }

    Scanner scan_;
    CurveWriter& out_;
    Vec2 at_, start_, handle_;
    char before_ = 'M';
    bool begun_ = false, closed_ = false;
};

/// The map of a transform's name and numbers; nothing when the numbers do not fit.
std::optional<Affine> map_of(std::string_view name, const std::vector<double>& v) {
    const std::size_t n = v.size();
    if (name == "matrix" && n == 6) return Affine{v[0], v[1], v[2], v[3], v[4], v[5]};
    if (name == "translate" && (n == 1 || n == 2)) return Affine{1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
    if (name == "scale" && (n == 1 || n == 2)) return Affine{v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
    if (name == "rotate" && (n == 1 || n == 3)) {
        const double angle = std::fmod(v[0], 360.0) * degree, c = math::cos(angle), s = math::sin(angle);
        const Affine turn{c, s, -s, c, 0, 0};
        if (n == 1) return turn;
        return Affine{1, 0, 0, 1, v[1], v[2]} * turn * Affine{1, 0, 0, 1, -v[1], -v[2]};
    }
    if (name == "skewX" && n == 1) return Affine{1, 0, math::tan(v[0] * degree), 1, 0, 0};
    if (name == "skewY" && n == 1) return Affine{1, math::tan(v[0] * degree), 0, 1, 0, 0};
    return std::nullopt;
}

}  // namespace

std::optional<DataError> draw_path(std::string_view data, CurveWriter& out) {
    return PathReader(data, out).read();
}

std::optional<DataError> parse_transform(std::string_view text, Affine& out) {
    constexpr std::size_t most_numbers = 6;
    out = {};
    Scanner scan(text);
    while (!scan.at_end()) {
        const std::size_t begin = scan.offset();
        const std::string_view name = scan.word();
        scan.skip_blanks();
        if (name.empty()) return scan.error("a transform such as `translate(1 2)`");
        if (scan.peek() != '(') return scan.error("`(`");
        scan.advance();
        scan.skip_blanks();
        std::vector<double> numbers;
        while (scan.peek() != ')') {
            double value;
            if (numbers.size() == most_numbers || !scan.number(value)) return scan.error("a number or `)`");
            numbers.push_back(value);
            scan.skip_comma();
        }
        scan.advance();
        const auto map = map_of(name, numbers);
        if (!map)
            return DataError{begin,
                             fmt::format("no transform {} of {} numbers", quoted(name), numbers.size())};
        out = out * *map;
        scan.skip_comma();
    }
    return std::nullopt;
}

std::optional<DataError> parse_numbers(std::string_view text, std::vector<double>& out) {
    Scanner scan(text);
    while (!scan.at_end()) {
        double value;
        if (!scan.number(value)) return scan.error("a number");
        out.push_back(value);
        scan.skip_comma();
    }
    return std::nullopt;
}

std::optional<SvgLength> parse_length(std::string_view text) {
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    Scanner scan(text);
    scan.skip_blanks();
    SvgLength length;
    if (!scan.number(length.number)) return std::nullopt;
    length.unit = text.substr(scan.offset());
    return length;
}

std::optional<double> millimetres(std::string_view unit) {
    constexpr double inch = 25.4;
    if (unit == "mm") return 1.0;
    if (unit == "cm") return 10.0;
    if (unit == "Q") return 0.25;
    if (unit == "in") return inch;
    if (unit == "pt") return inch / 72;
    if (unit == "pc") return inch / 6;
    if (unit == "px") return inch / 96;
    return std::nullopt;
}

}  // namespace frep::reading
