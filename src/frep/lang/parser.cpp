// parse(): the entry, the token stream with its look-ahead of one, expectations and recovery. The rules are
// in parser_objects.cpp, parser_statements.cpp, parser_expressions.cpp, parser_names.cpp and
// parser_calls.cpp. Tested by tests/unit/lang/parser_test.cpp and text_cases_test.cpp.
#include "frep/lang/parser.h"

#include <fmt/format.h>

#include "frep/lang/annotations.h"
#include "frep/lang/parser_impl.h"

namespace frep::lang {

Program parse(const Source& source, Diagnostics& diagnostics) {
    Reporter report(source);
    Program program;
    if (source.text().size() > source_limit)
        report.fatal(
            Code::source_too_large, {0, 0},
            {fmt::format("this file has {} bytes; a model may have {}", source.text().size(), source_limit),
             {},
             "split the model, or keep large data outside of it"});
    else
        program = Parser(source, report).run();
    report.finish(diagnostics);
    return program;
}

Parser::Parser(const Source& source, Reporter& report)
    : source_(source), report_(report), lexer_(source, &report) {
    current_ = lexer_.next();
    next_ = lexer_.next();
}

Program Parser::run() {
    while (!at(TokenKind::end)) {
        const bool named = at(TokenKind::identifier) || current_.kind >= TokenKind::key_array;
        if (named && next_.kind == TokenKind::left_parenthesis)
            object();
        else
            text_outside();
    }
    if (program_.objects.empty() && report_.errors() == 0)
        report_.report(Code::no_object, {0, 0},
                       {"this file has no object", "an object is expected",
                        "a model begins like this: my_model(x[3], a[1]) { my_model = ...; }"});
    read_annotations(source_, lexer_.annotations(), program_, report_);
    return std::move(program_);
}

void Parser::advance() {
    previous_ = current_.span;
    if (report_.stopped()) {  // answer the end from here on, so that every rule comes to its own
        const auto end = static_cast<std::uint32_t>(source_.text().size());
        current_ = next_ = Token{TokenKind::end, true, false, 0, {end, end}};
        return;
    }
    current_ = next_;
    if (current_.kind != TokenKind::end) next_ = lexer_.next();
}

bool Parser::accept(TokenKind kind) {
    if (!at(kind)) return false;
    advance();
    return true;
}

bool Parser::expect(TokenKind kind, std::string help) {
    if (accept(kind)) return true;
    syntax_error(Code::expected_token, to_string(kind), std::move(help));
    return false;
}

/// A forgotten semicolon before something that can begin or end a statement costs no more than its report.
bool Parser::expect_semicolon(std::string_view after) {
    if (accept(TokenKind::semicolon)) return true;
    if (at(TokenKind::invalid)) return false;
    std::string help = fmt::format("found {} instead", to_string(current_.kind));
    if (current_.after_comment)
        help = "`--` begins a comment: what follows in that line is not read";
    else if (at(TokenKind::comma))
        help = "a comma separates arguments and items of lists; numbers have a point: 1.5";
    report_.report(Code::expected_token, {previous_.end, previous_.end},
                   {fmt::format("expected `;` after {}", after), "`;` is missing here", std::move(help)});
    return begins_statement() || at(TokenKind::end) || at(TokenKind::right_brace) ||
           at(TokenKind::key_else) || at(TokenKind::key_endif) || at(TokenKind::key_endloop);
}

/// Reports "expected ..., found ...", unless the lexer has already reported what stands here.
void Parser::syntax_error(Code code, std::string_view expected, std::string help) {
    if (at(TokenKind::invalid)) return;
    if (help.empty() && current_.after_comment)
        help = "`--` begins a comment: what follows in that line is not read";
    std::string found(to_string(current_.kind));
    if (at(TokenKind::identifier) || at(TokenKind::number) || at(TokenKind::text))
        found = quote(current_.span);
    report_.report(code, place_of_missing(),
                   {fmt::format("expected {}, found {}", expected, found),
                    fmt::format("expected {}", expected), std::move(help)});
}

/// The current token, or the end of the one before where the line ends there.
Span Parser::place_of_missing() const {
    const bool elsewhere = at(TokenKind::end) || current_.first_on_line;
    return elsewhere && previous_.end > 0 ? Span{previous_.end, previous_.end} : current_.span;
}

bool Parser::begins_statement() const {
    switch (current_.kind) {
        case TokenKind::key_if:
        case TokenKind::key_while:
        case TokenKind::key_array:
            return true;
        case TokenKind::identifier:
            return next_.kind == TokenKind::equal || next_.kind == TokenKind::left_bracket || at_elseif();
        default:
            return false;
    }
}

/// After an error: on to the next `;` (read) or to what begins or ends a statement (not read).
void Parser::skip_statement() {
    for (;; advance()) {
        if (at(TokenKind::identifier) && current_.first_on_line && next_.kind == TokenKind::equal) return;
        switch (current_.kind) {
            case TokenKind::semicolon:
                advance();
                return;
            case TokenKind::end:
            case TokenKind::right_brace:
            case TokenKind::key_if:
            case TokenKind::key_while:
            case TokenKind::key_else:
            case TokenKind::key_endif:
            case TokenKind::key_endloop:
                return;
            default:
                break;
        }
    }
}

/// One level deeper; false, with a report, when that is too deep. leave() undoes it.
bool Parser::enter(Span where) {
    if (depth_ >= nesting_limit) {
        report_.fatal(Code::nesting_too_deep, where,
                      {fmt::format("this is nested more than {} levels deep", nesting_limit),
                       {},
                       "give parts of it to variables, or to objects of their own"});
        advance();  // to the end: nothing more is read
        return false;
    }
    ++depth_;
    return true;
}

}  // namespace frep::lang
