// `frep info`: what a model consists of; with --library and --engines what the program has.
// Tested by tests/cli/info.txt.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "command_line.h"
#include "info_file.h"
#include "json.h"
#include "model_input.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

struct InfoOptions {
    std::string input;
    std::optional<std::string> object;
    bool library = false, engines = false, json = false;
};

std::string_view word(shapes::ArgumentKind kind) {
    switch (kind) {
        case shapes::ArgumentKind::number:
            return "number";
        case shapes::ArgumentKind::array:
            return "array";
        case shapes::ArgumentKind::array_in_out:
            return "changed array";
        case shapes::ArgumentKind::text:
            return "text";
    }
    return "number";
}

Json library_json() {
    Json list = Json::array();
    for (const shapes::LibraryFunction& f : shapes::library()) {
        Json arguments = Json::array();
        for (const shapes::ArgumentInfo& a : f.arguments)
            arguments.push_back({{"name", a.name}, {"kind", word(a.kind)}});
        list.push_back({{"name", f.name},
                        {"group", f.group},
                        {"arguments", std::move(arguments)},
                        {"doc", f.doc},
                        {"formula", f.formula},
                        {"citation", f.citation},
                        {"note", f.note}});
    }
    return list;
}

std::string library_text() {
    std::string out;
    std::string_view group;
    for (const shapes::LibraryFunction& f : shapes::library()) {
        if (f.group != group) {
            out += fmt::format("{}{}\n", out.empty() ? "" : "\n", f.group);
            group = f.group;
        }
        out += fmt::format("  {}\n      {}\n", shapes::signature(f), f.doc);
        if (!f.note.empty()) out += fmt::format("      note: {}\n", f.note);
    }
    return out;
}

Json engines_json() {
    Json list = Json::array();
    for (const EngineInfo& engine : engines())
        list.push_back(
            {{"name", engine.name}, {"doc", engine.doc}, {"default", &engine == &engines().back()}});
    return list;
}

std::string engines_text() {
    std::string out;
    for (const EngineInfo& engine : engines())
        out += fmt::format("{:<10} {}{}\n", engine.name, engine.doc,
                           &engine == &engines().back() ? " (default)" : "");
    out += fmt::format("instructions up to {}; {} native code\n", name_of(machine_isa()),
                       NativeCode<double>::is_available() ? "with" : "without");
    return out;
}

/// An object with what its lowering found.
struct ObjectFacts {
    const lang::Object* object = nullptr;
    bool is_default = false;
    lang::Lowered lowered;
    std::size_t operations_after = 0;
    std::vector<double> parameters;
};

/// The `--@ param` line of a parameter, from 1, or none.
const lang::ParameterAnnotation* annotation_of(const Model& model, const ObjectFacts& facts, int index) {
    if (!facts.is_default) return nullptr;  // the annotations speak of the default object
    for (const lang::ParameterAnnotation& p : model.program().annotations.parameters)
        if (p.index == index) return &p;
    return nullptr;
}

bool is_structural(const ObjectFacts& facts, int index) {
    const auto i = static_cast<std::size_t>(index - 1);
    return i < facts.lowered.structural.size() && facts.lowered.structural[i];
}

Json parameters_json(const Model& model, const ObjectFacts& facts) {
    Json list = Json::array();
    for (int i = 1; i <= facts.object->parameters(); ++i) {
        const lang::ParameterAnnotation* p = annotation_of(model, facts, i);
        Json range = nullptr;
        if (p && p->has_range) range = {json_number(p->low), json_number(p->high)};
        list.push_back({{"index", i},
                        {"name", p ? json_text(p->name) : Json(nullptr)},
                        {"range", std::move(range)},
                        {"default", json_number(facts.parameters[static_cast<std::size_t>(i - 1)])},
                        {"structural", is_structural(facts, i)},
                        {"description", p ? json_text(p->description) : Json(nullptr)}});
    }
    return list;
}

Json object_json(const Model& model, const ObjectFacts& facts) {
    return {{"name", json_text(facts.object->written_name)},
            {"default", facts.is_default},
            {"dimension", facts.object->coordinates()},
            {"attributes", facts.object->declares_attributes ? facts.object->attributes() : 0},
            {"parameters", parameters_json(model, facts)},
            {"functions", facts.lowered.functions},
            {"operations_before", facts.lowered.operations_before},
            {"operations_after", facts.operations_after},
            {"operations_lifted", facts.lowered.lifted.total()},
            {"loops_depend_on_point", facts.lowered.has_regions}};
}

Json model_json(const Model& model, const std::vector<ObjectFacts>& objects) {
    const lang::Annotations& notes = model.program().annotations;
    const auto text_or_null = [](const std::string& s) { return s.empty() ? Json(nullptr) : json_text(s); };
    Json list = Json::array();
    for (const ObjectFacts& facts : objects) list.push_back(object_json(model, facts));
    return {{"schema", "frep.info/1"},
            {"model", json_text(model.source().name())},
            {"title", text_or_null(notes.title)},
            {"author", text_or_null(notes.author)},
            {"license", text_or_null(notes.license)},
            {"source", text_or_null(notes.source)},
            {"units", text_or_null(notes.units)},
            {"bounds", notes.bounds.empty() ? Json(nullptr) : Json(notes.bounds)},
            {"color", notes.color.empty() ? Json(nullptr) : Json(notes.color)},
            {"objects", std::move(list)}};
}

std::string numbers_text(const std::vector<double>& values) {
    std::string out;
    for (const double value : values) {
        if (!out.empty()) out += ' ';
        append_number(out, value);
    }
    return out;
}

