#include "frep/lang/explain.h"

#include <filesystem>
#include <set>

#include <doctest/doctest.h>

#include "frep/lang/limits.h"
#include "frep/lang/model.h"
#include "lang_test.h"

using namespace frep;
using namespace frep::lang;
using namespace frep::lang::test;

namespace {

/// The text of a `generated` row.
std::string generated(std::string_view code) {
    if (code == "HF005") return std::string(source_limit + 1, ' ');
    std::string body;
    if (code == "HF008") body.append("y = ").append(300, '(').append("1").append(300, ')').append(";");
    if (code == "HF006")
        for (int i = 0; i < 300; ++i) body += "y = ;\n";
    if (code == "HF009") {
        body = "my_model = 1";
        for (std::size_t i = 0; i < expression_limit + 1; ++i) body += "+1";
    }
    return model(body);
}

}  // namespace

TEST_CASE("every example of the table is right") {
    for (const CodeInfo& row : diagnostic_table()) {
        CAPTURE(row.code);
        if (row.proof == Proof::lowering || row.proof == Proof::advice || row.proof == Proof::blends ||
            row.code >= "HF200")
            continue;
        const std::string wrong =
            row.proof == Proof::generated ? generated(row.code) : std::string(row.wrong);
        const Parse found = parse_text(wrong);
        CHECK(has_code(found.diagnostics, row.code));
        for (const Diagnostic& d : found.diagnostics.list())
            if (d.code == row.code) CHECK(d.severity == row.severity);
        CHECK(findings(row.right) == std::vector<std::string>{});
    }
}

TEST_CASE("examples of advice are right") {
    for (const CodeInfo& row : diagnostic_table()) {
        CAPTURE(row.code);
        if (row.proof != Proof::advice) continue;
        const auto advice = [](std::string_view text) {
            const Model model(Source("example.hf", text));
            Diagnostics found;
            const auto lowered = model.lower(*model.find_object({}), {}, found);
            REQUIRE(lowered);
            CHECK(found.list().empty());
            model.advise(*lowered, found);
            return found;
        };
        const Diagnostics found = advice(row.wrong);
        REQUIRE(has_code(found, row.code));
        CHECK(found.list()[0].severity == row.severity);
        CHECK(found.list()[0].span.end > 0);
        CHECK(advice(row.right).list().empty());
    }
}

TEST_CASE("examples of lowering's codes are right") {
    for (const CodeInfo& row : diagnostic_table()) {
        CAPTURE(row.code);
        if (row.proof != Proof::lowering) continue;
        CHECK(row.code >= "HF100");
        auto lowered = [](std::string_view text) {
            const Model model(Source("example.hf", text));
            REQUIRE(model.ok());
            Diagnostics found;
            static_cast<void>(model.lower(*model.find_object({}), {}, found));
            return found;
        };
        if (!row.wrong.starts_with("(")) {  // too large for the table; tested in lower_test.cpp
            const Diagnostics found = lowered(row.wrong);
            CHECK(has_code(found, row.code));
            for (const Diagnostic& d : found.list())
                if (d.code == row.code) CHECK(d.severity == row.severity);
        }
        CHECK(lowered(row.right).empty());
    }
}

TEST_CASE("codes are unique, in order, and have a page") {
    std::set<std::string_view> names;
    std::string_view before;
    for (const CodeInfo& row : diagnostic_table()) {
        CAPTURE(row.code);
        CHECK(row.code.size() == 5);
        CHECK(row.code > before);
        before = row.code;
        CHECK(names.insert(row.name).second);
        const auto page = explain(row.code);
        REQUIRE(page);
        for (std::string_view part :
             {row.code, row.title, row.text, std::string_view("Wrong:"), std::string_view("Right:")})
            CHECK(page->find(part) != std::string::npos);
    }
}

TEST_CASE("every code of the table is used by the front end, lowering and blends apart") {
    std::string all;
    for (const auto& entry : std::filesystem::directory_iterator(FREP_SOURCE_DIR "/src/frep/lang"))
        if (entry.path().extension() == ".cpp") all += read_file(entry.path().string());
    for (const CodeInfo& row : diagnostic_table()) {
        CAPTURE(row.name);
        if (row.proof != Proof::lowering && row.proof != Proof::blends)
            CHECK(all.find("Code::" + std::string(row.name)) != std::string::npos);
    }
}

TEST_CASE("explain() is lenient about spelling and helpful about slips") {
    const auto page = explain("HF012");
    REQUIRE(page);
    for (std::string_view spelling : {"hf012", "HF12", "12", "hf0012", "expected_expression"}) {
        const auto same = explain(spelling);
        REQUIRE(same);
        CHECK(*same == *page);
    }
    for (std::string_view wrong :
         {"", "HF", "HF999", "nonsense", "HF012 ", "\x1b[2J", "99999999999999999999"}) {
        const auto none = explain(wrong);
        REQUIRE(!none);
        CHECK(none.error().kind == ErrorKind::invalid_argument);
        CHECK(none.error().message.find('\x1b') == std::string::npos);
    }
    CHECK(explain("expected_expresion").error().message.find("expected_expression") != std::string::npos);
}
