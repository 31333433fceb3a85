// Texts that mean harm: each must end soon, in bounded memory and with the finding that names the trouble.
// No times are asserted; a quadratic step anywhere here takes hours.
#include <doctest/doctest.h>

#include "frep/lang/explain.h"
#include "frep/lang/limits.h"
#include "lang_test.h"

using namespace frep;
using namespace frep::lang;
using namespace frep::lang::test;

namespace {

std::string repeat(std::string_view part, std::size_t count) {
    std::string text;
    text.reserve(part.size() * count);
    for (std::size_t i = 0; i < count; ++i) text += part;
    return text;
}

void check_ends_with(const std::string& text, std::string_view code) {
    const Parse parse = parse_text(text);
    CHECK(has_code(parse.diagnostics, code));
    CHECK(parse.diagnostics.list().size() <= diagnostic_limit);
}

}  // namespace

TEST_CASE("nesting of every kind is limited by name") {
    check_ends_with(model("my_model = " + repeat("- ", 500'000) + "1;"), "HF008");
    check_ends_with(model("my_model = " + repeat("~", 500'000) + "1;"), "HF008");
    check_ends_with(model("my_model = " + repeat("(", 500'000) + "1;"), "HF008");
    check_ends_with(model("my_model = " + repeat("(-", 500'000) + "1;"), "HF008");
    check_ends_with(model("my_model = " + repeat("x[", 500'000) + "1;"), "HF008");
    check_ends_with(model("my_model = " + repeat("sin(", 500'000) + "1;"), "HF008");
    check_ends_with(model("if " + repeat("not ", 500'000) + "1 then endif;"), "HF008");
    check_ends_with(model(repeat("if 1 then ", 500'000)), "HF008");
    check_ends_with(model(repeat("while 1 loop ", 500'000)), "HF008");
    check_ends_with(model("if 1 then " + repeat("elseif 1 then ", 500'000)), "HF008");
}

TEST_CASE("nesting up to the limit is accepted") {
    const auto nested = [](int depth) {
        const auto count = static_cast<std::size_t>(depth);
        return findings(model("my_model = " + repeat("(", count) + "1" + repeat(")", count) + ";"));
    };
    CHECK(nested(nesting_limit).empty());
    CHECK(nested(nesting_limit + 1).size() == 1);
}

TEST_CASE("long chains and long lists are legal") {
    CHECK(findings(model("my_model = 1" + repeat("+1", 1'000'000) + ";")).empty());
    CHECK(findings(model("if 1" + repeat(" and 1", 200'000) + " then endif; my_model = 1;")).empty());
    CHECK(
        findings(model("array p[1000000]; p = [0" + repeat(",1", 999'999) + "]; my_model = p[7];")).empty());
    CHECK(findings(model(repeat("y = 1;\n", 300'000) + "my_model = y;")).empty());
    CHECK(findings(model("my_model = max(1" + repeat(",1", 300'000) + ");")).size() == 1);
}

TEST_CASE("many objects and many names") {
    std::string objects, names, arrays;
    for (int i = 0; i < 100'000; ++i) {
        const std::string n = std::to_string(i);
        objects += "o" + n + "(x[1],a[1]){o" + n + "=1;}\n";
        names += "v" + n + "=1;";
        arrays += "array p" + n + "[1];";
    }
    const Parse parse = parse_text(objects);
    CHECK(parse.diagnostics.empty());
    CHECK(parse.program.objects.size() == 100'000);
    CHECK(findings(model(names + "my_model=v77;")).empty());
    CHECK(findings(model(arrays + "my_model=p77[1];")).empty());
    check_ends_with(objects + model(repeat("y = unknown_function(1);", 1000)), "HF030");
    check_ends_with(model(names + repeat("y = unknown_array[1];", 1000)), "HF029");
    check_ends_with(repeat("m(x[1],a[1]){m=1;}\n", 100'000), "HF020");
}

TEST_CASE("findings are kept up to a limit and the rest is told of") {
    for (const std::string& text :
         {model(repeat("y = ;\n", 200'000)), model(repeat("y + \n", 200'000)), repeat("}\n", 200'000),
          repeat("m(\n", 200'000), model(repeat("endif;\n", 200'000)), repeat("$\n", 200'000),
          repeat("\"\n", 200'000), model(repeat("{\n", 200'000)), repeat("if(\n", 200'000),
          repeat("#\n", 200'000)}) {
        const Parse parse = parse_text(text);
        CHECK(parse.diagnostics.has_errors());
        CHECK(parse.diagnostics.list().size() <= diagnostic_limit);
        CHECK(!render(parse.diagnostics, parse.source).empty());
    }
    check_ends_with(model(repeat("y = ;\n", 200'000)), "HF006");
}

TEST_CASE("many warnings do not make a file unusable") {
    const Parse parse = parse_text(model("y = 1;\n" + repeat("y = -y^2;\n", 100'000) + "my_model = y;"));
    CHECK(!parse.diagnostics.has_errors());
    CHECK(parse.diagnostics.list().size() <= diagnostic_limit);
    CHECK(has_code(parse.diagnostics, "HF050"));
    CHECK(has_code(parse.diagnostics, "HF006"));
    CHECK(parse.program.objects[0].body.size() == 100'002);
    const Parse annotated = parse_text(repeat("--@ nonsense\n", 100'000) + model("my_model = 1;"));
    CHECK(!annotated.diagnostics.has_errors());
    CHECK(annotated.diagnostics.list().size() <= diagnostic_limit);
}

TEST_CASE("large files") {
    check_ends_with(std::string(source_limit + 1, ' '), "HF005");
    check_ends_with(std::string(source_limit, '\n'), "HF007");
    for (std::string_view part : {"(", "- ", "if ", "m(", "a", "a[", "{", "\"", "$", "--@\n"})
        CHECK(parse_text(repeat(part, source_limit / part.size())).diagnostics.has_errors());
    for (std::string_view part : {"y=1;", "y=-y^2;", "array p[1];", ";"})
        CHECK(parse_text(model(repeat(part, (source_limit - 100) / part.size()))).diagnostics.has_errors());
}

TEST_CASE("unterminated everything") {
    const std::string whole =
        "my_model(x[3], a[1], s[2])\n{\n  array p[2];\n  p = [1, 2];\n  if p[1] > (2 + 1) then "
        "y = max(1, 2); else y = \"t\"; endif;\n  while y < 3 loop y = y + 1; endloop;\n"
        "  my_model = -y ^ 2;\n}\n";
    for (std::size_t length = 0; length + 3 < whole.size(); ++length) {
        const Parse parse = parse_text(whole.substr(0, length));
        CHECK(parse.diagnostics.has_errors());
        const Parse tail = parse_text(whole.substr(length));
        CHECK(render(tail.diagnostics, tail.source).size() < 100'000);
    }
}

TEST_CASE("terminal escapes never come through") {
    const std::string evil = "\x1b]0;pwned\x07\x1b[2J\xC2\x9B";
    for (const std::string& text :
         {evil, model(evil), model("y = " + evil), "m" + evil + "(x[1])", model("y = \"" + evil + "\";"),
          "--@ " + evil + "\n", "--@ color " + evil + "\n", "--@ param " + evil + "\n",
          model("y = sin(" + evil)}) {
        const Parse parse = parse_text(text);
        for (const Diagnostic& d : parse.diagnostics.list())
            for (const std::string* part : {&d.message, &d.label, &d.help}) {
                CHECK(part->find('\x1b') == std::string::npos);
                CHECK(part->find('\x07') == std::string::npos);
                CHECK(part->find("\xC2\x9B") == std::string::npos);
            }
        CHECK(render(parse.diagnostics, parse.source).find('\x1b') == std::string::npos);
    }
}

TEST_CASE("random bytes") {
    std::uint64_t state = 88172645463325252u;  // xorshift
    const auto next = [&] {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return state;
    };
    std::string bytes(1 << 20, '\0');
    for (char& c : bytes) c = static_cast<char>(next() & 0xFF);
    CHECK(parse_text(bytes).diagnostics.has_errors());
    CHECK(parse_text(model(bytes)).diagnostics.has_errors());
    constexpr std::string_view words[] = {
        "if ", "then ", "else ", "endif", ";", "while ",  "loop ",    "endloop", "x", "[",
        "]",   "(",     ")",     "1",     "=", "y",       "my_model", "array ",  "{", "}",
        ",",   "-",     "\n",    "^",     "|", "elseif ", "a",        "not "};
    for (int round = 0; round < 2000; ++round) {
        std::string text = "my_model(x[3],a[1]){";
        for (int i = 0; i < 60; ++i) text += words[next() % std::size(words)];
        const Parse parse = parse_text(text);
        CHECK(parse.diagnostics.list().size() <= diagnostic_limit);
    }
}
