// Tokens of HyperFun text; see lexer.h. Tested by tests/unit/lang/lexer_test.cpp.
#include "frep/lang/lexer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "frep/lang/report.h"

namespace frep::lang {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) { return is_letter(c) || is_digit(c) || c == '_'; }
bool is_newline(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || is_newline(c); }

struct Keyword {
    std::string_view word;
    TokenKind kind;
};

constexpr std::array<Keyword, 12> keywords{{{"array", TokenKind::key_array},
                                            {"if", TokenKind::key_if},
                                            {"then", TokenKind::key_then},
                                            {"else", TokenKind::key_else},
                                            {"endif", TokenKind::key_endif},
                                            {"while", TokenKind::key_while},
                                            {"loop", TokenKind::key_loop},
                                            {"endloop", TokenKind::key_endloop},
                                            {"and", TokenKind::key_and},
                                            {"or", TokenKind::key_or},
                                            {"not", TokenKind::key_not},
                                            {"xor", TokenKind::key_xor}}};

TokenKind keyword_kind(std::string_view word) {
    if (word.size() < 2 || word.size() > 7) return TokenKind::identifier;
    const std::string lower = lower_case(word);
    for (const Keyword& keyword : keywords)
        if (keyword.word == lower) return keyword.kind;
    return TokenKind::identifier;
}

/// Marks of other languages, what to write here, and the token that goes on in their place.
struct Foreign {
    std::string_view mark;
    TokenKind stands_for;
    std::string_view help;
};

constexpr std::array<Foreign, 11> foreign_marks{{
    {"==", TokenKind::equal, "`=` compares (in conditions) and assigns; there is no `==`"},
    {"!=", TokenKind::not_equal, "write `/=` for \"not equal\""},
    {"<>", TokenKind::not_equal, "write `/=` for \"not equal\""},
    {"=<", TokenKind::less_equal, "write `<=`"},
    {"=>", TokenKind::greater_equal, "write `>=`"},
    {":=", TokenKind::equal, "an assignment is written with `=`"},
    {"&&", TokenKind::key_and, "in a condition write `and`; the intersection of two solids is `&`"},
    {"||", TokenKind::key_or, "in a condition write `or`; the union of two solids is `|`"},
    {"**", TokenKind::caret, "a power is written with `^`"},
    {"!", TokenKind::key_not, "in a condition write `not`; the complement of a solid is `~`"},
    {"%", TokenKind::invalid, "the remainder is `mod(a, b)`; a comment begins with `--`"},
}};

constexpr std::array<std::string_view, 41> kind_names{"the end of the file",
                                                      "a wrong character",
                                                      "a name",
                                                      "a number",
                                                      "a text",
                                                      "`+`",
                                                      "`-`",
                                                      "`*`",
                                                      "`/`",
                                                      "`^`",
                                                      "`~`",
                                                      "`|`",
                                                      "`&`",
                                                      "`\\`",
                                                      "`@`",
                                                      "`=`",
                                                      "`/=`",
                                                      "`<`",
                                                      "`<=`",
                                                      "`>`",
                                                      "`>=`",
                                                      "`(`",
                                                      "`)`",
                                                      "`[`",
                                                      "`]`",
                                                      "`{`",
                                                      "`}`",
                                                      "`,`",
                                                      "`;`",
                                                      "`array`",
                                                      "`if`",
                                                      "`then`",
                                                      "`else`",
                                                      "`endif`",
                                                      "`while`",
                                                      "`loop`",
                                                      "`endloop`",
                                                      "`and`",
                                                      "`or`",
                                                      "`not`",
                                                      "`xor`"};

constexpr std::size_t kind_count = static_cast<std::size_t>(TokenKind::key_xor) + 1;
static_assert(kind_names.size() == kind_count);

/// Kinds of the marks of one character; `end` for the others.
TokenKind mark_kind(char c) {
    constexpr std::string_view marks = "+-*/^~|&\\@=";
    constexpr std::string_view brackets = "()[]{},;";
    if (const auto i = marks.find(c); i != marks.npos)
        return static_cast<TokenKind>(static_cast<std::size_t>(TokenKind::plus) + i);
    if (const auto i = brackets.find(c); i != brackets.npos)
        return static_cast<TokenKind>(static_cast<std::size_t>(TokenKind::left_parenthesis) + i);
    if (c == '<') return TokenKind::less;
    if (c == '>') return TokenKind::greater;
    return TokenKind::end;
}

bool ends_operand(TokenKind kind) {
    return kind == TokenKind::identifier || kind == TokenKind::number ||
           kind == TokenKind::right_parenthesis || kind == TokenKind::right_bracket;
}

bool wants_operand(TokenKind kind) {
    return (kind >= TokenKind::plus && kind <= TokenKind::left_parenthesis) || kind == TokenKind::key_and ||
           kind == TokenKind::key_or || kind == TokenKind::key_not;
}

