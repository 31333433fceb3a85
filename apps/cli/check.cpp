// `frep check`: the mistakes of a model's text, those that only show when its objects are lowered, and what
// its blends do to the shape. Tested by tests/cli/check.txt.
#include <cctype>
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

/// The word that a call begins with at this place of the text, in lower case.
std::string called_name(const Source& source, Span span) {
    const std::string_view text = source.text(span);
    std::size_t end = 0;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
        ++end;
    return lower_case(text.substr(0, end));
}

/// What the geometry says of a blend, or nothing: fillets and blends by extents are meant for every edge that
/// the two solids have in common, blends between control points for one.
std::optional<Diagnostic> blend_diagnostic(const BlendFinding& found, const Source& source,
                                           const std::array<bool, 3>& axes) {
    const auto text = [&](const Vec3& p) {
        const std::array<double, 3> all{p.x, p.y, p.z};
        std::string out;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (axes[axis]) out += fmt::format("{}{:.4g}", out.empty() ? "(" : ", ", all[axis]);
        return out + ")";
    };
    Diagnostic d;
    d.severity = Severity::warning;
    d.span = found.origin;
    switch (found.flaw) {
        case BlendFlaw::never_acts:
            d.message = "this blend changes nothing: the shape is that of the plain set operation";
            d.label = "never reaches the surface";
            d.help =
                "the two surfaces do not meet where it acts, or what it adds lies inside the rest of the "
                "model; "
                "check the bounding solid and the extents";
            return d;
        case BlendFlaw::second_place:
            if (!called_name(source, found.origin).starts_with("hfcontrolblend")) return std::nullopt;
            d.message = fmt::format("this blend also acts at {}, apart from {}", text(found.place),
                                    text(found.first_place));
            d.label = "acts at a second place";
            d.help =
                "a blend between control points acts wherever the two surfaces are that near; "
                "hfBoundedBlendUni and its relatives choose one place by a bounding solid";
            return d;
        case BlendFlaw::through_wall:
            d.message = fmt::format("the bounding solid of this blend reaches another surface at {}",
                                    text(found.place));
            d.label = "moves a surface away from the joint";
            d.help = fmt::format(
                "the joint is near {}; make the bounding solid smaller, cut it with the outer surface, "
                "or blend before the hollow is taken out",
                text(found.first_place));
            return d;
    }
    return std::nullopt;
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
    if (has_regions(prepared->field())) {
        print_note("--blends: the model has loops that depend on the point; its blends were not looked at");
        return exit_ok;
    }
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
