// Helpers of the language's tests: parse a text, list what was found.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "frep/lang/parser.h"

namespace frep::lang::test {

struct Parse {
    Source source;
    Diagnostics diagnostics;
    Program program;
};

inline Parse parse_text(std::string_view text) {
    Parse result{Source("test.hf", text), {}, {}};
    result.program = parse(result.source, result.diagnostics);
    return result;
}

/// "error HF012 at 3:7" for each finding.
inline std::vector<std::string> findings(const Parse& parse) {
    std::vector<std::string> list;
    for (const Diagnostic& d : parse.diagnostics.list()) {
        const LineColumn place = parse.source.locate(d.span.begin);
        list.push_back(std::string(to_string(d.severity)) + " " + d.code + " at " +
                       std::to_string(place.line) + ":" + std::to_string(place.column));
    }
    return list;
}

inline std::vector<std::string> findings(std::string_view text) { return findings(parse_text(text)); }

inline bool has_code(const Diagnostics& diagnostics, std::string_view code) {
    return std::any_of(diagnostics.list().begin(), diagnostics.list().end(),
                       [&](const auto& d) { return d.code == code; });
}

inline std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A model whose body is `body`.
inline std::string model(std::string_view body) {
    return "my_model(x[3], a[2])\n{\n" + std::string(body) + "\n}\n";
}

/// The expression as text with all its parentheses, to compare trees: "((1 + 2) | 3)".
inline std::string shape_of(const Program& program, ExpressionId id) {
    constexpr const char* marks[] = {"+", "-",  "|", "&",  "\\",  "@",  "*", "/", "^", "<",   "<=",
                                     ">", ">=", "=", "/=", "and", "or", "+", "-", "~", "not "};
    const ExpressionNode& node = program.expressions[id];
    const auto mark = [&](std::size_t i) {
        return std::string(marks[static_cast<std::size_t>(node.operators[i])]);
    };
    std::string text;
    switch (node.kind) {
        case ExpressionKind::number:
            text = std::to_string(node.value);
            text.erase(text.find_last_not_of("0") + 1);
            return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
        case ExpressionKind::scalar:
            return program.objects.back().scalars[node.symbol];
        case ExpressionKind::array:
            return program.objects.back().arrays[node.symbol].name;
        case ExpressionKind::item:
            return program.objects.back().arrays[node.symbol].name + "[" +
                   shape_of(program, node.operands[0]) + "]";
        case ExpressionKind::text:
            return "\"" + program.texts[node.symbol] + "\"";
        case ExpressionKind::unary:
            return "(" + mark(0) + shape_of(program, node.operands[0]) + ")";
        case ExpressionKind::chain:
            text = shape_of(program, node.operands[0]);
            for (std::size_t i = 0; i < node.operators.size(); ++i)
                text = "(" + text + " " + mark(i) + " " + shape_of(program, node.operands[i + 1]) + ")";
            return text;
        case ExpressionKind::builtin:
            text = "builtin" + std::to_string(static_cast<int>(node.builtin));
            break;
        case ExpressionKind::library_call:
            text = node.function->name;
            break;
        case ExpressionKind::object_call:
            text = program.objects[node.symbol].name;
            break;
    }
    text += "(";
    for (std::size_t i = 0; i < node.operands.size(); ++i)
        text += (i ? ", " : "") + shape_of(program, node.operands[i]);
    return text + ")";
}

}  // namespace frep::lang::test
