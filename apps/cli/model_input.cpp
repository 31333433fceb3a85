// Implementation of model_input.h.
#include "model_input.h"

#include <algorithm>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "input_stream.h"
#include "parameters.h"
#include "terminal.h"
#include "values.h"

namespace frep::cli {

namespace {

Result<std::string> read_source(const std::string& path) {
    if (path == "-" || is_pipe(path)) return read_stream(path, lang::source_limit);
    return read_file(path, lang::source_limit);
}

bool has_extension(const std::string& path, std::string_view extension) {
    return lower_case(std::filesystem::path(path).extension().string()) == extension;
}

/// The engine of that name, without a name the default one; an unknown name is printed.
std::optional<EngineInfo> choose_engine(const std::optional<std::string>& name) {
    if (!name) return engines().back();
    std::vector<std::string_view> names;
    for (const EngineInfo& info : engines()) {
        if (info.name == *name) return info;
        names.push_back(info.name);
    }
    print_error(fmt::format("--engine: this program has no engine `{}`", *name));
    print_help_line(fmt::format("it has: {}", fmt::join(names, ", ")));
    return std::nullopt;
}

/// Engine, steps and threads into `out`; false when one is wrong, which is printed.
bool read_running_options(const ModelOptions& options, PreparedModel& out) {
    const auto engine = choose_engine(options.engine);
    if (!engine) return false;
    out.evaluator.engine = engine->engine;
    out.evaluator.compile_at_once = options.engine.has_value();
    out.engine = engine->name;
    if (options.max_steps) {
        const auto steps = parse_integer(*options.max_steps, 1, std::int64_t{1} << 53);
        if (!steps) return usage_error("--max-steps: " + steps.error().message), false;
        out.evaluator.max_steps = *steps;
    }
    std::int64_t threads = 0;
    if (options.threads) {
        const auto given = parse_integer(*options.threads, 0, 1024);
        if (!given) return usage_error("-j: " + given.error().message), false;
        threads = *given;
    }
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    out.threads = static_cast<int>(threads);
    return true;
}

}  // namespace

std::optional<Model> read_model(const std::string& path, int& code) {
    if (path.empty()) {
        code = usage_error("a model is missing: give the name of a .hf file");
        return std::nullopt;
    }
    const auto bytes = read_source(path);
    if (!bytes) {
        code = fail(bytes.error());
        return std::nullopt;
    }
    const std::string folder = path == "-" ? "" : std::filesystem::path(path).parent_path().string();
    const ModelText text = has_extension(path, ".vm") ? ModelText::vm : ModelText::hyperfun;
    return Model(Source(path == "-" ? "<stdin>" : to_valid_utf8(path), *bytes), files_of_folder(folder),
                 text);
}

std::optional<Model> load_model(const std::string& path, int& code) {
    auto model = read_model(path, code);
    if (!model || model->ok()) return model;
    print_diagnostics(model->diagnostics(), model->source());
    code = exit_invalid_model;
    return std::nullopt;
}

std::optional<std::size_t> choose_object(const Model& model, std::string_view name, int& code) {
    const auto found = model.find_object(name);
    if (found) return found;
    print_error(fmt::format("--object: the model has no object `{}`", name));
    if (const std::string_view near = model.nearest_object(name); !near.empty()) {
        print_help_line(fmt::format("did you mean `{}`?", near));
    } else {
        std::string names;
        for (const lang::Object& object : model.program().objects) {
            if (names.size() > 200) break;
            names += fmt::format("{}{}", names.empty() ? "" : ", ", object.written_name);
        }
        print_help_line("it has: " + names);
    }
    code = exit_usage;
    return std::nullopt;
}

void declare_model_options(CommandLine& line, ModelOptions& options) {
    line.positional("MODEL", options.input, "HyperFun file, - for standard input");
    line.text("--object", options.object, "NAME", "object to take (default my_model, else the first)");
    line.text("-a", options.values, "V,V,...", "values of the parameters a[1], a[2], ...");
    line.texts("--param", options.named_values, "NAME=V",
               "value of one parameter: its name, or a[3] (repeatable)");
    line.text("--map", options.map, "MAP",
              "x, y, z, a number or a parameter for every coordinate; or NAME=V to freeze some");
    line.text("--engine", options.engine, "NAME", "engine to evaluate with (see frep info --engines)");
    line.flag("--no-lift", options.no_lift,
              "leave set operations that are spelled out by roots or absolute values as they are");
    line.text("--max-steps", options.max_steps, "N", "loop steps at one point (default 1000000)");
    line.text("-j,--threads", options.threads, "N", "threads (default: all cores); the result is the same");
}

std::optional<PreparedModel> prepare_model(const ModelOptions& options, int& code) {
    auto model = load_model(options.input, code);
    if (!model) return std::nullopt;
    code = exit_usage;
    const auto object = choose_object(*model, options.object.value_or(""), code);
    if (!object) return std::nullopt;
    PreparedModel out{std::move(*model), *object, {}, {}, {}, {}, false, 1};
    if (!read_running_options(options, out)) return std::nullopt;
    const auto count = static_cast<std::size_t>(out.header().coordinates());
    out.map_given = options.map.has_value();
    out.map = AxisMap::standard(static_cast<int>(count));
    if (options.map) {
        auto stated = parse_map(*options.map, count, [&](std::string_view name) {
            const auto number = find_parameter(out.model, *object, name);
            const auto most = static_cast<std::size_t>(out.header().parameters());
            return number && *number <= most ? std::optional(*number - 1) : std::nullopt;
        });
        if (!stated) return usage_error("--map: " + stated.error().message), std::nullopt;
        out.map = std::move(stated->map);
        out.tied = std::move(stated->tied);
    }
    const auto parameters = read_parameters(out.model, *object, options.values, options.named_values);
    if (!parameters) return std::nullopt;
    for (const auto& [coordinate, parameter] : out.tied)
        out.map.coordinates[coordinate].value = (*parameters)[parameter];

    Diagnostics found = out.model.diagnostics();
    auto lowered = out.model.lower(*object, *parameters, found, !options.no_lift);
    print_diagnostics(found, out.model.source());
    if (!lowered) {
        code = exit_invalid_model;
        return std::nullopt;
    }
    out.lowered = std::move(*lowered);
    code = exit_ok;
    return out;
}

Result<std::unique_ptr<SampledField>> sampled_field(const PreparedModel& prepared, double iso,
                                                    bool attributes) {
    EvaluatorOptions options = prepared.evaluator;
    options.attributes = attributes;
    auto evaluator = make_evaluator(prepared.field(), options);
    if (!evaluator) return evaluator.error();
    return make_sampled_field(std::move(*evaluator), prepared.map, iso);
}

bool has_colors(const PreparedModel& prepared) { return prepared.field().attributes.size() >= 3; }

std::optional<Color> annotated_color(const Model& model) {
    const std::vector<double>& color = model.program().annotations.color;
    if (color.size() != 3) return std::nullopt;
    return Color{color[0], color[1], color[2]};
}

std::optional<int> unused_axis(const PreparedModel& prepared) {
    for (int axis = 2; axis >= 0; --axis)
        if (!prepared.map.uses(axis)) return axis;
    return std::nullopt;
}

std::string coordinate_name(std::size_t index) {
    static constexpr std::string_view names = "xyzt";
    return index < names.size() ? std::string(1, names[index]) : fmt::format("x{}", index + 1);
}

std::optional<std::size_t> find_coordinate(std::string_view name, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (name == coordinate_name(i) || name == fmt::format("x{}", i + 1) ||
            name == fmt::format("x[{}]", i + 1))
            return i;
    return std::nullopt;
}

std::optional<std::size_t> find_time(std::string_view name, std::size_t count) {
    return name == "t" && count == 3 ? std::optional<std::size_t>(2) : std::nullopt;
}

namespace {

Error map_error(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

/// Freezes coordinate i at the number, or ties it to the parameter, that `text` means. False for neither.
bool freeze_at(std::size_t i, std::string_view text, const FindParameter& find, StatedMap& out) {
    if (const auto value = parse_number(text)) {
        out.map.coordinates[i] = {.axis = -1, .value = *value};
        return true;
    }
    const auto parameter = find ? find(lower_case(text)) : std::nullopt;
    if (!parameter) return false;
    out.map.coordinates[i] = {.axis = -1, .value = 0};
    out.tied.emplace_back(i, *parameter);
    return true;
}

/// Freezes the coordinate that `piece` (NAME=V) names.
Status freeze(std::string_view piece, const FindParameter& find, StatedMap& out) {
    const std::size_t equals = piece.find('=');
    const std::string name = lower_case(piece.substr(0, equals));
    const std::string_view value = piece.substr(equals + 1);
    const std::size_t count = out.map.coordinates.size();
    auto coordinate = find_coordinate(name, count);
    if (!coordinate) coordinate = find_time(name, count);
    if (!coordinate) return map_error(fmt::format("the object has no coordinate `{}`", name));
    if (freeze_at(*coordinate, value, find, out)) return {};
    return map_error(fmt::format("`{}` is neither a number nor a parameter", value));
}

}  // namespace

Result<StatedMap> parse_map(std::string_view text, std::size_t count, const FindParameter& find) {
    const std::vector<std::string_view> pieces = split_at_commas(text);
    const auto is_named = [](std::string_view piece) { return piece.find('=') != std::string_view::npos; };
    const auto named = static_cast<std::size_t>(std::count_if(pieces.begin(), pieces.end(), is_named));
    if (named > 0 && named < pieces.size())
        return map_error("give an entry for every coordinate, or NAME=V entries only");
    StatedMap out{AxisMap::standard(static_cast<int>(count)), {}};
    if (named > 0) {
        for (const std::string_view piece : pieces)
            if (const Status status = freeze(piece, find, out); !status) return status.error();
        return out;
    }
    if (pieces.size() != count)
        return map_error(
            fmt::format("`{}` has {} entries, the object has {} coordinates", text, pieces.size(), count));
    for (std::size_t i = 0; i < count; ++i) {
        const std::string entry = lower_case(pieces[i]);
        if (entry == "x" || entry == "y" || entry == "z")
            out.map.coordinates[i] = {.axis = entry[0] - 'x', .value = 0};
        else if (!freeze_at(i, entry, find, out))
            return map_error(
                fmt::format("`{}` is neither x, y, z, a number nor a parameter of the object", pieces[i]));
    }
    return out;
}

void warn_undefined(const PreparedModel& prepared, NodeId root, std::span<const double> point,
                    const std::string& message) {
    const auto causes = find_undefined(prepared.field(), root, point, prepared.evaluator.max_steps);
    const UndefinedCause* first = nullptr;
    for (const UndefinedCause& cause : causes) {
        if (cause.origin.end == 0) continue;  // a node without a place
        if (!first || cause.origin.begin < first->origin.begin) first = &cause;
    }
    if (!first) return print_warning(message);
    Diagnostic d;
    d.severity = Severity::warning;
    d.message = message;
    d.span = first->origin;
    d.label = "no value here";
    print_uncoded(d, prepared.model.source());
}

std::string point_text(std::span<const double> point) {
    std::string out = "(";
    for (const double value : point) {
        if (out.size() > 1) out += ", ";
        append_number(out, value);
    }
    return out + ")";
}

}  // namespace frep::cli
