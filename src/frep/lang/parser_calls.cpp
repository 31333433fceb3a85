// Calls: built-in functions, library functions and other objects, with their arguments. hyperfun.md a.5.
// Tested by tests/unit/lang/parser_test.cpp and tests/lang/call_*.hf.
#include <fmt/format.h>

#include "frep/lang/parser_impl.h"

namespace frep::lang {
namespace {

std::string plural(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// How to write a call of this row: "hfSphere(x, center, r)".
std::string signature(const shapes::LibraryFunction& row) {
    std::string list;
    for (const auto& argument : row.arguments) {
        if (!list.empty()) list += ", ";
        list += argument.name;
    }
    return fmt::format("{}({})", row.name, list);
}

bool is_array(shapes::ArgumentKind kind) {
    return kind == shapes::ArgumentKind::array || kind == shapes::ArgumentKind::array_in_out;
}

bool fits(shapes::ArgumentKind wanted, ExpressionKind given) {
    if (is_array(wanted)) return given == ExpressionKind::array;
    if (wanted == shapes::ArgumentKind::text) return given == ExpressionKind::text;
    return given != ExpressionKind::array && given != ExpressionKind::text;
}

std::string_view noun_of(shapes::ArgumentKind kind) {
    if (is_array(kind)) return "the name of an array";
    return kind == shapes::ArgumentKind::text ? "a text in quotation marks" : "a number";
}

}  // namespace

// call = name "(" [ argument { "," argument } ] ")"
Parsed Parser::call(const Token& name, const std::string& lowered) {
    ExpressionNode node;
    if (!enter(current_.span)) return {};
    advance();  // "(", seen by the caller
    const bool read = arguments(node.operands);
    leave();
    if (!read) return {};
    node.span = {name.span.begin, previous_.end};
    if (const auto object = find_object(lowered)) return object_call(name, *object, std::move(node));
    if (const BuiltinInfo* builtin = find_builtin(lowered))
        return builtin_call(name, *builtin, std::move(node));
    if (const auto rows = find_library(lowered); !rows.empty() && lowered != scope_.name)
        return library_call(name, rows, std::move(node));
    return unknown_call(name, lowered, node.span);
}

bool Parser::arguments(std::vector<ExpressionId>& out) {
    if (accept(TokenKind::right_parenthesis)) return true;
    do {
        const Parsed one = argument();
        if (!one) return false;
        out.push_back(one.id);
    } while (accept(TokenKind::comma));
    return expect(TokenKind::right_parenthesis, "arguments are separated by commas");
}

// argument = array | text | expression
Parsed Parser::argument() {
    const bool alone = next_.kind == TokenKind::comma || next_.kind == TokenKind::right_parenthesis;
    if (!alone) return value_expression();
    ExpressionNode node;
    node.span = current_.span;
    if (at(TokenKind::text)) {
        node.kind = ExpressionKind::text;
        node.symbol = static_cast<std::uint32_t>(program_.texts.size());
        const std::string_view quoted = source_.text(current_.span);
        program_.texts.emplace_back(quoted.substr(1, quoted.size() - 2));
        advance();
        return {add(std::move(node))};
    }
    if (!at(TokenKind::identifier)) return value_expression();
    const auto array = find_array(lower(current_));
    if (!array) return value_expression();
    node.kind = ExpressionKind::array;
    node.symbol = *array;
    advance();
    return {add(std::move(node))};
}

Parsed Parser::builtin_call(const Token& name, const BuiltinInfo& builtin, ExpressionNode node) {
    if (node.operands.size() != static_cast<std::size_t>(builtin.arity)) {
        report_.report(
            Code::wrong_argument_count, node.span,
            {fmt::format("{} takes {}, not {}", quote(name.span),
                         plural(static_cast<std::size_t>(builtin.arity), "argument"), node.operands.size()),
             plural(node.operands.size(), "argument"),
             builtin.name == "max" || builtin.name == "min" ? "nest the calls: max(max(p, q), r)" : ""});
        return placeholder(node.span);
    }
    for (ExpressionId operand : node.operands) {
        const ExpressionNode& given = program_.expressions[operand];
        if (fits(shapes::ArgumentKind::number, given.kind)) continue;
        report_.report(Code::wrong_argument_kind, given.span,
                       {fmt::format("{} takes a number, not an array or a text", quote(name.span)),
                        "a number is expected", "write an item of the array, such as x[1]"});
        return placeholder(node.span);
    }
    node.kind = ExpressionKind::builtin;
    node.builtin = builtin.builtin;
    return {add(std::move(node))};
}

bool Parser::kinds_fit(const shapes::LibraryFunction& row, const ExpressionNode& node) const {
    for (std::size_t i = 0; i < node.operands.size(); ++i)
        if (!fits(row.arguments[i].kind, program_.expressions[node.operands[i]].kind)) return false;
    return true;
}

/// The first argument of the wrong kind.
void Parser::report_kind(const Token& name, const shapes::LibraryFunction& row, const ExpressionNode& node) {
    for (std::size_t i = 0; i < node.operands.size(); ++i) {
        const ExpressionNode& given = program_.expressions[node.operands[i]];
        const auto& wanted = row.arguments[i];
        if (fits(wanted.kind, given.kind)) continue;
        return report_.report(Code::wrong_argument_kind, given.span,
                              {fmt::format("argument {} of {}, `{}`, must be {}", i + 1, quote(name.span),
                                           wanted.name, noun_of(wanted.kind)),
                               fmt::format("{} is expected", noun_of(wanted.kind)), signature(row)});
    }
}

/// Several rows of one name are alternatives: the first that fits is called.
Parsed Parser::library_call(const Token& name, std::span<const shapes::LibraryFunction> rows,
                            ExpressionNode node) {
    const shapes::LibraryFunction* near_miss = nullptr;
    std::string counts;
    std::string forms;
    for (const auto& row : rows) {
        if (row.arguments.size() == node.operands.size()) {
            if (kinds_fit(row, node)) {
                node.kind = ExpressionKind::library_call;
                node.function = &row;
                return {add(std::move(node))};
            }
            if (!near_miss) near_miss = &row;
        }
        counts += fmt::format("{}{}", counts.empty() ? "" : " or ", row.arguments.size());
        forms += fmt::format("{}{}", forms.empty() ? "" : " or ", signature(row));
    }
    if (near_miss)
        report_kind(name, *near_miss, node);
    else
        report_.report(Code::wrong_argument_count, node.span,
                       {fmt::format("{} takes {} argument{}, not {}", quote(name.span), counts,
                                    counts == "1" ? "" : "s", node.operands.size()),
                        plural(node.operands.size(), "argument"), forms});
    return placeholder(node.span);
}

bool Parser::only_arrays(const Token& name, const ExpressionNode& node) {
    for (ExpressionId operand : node.operands) {
        const ExpressionNode& given = program_.expressions[operand];
        if (given.kind == ExpressionKind::array) continue;
        report_.report(Code::wrong_argument_kind, given.span,
                       {fmt::format("the object {} takes arrays, by their names", quote(name.span)),
                        "the name of an array is expected",
                        "put the values into an array first: array p[3]; p[1] = ...;"});
        return false;
    }
    return true;
}

/// Arrays must have exactly the sizes of the callee's header.
bool Parser::lengths_fit(const Token& name, const Object& callee, const ExpressionNode& node) {
    if (!scope_.sizes_known) return true;
    for (std::size_t i = 0; i < node.operands.size(); ++i) {
        const ExpressionNode& given = program_.expressions[node.operands[i]];
        const ArrayInfo& array = object_now().arrays[given.symbol];
        const ArrayInfo& wanted = callee.arrays[i];
        if (array.size == wanted.size) continue;
        report_.report(
            Code::wrong_array_length, given.span,
            {fmt::format("{} has {}, but {} of {} has {}", quote(given.span), plural(array.size, "item"),
                         wanted.name, quote(name.span), plural(wanted.size, "item")),
             fmt::format("{} expected", plural(wanted.size, "item")),
             "copy the items into an array of the size that the object's header declares"});
        return false;
    }
    if (node.operands.size() == 2 && callee.arrays[array_s].size != 1) {
        report_.report(Code::wrong_array_length, node.span,
                       {fmt::format("{} has {} attributes, so its call needs a third array", quote(name.span),
                                    callee.arrays[array_s].size),
                        "two arrays",
                        fmt::format("add an array of {} as the third argument",
                                    plural(callee.arrays[array_s].size, "item"))});
        return false;
    }
    return true;
}

Parsed Parser::object_call(const Token& name, std::uint32_t object, ExpressionNode node) {
    const Object& callee = program_.objects[object];
    if (node.operands.size() != 2 && node.operands.size() != 3) {
        report_.report(Code::wrong_argument_count, node.span,
                       {fmt::format("the object {} takes 2 or 3 arrays, not {}", quote(name.span),
                                    plural(node.operands.size(), "argument")),
                        plural(node.operands.size(), "argument"),
                        "the arrays are the point, the parameters and, if wanted, the attributes"});
        return placeholder(node.span);
    }
    if (!only_arrays(name, node) || !lengths_fit(name, callee, node)) return placeholder(node.span);
    node.kind = ExpressionKind::object_call;
    node.symbol = object;
    return {add(std::move(node))};
}

Parsed Parser::unknown_call(const Token& name, const std::string& lowered, Span span) {
    const std::string shown = quote(name.span);
    if (lowered == scope_.name) {
        report_.report(Code::object_not_defined_yet, name.span,
                       {fmt::format("the object {} calls itself", shown), "recursion",
                        "objects call only objects that stand before them; repeat with while ... loop"});
    } else if (const auto array = find_array(lowered)) {
        report_.report(
            Code::unknown_function, name.span,
            {fmt::format("{} is an array, not a function", shown),
             {},
             fmt::format("an item is written in brackets: {}[1]", source_.text(name.span).substr(0, 60))});
    } else if (find_scalar(lowered)) {
        report_.report(Code::unknown_function, name.span,
                       {fmt::format("{} is a variable, not a function", shown),
                        {},
                        "a product needs its sign: y * (1 + z)"});
    } else if (const auto place = defined_later(lowered)) {
        report_.report(Code::object_not_defined_yet, name.span,
                       {fmt::format("the object {} is defined after its use", shown), "not known yet",
                        fmt::format("move its definition, in line {}, before this object",
                                    source_.locate(place->begin).line)});
    } else {
        report_.report(Code::unknown_function, name.span,
                       {fmt::format("there is no function or object {}", shown), "unknown",
                        suggestion(lowered, false, false, true)});
    }
    return placeholder(span);
}

}  // namespace frep::lang
