// The examples of the codes of `frep check --blends`: the wrong one has the fault, the right one has not.
#include "frep/blend_diagnostics.h"

#include "frep/lang/codes.h"
#include "unit/measure/models.h"

using namespace frep;

namespace {

std::vector<Diagnostic> findings(std::string_view text) {
    const auto model = compile(std::string(text));
    REQUIRE(model);
    const auto field = model->field();
    REQUIRE(field);
    const auto space = field_in_space(*field, AxisMap::standard(3));
    REQUIRE(space);
    BlendCheckOptions options;
    options.bounds = Box3::cube(1.7);
    const auto found = check_blends(*space, options, {});
    REQUIRE(found);
    std::vector<Diagnostic> out;
    for (const BlendFinding& one : *found)
        if (auto d = blend_diagnostic(one, model->source(), options.axes)) out.push_back(std::move(*d));
    return out;
}

}  // namespace

TEST_CASE("examples of what blends do are right") {
    int rows = 0;
    for (const lang::CodeInfo& row : lang::diagnostic_table()) {
        if (row.proof != lang::Proof::blends) continue;
        ++rows;
        CAPTURE(row.code);
        const std::vector<Diagnostic> found = findings(row.wrong);
        REQUIRE(found.size() == 1);
        CHECK(found[0].code == row.code);
        CHECK(found[0].severity == row.severity);
        CHECK_FALSE(found[0].help.empty());
        CHECK(row.wrong.substr(found[0].span.begin).substr(0, 2) == "hf");
        CHECK(findings(row.right).empty());
    }
    CHECK(rows == 4);
}