std::string parameter_text(const Model& model, const ObjectFacts& facts, int index) {
    const lang::ParameterAnnotation* p = annotation_of(model, facts, index);
    std::string out = fmt::format("    a[{}]", index);
    if (p) out += "  " + escape_controls(p->name);
    if (p && p->has_range) out += fmt::format("  {}..{}", number_text(p->low), number_text(p->high));
    out += "  default " + number_text(facts.parameters[static_cast<std::size_t>(index - 1)]);
    if (is_structural(facts, index)) out += "  structural";
    if (p && !p->description.empty()) out += fmt::format("  \"{}\"", escape_controls(p->description));
    return out + "\n";
}

std::string object_text(const Model& model, const ObjectFacts& facts) {
    const lang::Object& object = *facts.object;
    std::string out = fmt::format("\nobject {}{}\n", escape_controls(object.written_name),
                                  facts.is_default ? " (default)" : "");
    std::string names;
    for (int i = 0; i < object.coordinates(); ++i)
        names += fmt::format("{}{}", i > 0 ? " " : "", coordinate_name(static_cast<std::size_t>(i)));
    out += fmt::format("  dimension   {}{}\n", object.coordinates(),
                       names.empty() ? "" : fmt::format(": {}", names));
    if (object.declares_attributes) out += fmt::format("  attributes  {}\n", object.attributes());
    out += fmt::format("  parameters  {}\n", object.parameters());
    for (int i = 1; i <= object.parameters(); ++i) out += parameter_text(model, facts, i);
    out +=
        fmt::format("  functions   {}\n", facts.lowered.functions.empty()
                                              ? "none"
                                              : fmt::format("{}", fmt::join(facts.lowered.functions, " ")));
    out += fmt::format("  operations  {} as written, {} after simplification\n",
                       facts.lowered.operations_before, facts.operations_after);
    if (const LiftReport& lifted = facts.lowered.lifted; lifted.total() > 0)
        out += fmt::format("  lifted      {} R-functions, {} minima and maxima from sums\n",
                           lifted.r_functions, lifted.min_max);
    if (facts.lowered.has_regions) out += "  loops       some depend on the point: pruning may find less\n";
    return out;
}

std::string model_text(const Model& model, const std::vector<ObjectFacts>& objects) {
    const lang::Annotations& notes = model.program().annotations;
    std::string out = fmt::format("model    {}\n", escape_controls(model.source().name()));
    const auto line = [&](std::string_view key, const std::string& value) {
        if (!value.empty()) out += fmt::format("{:<8} {}\n", key, escape_controls(value));
    };
    line("title", notes.title);
    line("author", notes.author);
    line("license", notes.license);
    line("source", notes.source);
    line("units", notes.units);
    line("bounds", numbers_text(notes.bounds));
    line("color", numbers_text(notes.color));
    for (const ObjectFacts& facts : objects) out += object_text(model, facts);
    return out;
}

int describe_model(const InfoOptions& options) {
    if (!options.object)
        if (const auto done = describe_file(options.input, options.json)) return *done;
    int code = exit_ok;
    const auto model = load_model(options.input, code);
    if (!model) return code;
    std::size_t begin = 0, end = model->program().objects.size();
    if (options.object) {
        const auto only = choose_object(*model, *options.object, code);
        if (!only) return code;
        begin = *only;
        end = begin + 1;
    }
    Diagnostics found = model->diagnostics();
    std::vector<ObjectFacts> objects;
    for (std::size_t i = begin; i < end; ++i) {
        Diagnostics own;
        auto lowered = model->lower(i, {}, own);
        if (!lowered) found.append(own);
        if (!lowered) continue;
        const std::vector<NodeId> roots = lowered->field.roots();
        const std::size_t after = count_operations(*lowered->field.graph, roots).operations;
        objects.push_back({&model->program().objects[i], model->find_object({}) == i, std::move(*lowered),
                           after, model->complete_parameters(i, {})});
    }
    print_diagnostics(found, model->source());
    if (found.has_errors()) return exit_invalid_model;
    return print_result(options.json ? json_bytes(model_json(*model, objects)) : model_text(*model, objects));
}

/// --library and --engines.
int describe_program(const InfoOptions& options) {
    if (options.json) {
        Json out = {{"schema", "frep.info/1"}};
        if (options.engines) {
            out["engines"] = engines_json();
            out["instruction_set"] = name_of(machine_isa());
            out["native_code"] = NativeCode<double>::is_available();
        }
        if (options.library) out["library"] = library_json();
        return print_result(json_bytes(out));
    }
    std::string out;
    if (options.engines) out += engines_text();
    if (options.engines && options.library) out += "\n";
    if (options.library) out += library_text();
    return print_result(out);
}

}  // namespace

int run_info(Arguments arguments) {
    InfoOptions options;
    CommandLine line(
        "info", "info FILE [options] | info --library | info --engines",
        "Tells what a model, a drawing, a font or a voxel file consists of, or what this program has.",
        {"frep info pot.hf", "frep info logo.svg --json", "frep info --library"});
    line.positional("FILE", options.input,
                    "HyperFun file, - for standard input; or .svg .ttf .otf .ttc .woff .nrrd .nhdr .vdb");
    line.text("--object", options.object, "NAME", "only this object (default: all)");
    line.flag("--library", options.library, "list the functions of the FRep library");
    line.flag("--engines", options.engines, "list the engines");
    line.flag("--json", options.json, "as one JSON object on standard output");
    if (const auto code = line.parse(arguments)) return *code;
    if (!options.library && !options.engines) return describe_model(options);
    if (!options.input.empty()) return usage_error("--library and --engines take no model");
    return describe_program(options);
}

}  // namespace frep::cli
