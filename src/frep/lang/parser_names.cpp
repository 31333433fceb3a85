// Names in expressions: variables, items of arrays, and what is wrong with a name. hyperfun.md a.3. Tested by
// tests/unit/lang/parser_test.cpp and tests/lang/name_*.hf, index_*.hf.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frep/lang/parser_impl.h"

namespace frep::lang {
namespace {

constexpr std::size_t candidate_limit = 2000;  // names looked at for a suggestion

}  // namespace

std::optional<std::uint32_t> Parser::find_array(const std::string& lowered) const {
    const auto found = scope_.arrays.find(lowered);
    return found == scope_.arrays.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> Parser::find_scalar(const std::string& lowered) const {
    const auto found = scope_.scalars.find(lowered);
    return found == scope_.scalars.end() ? std::nullopt : std::optional(found->second);
}

/// A finished object; the one that is being read is not found.
std::optional<std::uint32_t> Parser::find_object(const std::string& lowered) const {
    if (lowered == scope_.name) return std::nullopt;
    const auto found = objects_.find(lowered);
    return found == objects_.end() ? std::nullopt : std::optional(found->second);
}

/// The number of a scalar, which comes into being here if it is new.
std::uint32_t Parser::scalar_symbol(const std::string& lowered) {
    auto& names = object_now().scalars;
    const auto [found, is_new] =
        scope_.scalars.try_emplace(lowered, static_cast<std::uint32_t>(names.size()));
    if (is_new) names.push_back(lowered);
    return found->second;
}

/// True when `name` may be given to a new `what`. A taken name is an error, a shadowed one a warning.
bool Parser::check_new_name(const Token& name, const std::string& lowered, std::string_view what) {
    const bool is_object = what == "an object";
    const auto rows = find_library(lowered);
    const auto refuse = [&](std::string_view owner) {
        report_.report(Code::name_taken, name.span,
                       {fmt::format("{} cannot be the name of {}", quote(name.span), what),
                        std::string(owner), "choose another name"});
        return false;
    };
    if (is_reserved_word(lowered)) return refuse("is a word of the language");
    if (find_builtin(lowered)) return refuse("is a built-in function");
    const bool reserved = std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.reserved; });
    if (reserved) return refuse("is a function of the library");
    if (!is_object && lowered == scope_.name) return refuse("is the object's own name");
    const bool shadows_object = !is_object && find_object(lowered);
    if (shadows_object || !rows.empty())
        report_.report(Code::shadowed_name, name.span,
                       {fmt::format("{} gets the name of {}", what,
                                    shadows_object ? "an object of this file" : "a library function"),
                        "the same name", "choose another name, so that readers are not misled"});
    return true;
}

/// "did you mean ...?" among the names that could stand there, or nothing.
std::string Parser::suggestion(std::string_view name, bool scalars, bool arrays, bool functions) const {
    if (name.size() < 3) return {};  // everything is near to a letter
    std::vector<std::string_view> candidates;
    const auto offer = [&](std::string_view candidate) {
        if (candidates.size() < candidate_limit) candidates.push_back(candidate);
    };
    const Object& object = object_now();
    if (arrays)
        for (const ArrayInfo& array : object.arrays) offer(array.name);
    if (functions) {
        for (const BuiltinInfo& builtin : builtin_table()) offer(builtin.name);
        for (const auto& row : shapes::library()) offer(row.name);
        for (const Object& other : program_.objects)
            if (other.name != scope_.name) offer(other.name);
    }
    if (scalars)
        for (const std::string& scalar : object.scalars) offer(scalar);
    const std::string_view nearest = nearest_name(name, candidates);
    return nearest.empty() ? std::string() : fmt::format("did you mean {}?", Reporter::quote(nearest));
}

/// Where the file has an object of that name, if only farther down. The file is read once for all questions.
std::optional<Span> Parser::defined_later(const std::string& lowered) {
    if (!all_objects_) {
        all_objects_.emplace();
        Lexer lexer(source_, nullptr, previous_.end);
        Token window[3];
        for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) {
            const bool header = window[1].kind == TokenKind::identifier &&
                                window[2].kind == TokenKind::left_parenthesis &&
                                token.kind == TokenKind::identifier && lower(token) == "x" &&
                                window[0].kind == TokenKind::right_brace;
            if (header) all_objects_->try_emplace(lower(window[1]), window[1].span);
            window[0] = window[1];
            window[1] = window[2];
            window[2] = token;
        }
    }
    const auto found = all_objects_->find(lowered);
    return found == all_objects_->end() ? std::nullopt : std::optional(found->second);
}

