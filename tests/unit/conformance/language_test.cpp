// The cases of the old interpreter (tests/conformance/language/cases.jsonl; its README says what `expect`
// means), through both engines.
#include <doctest/doctest.h>

#include <charconv>
#include <limits>

#include <nlohmann/json.hpp>

#include "support/evaluate.h"

using namespace frep;
using nlohmann::json;

namespace {

double number_of(const json& value) {
    if (value.is_number()) return value.get<double>();
    const std::string text = value.get<std::string>();
    if (text.find("inf") != std::string::npos)
        return text[0] == '-' ? -std::numeric_limits<double>::infinity()
                              : std::numeric_limits<double>::infinity();
    double out = 0;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
}

/// Line of the old tool's first message "line 3 pos 7: ...", or a large number.
std::uint32_t old_line(const json& test) {
    if (!test.contains("parse_errors") || test["parse_errors"].empty()) return ~0u;
    const std::string message = test["parse_errors"][0];
    std::uint32_t line = ~0u;
    if (message.starts_with("line "))
        std::from_chars(message.data() + 5, message.data() + message.size(), line);
    return line;
}

void check_case(const json& test, Engine engine) {
    const std::string source = test["src"];
    CAPTURE(source);
    const auto out = test::evaluate(source, test.value("object", ""), test["x"].get<std::vector<double>>(),
                                    test["a"].get<std::vector<double>>(), engine);
    const std::string expect = test["expect"];
    CAPTURE(expect);
    if (expect == "error") {
        CHECK_FALSE(out.ok);
        CHECK(out.diagnostics.has_errors());
        CHECK(out.first_error_line <= old_line(test));
    } else if (expect == "undefined") {
        if (out.ok) {
            const double value = out.values[0];
            CHECK((value != value || value - value != 0));
        }
        CHECK((out.ok || out.diagnostics.has_errors()));
    } else if (expect == "value") {
        REQUIRE(out.ok);
        CHECK(test::close(out.values[0], number_of(test["value"]), 1e-9));
        if (test.contains("s") && test["s"].is_array())
            for (std::size_t i = 0; i < test["s"].size(); ++i)
                CHECK(test::close(out.values.at(i + 1), number_of(test["s"][i]), 1e-9));
    }
}

}  // namespace

TEST_CASE("language cases of the old interpreter") {
    std::ifstream file(FREP_SOURCE_DIR "/tests/conformance/language/cases.jsonl");
    REQUIRE(file.good());
    std::string line;
    std::size_t count = 0;
    while (std::getline(file, line)) {
        if (line.empty()) continue;
        const json test = json::parse(line);
        for (Engine engine : {Engine::reference, Engine::vm, Engine::jit}) check_case(test, engine);
        ++count;
    }
    CHECK(count >= 170);
}
