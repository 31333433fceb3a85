// The lowering against a plain interpreter of the syntax tree, on hand-made and random programs, through both
// engines.
#include <doctest/doctest.h>

#include <bit>
#include <cstdlib>

#include <fmt/format.h>

#include "support/evaluate.h"
#include "support/interpreter.h"
#include "support/random_program.h"

using namespace frep;

namespace {

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

/// Runs `text` at points through the interpreter, `reference` and `vm`, and compares bit for bit.
void compare(const std::string& text, std::uint64_t seed) {
    CAPTURE(text);
    const Model model(Source("random.hf", text));
    REQUIRE_MESSAGE(model.ok(), render(model.diagnostics(), model.source()));
    Diagnostics found;
    const std::vector<double> a{0.75, -0.5};
    const auto index = model.find_object("");
    const auto lowered = model.lower(*index, a, found);
    REQUIRE_MESSAGE(static_cast<bool>(lowered), render(found, model.source()));
    test::Interpreter interpreter(model.program());
    test::RandomProgram random(seed);
    constexpr std::size_t points = 7;
    std::vector<double> x[3];
    for (auto& axis : x)
        for (std::size_t p = 0; p < points; ++p) axis.push_back(random.number());
    const double* coordinates[] = {x[0].data(), x[1].data(), x[2].data()};
    for (Engine engine : {Engine::reference, Engine::vm}) {
        auto evaluator = make_evaluator(lowered->field, {.engine = engine, .attributes = true});
        const auto outputs = static_cast<std::size_t>((*evaluator)->outputs());
        std::vector<std::vector<double>> values(outputs, std::vector<double>(points));
        std::vector<double*> out;
        for (auto& list : values) out.push_back(list.data());
        (*evaluator)->values(coordinates, points, out);
        for (std::size_t p = 0; p < points; ++p) {
            const auto expected = interpreter.run(*index, {x[0][p], x[1][p], x[2][p]}, a);
            for (std::size_t k = 0; k < outputs; ++k) {
                CAPTURE(p);
                CAPTURE(k);
                CAPTURE(values[k][p]);
                CAPTURE(expected[k]);
                CHECK(same_bits(values[k][p], expected[k]));
            }
        }
    }
}

}  // namespace

TEST_CASE("random programs mean what an interpreter says") {
    const int count = std::getenv("FREP_FULL") ? 40'000 : 1500;
    for (int seed = 1; seed <= count; ++seed) {
        CAPTURE(seed);
        compare(test::RandomProgram(static_cast<std::uint64_t>(seed)).text(),
                static_cast<std::uint64_t>(seed));
    }
}

TEST_CASE("a loop with a known number of steps is unrolled") {
    const auto out = test::evaluate(
        "my_model(x[3],a[1]){ i=0; y=0; while i<100 loop y=y+x[1]; i=i+1; endloop; my_model=y; }", "", {2},
        {});
    CHECK(out.ok);
    CHECK_FALSE(out.has_regions);
    CHECK(out.values[0] == 200);
}

TEST_CASE("a long loop of constants costs no nodes") {
    const auto out = test::evaluate(
        "my_model(x[3],a[1]){ i=0; y=0; while i<300000 loop y=y+i; i=i+1; endloop; my_model=y+x[1]; }", "",
        {1}, {});
    CHECK(out.ok);
    CHECK_FALSE(out.has_regions);
    CHECK(out.values[0] == 44999850001.0);
}

TEST_CASE("a long loop with the point in it stays a loop") {
    const auto out = test::evaluate(
        "my_model(x[3],a[1]){ i=0; y=0; while i<5000 loop y=y+x[1]; i=i+1; endloop; my_model=y; }", "", {0.5},
        {});
    CHECK(out.ok);
    CHECK(out.has_regions);
    CHECK(out.values[0] == 2500);
}

TEST_CASE("parameters that decide a loop are structural, others are not") {
    const std::string text =
        "my_model(x[3],a[3]){ i=0; y=a[2]; while i<a[1] loop y=y+x[1]; i=i+1; endloop;"
        " if a[3]>0 then y=y+1; endif; my_model=y; }";
    const auto out = test::evaluate(text, "", {2}, {3, 10, 1});
    REQUIRE(out.ok);
    CHECK(out.structural == std::vector<bool>{true, false, false});
    CHECK(out.values[0] == 17);
}

TEST_CASE("a branch not taken need not end") {
    const std::string text =
        "my_model(x[3],a[1]){ y=1; if x[1]>0 then while x[1]>0 loop y=y+1; x[1]=x[1]+1; endloop; endif; "
        "my_model=y; }";
    CHECK(test::value_of(text, {-1}) == 1);
    const double endless = test::value_of(text, {1});
    CHECK(endless != endless);
}

TEST_CASE("loops that never end are refused") {
    CHECK_FALSE(
        test::evaluate("my_model(x[3],a[1]){ while 1 loop y=x[1]; endloop; my_model=1; }", "", {1}, {}).ok);
    CHECK_FALSE(
        test::evaluate("my_model(x[3],a[1]){ i=1; while i>0 loop i=i+1; endloop; my_model=i; }", "", {1}, {})
            .ok);
}

TEST_CASE("doubling objects are read once each") {
    std::string text = "o0(x[3],a[1]){ o0=x[1]; }\n";
    for (int i = 1; i <= 60; ++i)
        text += fmt::format("o{}(x[3],a[1]){{ o{}=o{}(x,a)+o{}(x,a); }}\n", i, i, i - 1, i - 1);
    const auto out = test::evaluate(text, "o60", {1}, {});
    CHECK(out.ok);
    CHECK(out.values[0] == 1152921504606846976.0);
}

TEST_CASE("limits of the lowering have their own diagnostics") {
    auto code_of = [](const std::string& text) {
        const auto out = test::evaluate(text, "my_model", {1}, {});
        for (const auto& d : out.diagnostics.list())
            if (d.severity == Severity::error) return d.code;
        return std::string();
    };
    std::string doubling = "o0(x[3],a[1]){ o0=x[1]; }\n";
    for (int i = 1; i <= 60; ++i)
        doubling += fmt::format(
            "o{}(x[3],a[1]){{ t=hfShift3D(x,{},1,1); y=o{}(x,a); t=hfShift3D(x,1,{},1); o{}=y+o{}(x,a); }}\n",
            i, i, i - 1, i, i, i - 1);
    CHECK(code_of(doubling + "my_model(x[3],a[1]){ my_model=o60(x,a); }") == "HF101");
    std::string chain = "o0(x[3],a[1]){ o0=x[1]; }\n";
    for (int i = 1; i <= 5000; ++i)
        chain += fmt::format("o{}(x[3],a[1]){{ o{}=o{}(x,a)+1; }}\n", i, i, i - 1);
    CHECK(code_of(chain + "my_model(x[3],a[1]){ my_model=o5000(x,a); }") == "HF103");
    CHECK(code_of("my_model(x[3],a[1]){ array c[3]; c=[1,2,3]; i=2; c[i*2]=1; my_model=c[1]; }") == "HF104");
}
