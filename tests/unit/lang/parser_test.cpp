// The tree that parse() makes. What it finds wrong is tested by text_cases_test.cpp, hostile input by
// hostile_test.cpp.
#include "frep/lang/parser.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "lang_test.h"

using namespace frep::lang;
using namespace frep::lang::test;

namespace {

/// The tree of an expression in which y and z are variables.
std::string tree(std::string_view expression) {
    const Parse parse =
        parse_text(model("array p[3]; y = 0; z = 0; my_model = " + std::string(expression) + ";"));
    REQUIRE(!parse.diagnostics.has_errors());
    const StatementNode& result = parse.program.statements[parse.program.objects[0].body.back()];
    return shape_of(parse.program, result.value);
}

std::string condition_tree(std::string_view condition) {
    const Parse parse =
        parse_text(model("y = 0; z = 0; if " + std::string(condition) + " then y = 1; endif; my_model = y;"));
    REQUIRE(!parse.diagnostics.has_errors());
    for (const StatementNode& statement : parse.program.statements)
        if (statement.kind == StatementKind::branch) return shape_of(parse.program, statement.value);
    return {};
}

}  // namespace

TEST_CASE("precedence and associativity of arithmetic and set operations") {
    CHECK(tree("1+2*3") == "(1 + (2 * 3))");
    CHECK(tree("1-2-3") == "((1 - 2) - 3)");
    CHECK(tree("8/4*2") == "((8 / 4) * 2)");
    CHECK(tree("2^3^2") == "((2 ^ 3) ^ 2)");
    CHECK(tree("-y^2") == "((-y) ^ 2)");
    CHECK(tree("2^-2^2") == "((2 ^ (-2)) ^ 2)");
    CHECK(tree("-~y") == "(-(~y))");
    CHECK(tree("1|2+3") == "((1 | 2) + 3)");
    CHECK(tree("1+2|3") == "((1 + 2) | 3)");
    CHECK(tree("1|2&3") == "((1 | 2) & 3)");
    CHECK(tree("1\\2@3") == "((1 \\ 2) @ 3)");
    CHECK(tree("2*3|4*5") == "((2 * 3) | (4 * 5))");
    CHECK(tree("-(y+1)*2") == "((-(y + 1)) * 2)");
    CHECK(tree("1-(2-3)") == "(1 - (2 - 3))");
}

TEST_CASE("conditions") {
    CHECK(condition_tree("1 or 1 and 0") == "((1 or 1) and 0)");
    CHECK(condition_tree("2<=y<5") == "((2 <= y) < 5)");
    CHECK(condition_tree("not y>5") == "((not y) > 5)");
    CHECK(condition_tree("not y+1>5") == "((not (y + 1)) > 5)");
    CHECK(condition_tree("not (y>5)") == "(not (y > 5))");
    CHECK(condition_tree("not not y") == "(not (not y))");
    CHECK(condition_tree("y>1 and not z") == "((y > 1) and (not z))");
    CHECK(condition_tree("(y+1)*2>0") == "(((y + 1) * 2) > 0)");
    CHECK(condition_tree("(y-1)^2>0.5") == "(((y - 1) ^ 2) > 0.5)");
    CHECK(condition_tree("(y>0)=(z>0)") == "((y > 0) = (z > 0))");
    CHECK(condition_tree("1|2>3") == "((1 | 2) > 3)");
    CHECK(condition_tree("((y))") == "y");
}

TEST_CASE("items and calls") {
    CHECK(tree("x[1]+P[2]") == "(x[1] + p[2])");
    CHECK(tree("x[x[1]+1]") == "x[(x[1] + 1)]");
    CHECK(tree("hfSphere(x, p, 1+y)") == "hfSphere(x, p, (1 + y))");
    CHECK(tree("HFSPHERE(X, P, 1)") == "hfSphere(x, p, 1)");
    CHECK(tree("max(y, min(1, z))") == "builtin16(y, builtin17(1, z))");
}

TEST_CASE("the two forms of a library function are two rows") {
    const Parse parse =
        parse_text(model("my_model = hfA_SmoothStep(1, 2, 3) + hfA_SmoothStep(1, 2, 3, 4, 5, 6);"));
    REQUIRE(!parse.diagnostics.has_errors());
    for (const ExpressionNode& node : parse.program.expressions)
        if (node.kind == ExpressionKind::library_call)
            CHECK(node.function->arguments.size() == node.operands.size());
}

TEST_CASE("objects") {
    const Parse parse = parse_text(
        "Ball(X[2.5], A[0]) { Ball = 1; }\n"
        "my_model(x[3], a[2], s[4]) { array p[2.4], q[0.5]; Y = p[1]; z = y; my_model = z; }\n");
    CHECK(parse.diagnostics.empty());
    REQUIRE(parse.program.objects.size() == 2);
    const Object& ball = parse.program.objects[0];
    CHECK(ball.name == "ball");
    CHECK(ball.written_name == "Ball");
    CHECK(ball.coordinates() == 3);
    CHECK(ball.parameters() == 0);
    CHECK(ball.attributes() == 1);
    CHECK(!ball.declares_attributes);
    CHECK(parse.source.text(ball.name_span) == "Ball");
    const Object& shown = parse.program.objects[1];
    CHECK(shown.declares_attributes);
    CHECK(shown.attributes() == 4);
    REQUIRE(shown.arrays.size() == 5);
    CHECK(shown.arrays[array_x].name == "x");
    CHECK(shown.arrays[array_a].name == "a");
    CHECK(shown.arrays[array_s].name == "s");
    CHECK(shown.arrays[3].size == 2);
    CHECK(shown.arrays[4].size == 1);
    CHECK(shown.scalars == std::vector<std::string>{"y", "z"});
    CHECK(parse.program.statements[shown.body.back()].kind == StatementKind::result);
}