bool is_known(char c) {
    return is_word(c) || is_blank(c) || mark_kind(c) != TokenKind::end || c == '"' || c == '.' || c == '!' ||
           c == '%' || c == '#';
}

/// The decimal exponent of a literal's first non-zero digit, roughly: enough to tell huge from tiny.
long decimal_exponent(std::string_view digits) {
    const std::size_t mark = digits.find_first_of("eE");
    long exponent = 0;
    if (mark != digits.npos) {
        std::string_view tail = digits.substr(mark + 1);
        if (tail.front() == '+') tail.remove_prefix(1);
        const bool negative = tail.front() == '-';
        const auto [end, error] = std::from_chars(tail.data(), tail.data() + tail.size(), exponent);
        if (error != std::errc()) exponent = negative ? -1'000'000'000 : 1'000'000'000;
        digits = digits.substr(0, mark);
    }
    const auto first = static_cast<long>(digits.find_first_of("123456789"));
    const auto point = static_cast<long>(std::min(digits.find('.'), digits.size()));
    return exponent + point - first;
}

/// The value of a well-formed literal; what overflows is inf, what underflows is 0.
double literal_value(std::string_view digits) {
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc::result_out_of_range) return value;
    return decimal_exponent(digits) > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace

bool is_reserved_word(std::string_view lower) {
    return lower == "x" || lower == "a" || lower == "s" || keyword_kind(lower) != TokenKind::identifier;
}

std::string_view to_string(TokenKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

Lexer::Lexer(const Source& source, Reporter* reporter, std::uint32_t offset)
    : text_(source.text()), reporter_(reporter), position_(offset) {}

char Lexer::peek(std::size_t ahead) const {
    return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
}

Token Lexer::finish(Token token, TokenKind kind) {
    token.kind = previous_ = kind;
    token.span.end = static_cast<std::uint32_t>(position_);
    return token;
}

Token Lexer::next() {
    Token token;
    token.first_on_line = skip_blanks_and_comments(token);
    token.span.begin = static_cast<std::uint32_t>(position_);
    if (position_ >= text_.size()) return finish(token, TokenKind::end);
    const char c = peek();
    if (is_letter(c) || c == '_') return read_word(token);
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return read_number(token);
    if (c == '"') return read_text(token);
    if (read_foreign(token)) return token;
    return mark_kind(c) != TokenKind::end ? read_mark(token) : read_unexpected(token);
}

/// True when a line began on the way (or the file).
bool Lexer::skip_blanks_and_comments(Token& token) {
    bool new_line = position_ == 0;
    while (position_ < text_.size()) {
        if (peek() == '-' && peek(1) == '-') {
            token.after_comment = token.after_comment || !new_line;
            skip_comment(!new_line);
        } else if (is_blank(peek())) {
            new_line = new_line || is_newline(peek());
            ++position_;
        } else if (!skip_foreign_comment()) {
            break;
        }
    }
    return new_line;
}

// comment = "--" { any character but the end of the line }
void Lexer::skip_comment(bool same_line) {
    const std::size_t begin = position_;
    if (same_line) warn_of_double_minus(begin);
    while (position_ < text_.size() && !is_newline(text_[position_])) ++position_;
    if (begin + 2 < position_ && text_[begin + 2] == '@')
        annotations_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(position_)});
}

void Lexer::warn_of_double_minus(std::size_t begin) {
    if (!reporter_ || begin == 0) return;
    const char after = peek(2);
    const bool value = is_digit(after) || after == '(' || after == '.';
    const bool in_operand =
        ends_operand(previous_) && !is_blank(text_[begin - 1]) && (value || is_word(after));
    if (!in_operand && !(wants_operand(previous_) && value)) return;
    const auto place = static_cast<std::uint32_t>(begin);
    reporter_->report(
        Code::double_minus, {place, place + 2},
        {"`--` begins a comment here: the rest of the line is not read", "a comment",
         "write `- -` with a blank to subtract a negative value, or put a blank before a comment"});
}

// number = digits [ "." [ digits ] ] [ exponent ] | "." digits [ exponent ] ; exponent = "e" [ sign ] digits
Token Lexer::read_number(Token token) {
    const std::size_t begin = position_;
    while (is_digit(peek())) ++position_;
    if (peek() == '.') ++position_;
    while (is_digit(peek())) ++position_;
    if (peek() == 'e' || peek() == 'E') {
        const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
        if (is_digit(peek(1 + sign))) {
            position_ += 1 + sign;
            while (is_digit(peek())) ++position_;
        } else {
            std::size_t end = position_;
            while (end < text_.size() && is_word(text_[end])) ++end;
            const std::string_view word = text_.substr(position_, end - position_);
            if (keyword_kind(word) == TokenKind::identifier) {  // not the `endif` of `1endif`
                position_ = end + (end == position_ + 1 ? sign : 0);
                token = finish(token, TokenKind::invalid);
                if (reporter_)
                    reporter_->report(
                        Code::malformed_number, token.span,
                        {fmt::format("the number {} has an exponent without digits",
                                     reporter_->quote(token.span)),
                         "digits are missing", "write the power of ten behind the `e`: `1e5`, `1e-5`"});
                return token;
            }
        }
    }
    token.value = literal_value(text_.substr(begin, position_ - begin));
    return finish(token, TokenKind::number);
}

