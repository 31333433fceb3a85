// Rules of objects: headers, array declarations, bodies, and text outside of objects. hyperfun.md a.1, a.3.
// Tested by tests/unit/lang/parser_test.cpp and tests/lang/object_*.hf.
#include <cmath>

#include <fmt/format.h>

#include "frep/field/field.h"
#include "frep/lang/parser_impl.h"

namespace frep::lang {
namespace {

constexpr std::string_view header_help =
    "the header of an object is name(x[3], a[1]) or name(x[3], a[1], s[3])";

/// As the old tools: to the nearest integer, halves upward.
double round_half_up(double value) {
    const double above = std::ceil(value);
    return above - value > 0.5 ? above - 1 : above;
}

}  // namespace

// object = name header "{" declarations statements "}"
void Parser::object() {
    const Token name = current_;
    object_name(name);
    advance();
    if (!header()) {
        scope_.sizes_known = false;
        while (!at(TokenKind::left_brace) && !at(TokenKind::right_brace) && !at(TokenKind::end)) advance();
    }
    Object& object = object_now();
    for (std::string_view missing : {"x", "a", "s"})
        if (!scope_.arrays.contains(std::string(missing))) {
            scope_.arrays.emplace(missing, static_cast<std::uint32_t>(object.arrays.size()));
            object.arrays.push_back({std::string(missing), 1u, name.span});
        }
    const Span brace = current_.span;
    if (!accept(TokenKind::left_brace)) {
        if (scope_.sizes_known)
            syntax_error(Code::expected_token, "`{`", "the body of an object stands in braces");
        while (!at(TokenKind::right_brace) && !at(TokenKind::end)) advance();
        accept(TokenKind::right_brace);
        return;
    }
    declarations();
    body(brace);
}

/// Opens the scope of a new object. An unfit name is reported; the object is read all the same.
void Parser::object_name(const Token& name) {
    const std::string lowered = lower(name);
    scope_ = Scope{};
    scope_.name = lowered;
    const auto [known, is_new] =
        objects_.try_emplace(lowered, static_cast<std::uint32_t>(program_.objects.size()));
    if (!is_new) {
        const LineColumn first = source_.locate(program_.objects[known->second].name_span.begin);
        report_.report(
            Code::duplicate_object, name.span,
            {fmt::format("the object {} is defined twice", quote(name.span)), "second definition",
             fmt::format("the first one is in line {}; names of objects must differ, capitals do not "
                         "count",
                         first.line)});
    } else {
        check_new_name(name, lowered, "an object");
    }
    Object object;
    object.name = lowered;
    object.written_name = std::string(source_.text(name.span));
    object.name_span = name.span;
    program_.objects.push_back(std::move(object));
}

// header = "(" "x" "[" number "]" "," "a" "[" number "]" [ "," "s" "[" number "]" ] ")"
bool Parser::header() {
    advance();  // "(", seen by the caller
    const auto fail = [&](std::string_view expected) {
        syntax_error(Code::malformed_header, expected, std::string(header_help));
        return false;
    };
    if (!header_array("x", max_coordinates)) return false;
    if (!accept(TokenKind::comma)) return fail("`,` and the parameters `a[...]`");
    if (!header_array("a", max_parameters)) return false;
    if (accept(TokenKind::comma)) {
        if (!header_array("s", max_attributes)) return false;
        object_now().declares_attributes = true;
    }
    return accept(TokenKind::right_parenthesis) || fail("`)`");
}

/// One array of the header, of the fixed name.
bool Parser::header_array(std::string_view name, double limit) {
    const Token token = current_;
    if (!at(TokenKind::identifier) || lower(token) != name) {
        syntax_error(Code::malformed_header, fmt::format("`{}[...]`", name), std::string(header_help));
        return false;
    }
    advance();
    if (!at(TokenKind::left_bracket)) {
        syntax_error(Code::malformed_header, "`[` and a size", std::string(header_help));
        return false;
    }
    const Span size_span = next_.span;
    const auto size = array_size();
    if (!size) return false;
    double kept = *size;
    if (kept > limit) {
        report_.report(Code::size_out_of_range, size_span,
                       {fmt::format("`{}` may have up to {} items", name, limit), "too large",
                        name == "a" ? "shapes with more numbers keep them in local arrays" : ""});
        kept = 1;
        scope_.sizes_known = false;
    }
    scope_.arrays.emplace(name, static_cast<std::uint32_t>(object_now().arrays.size()));
    object_now().arrays.push_back({std::string(name), static_cast<std::uint32_t>(kept), token.span});
    return true;
}

// size = "[" number "]"
std::optional<double> Parser::array_size() {
    advance();  // "[", seen by the caller
    if (!at(TokenKind::number)) {
        if (!at(TokenKind::invalid))
            report_.report(Code::size_not_number, place_of_missing(),
                           {"the size of an array must be a plain number", "a number is expected",
                            "sizes are fixed when the file is read: they cannot be computed"});
        return std::nullopt;
    }
    const double size = round_half_up(current_.value);
    advance();
    if (!expect(TokenKind::right_bracket,
                at(TokenKind::comma) ? "" : "the size of an array is a single number"))
        return std::nullopt;
    return size;
}

// declarations = { "array" declaration { "," declaration } ";" }
void Parser::declarations() {
    while (at(TokenKind::key_array)) declaration();
}

// declaration = name "[" number "]"
void Parser::declaration() {
    advance();  // "array"
    do {
        const Token name = current_;
        if (!at(TokenKind::identifier) || next_.kind != TokenKind::left_bracket) {
            if (at(TokenKind::identifier)) advance();
            syntax_error(Code::expected_token, at(TokenKind::identifier) ? "`[`" : "a name and `[size]`",
                         "an array is declared like this: array points[8];");
            return skip_statement();
        }
        advance();
        const auto size = array_size();
        declared_array(name, size.value_or(std::numeric_limits<double>::quiet_NaN()));
        if (!size) return skip_statement();
    } while (accept(TokenKind::comma));
    const bool another =
        at(TokenKind::identifier) && !current_.first_on_line;  // of the same line: no statement
    if (!expect_semicolon("the declaration") || another) skip_statement();
}

/// Adds a local array; a size of NaN was reported already. The first of two declarations counts.
void Parser::declared_array(const Token& name, double size) {
    const std::string lowered = lower(name);
    if (const auto known = scope_.arrays.find(lowered);
        known != scope_.arrays.end() && known->second > array_s) {
        const ArrayInfo& first = object_now().arrays[known->second];
        report_.report(
            Code::duplicate_array, name.span,
            {fmt::format("the array {} is declared twice", quote(name.span)), "this one does not count",
             fmt::format("the first declaration, with {} items, holds: remove this one", first.size)});
        return;
    }
    if (!check_new_name(name, lowered, "an array")) return;
    const auto limit = static_cast<double>(array_item_limit);
    if (size < 1) {
        report_.report(Code::size_out_of_range, name.span,
                       {fmt::format("the array {} has no items", quote(name.span)),
                        {},
                        "a local array has at least one item"});
        size = 1;
    } else if (scope_.items + size > limit) {
        report_.report(Code::too_many_items, name.span,
                       {fmt::format("the arrays of this object have more than {} items", array_item_limit),
                        {},
                        "keep large data outside of the model"});
        size = 1;
    }
    if (std::isnan(size)) {
        scope_.sizes_known = false;
        size = 1;
    }
    scope_.items += size;
    scope_.arrays.emplace(lowered, static_cast<std::uint32_t>(object_now().arrays.size()));
    object_now().arrays.push_back({lowered, static_cast<std::uint32_t>(size), name.span});
}

// body = { statement } result "}"
void Parser::body(Span brace) {
    Statements& all = object_now().body;
    for (;;) {
        const Statements some = statements();
        all.insert(all.end(), some.begin(), some.end());
        if (at(TokenKind::right_brace) || at(TokenKind::end) || looks_like_header()) break;
        stray_end();
    }
    if (!at(TokenKind::right_brace))
        report_.report(Code::unclosed_block, brace,
                       {fmt::format("the body of {} is not closed", quote(object_now().name_span)),
                        "opened here", "a `}` is missing"});
    else if (!scope_.result_seen && !scope_.results_reported && scope_.results_in_block.empty())
        report_.report(
            Code::missing_result, current_.span,
            {fmt::format("the object {} gets no value", quote(object_now().name_span)),
             "the value is missing before this brace",
             fmt::format("assign the object's own name last: {} = ...;", object_now().written_name)});
    accept(TokenKind::right_brace);
}

/// `else`, `endif` or `endloop` that closes nothing.
void Parser::stray_end() {
    report_.report(Code::stray_end, current_.span,
                   {fmt::format("{} without an open {}", quote(current_.span),
                                at(TokenKind::key_endloop) ? "`while`" : "`if`"),
                    "closes nothing", "remove it, or write the beginning that it belongs to"});
    advance();
    if (at(TokenKind::semicolon)) advance();
}

/// Anything but an object at the outermost level: one finding, then on to what looks like an object.
void Parser::text_outside() {
    if (at(TokenKind::semicolon)) {
        report_.report(Code::empty_statement, current_.span,
                       {"this `;` has no meaning here", {}, "an object ends with its brace: remove the `;`"});
        return advance();
    }
    const bool before = program_.objects.empty();
    if (!at(TokenKind::invalid))
        report_.report(
            Code::text_outside_objects, current_.span,
            {fmt::format("{} stands outside of an object", at(TokenKind::identifier)
                                                               ? quote(current_.span)
                                                               : std::string(to_string(current_.kind))),
             before ? "an object is expected" : "after the end of the object",
             "a file holds only objects, name(x[3], a[1]) { ... }, and comments, which begin with `--`"});
    do advance();
    while (!at(TokenKind::end) && !(at(TokenKind::identifier) && next_.kind == TokenKind::left_parenthesis));
}

/// True where `name(x[` stands: the header of an object, never a call.
bool Parser::looks_like_header() const {
    if (!at(TokenKind::identifier) || next_.kind != TokenKind::left_parenthesis) return false;
    Lexer ahead(source_, nullptr, next_.span.end);
    const Token first = ahead.next();
    return first.kind == TokenKind::identifier && lower_case(source_.text(first.span)) == "x" &&
           ahead.next().kind == TokenKind::left_bracket;
}

}  // namespace frep::lang
