// Rules of expressions and conditions, which have one grammar: what may stand where is checked on the way.
// Precedence as in hyperfun.md a.5, with a warning at each place where it surprises. Tested by
// tests/unit/lang/parser_test.cpp and tests/lang/expression_*.hf, condition_*.hf, surprise_*.hf.
#include <cmath>

#include <fmt/format.h>

#include "frep/lang/parser_impl.h"

namespace frep::lang {
namespace {

bool is_set_operation(Operator op) {
    return op == Operator::unite || op == Operator::intersect || op == Operator::subtract_solid ||
           op == Operator::product;
}

std::optional<Operator> sum_operator(TokenKind kind) {
    switch (kind) {
        case TokenKind::plus:
            return Operator::add;
        case TokenKind::minus:
            return Operator::subtract;
        case TokenKind::bar:
            return Operator::unite;
        case TokenKind::ampersand:
            return Operator::intersect;
        case TokenKind::backslash:
            return Operator::subtract_solid;
        case TokenKind::at:
            return Operator::product;
        default:
            return std::nullopt;
    }
}

std::optional<Operator> relation_operator(TokenKind kind) {
    switch (kind) {
        case TokenKind::less:
            return Operator::less;
        case TokenKind::less_equal:
            return Operator::less_equal;
        case TokenKind::greater:
            return Operator::greater;
        case TokenKind::greater_equal:
            return Operator::greater_equal;
        case TokenKind::equal:
            return Operator::equal;
        case TokenKind::not_equal:
            return Operator::not_equal;
        default:
            return std::nullopt;
    }
}

std::optional<Operator> sign_operator(TokenKind kind) {
    if (kind == TokenKind::plus) return Operator::plus;
    if (kind == TokenKind::minus) return Operator::minus;
    if (kind == TokenKind::tilde) return Operator::complement;
    return std::nullopt;
}

}  // namespace

std::optional<Operator> binary_operator(TokenKind kind, Level level) {
    switch (level) {
        case Level::logical:
            if (kind == TokenKind::key_and) return Operator::logical_and;
            if (kind == TokenKind::key_or) return Operator::logical_or;
            return std::nullopt;
        case Level::relation:
            return relation_operator(kind);
        case Level::sum:
            return sum_operator(kind);
        case Level::product:
            if (kind == TokenKind::star) return Operator::multiply;
            if (kind == TokenKind::slash) return Operator::divide;
            return std::nullopt;
        case Level::power:
            if (kind == TokenKind::caret) return Operator::power;
            return std::nullopt;
    }
    return std::nullopt;
}

ExpressionId Parser::add(ExpressionNode node) {
    if (program_.expressions.size() >= expression_limit && !report_.stopped())
        report_.fatal(Code::program_too_large, node.span,
                      {fmt::format("this file has more than {} values and operations", expression_limit),
                       {},
                       "keep large data outside of the model"});
    program_.expressions.push_back(std::move(node));
    return static_cast<ExpressionId>(program_.expressions.size() - 1);
}

/// Stands for an expression that was reported, so that the rest can be checked.
Parsed Parser::placeholder(Span span) {
    ExpressionNode node;
    node.span = span;
    return {add(std::move(node))};
}

// expression = sum; a condition here is reported
Parsed Parser::value_expression() {
    Parsed value = condition();
    if (value && value.condition) {
        report_.report(
            Code::condition_outside, span_of(value.id),
            {"a comparison is not a value", "a condition",
             "comparisons, `and`, `or` and `not` stand only after `if` and `while`: if a > b then y = 1; "
             "else y = 0; endif;"});
        value.condition = false;
    }
    return value;
}

// condition = relation { ( "and" | "or" ) relation }
// relation  = operand { ( "<" | "<=" | ">" | ">=" | "=" | "/=" ) operand }
// operand   = "not" operand | sum
// sum       = product { ( "+" | "-" | "|" | "&" | "\" | "@" ) product }
// product   = power { ( "*" | "/" ) power }
// power     = unary { "^" unary }
Parsed Parser::chain(Level level) {
    const std::uint32_t begin = current_.span.begin;
    Parsed operand = operand_of(level);
    if (!operand || !binary_operator(current_.kind, level)) return operand;
    check_operand(level, operand);
    if (level == Level::relation && operand.bare_not)
        report_.report(
            Code::not_before_comparison, span_of(operand.id),
            {"`not` belongs to what follows it, not to the comparison", "this is negated first",
             "write not (a > b) to negate the comparison, or (not a) > b to say that this is meant"});
    ExpressionNode node;
    node.kind = ExpressionKind::chain;
    node.operands.push_back(operand.id);
    while (const auto op = binary_operator(current_.kind, level)) {
        const Span base = {begin, previous_.end};
        const bool signed_base = level == Level::power && operand.bare_sign;
        node.operators.push_back(*op);
        node.operator_spans.push_back(current_.span);
        advance();
        operand = operand_of(level);
        if (!operand) return {};
        check_operand(level, operand);
        if (signed_base) warn_of_power(base, operand);
        node.operands.push_back(operand.id);
    }
    node.span = {begin, previous_.end};
    warn_of_surprises(level, node);
    return {add(std::move(node)), level == Level::logical || level == Level::relation};
}

Parsed Parser::operand_of(Level level) {
    switch (level) {
        case Level::logical:
            return chain(Level::relation);
        case Level::relation:
            return at(TokenKind::key_not) ? negation() : chain(Level::sum);
        case Level::sum:
            return chain(Level::product);
        case Level::product:
            return chain(Level::power);
        case Level::power:
            return signed_primary();
    }
    return {};
}

/// Arithmetic takes no truth values.
void Parser::check_operand(Level level, const Parsed& operand) {
    if (!operand.condition || level == Level::logical || level == Level::relation) return;
    report_.report(Code::condition_in_arithmetic, span_of(operand.id),
                   {"a comparison cannot be part of a calculation", "a condition",
                    "choose with `if` instead, or compare two values only"});
}

void Parser::warn_of_power(Span base, const Parsed& exponent) {
    const auto power = literal(exponent.id);
    if (power && std::fmod(*power, 2) != 0 && std::floor(*power) == *power)
        return;  // -x^3 is the same both ways
    report_.report(Code::sign_before_power, base,
                   {"the sign belongs to the base: this is (-x)^2, not -(x^2)", "the sign comes first",
                    "write -(x^2) or (-x)^2 to say which is meant"});
}

/// The precedence of the old tools, where readers expect another.
void Parser::warn_of_surprises(Level level, const ExpressionNode& node) {
    const auto& ops = node.operators;
    if (level == Level::sum) {
        bool set_seen = false;
        for (std::size_t i = 0; i < ops.size(); ++i) {
            if (is_set_operation(ops[i]))
                set_seen = true;
            else if (set_seen)
                return report_.report(
                    Code::sum_after_set_operation, node.operator_spans[i],
                    {fmt::format("{} after a set operation works on its result: a|b+c is (a|b)+c",
                                 quote(node.operator_spans[i])),
                     "read from left to right", "write a|(b+c) or (a|b)+c to say which is meant"});
        }
    } else if (level == Level::relation && ops.size() > 1) {
        report_.report(Code::chained_comparison, node.operator_spans[1],
                       {"this compares the result of the first comparison, 0 or 1: 2<=x<5 is (2<=x)<5",
                        "compares 0 or 1", "for a range write (2<=x) and (x<5)"});
    } else if (level == Level::logical) {
        for (std::size_t i = 1; i < ops.size(); ++i)
            if (ops[i] != ops[0])
                return report_.report(
                    Code::mixed_and_or, node.operator_spans[i],
                    {"`and` and `or` bind equally, from left to right: a or b and c is (a or b) and c",
                     "applies to all before it", "write a or (b and c), or (a or b) and c"});
    } else if (level == Level::power && ops.size() > 1) {
        report_.report(Code::repeated_power, node.operator_spans[1],
                       {"powers are read from left to right: 2^3^2 is (2^3)^2", "applies to all before it",
                        "write (a^b)^c or a^(b^c) to say which is meant"});
    }
}

// operand = "not" operand
Parsed Parser::negation() {
    const Token word = current_;
    if (!enter(word.span)) return {};
    advance();
    const Parsed operand = at(TokenKind::key_not) ? negation() : chain(Level::sum);
    leave();
    if (!operand) return {};
    ExpressionNode node;
    node.kind = ExpressionKind::unary;
    node.operators = {Operator::logical_not};
    node.operator_spans = {word.span};
    node.operands = {operand.id};
    node.span = {word.span.begin, previous_.end};
    return {add(std::move(node)), true, false, true};
}

// unary = { "+" | "-" | "~" } primary
Parsed Parser::signed_primary() {
    std::vector<Operator> signs;
    std::vector<Span> places;
    Parsed result;
    while (const auto sign = sign_operator(current_.kind)) {
        if (!enter(current_.span)) break;  // reported; the end of the file follows
        signs.push_back(*sign);
        places.push_back(current_.span);
        result.bare_sign = result.bare_sign || *sign != Operator::plus;
        advance();
    }
    const Parsed operand = report_.stopped() ? Parsed{} : primary();
    depth_ -= static_cast<int>(signs.size());
    if (!operand || signs.empty()) return operand;
    check_operand(Level::power, operand);
    result.id = operand.id;
    for (std::size_t i = signs.size(); i-- > 0;) {
        ExpressionNode node;
        node.kind = ExpressionKind::unary;
        node.operators = {signs[i]};
        node.operator_spans = {places[i]};
        node.operands = {result.id};
        node.span = {places[i].begin, previous_.end};
        result.id = add(std::move(node));
    }
    return result;
}

// primary = number | "(" condition ")" | name | name "[" expression "]" | name "(" arguments ")"
Parsed Parser::primary() {
    switch (current_.kind) {
        case TokenKind::number:
            return number_literal();
        case TokenKind::left_parenthesis:
            return parenthesised();
        case TokenKind::identifier:
            return named();
        case TokenKind::text:
            report_.report(Code::text_outside_call, current_.span,
                           {"a text is not a value",
                            {},
                            "texts are arguments of library functions, such as file names"});
            advance();
            return placeholder(previous_);
        case TokenKind::key_not:
            report_.report(
                Code::condition_in_arithmetic, current_.span,
                {"`not` cannot be part of a calculation",
                 {},
                 "`not` stands at the beginning of a condition or behind `and`, `or` and a comparison"});
            return {};
        default:
            break;
    }
    const bool mark = current_.kind != TokenKind::end && binary_operator(current_.kind, Level::relation);
    const bool list = at(TokenKind::left_bracket);
    syntax_error(Code::expected_expression, "an expression",
                 mark   ? "a value is missing before the comparison"
                 : list ? "an array is given by its name: `array c[3]` first, then `c = [1, 2, 3];`"
                        : "");
    return {};
}

Parsed Parser::number_literal() {
    ExpressionNode node;
    node.kind = ExpressionKind::number;
    node.value = current_.value;
    node.span = current_.span;
    advance();
    return {add(std::move(node))};
}

Parsed Parser::parenthesised() {
    if (!enter(current_.span)) return {};
    advance();
    Parsed inner = condition();
    leave();
    if (!inner || !expect(TokenKind::right_parenthesis)) return {};
    inner.bare_sign = inner.bare_not = false;
    return inner;
}

/// The value of a literal number, signed or not.
std::optional<double> Parser::literal(ExpressionId id) const {
    const ExpressionNode& node = program_.expressions[id];
    if (node.kind == ExpressionKind::number) return node.value;
    if (node.kind != ExpressionKind::unary || node.operators[0] == Operator::logical_not) return std::nullopt;
    const ExpressionNode& inner = program_.expressions[node.operands[0]];
    if (inner.kind != ExpressionKind::number) return std::nullopt;
    return node.operators[0] == Operator::plus ? inner.value : -inner.value;
}

}  // namespace frep::lang
