#include "frep/lang/lexer.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "frep/lang/report.h"

using namespace frep;
using namespace frep::lang;

namespace {

std::vector<Token> tokens_of(const Source& source, Reporter* report = nullptr) {
    Lexer lexer(source, report);
    std::vector<Token> all;
    for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) all.push_back(token);
    return all;
}

std::vector<TokenKind> kinds_of(std::string_view text) {
    const Source source("t", text);
    std::vector<TokenKind> kinds;
    for (const Token& token : tokens_of(source)) kinds.push_back(token.kind);
    return kinds;
}

double value_of(std::string_view text) {
    const Source source("t", text);
    const auto tokens = tokens_of(source);
    REQUIRE(tokens.size() == 1);
    REQUIRE(tokens[0].kind == TokenKind::number);
    return tokens[0].value;
}

std::string code_of(std::string_view text) {
    const Source source("t", text);
    Reporter report(source);
    tokens_of(source, &report);
    Diagnostics found;
    report.finish(found);
    std::string codes;
    for (const Diagnostic& d : found.list()) codes += (codes.empty() ? "" : " ") + d.code;
    return codes;
}

}  // namespace

TEST_CASE("numbers") {
    CHECK(value_of("5") == 5);
    CHECK(value_of("5.") == 5);
    CHECK(value_of(".5") == 0.5);
    CHECK(value_of("007") == 7);
    CHECK(value_of("00.5") == 0.5);
    CHECK(value_of("1e-05") == 1e-5);
    CHECK(value_of("1E2") == 100);
    CHECK(value_of("1e+2") == 100);
    CHECK(value_of("0.1") == 0.1);
    CHECK(std::isinf(value_of("1e400")));
    CHECK(std::isinf(value_of("1e99999999999999999999")));
    CHECK(std::isinf(value_of(std::string(400, '9'))));
    CHECK(value_of("1e-400") == 0);
    CHECK(value_of("1e-99999999999999999999") == 0);
    CHECK(value_of("0." + std::string(500, '0') + "1e5") == 0);
    CHECK(value_of("0e999") == 0);
    CHECK(value_of("2.2250738585072014e-308") == std::numeric_limits<double>::min());
}

TEST_CASE("numbers that touch words") {
    CHECK(kinds_of("1then") == std::vector{TokenKind::number, TokenKind::key_then});
    CHECK(kinds_of("1endif") == std::vector{TokenKind::number, TokenKind::key_endif});
    CHECK(kinds_of("2x") == std::vector{TokenKind::number, TokenKind::identifier});
    CHECK(kinds_of("1e") == std::vector{TokenKind::invalid});
    CHECK(kinds_of("1e+") == std::vector{TokenKind::invalid});
    CHECK(kinds_of("1ex") == std::vector{TokenKind::invalid});
    CHECK(kinds_of("1..2") == std::vector{TokenKind::number, TokenKind::number});
    CHECK(code_of("1e 2e-") == "HF002 HF002");
}

TEST_CASE("words") {
    CHECK(kinds_of("IF If iF") == std::vector{TokenKind::key_if, TokenKind::key_if, TokenKind::key_if});
    CHECK(kinds_of("ifx endifs arrays") ==
          std::vector{TokenKind::identifier, TokenKind::identifier, TokenKind::identifier});
    CHECK(kinds_of("elseif") == std::vector{TokenKind::identifier});
    CHECK(kinds_of("x a s") ==
          std::vector{TokenKind::identifier, TokenKind::identifier, TokenKind::identifier});
    CHECK(is_reserved_word("x"));
    CHECK(is_reserved_word("xor"));
    CHECK(!is_reserved_word("elseif"));
    CHECK(!is_reserved_word("e"));
    CHECK(lower_case("HfSphere_9\xC3\x84") == "hfsphere_9\xC3\x84");
    CHECK(code_of("_a a_") == "HF003");
}

TEST_CASE("marks") {
    CHECK(kinds_of("+-*/^~|&\\@=") == std::vector{TokenKind::plus, TokenKind::minus, TokenKind::star,
                                                  TokenKind::slash, TokenKind::caret, TokenKind::tilde,
                                                  TokenKind::bar, TokenKind::ampersand, TokenKind::backslash,
                                                  TokenKind::at, TokenKind::equal});
    CHECK(kinds_of("< <= > >= /=") == std::vector{TokenKind::less, TokenKind::less_equal, TokenKind::greater,
                                                  TokenKind::greater_equal, TokenKind::not_equal});
    CHECK(kinds_of("()[]{},;") == std::vector{TokenKind::left_parenthesis, TokenKind::right_parenthesis,
                                              TokenKind::left_bracket, TokenKind::right_bracket,
                                              TokenKind::left_brace, TokenKind::right_brace, TokenKind::comma,
                                              TokenKind::semicolon});
    for (std::size_t kind = 0; kind <= static_cast<std::size_t>(TokenKind::key_xor); ++kind)
        CHECK(!to_string(static_cast<TokenKind>(kind)).empty());
}