// The last three forms of primary, told apart by what follows the name.
Parsed Parser::named() {
    const Token name = current_;
    const std::string lowered = lower(name);
    advance();
    if (at(TokenKind::left_parenthesis)) return call(name, lowered);
    if (at(TokenKind::left_bracket)) return item(name, lowered);
    return scalar_value(name, lowered);
}

Parsed Parser::scalar_value(const Token& name, const std::string& lowered) {
    ExpressionNode node;
    node.kind = ExpressionKind::scalar;
    node.span = name.span;
    if (const auto scalar = find_scalar(lowered)) {
        node.symbol = *scalar;
        return {add(std::move(node))};
    }
    const std::string shown = quote(name.span);
    if (const auto array = find_array(lowered)) {
        report_.report(Code::array_without_index, name.span,
                       {fmt::format("{} is an array, not a value", shown), "an item is expected",
                        fmt::format("write {}[1] for its first item", object_now().arrays[*array].name)});
    } else if (lowered == scope_.name) {
        report_.report(Code::result_read, name.span,
                       {fmt::format("the value of {} cannot be read back", shown), "the object's own name",
                        "give the value to a variable first, and use that"});
    } else if (find_object(lowered) || find_builtin(lowered) || !find_library(lowered).empty()) {
        const bool object = find_object(lowered).has_value();
        report_.report(
            Code::call_without_parentheses, name.span,
            {fmt::format("{} is {}, and is used without its arguments", shown,
                         object ? "an object" : "a function"),
             "`(` is expected after it",
             object ? fmt::format("call it with arrays: {}(x, a)", source_.text(name.span).substr(0, 60))
                    : "write its arguments in parentheses"});
    } else {
        std::string help = suggestion(lowered, true, false, false);
        if (help.empty())
            help =
                "a variable comes into being by an assignment, which must stand before this place in the "
                "text";
        report_.report(Code::unknown_name, name.span,
                       {fmt::format("{} has no value yet", shown), "not assigned before", std::move(help)});
        scalar_symbol(lowered);  // reported once
    }
    return placeholder(name.span);
}

// item = array "[" expression "]"
Parsed Parser::item(const Token& name, const std::string& lowered) {
    const auto array = find_array(lowered);
    if (!array) {
        std::string help = suggestion(lowered, false, true, false);
        if (find_scalar(lowered))
            help = "it is a variable; arrays are declared at the top of the body: array name[size];";
        else if (help.empty())
            help = fmt::format("declare it at the top of the body: array {}[size];",
                               source_.text(name.span).substr(0, 60));
        report_.report(
            Code::unknown_array, name.span,
            {fmt::format("{} is not an array", quote(name.span)), "not declared", std::move(help)});
    }
    if (!enter(current_.span)) return {};
    advance();  // "[", seen by the caller
    const Parsed index = value_expression();
    leave();
    if (!index || !expect(TokenKind::right_bracket, "arrays have one index")) return {};
    if (!array) return placeholder({name.span.begin, previous_.end});
    check_index(*array, index.id);
    ExpressionNode node;
    node.kind = ExpressionKind::item;
    node.symbol = *array;
    node.operands = {index.id};
    node.span = {name.span.begin, previous_.end};
    return {add(std::move(node))};
}

/// An index written as a number is checked now. Only a warning: the value is undefined, which matters where
/// it is used.
void Parser::check_index(std::uint32_t array, ExpressionId index) {
    const auto value = literal(index);
    if (!value || !scope_.sizes_known) return;
    const ArrayInfo& info_of = object_now().arrays[array];
    const double rounded = std::ceil(*value) - *value > 0.5 ? std::ceil(*value) - 1 : std::ceil(*value);
    if (rounded >= 1 && rounded <= info_of.size) return;
    Words words{fmt::format("`{}` has {} items, there is none with this number",
                            info_of.name.size() > 60 ? std::string("...") : info_of.name, info_of.size),
                "out of range",
                info_of.size == 0 ? "" : fmt::format("items are numbered 1 to {}", info_of.size)};
    report_.warning(Code::index_out_of_range, span_of(index), std::move(words));
}

}  // namespace frep::lang