TEST_CASE("calls of objects know their arrays") {
    const Parse parse = parse_text(
        "b(x[2], a[3], s[2]) { b = 1; }\n"
        "my_model(x[3], a[1]) { array p[2], q[2]; my_model = B(p, x, q); }\n");
    REQUIRE(!parse.diagnostics.has_errors());
    const ExpressionNode& call = parse.program.expressions.back();
    CHECK(call.kind == ExpressionKind::object_call);
    CHECK(call.symbol == 0);
    CHECK(shape_of(parse.program, static_cast<ExpressionId>(parse.program.expressions.size() - 1)) ==
          "b(p, x, q)");
}

TEST_CASE("statements") {
    const Parse parse =
        parse_text(model("array p[2];\n"
                         "p = [1, -2];\n"
                         "p[1+1] = 3;\n"
                         "if y0 > 0 then i = 1; elseif i0 then i = 2; else i = 3; endif;\n"
                         "while i < 5 loop i = i + 1; endloop;\n"
                         "my_model = i;"));
    // y0 and i0 are unknown: the tree is complete all the same
    CHECK(findings(parse) == std::vector<std::string>{"error HF028 at 6:4", "error HF028 at 6:30"});
    const Program& program = parse.program;
    const auto& body = program.objects[0].body;
    REQUIRE(body.size() == 5);
    const StatementNode& list = program.statements[body[0]];
    CHECK(list.kind == StatementKind::assign_list);
    CHECK(list.symbol == 3);
    CHECK(list.list.size() == 2);
    CHECK(parse.source.text(list.span) == "p = [1, -2]");
    const StatementNode& item = program.statements[body[1]];
    CHECK(item.kind == StatementKind::assign_item);
    CHECK(shape_of(program, item.index) == "(1 + 1)");
    CHECK(parse.source.text(item.target_span) == "p[1+1]");
    const StatementNode& branch = program.statements[body[2]];
    CHECK(branch.kind == StatementKind::branch);
    CHECK(branch.first.size() == 1);
    REQUIRE(branch.second.size() == 1);
    const StatementNode& nested = program.statements[branch.second[0]];
    CHECK(nested.kind == StatementKind::branch);
    CHECK(nested.first.size() == 1);
    CHECK(nested.second.size() == 1);
    const StatementNode& loop = program.statements[body[3]];
    CHECK(loop.kind == StatementKind::loop);
    CHECK(loop.first.size() == 1);
    CHECK(parse.source.text(loop.span).starts_with("while"));
}

TEST_CASE("spans cover what was written") {
    const Parse parse = parse_text(model("y = (1 + 2) * -3;\nmy_model = max(y, x[2]);"));
    for (const ExpressionNode& node : parse.program.expressions) {
        const std::string_view text = parse.source.text(node.span);
        if (node.kind == ExpressionKind::chain) CHECK((text == "1 + 2" || text == "(1 + 2) * -3"));
        if (node.kind == ExpressionKind::unary) CHECK(text == "-3");
        if (node.kind == ExpressionKind::builtin) CHECK(text == "max(y, x[2])");
        if (node.kind == ExpressionKind::item) CHECK(text == "x[2]");
        CHECK(node.operators.size() == node.operator_spans.size());
    }
}

TEST_CASE("suggestions name what was probably meant") {
    const auto help_of = [](std::string_view body) {
        return parse_text(model(body)).diagnostics.list()[0].help;
    };
    CHECK(help_of("radius = 1; my_model = raduis;") == "did you mean `radius`?");
    CHECK(help_of("array centre[3]; my_model = center[1];") == "did you mean `centre`?");
    CHECK(help_of("my_model = hfSpher(x, a, 1);") == "did you mean `hfSphere`?");
    CHECK(help_of("my_model = squrt(2);") == "did you mean `sqrt`?");
}

TEST_CASE("an object has at most sixteen coordinates, a thousand parameters and attributes") {
    CHECK(findings("m(x[16], a[1000], s[1000]) { m = 1; }").empty());
    CHECK(findings("m(x[17], a[1]) { m = 1; }") == std::vector<std::string>{"error HF017 at 1:5"});
    CHECK(findings("m(x[1], a[1], s[1001]) { m = 1; }") == std::vector<std::string>{"error HF017 at 1:17"});
    CHECK(findings("m(x[1e400], a[1]) { m = 1; }") == std::vector<std::string>{"error HF017 at 1:5"});
}

TEST_CASE("names of newer library functions may be used by the model, with a warning") {
    const auto rows = frep::shapes::library();
    const auto row = std::find_if(rows.begin(), rows.end(), [](const auto& one) { return !one.reserved; });
    REQUIRE(row != rows.end());
    const std::string name(row->name);
    const std::string object = name + "(x[3], a[2]) { " + name + " = 1; }\n";
    CHECK(findings(object) == std::vector<std::string>{"warning HF057 at 1:1"});
    CHECK(findings(model(name + " = 1; my_model = " + name + ";")) ==
          std::vector<std::string>{"warning HF057 at 3:1"});
    CHECK(findings(model("array " + name + "[2]; my_model = " + name + "[1];")) ==
          std::vector<std::string>{"warning HF057 at 3:7"});
    const Parse call = parse_text(object + model("my_model = " + name + "(x, a);"));
    CHECK(!call.diagnostics.has_errors());
    CHECK(call.program.expressions.back().kind == ExpressionKind::object_call);
}