TEST_CASE("operators of other languages stand for ours") {
    CHECK(kinds_of("==") == std::vector{TokenKind::equal});
    CHECK(kinds_of("!= <>") == std::vector{TokenKind::not_equal, TokenKind::not_equal});
    CHECK(kinds_of("&& || ** ! :=") == std::vector{TokenKind::key_and, TokenKind::key_or, TokenKind::caret,
                                                   TokenKind::key_not, TokenKind::equal});
    CHECK(code_of("a == b && c") == "HF010 HF010");
    CHECK(kinds_of("a // b\nc # d\n/* e\nf */ g") ==
          std::vector{TokenKind::identifier, TokenKind::identifier, TokenKind::identifier});
    CHECK(kinds_of("a /* never closed") == std::vector{TokenKind::identifier});
    CHECK(code_of("// a\n# b\n/* c */") == "HF010 HF010 HF010");
}

TEST_CASE("blanks and comments") {
    CHECK(kinds_of(" \t\f\r\n\r \n") == std::vector<TokenKind>{});
    CHECK(kinds_of("a--b\rc--d\r\ne") ==
          std::vector{TokenKind::identifier, TokenKind::identifier, TokenKind::identifier});
    CHECK(kinds_of("- -2") == std::vector{TokenKind::minus, TokenKind::minus, TokenKind::number});
    const Source source("t", "a -- one\n  b c -- two\n -- three\n;");
    const auto tokens = tokens_of(source);
    REQUIRE(tokens.size() == 4);
    CHECK(tokens[0].first_on_line);
    CHECK(tokens[1].first_on_line);
    CHECK(tokens[1].after_comment);
    CHECK(!tokens[2].first_on_line);
    CHECK(!tokens[2].after_comment);
    CHECK(tokens[3].first_on_line);
    CHECK(source.text(tokens[2].span) == "c");
}

TEST_CASE("two minus signs are warned of where a value could be meant") {
    CHECK(code_of("a--b") == "HF054");
    CHECK(code_of("a[1]--2") == "HF054");
    CHECK(code_of("y = --2") == "HF054");
    CHECK(code_of("(--2)") == "HF054");
    CHECK(code_of("a --b") == "");
    CHECK(code_of("a-- b") == "");
    CHECK(code_of("a;--b") == "");
    CHECK(code_of("then--b") == "");
    CHECK(code_of("a |--the lid") == "");
    CHECK(code_of("[1,--2") == "");
    CHECK(code_of("a------") == "");
    CHECK(code_of("--@ title") == "");
}

TEST_CASE("texts") {
    CHECK(kinds_of("\"a -- b\"") == std::vector{TokenKind::text});
    CHECK(kinds_of("\"\"") == std::vector{TokenKind::text});
    CHECK(kinds_of("\"a\nb") == std::vector{TokenKind::invalid, TokenKind::identifier});
    CHECK(code_of("\"") == "HF004");
    CHECK(code_of("\"a\rb\"") == "HF004 HF004");
}

TEST_CASE("annotations are remembered by their place") {
    const Source source("t", "--@ a\nx -- @ no\n\"--@ no\" --@\r\n---@ no\n--@b");
    Lexer lexer(source);
    while (lexer.next().kind != TokenKind::end) {
    }
    REQUIRE(lexer.annotations().size() == 3);
    CHECK(source.text(lexer.annotations()[0]) == "--@ a");
    CHECK(source.text(lexer.annotations()[1]) == "--@");
    CHECK(source.text(lexer.annotations()[2]) == "--@b");
}

TEST_CASE("a run of wrong characters is one token and one finding") {
    CHECK(kinds_of("a $$\xC3\xA9? b") ==
          std::vector{TokenKind::identifier, TokenKind::invalid, TokenKind::identifier});
    CHECK(code_of("$$$ ???") == "HF001 HF001");
    CHECK(code_of("'it is' x") == "HF001");
    const Source source("t", "\x1b[2J");
    Reporter report(source);
    tokens_of(source, &report);
    Diagnostics found;
    report.finish(found);
    REQUIRE(found.list().size() == 1);
    CHECK(found.list()[0].message.find("\\x1b") != std::string::npos);
    CHECK(found.list()[0].message.find('\x1b') == std::string::npos);
}

TEST_CASE("quotes are clipped at a character and free of control characters") {
    CHECK(Reporter::quote("abc") == "`abc`");
    CHECK(Reporter::quote("a\x07") == "`a\\x07`");
    const std::string long_text = std::string(59, 'a') + "\xC3\xA9\xC3\xA9\xC3\xA9";
    CHECK(Reporter::quote(long_text) == "`" + std::string(59, 'a') + "...`");
}