// identifier = letter { letter | digit | "_" }
Token Lexer::read_word(Token token) {
    const std::size_t begin = position_;
    while (position_ < text_.size() && is_word(text_[position_])) ++position_;
    token = finish(token, keyword_kind(text_.substr(begin, position_ - begin)));
    if (text_[begin] == '_' && reporter_)
        reporter_->report(Code::underscore_start, token.span,
                          {fmt::format("the name {} begins with an underscore", reporter_->quote(token.span)),
                           "must begin with a letter", "let the name begin with a letter"});
    return token;
}

// text = '"' { any character but '"' and the end of the line } '"'
Token Lexer::read_text(Token token) {
    ++position_;
    while (position_ < text_.size() && peek() != '"' && !is_newline(peek())) ++position_;
    if (peek() == '"' && position_ < text_.size()) {
        ++position_;
        return finish(token, TokenKind::text);
    }
    token = finish(token, TokenKind::invalid);
    if (reporter_)
        reporter_->report(Code::unterminated_text, {token.span.begin, token.span.begin + 1},
                          {"this text has no closing quotation mark", "begins here",
                           "close the text with `\"` in the same line"});
    return token;
}

/// Operators of other languages: reported, then read as the one that was meant.
bool Lexer::read_foreign(Token& token) {
    const std::string_view rest = text_.substr(position_, 2);
    const auto found = std::find_if(foreign_marks.begin(), foreign_marks.end(),
                                    [&](const Foreign& foreign) { return rest.starts_with(foreign.mark); });
    if (found == foreign_marks.end()) return false;
    position_ += found->mark.size();
    token = finish(token, found->stands_for);
    if (reporter_)
        reporter_->report(Code::foreign_operator, token.span,
                          {fmt::format("{} is not an operator of HyperFun", reporter_->quote(token.span)),
                           {},
                           std::string(found->help)});
    return true;
}

/// Comments of other languages: reported, then passed over. False when there is none.
bool Lexer::skip_foreign_comment() {
    const std::string_view rest = text_.substr(position_, 2);
    const bool block = rest == "/*";
    if (!block && rest != "//" && !rest.starts_with('#')) return false;
    const auto begin = static_cast<std::uint32_t>(position_);
    const Span mark = {begin, begin + (peek() == '#' ? 1u : 2u)};
    if (reporter_)
        reporter_->report(Code::foreign_operator, mark,
                          {fmt::format("{} does not begin a comment in HyperFun", reporter_->quote(mark)),
                           {},
                           "a comment begins with `--` and ends with its line"});
    if (block) {
        const std::size_t end = text_.find("*/", position_ + 2);
        position_ = end == text_.npos ? text_.size() : end + 2;
    } else {
        while (position_ < text_.size() && !is_newline(text_[position_])) ++position_;
    }
    return true;
}

Token Lexer::read_mark(Token token) {
    const char c = text_[position_++];
    const bool equal_follows = peek() == '=';
    const bool joins = equal_follows && (c == '<' || c == '>' || c == '/');
    if (!joins) return finish(token, mark_kind(c));
    ++position_;
    return finish(token, c == '<'   ? TokenKind::less_equal
                         : c == '>' ? TokenKind::greater_equal
                                    : TokenKind::not_equal);
}

/// A run of characters that HyperFun has no use for: one finding, one invalid token.
Token Lexer::read_unexpected(Token token) {
    std::size_t first = 1;
    while (position_ + first < text_.size() && (static_cast<unsigned char>(peek(first)) & 0xC0) == 0x80)
        ++first;
    const std::string_view character = text_.substr(position_, first);
    const std::size_t closing = character == "'" ? text_.find_first_of("'\r\n", position_ + 1) : text_.npos;
    position_ += first;
    if (closing != text_.npos && text_[closing] == '\'') position_ = closing + 1;
    while (position_ < text_.size() && !is_known(peek())) ++position_;
    token = finish(token, TokenKind::invalid);
    if (!reporter_) return token;
    std::string help =
        "HyperFun is written with letters, digits and `_ + - * / ^ ~ & | \\ @ = < > ( ) [ ] { } , ;`";
    if (character == "\xC2\xA0" || character == "\xE3\x80\x80")
        help = "this is a blank, but not the plain one: put a plain blank in its place";
    else if (character == "\xEF\xBF\xBD")
        help = "these bytes are not UTF-8 text; outside comments only ASCII has a meaning";
    else if (character == "'")
        help = "a text stands between `\"` marks";
    reporter_->report(
        Code::unexpected_character, token.span,
        {fmt::format("unexpected character {}", Reporter::quote(character)), {}, std::move(help)});
    return token;
}

}  // namespace frep::lang
