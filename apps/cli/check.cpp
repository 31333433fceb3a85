// `frep check`: the mistakes of a model's text, those that only show when its objects are lowered, and what
// its blends do to the shape. Tested by tests/cli/check.txt.
#include <optional>

#include <fmt/format.h>

#include "box.h"
#include "command_line.h"
#include "json.h"
#include "model_input.h"
#include "terminal.h"
#include "values.h"
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

/// The findings of --blends for the default object with its default parameters, or an exit code.
int add_blend_findings(const ModelOptions& options, const std::optional<std::string>& bounds,
                       Diagnostics& out) {
    std::optional<StatedBounds> stated;
    if (bounds) {
        const auto box = parse_bounds(*bounds);
        if (!box) return usage_error("--bounds: " + box.error().message);
        stated = *box;
    }
    int code = exit_ok;
    const bool was_quiet = voice().quiet;
    voice().quiet = true;  // the model's findings are in the list already
    const auto prepared = prepare_model(options, code);
    voice().quiet = was_quiet;
    if (!prepared) return code;
    const auto sampled = sampled_field(*prepared);
    if (!sampled) return fail(sampled.error());
    Job job;
    job.threads = prepared->threads;
    const auto box = choose_box(*prepared, stated, **sampled, job);
    if (!box) return fail(box.error());
    const auto field = field_in_space(prepared->field(), prepared->map);
    if (!field) return fail(field.error());
    BlendCheckOptions check;
    check.bounds = *box;
    for (int axis = 0; axis < 3; ++axis)
        check.axes[static_cast<std::size_t>(axis)] = prepared->map.uses(axis);
    check.evaluator = prepared->evaluator;
    const auto findings = check_blends(*field, check, job);
    if (!findings) return fail(findings.error());
    for (const BlendFinding& found : *findings)
        if (auto d = blend_diagnostic(found, prepared->model.source(), check.axes)) out.add(std::move(*d));
    return exit_ok;
}

}  // namespace

int run_check(Arguments arguments) {
    ModelOptions options;
    std::optional<std::string> bounds;
    bool json = false, blends = false;
    CommandLine line(
        "check", "check MODEL [options]",
        "Parses a model and lowers each of its objects; tells what is wrong, and where.",
        {"frep check pot.hf", "frep check pot.hf --json > findings.json", "frep check pot.hf --blends"});
    line.positional("MODEL", options.input, "HyperFun file, - for standard input");
    line.flag("--json", json, "the findings as one JSON object on standard output");
    line.flag("--blends", blends, "also look at what each blend does to the default object");
    line.text("--object", options.object, "NAME", "object that --blends looks at");
    line.text("--bounds", bounds, "BOX", "where --blends looks (default: found)");
    line.text("-j,--threads", options.threads, "N", "threads of --blends (default: all cores)");
    if (const auto code = line.parse(arguments)) return *code;
    if (blends && options.input == "-") return usage_error("--blends needs a model from a file");

    int code = exit_ok;
    const auto model = read_model(options.input, code);
    if (!model) return code;
    Diagnostics findings = all_findings(*model);
    if (blends && !findings.has_errors())
        if (const int failure = add_blend_findings(options, bounds, findings)) return failure;
    if (json) {
        if (const int failure = print_result(json_bytes(report(findings, model->source())))) return failure;
    } else {
        print_diagnostics(findings, model->source());
    }
    return findings.has_errors() ? exit_invalid_model : exit_ok;
}

}  // namespace frep::cli
