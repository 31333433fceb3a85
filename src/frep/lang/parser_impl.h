// The parser's class, shared by the parser_*.cpp files: recursive descent over the token stream, one member
// function for a rule of the grammar, which stands above it. A rule that fails has reported why and answers
// "no value"; the statement that contains it skips to its end and parsing goes on. Nesting is counted
// (nesting_limit); chains of operators are loops. Tested by tests/unit/lang/parser_test.cpp.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frep/lang/ast.h"
#include "frep/lang/lexer.h"
#include "frep/lang/limits.h"
#include "frep/lang/names.h"
#include "frep/lang/report.h"

namespace frep::lang {

inline constexpr ExpressionId no_expression = std::numeric_limits<ExpressionId>::max();

using Statements = std::vector<StatementId>;

/// An expression just read, and what its context must know of it.
struct Parsed {
    ExpressionId id = no_expression;
    bool condition = false;  ///< a comparison or a logical operation: allowed in conditions only
    bool bare_sign = false;  ///< begins with a `-` or `~` of its own, not in parentheses
    bool bare_not = false;   ///< is `not` and its operand, not in parentheses
    explicit operator bool() const { return id != no_expression; }
};

/// Levels of precedence, loosest first. Each is one left-associative chain.
enum class Level : std::uint8_t { logical, relation, sum, product, power };

/// The operator that a token stands for at a level, if any.
std::optional<Operator> binary_operator(TokenKind kind, Level level);

class Parser {
  public:
    Parser(const Source& source, Reporter& report);

    // program = object { object }
    Program run();

  private:
    // --- tokens (parser.cpp)
    void advance();
    bool at(TokenKind kind) const { return current_.kind == kind; }
    bool accept(TokenKind kind);
    bool expect(TokenKind kind, std::string help = {});
    bool expect_semicolon(std::string_view after);
    void syntax_error(Code code, std::string_view expected, std::string help = {});
    Span place_of_missing() const;
    void skip_statement();
    bool begins_statement() const;
    bool enter(Span where);
    void leave() { --depth_; }

    // --- objects (parser_objects.cpp)
    void object();
    void object_name(const Token& name);
    void note_name(const Token& name, const std::string& lower);
    bool header();
    bool header_array(std::string_view name, double limit);
    std::optional<double> array_size();
    void declarations();
    void declaration();
    void declared_array(const Token& name, double size);
    void body(Span brace);
    void stray_end();
    void text_outside();
    bool looks_like_header() const;

    // --- statements (parser_statements.cpp)
    Statements statements();
    bool statement(Statements& out);
    bool assignment(Statements& out);
    bool result_assignment(const Token& name, Statements& out);
    bool scalar_assignment(const Token& name, const std::string& lower, Statements& out);
    bool item_assignment(const Token& name, const std::string& lower, Statements& out);
    bool list_assignment(const Token& name, std::uint32_t array, Statements& out);
    bool list_items(StatementNode& node, const ArrayInfo& target);
    bool call_statement(const Token& name);
    bool branch(Statements& out);
    bool branch_tail(StatementNode& node, const Token& opener);
    bool loop(Statements& out);
    void report_results_in_block();
    bool close_block(TokenKind closer, const Token& opener);
    std::optional<ExpressionId> block_condition(TokenKind follower);
    bool at_elseif() const;
    StatementId add(StatementNode node);

    // --- expressions (parser_expressions.cpp)
    Parsed condition() { return chain(Level::logical); }
    Parsed value_expression();
    Parsed chain(Level level);
    Parsed operand_of(Level level);
    Parsed negation();
    Parsed signed_primary();
    Parsed primary();
    Parsed parenthesised();
    Parsed number_literal();
    void check_operand(Level level, const Parsed& operand);
    void warn_of_surprises(Level level, const ExpressionNode& node);
    void warn_of_power(Span base, const Parsed& exponent);
    std::optional<double> literal(ExpressionId id) const;
    Parsed placeholder(Span span);
    ExpressionId add(ExpressionNode node);
    Span span_of(ExpressionId id) const { return program_.expressions[id].span; }

    // --- names (parser_names.cpp)
    Parsed named();
    Parsed scalar_value(const Token& name, const std::string& lower);
    Parsed item(const Token& name, const std::string& lower);
    void check_index(std::uint32_t array, ExpressionId index);
    std::optional<std::uint32_t> find_array(const std::string& lower) const;
    std::optional<std::uint32_t> find_scalar(const std::string& lower) const;
    std::optional<std::uint32_t> find_object(const std::string& lower) const;
    std::uint32_t scalar_symbol(const std::string& lower);
    bool check_new_name(const Token& name, const std::string& lower, std::string_view what);
    std::string suggestion(std::string_view name, bool scalars, bool arrays, bool functions) const;
    std::optional<Span> defined_later(const std::string& lower);
    std::string lower(const Token& token) const { return lower_case(source_.text(token.span)); }
    std::string quote(Span span) const { return report_.quote(span); }

    // --- calls (parser_calls.cpp)
    Parsed call(const Token& name, const std::string& lower);
    bool arguments(std::vector<ExpressionId>& out);
    Parsed argument();
    Parsed builtin_call(const Token& name, const BuiltinInfo& builtin, ExpressionNode node);
    Parsed library_call(const Token& name, std::span<const shapes::LibraryFunction> rows,
                        ExpressionNode node);
    Parsed object_call(const Token& name, std::uint32_t object, ExpressionNode node);
    Parsed unknown_call(const Token& name, const std::string& lower, Span span);
    bool kinds_fit(const shapes::LibraryFunction& row, const ExpressionNode& node) const;
    void report_kind(const Token& name, const shapes::LibraryFunction& row, const ExpressionNode& node);
    bool only_arrays(const Token& name, const ExpressionNode& node);
    bool lengths_fit(const Token& name, const Object& callee, const ExpressionNode& node);

    Object& object_now() { return program_.objects.back(); }
    const Object& object_now() const { return program_.objects.back(); }

    const Source& source_;
    Reporter& report_;
    Lexer lexer_;
    Token current_, next_;
    Span previous_;
    int depth_ = 0;

    Program program_;
    std::unordered_map<std::string, std::uint32_t> objects_;
    std::optional<std::unordered_map<std::string, Span>> all_objects_;  ///< filled when first asked for

    // Of the object that is being read.
    struct Scope {
        std::string name;
        bool sizes_known = true;
        bool result_seen = false;
        bool results_reported = false;
        bool late_statement_reported = false;
        int block_depth = 0;
        int open_ifs = 0;
        int open_loops = 0;
        int extra_braces = 0;
        std::vector<Span> results_in_block;
        double items = 0;
        std::unordered_map<std::string, std::uint32_t> arrays;
        std::unordered_map<std::string, std::uint32_t> scalars;
    };
    Scope scope_;
};

}  // namespace frep::lang
