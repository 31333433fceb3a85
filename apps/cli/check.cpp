// `frep check`: the mistakes of a model's text, and those that only show when its objects are lowered.
// Tested by tests/cli/check.txt.
#include <optional>

#include <fmt/format.h>

#include "command_line.h"
#include "json.h"
#include "model_input.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

bool same_finding(const Diagnostic& a, const Diagnostic& b) {
    return a.code == b.code && a.span == b.span && a.message == b.message;
}

/// Findings of the text and of every object's lowering, each once: an object that others call is lowered
/// with each of them.
Diagnostics all_findings(const Model& model) {
    Diagnostics all = model.diagnostics();
    if (!model.ok()) return all;
    for (std::size_t i = 0; i < model.program().objects.size(); ++i) {
        Diagnostics found;
        if (const auto lowered = model.lower(i, {}, found)) model.advise(*lowered, found);
        for (const Diagnostic& d : found.list()) {
            bool is_known = false;
            for (const Diagnostic& known : all.list()) is_known = is_known || same_finding(d, known);
            if (!is_known) all.add(d);
        }
        if (all.list().size() > 1000) break;  // far more than anybody reads
    }
    return all;
}

Json to_json(const Diagnostic& d, const Source& source) {
    const LineColumn begin = source.locate(d.span.begin);
    const LineColumn end = source.locate(std::max(d.span.begin, d.span.end));
    return {{"code", d.code},
            {"severity", to_string(d.severity)},
            {"message", json_text(d.message)},
            {"label", json_text(d.label)},
            {"help", json_text(d.help)},
            {"line", begin.line},
            {"column", begin.column},
            {"end_line", end.line},
            {"end_column", end.column}};
}

Json report(const Diagnostics& findings, const Source& source) {
    std::size_t warnings = 0;
    Json list = Json::array();
    for (const Diagnostic& d : findings.list()) {
        warnings += d.severity == Severity::warning ? 1 : 0;
        list.push_back(to_json(d, source));
    }
    return {{"schema", "frep.check/1"},     {"model", json_text(source.name())},
            {"ok", !findings.has_errors()}, {"errors", findings.error_count()},
            {"warnings", warnings},         {"diagnostics", std::move(list)}};
}

}  // namespace

int run_check(Arguments arguments) {
    std::string input;
    bool json = false;
    CommandLine line("check", "check MODEL [options]",
                     "Parses a model and lowers each of its objects; tells what is wrong, and where.",
                     {"frep check pot.hf", "frep check pot.hf --json > findings.json",
                      "frep check pot.hf --quiet && echo fine"});
    line.positional("MODEL", input, "HyperFun file, - for standard input");
    line.flag("--json", json, "the findings as one JSON object on standard output");
    if (const auto code = line.parse(arguments)) return *code;

    int code = exit_ok;
    const auto model = read_model(input, code);
    if (!model) return code;
    const Diagnostics findings = all_findings(*model);
    if (json) {
        if (const int failure = print_result(json_bytes(report(findings, model->source())))) return failure;
    } else {
        print_diagnostics(findings, model->source());
    }
    return findings.has_errors() ? exit_invalid_model : exit_ok;
}

}  // namespace frep::cli
