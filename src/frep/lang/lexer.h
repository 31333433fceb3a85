// Lexer: HyperFun text -> tokens, one at a time, so that a file of any size costs no memory here. Comments
// and blanks are skipped; annotation comments (`--@`) are remembered by their place. Wrong characters are
// reported once for a run of them and answered as one `invalid` token. hyperfun.md a.2. Tested by
// tests/unit/lang/lexer_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/source.h"

namespace frep::lang {

class Reporter;

enum class TokenKind : std::uint8_t {
    end,      ///< of the file; answered again and again
    invalid,  ///< already reported
    identifier,
    number,
    text,  ///< "..." with its quotes
    plus,
    minus,
    star,
    slash,
    caret,
    tilde,
    bar,
    ampersand,
    backslash,
    at,
    equal,
    not_equal,
    less,
    less_equal,
    greater,
    greater_equal,
    left_parenthesis,
    right_parenthesis,
    left_bracket,
    right_bracket,
    left_brace,
    right_brace,
    comma,
    semicolon,
    key_array,
    key_if,
    key_then,
    key_else,
    key_endif,
    key_while,
    key_loop,
    key_endloop,
    key_and,
    key_or,
    key_not,
    key_xor,
};

/// A token and its place. Identifiers keep their spelling in the source; see lower_case().
struct Token {
    TokenKind kind = TokenKind::end;
    bool first_on_line = false;  ///< nothing but blanks stands before it in its line
    bool after_comment = false;  ///< a comment stands between it and the token before, in that token's line
    double value = 0;            ///< of a number; 1e400 is inf
    Span span;
};

class Lexer {
  public:
    /// Reads `source` from byte `offset`. Without a reporter wrong text is passed over silently.
    explicit Lexer(const Source& source, Reporter* reporter = nullptr, std::uint32_t offset = 0);

    Token next();

    /// Places of the `--@` comments met so far, each from its dashes to the end of its line.
    const std::vector<Span>& annotations() const { return annotations_; }

  private:
    bool skip_blanks_and_comments(Token& token);
    void skip_comment(bool same_line);
    bool skip_foreign_comment();
    void warn_of_double_minus(std::size_t begin);
    Token read_number(Token token);
    Token read_word(Token token);
    Token read_text(Token token);
    Token read_mark(Token token);
    bool read_foreign(Token& token);
    Token read_unexpected(Token token);
    Token finish(Token token, TokenKind kind);
    char peek(std::size_t ahead = 0) const;

    std::string_view text_;
    Reporter* reporter_;
    std::size_t position_;
    TokenKind previous_ = TokenKind::end;
    std::vector<Span> annotations_;
};

/// The words that the language keeps for itself: `if`, `then`, ..., and the arrays `x`, `a`, `s`.
bool is_reserved_word(std::string_view lower);

/// A kind as people read it: "`;`", "a number", "`endif`".
std::string_view to_string(TokenKind kind);

}  // namespace frep::lang
