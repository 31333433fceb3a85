// Rules of statements: assignments, if, while. hyperfun.md a.4. Tested by tests/unit/lang/parser_test.cpp and
// tests/lang/statement_*.hf.
#include <utility>

#include <fmt/format.h>

#include "frep/lang/parser_impl.h"

namespace frep::lang {

StatementId Parser::add(StatementNode node) {
    program_.statements.push_back(std::move(node));
    return static_cast<StatementId>(program_.statements.size() - 1);
}

// statements = { statement ";" }
Statements Parser::statements() {
    Statements list;
    for (;;) {
        switch (current_.kind) {
            case TokenKind::right_brace:
                if (scope_.extra_braces == 0) return list;
                --scope_.extra_braces;
                advance();
                continue;
            case TokenKind::left_brace:
                ++scope_.extra_braces;
                syntax_error(Code::expected_statement, "a statement",
                             "blocks have no braces: if ... then ... endif; and while ... loop ... endloop;");
                advance();
                continue;
            case TokenKind::end:
            case TokenKind::key_else:
            case TokenKind::key_endif:
            case TokenKind::key_endloop:
                return list;
            case TokenKind::semicolon:
                report_.report(Code::empty_statement, current_.span,
                               {"this `;` ends nothing", {}, "a statement has one `;`: remove this one"});
                advance();
                continue;
            default:
                break;
        }
        if (at_elseif() || looks_like_header()) return list;
        if (!statement(list)) skip_statement();
    }
}

// statement = branch | loop | assignment
/// As every rule of a statement: adds it to `out` if it is whole; false when its end was not found.
bool Parser::statement(Statements& out) {
    if (scope_.result_seen && scope_.block_depth == 0 && !scope_.late_statement_reported) {
        scope_.late_statement_reported = true;
        report_.report(
            Code::statement_after_result, current_.span,
            {fmt::format("the value of {} is already assigned", quote(object_now().name_span)),
             "nothing may follow it", "the object's own name is assigned last, just before the brace"});
    }
    switch (current_.kind) {
        case TokenKind::key_if:
            return branch(out);
        case TokenKind::key_while:
            return loop(out);
        case TokenKind::identifier:
            return assignment(out);
        case TokenKind::key_array:
            report_.report(Code::late_declaration, current_.span,
                           {"arrays are declared before the first statement", "too late",
                            "move the declaration to the top of the body"});
            declaration();
            return true;
        default:
            break;
    }
    if (current_.kind >= TokenKind::key_array && next_.kind == TokenKind::equal) {
        check_new_name(current_, lower(current_), "a variable");
        return false;
    }
    syntax_error(Code::expected_statement, "a statement",
                 "a statement is an assignment, an `if` or a `while`");
    advance();
    return false;
}

// assignment = name "=" expression | name "[" expression "]" "=" expression | name "=" "[" list "]"
bool Parser::assignment(Statements& out) {
    const Token name = current_;
    const std::string lowered = lower(name);
    switch (next_.kind) {
        case TokenKind::equal:
            advance();
            advance();
            if (lowered == scope_.name) return result_assignment(name, out);
            if (const auto array = find_array(lowered)) return list_assignment(name, *array, out);
            return scalar_assignment(name, lowered, out);
        case TokenKind::left_bracket:
            return item_assignment(name, lowered, out);
        case TokenKind::left_parenthesis:
            return call_statement(name);
        default:
            advance();
            syntax_error(Code::expected_token, "`=`",
                         fmt::format("a statement begins with what it assigns: {} = ...;",
                                     source_.text(name.span).substr(0, 60)));
            return false;
    }
}

// result = own_name "=" expression
bool Parser::result_assignment(const Token& name, Statements& out) {
    if (scope_.block_depth > 0)
        scope_.results_in_block.push_back(name.span);
    else
        scope_.result_seen = true;
    const Parsed value = value_expression();
    if (!value) return false;
    StatementNode node;
    node.kind = StatementKind::result;
    node.value = value.id;
    node.target_span = name.span;
    node.span = join(name.span, previous_);
    out.push_back(add(std::move(node)));
    return expect_semicolon("the value");
}

/// The target is known before its right side is read: `y = y + 1;` is accepted, as by the old tools.
bool Parser::scalar_assignment(const Token& name, const std::string& lowered, Statements& out) {
    StatementNode node;
    node.kind = StatementKind::assign;
    node.target_span = name.span;
    if (!find_scalar(lowered)) check_new_name(name, lowered, "a variable");
    node.symbol = scalar_symbol(lowered);
    if (at(TokenKind::left_bracket)) {
        report_.report(Code::unknown_array, name.span,
                       {fmt::format("{} is not an array", quote(name.span)), "assigned a list",
                        "declare it at the top of the body: array name[size];"});
        return false;
    }
    const Parsed value = value_expression();
    if (!value) return false;
    node.value = value.id;
    node.span = join(name.span, previous_);
    out.push_back(add(std::move(node)));
    return expect_semicolon("the assignment");
}

// item_assignment = array "[" expression "]" "=" expression
bool Parser::item_assignment(const Token& name, const std::string& lowered, Statements& out) {
    advance();
    const auto array = find_array(lowered);
    const Parsed target = item(name, lowered);
    if (!target) return false;
    if (array == array_a)
        report_.report(Code::parameter_assigned, name.span,
                       {"the parameters `a` cannot be changed", "is a parameter",
                        "copy the value to a variable, or the items to a local array, and change that"});
    if (!expect(TokenKind::equal, "an item of an array is assigned like this: p[1] = 2;")) return false;
    const Parsed value = value_expression();
    if (!value) return false;
    if (!array) return expect_semicolon("the assignment");
    StatementNode node;
    node.kind = StatementKind::assign_item;
    node.symbol = *array;
    node.index = program_.expressions[target.id].operands.front();
    node.value = value.id;
    node.target_span = program_.expressions[target.id].span;
    node.span = join(name.span, previous_);
    out.push_back(add(std::move(node)));
    return expect_semicolon("the assignment");
}

// list_assignment = array "=" "[" expression { "," expression } "]"
bool Parser::list_assignment(const Token& name, std::uint32_t array, Statements& out) {
    if (array == array_a)
        report_.report(Code::parameter_assigned, name.span,
                       {"the parameters `a` cannot be changed", "is a parameter",
                        "copy what you need to a local array and change that"});
    if (!at(TokenKind::left_bracket)) {
        if (at(TokenKind::invalid)) return false;
        report_.report(Code::array_assigned, place_of_missing(),
                       {fmt::format("the array {} cannot be assigned as a whole", quote(name.span)),
                        "a list in brackets is expected",
                        "assign a list, p = [1, 2, 3];, or one item after the other, p[1] = x[1];"});
        return false;
    }
    StatementNode node;
    node.kind = StatementKind::assign_list;
    node.symbol = array;
    node.target_span = name.span;
    const ArrayInfo target = object_now().arrays[array];
    if (!list_items(node, target)) return false;
    node.span = join(name.span, previous_);
    out.push_back(add(std::move(node)));
    return expect_semicolon("the list");
}

/// The bracketed list of `node`; its length must be the array's.
bool Parser::list_items(StatementNode& node, const ArrayInfo& target) {
    const Span bracket = current_.span;
    advance();
    if (!at(TokenKind::right_bracket)) {
        do {
            const Parsed value = value_expression();
            if (!value) return false;
            node.list.push_back(value.id);
        } while (accept(TokenKind::comma));
    }
    if (!expect(TokenKind::right_bracket, "items of a list are separated by commas")) return false;
    if (scope_.sizes_known && node.list.size() != target.size)
        report_.report(
            Code::wrong_list_length, join(bracket, previous_),
            {fmt::format("the list has {} items, the array {} has {}", node.list.size(),
                         quote(node.target_span), target.size),
             fmt::format("{} items", node.list.size()), "give one value for every item of the array"});
    return true;
}

/// `hfScale3D(xt, ...);` alone: read, so that the rest of it is checked, and refused.
bool Parser::call_statement(const Token& name) {
    const std::string lowered = lower(name);
    report_.report(Code::expected_statement, name.span,
                   {fmt::format("the call of {} is not a statement", quote(name.span)),
                    "its value goes nowhere", "assign the value, even where it is of no use: t = ...;"});
    advance();
    return call(name, lowered) && expect_semicolon("the call");
}

/// `elseif`, which is no reserved word: a variable of that name is told by what follows.
bool Parser::at_elseif() const {
    return scope_.open_ifs > 0 && at(TokenKind::identifier) && next_.kind != TokenKind::equal &&
           next_.kind != TokenKind::left_bracket && current_.span.end - current_.span.begin == 6 &&
           lower(current_) == "elseif";
}

// branch = "if" condition "then" statements { "elseif" condition "then" statements }
//          [ "else" statements ] "endif"
bool Parser::branch(Statements& out) {
    const Token opener = current_;
    if (!enter(opener.span)) return false;
    advance();
    StatementNode node;
    node.kind = StatementKind::branch;
    node.target_span = opener.span;
    const auto value = block_condition(TokenKind::key_then);
    ++scope_.block_depth;
    ++scope_.open_ifs;
    node.first = statements();
    const bool closed = branch_tail(node, opener);
    --scope_.open_ifs;
    --scope_.block_depth;
    leave();
    node.span = join(opener.span, previous_);
    if (value) {
        node.value = *value;
        out.push_back(add(std::move(node)));
    }
    return closed;
}

/// What follows the first list of a branch, to the `;` after `endif`. An `elseif` is an `if` in the second
/// list, closed by the same `endif`.
bool Parser::branch_tail(StatementNode& node, const Token& opener) {
    if (at_elseif()) return branch(node.second);
    if (accept(TokenKind::key_else)) {
        node.second = statements();
        while (at(TokenKind::key_else) || at_elseif()) {
            stray_end();
            statements();
        }
    }
    return close_block(TokenKind::key_endif, opener);
}

// loop = "while" condition "loop" statements "endloop"
bool Parser::loop(Statements& out) {
    const Token opener = current_;
    if (!enter(opener.span)) return false;
    advance();
    StatementNode node;
    node.kind = StatementKind::loop;
    node.target_span = opener.span;
    const auto value = block_condition(TokenKind::key_loop);
    ++scope_.block_depth;
    ++scope_.open_loops;
    const int ifs_outside = std::exchange(scope_.open_ifs, 0);
    node.first = statements();
    scope_.open_ifs = ifs_outside;
    const bool closed = close_block(TokenKind::key_endloop, opener);
    --scope_.open_loops;
    --scope_.block_depth;
    leave();
    node.span = join(opener.span, previous_);
    if (value) {
        node.value = *value;
        out.push_back(add(std::move(node)));
    }
    return closed;
}

/// A condition and the word after it. After an error reading goes on at that word, where there is one.
std::optional<ExpressionId> Parser::block_condition(TokenKind follower) {
    const bool is_if = follower == TokenKind::key_then;
    const Parsed value = condition();
    const std::string help =
        is_if ? "if condition then statements endif;" : "while condition loop statements endloop;";
    if (value && expect(follower, help)) return value.id;
    if (value && begins_statement()) return std::nullopt;
    while (!at(follower) && !at(TokenKind::semicolon) && !at(TokenKind::right_brace) && !at(TokenKind::end) &&
           !at(TokenKind::key_endif) && !at(TokenKind::key_endloop) && !at(TokenKind::key_else) &&
           !at(TokenKind::key_if) && !at(TokenKind::key_while))
        advance();
    if (at(follower) || at(TokenKind::semicolon)) advance();
    return std::nullopt;
}

/// Known once the outermost block is closed: where it is not, that is the mistake.
void Parser::report_results_in_block() {
    for (Span place : scope_.results_in_block)
        report_.report(Code::result_in_block, place,
                       {fmt::format("the value of {} is assigned inside a block", quote(place)),
                        "must stand outside of `if` and `while`",
                        "give the value to a variable here, and that to the object's name at the end"});
    scope_.results_reported = scope_.results_reported || !scope_.results_in_block.empty();
    scope_.results_in_block.clear();
}

/// The closing word of a block and its `;`. A wrong closing word counts as ours when no outer block could
/// want it.
bool Parser::close_block(TokenKind closer, const Token& opener) {
    if (accept(closer)) {
        if (scope_.block_depth == 1) report_results_in_block();
        return expect_semicolon(to_string(closer));
    }
    report_.report(
        Code::unclosed_block, opener.span,
        {fmt::format("this {} has no {}", to_string(opener.kind), to_string(closer)), "opened here",
         fmt::format("expected {} before {} in line {}", to_string(closer), to_string(current_.kind),
                     source_.locate(current_.span.begin).line)});
    const bool wanted_outside = closer == TokenKind::key_endif ? scope_.open_loops > 0 : scope_.open_ifs > 0;
    if (!wanted_outside && (at(TokenKind::key_endif) || at(TokenKind::key_endloop))) {
        advance();
        accept(TokenKind::semicolon);
    }
    return true;
}

}  // namespace frep::lang
