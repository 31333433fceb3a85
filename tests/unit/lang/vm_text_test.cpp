// Tests of lang/vm_text.h: what operations mean, where mistakes are reported, and the models of the shared
// benchmarks against an interpreter of three lines.
#include "frep/lang/vm_text.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "frep/eval/evaluator.h"
#include "frep/lang/limits.h"
#include "frep/lang/model.h"
#include "lang_test.h"

using namespace frep;
using namespace frep::lang;
using namespace frep::lang::test;

namespace {

Parse parse_vm(std::string_view text) {
    Parse result{Source("test.vm", text), {}, {}};
    Reporter report(result.source);
    static_cast<void>(parse_vm_text(result.source, report));
    report.finish(result.diagnostics);
    return result;
}

Field field_of(std::string_view text) {
    const Model model(Source("test.vm", text), {}, ModelText::vm);
    INFO(render(model.diagnostics(), model.source()));
    auto field = model.field();
    REQUIRE(static_cast<bool>(field));
    return *field;
}

double value_at(const Field& field, double x, double y, double z) {
    const auto evaluator = make_evaluator(field);
    REQUIRE(static_cast<bool>(evaluator));
    const std::array<const double*, 3> point{&x, &y, &z};
    double value = 0;
    double* out = &value;
    (*evaluator)->values(std::span(point).first(static_cast<std::size_t>(field.coordinates)), 1, {&out, 1});
    return value;
}

/// The value of a `.vm` text at a point, line by line, with the functions of the C library.
double interpreted(const std::string& text, double x, double y, double z) {
    std::map<std::string, double> values;
    std::istringstream lines(text);
    std::string line;
    double last = 0;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::string name, op, a, b;
        words >> name >> op >> a >> b;
        if (name.empty() || name[0] == '#') continue;
        const double p = values[a], q = values[b];
        last = op == "const"    ? std::stod(a)
               : op == "var-x"  ? x
               : op == "var-y"  ? y
               : op == "var-z"  ? z
               : op == "add"    ? p + q
               : op == "sub"    ? p - q
               : op == "mul"    ? p * q
               : op == "max"    ? std::fmax(p, q)
               : op == "min"    ? std::fmin(p, q)
               : op == "mod"    ? p - q * std::floor(p / q)
               : op == "neg"    ? -p
               : op == "abs"    ? std::fabs(p)
               : op == "sqrt"   ? std::sqrt(p)
               : op == "square" ? p * p
               : op == "sin"    ? std::sin(p)
               : op == "cos"    ? std::cos(p)
               : op == "exp"    ? std::exp(p)
                                : std::nan("");
        values[name] = last;
    }
    return last;
}

/// Where the models of the shared benchmarks are; empty, and a line that says so, without them.
std::filesystem::path benchmark_models() {
    const char* shared = std::getenv("FREP_SHARED");
    std::filesystem::path folder = std::filesystem::path(shared ? shared : "") / "bench/models";
    if (shared && std::filesystem::is_directory(folder)) return folder;
    std::printf("skipped: 1 (no benchmark models)\n");
    return {};
}

/// Numbers in -1..1.
struct Random {
    std::uint32_t seed = 12345;
    double operator()() {
        seed = seed * 1664525u + 1013904223u;
        return static_cast<double>(seed >> 8) / 8388608.0 - 1;
    }
};

/// The field of a `.vm` file, with its set operations lifted or as sums.
lang::Lowered lowered(const std::filesystem::path& path, bool lift) {
    const Model model(Source("test.vm", read_file(path.string())), {}, ModelText::vm);
    Diagnostics found;
    auto out = model.lower(0, {}, found, lift);
    REQUIRE(out);
    return *out;
}

std::size_t count_of(const Field& field, Op op) {
    std::size_t count = 0;
    for (NodeId id = 0; id < field.graph->size(); ++id) count += field.graph->node(id).op == op;
    return count;
}

}  // namespace

TEST_CASE("the field is the negation of the last line") {
    const std::string ball =
        "# a ball\nx var-x\ny var-y\nz var-z\na square x\nb square y\nc square z\n"
        "d add a b\ne add d c\nr sqrt e\nk const 0.8\nf sub r k\n";
    const Field field = field_of(ball);
    CHECK(field.coordinates == 3);
    CHECK(value_at(field, 0, 0, 0) == 0.8);
    CHECK(value_at(field, 3, 0, 4) == doctest::Approx(-4.2));
}

TEST_CASE("without var-z the model is flat") {
    const Field field = field_of("x var-x\r\n\r\n y\tvar-y  \r\nf mul x y");
    CHECK(field.coordinates == 2);
    CHECK(value_at(field, 3, 5, 0) == -15);
}

