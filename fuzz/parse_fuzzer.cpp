// Fuzz target of the front end: any bytes are parsed, every finding is rendered and explained. Nothing may
// crash, hang, grow without bound or let a control character through.
//     cmake -DFREP_BUILD_FUZZERS=ON -DCMAKE_CXX_COMPILER=clang++-14 ... && ninja fuzz_parse
//     fuzz/fuzz_parse -dict=fuzz/hyperfun.dict /tmp/corpus fuzz/corpus/parse
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "frep/lang/explain.h"
#include "frep/lang/limits.h"
#include "frep/lang/parser.h"

namespace {

using namespace frep;

/// Ids of the tree stay within their pools, so that later passes may follow them blindly.
void check_tree(const lang::Program& program) {
    for (const auto& node : program.expressions) {
        for (lang::ExpressionId id : node.operands) FREP_CHECK(id < program.expressions.size());
        FREP_CHECK(node.operators.size() == node.operator_spans.size());
        if (node.kind == lang::ExpressionKind::chain)
            FREP_CHECK(node.operands.size() == node.operators.size() + 1);
        if (node.kind == lang::ExpressionKind::unary)
            FREP_CHECK(node.operands.size() == 1 && node.operators.size() == 1);
        if (node.kind == lang::ExpressionKind::library_call)
            FREP_CHECK(node.function && node.function->arguments.size() == node.operands.size());
    }
    for (const auto& statement : program.statements) {
        for (lang::ExpressionId id : statement.list) FREP_CHECK(id < program.expressions.size());
        for (lang::StatementId id : statement.first) FREP_CHECK(id < program.statements.size());
        for (lang::StatementId id : statement.second) FREP_CHECK(id < program.statements.size());
        FREP_CHECK(statement.span.begin <= statement.span.end);
    }
    for (const auto& object : program.objects) {
        FREP_CHECK(object.arrays.size() >= 3);
        for (lang::StatementId id : object.body) FREP_CHECK(id < program.statements.size());
    }
}

/// A program without errors is complete: every object ends with its result.
void check_complete(const lang::Program& program) {
    FREP_CHECK(!program.objects.empty());
    for (const auto& object : program.objects) {
        FREP_CHECK(!object.body.empty());
        FREP_CHECK(program.statements[object.body.back()].kind == lang::StatementKind::result);
    }
}

void check_findings(const Diagnostics& found, const Source& source) {
    FREP_CHECK(found.list().size() <= lang::diagnostic_limit);
    for (const Diagnostic& one : found.list()) {
        FREP_CHECK(one.span.begin <= one.span.end && one.span.end <= source.text().size());
        FREP_CHECK(bool(lang::explain(one.code)));
        for (const std::string* part : {&one.message, &one.label, &one.help})
            for (char c : *part) FREP_CHECK(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    }
    for (char c : render(found, source)) FREP_CHECK(static_cast<unsigned char>(c) >= 0x20 || c == '\n');
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const Source source("fuzz.hf", bytes);
    Diagnostics found;
    const lang::Program program = lang::parse(source, found);
    check_tree(program);
    if (!found.has_errors()) check_complete(program);
    check_findings(found, source);
    (void)lang::explain(bytes.substr(0, 64));
    return 0;
}