TEST_CASE("every operation") {
    const auto of = [](const std::string& op, const std::string& operands, double x, double y) {
        return -value_at(field_of("x var-x\ny var-y\nf " + op + " " + operands), x, y, 0);
    };
    CHECK(of("neg", "x", 2, 0) == -2);
    CHECK(of("abs", "x", -2, 0) == 2);
    CHECK(of("recip", "x", 4, 0) == 0.25);
    CHECK(of("square", "x", -3, 0) == 9);
    CHECK(of("floor", "x", -1.5, 0) == -2);
    CHECK(of("ceil", "x", 1.5, 0) == 2);
    CHECK(of("round", "x", 1.6, 0) == 2);
    CHECK(of("sub", "x y", 5, 3) == 2);
    CHECK(of("div", "x y", 6, 3) == 2);
    CHECK(of("min", "x y", 6, 3) == 3);
    CHECK(of("max", "x y", 6, 3) == 6);
    CHECK(of("mod", "x y", -0.5, 2) == 1.5);
    CHECK(of("mod", "x y", 5.5, 2) == 1.5);
    for (const double v : {0.3, 0.7}) {
        CHECK(of("sin", "x", v, 0) == doctest::Approx(std::sin(v)));
        CHECK(of("cos", "x", v, 0) == doctest::Approx(std::cos(v)));
        CHECK(of("tan", "x", v, 0) == doctest::Approx(std::tan(v)));
        CHECK(of("asin", "x", v, 0) == doctest::Approx(std::asin(v)));
        CHECK(of("acos", "x", v, 0) == doctest::Approx(std::acos(v)));
        CHECK(of("atan", "x", v, 0) == doctest::Approx(std::atan(v)));
        CHECK(of("exp", "x", v, 0) == doctest::Approx(std::exp(v)));
        CHECK(of("ln", "x", v, 0) == doctest::Approx(std::log(v)));
        CHECK(of("sqrt", "x", v, 0) == doctest::Approx(std::sqrt(v)));
        CHECK(of("atan2", "x y", v, 2) == doctest::Approx(std::atan2(v, 2)));
        CHECK(of("pow", "x y", v, 2.5) == doctest::Approx(std::pow(v, 2.5)));
    }
}

TEST_CASE("every example of the table is right (.vm)") {
    for (const CodeInfo& row : diagnostic_table()) {
        CAPTURE(row.code);
        if (row.code < "HF200") continue;
        const std::string wrong =
            row.proof == Proof::generated ? std::string(source_limit + 1, '#') : std::string(row.wrong);
        CHECK(has_code(parse_vm(wrong).diagnostics, row.code));
        CHECK(findings(parse_vm(row.right)).empty());
    }
}

TEST_CASE("mistakes have a place") {
    CHECK(findings(parse_vm("x var-x\nf add x q")) == std::vector<std::string>{"error HF203 at 2:9"});
    CHECK(findings(parse_vm("x var-x\nf add x x x")) == std::vector<std::string>{"error HF201 at 2:11"});
    CHECK(findings(parse_vm("x\nc const 1e999\nd const 1x\n")) ==
          std::vector<std::string>{"error HF201 at 1:1", "error HF201 at 2:9", "error HF201 at 3:9"});
    CHECK(findings(parse_vm("x var-w")) == std::vector<std::string>{"error HF202 at 1:3"});
    CHECK(findings(parse_vm("x var-x 3")) == std::vector<std::string>{"error HF204 at 1:3"});
}

TEST_CASE("the models of the shared benchmarks mean what they say") {
    const std::filesystem::path folder = benchmark_models();
    if (folder.empty()) return;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".vm") continue;
        CAPTURE(entry.path().filename().string());
        const std::string text = read_file(entry.path().string());
        const Field field = field_of(text);
        Random random;
        for (int i = 0; i < 20; ++i) {
            const double x = random(), y = random(), z = random();
            CHECK(value_at(field, x, y, z) == doctest::Approx(-interpreted(text, x, y, z)).epsilon(1e-9));
        }
    }
}

TEST_CASE("the R-functions of the shared benchmarks lift completely") {
    const std::filesystem::path folder = benchmark_models();
    if (folder.empty()) return;
    for (const auto& [sums, min_max] :
         {std::pair("rcsg100.vm", "csg100.vm"), {"runion1000.vm", "union1000.vm"}}) {
        CAPTURE(sums);
        const lang::Lowered plain = lowered(folder / sums, false), lifted = lowered(folder / sums, true);
        const Field twin = lowered(folder / min_max, true).field;
        CHECK(plain.lifted.total() == 0);
        CHECK(count_of(plain.field, Op::r_or) + count_of(plain.field, Op::r_and) == 0);
        // One operation for each minimum and maximum of the twin, and no other roots than its own.
        const std::size_t expected = count_of(twin, Op::min) + count_of(twin, Op::max);
        CHECK(lifted.lifted.r_functions == expected);
        CHECK(count_of(lifted.field, Op::r_or) + count_of(lifted.field, Op::r_and) == expected);
        CHECK(count_of(lifted.field, Op::sqrt) == count_of(twin, Op::sqrt));
        Random random;
        for (int i = 0; i < 400; ++i) {
            const double x = random(), y = random(), z = random();
            const double a = value_at(plain.field, x, y, z), b = value_at(lifted.field, x, y, z);
            CHECK(b == doctest::Approx(a).epsilon(1e-9));
            if (std::fabs(a) > 1e-12) CHECK((a >= 0) == (b >= 0));
            CHECK((b >= 0) == (value_at(twin, x, y, z) >= 0));
        }
    }
}
