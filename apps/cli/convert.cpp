// `frep convert`: a mesh file in another mesh format, or a model in an exchange form (convert_model.cpp).
// Tested by tests/cli/convert.txt.
#include "convert.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "budget.h"
#include "command_line.h"
#include "info_file.h"
#include "json.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

constexpr std::size_t file_limit = 0xffffffff;

bool is_model(const std::string& path) {
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    return path == "-" || extension == ".hf" || extension == ".vm";
}

void declare_convert_options(CommandLine& line, ConvertOptions& options) {
    declare_model_options(line, options.model);
    line.text("-o,--output", options.output, "FILE",
              "the result: .stl .ply .obj .off .glb .wrl .x3d .3mf .pov; - for standard output");
    line.text("--format", options.format, "FORMAT",
              "the result's format, whatever the file is called: its extension without dot");
    line.text("--unit", options.unit, "UNIT", "unit of a mesh without one: mm (default), cm, m, inch, ...");
    line.flag("--merge", options.merge, "join vertices at equal positions");
    line.flag("--ascii", options.ascii, "text in place of binary (.stl, .ply)");
    line.flag("--json", options.json, "what was read, on standard output");
    line.text("--bounds", options.bounds, "BOX",
              "of a model: v, or min,max, or ax,bx,ay,by,az,bz (default: found)");
    line.text("--max-gradient", options.max_gradient, "V",
              "of a model: largest slope of F at the surface (default: sampled)");
}

Result<MeshFormat> target_format(const ConvertOptions& options) {
    const auto bad = [](std::string message) {
        return Error{ErrorKind::invalid_argument, std::move(message)};
    };
    if (!options.output) return bad("-o FILE is missing: where the result goes");
    if (options.output->empty()) return bad("-o: the name of the file is empty");
    if (options.format) {
        const auto format = mesh_format_from_path("." + *options.format);
        if (!format)
            return bad(fmt::format("--format: `{}` is not one of stl, ply, obj, off, glb, wrl, x3d, 3mf, pov",
                                   *options.format));
        return *format;
    }
    if (*options.output == "-") return bad("-o -: --format says in which format");
    return mesh_format_from_path(*options.output);
}

struct ReadScene {
    Scene scene;
    SceneReadFormat format;
    ReadReport report;
};

Result<ReadScene> read_mesh_file(const std::string& path, const LengthUnit& unit) {
    const auto bytes = read_file(path, file_limit);
    if (!bytes) return bytes.error();
    const auto format = scene_read_format(path, *bytes);
    if (const auto named = named_file_kind(path, *bytes); !format && named)
        return Error{
            ErrorKind::invalid_argument,
            fmt::format("'{}' is {}: it becomes a solid in a model, by {}; `frep info` tells what it has",
                        path, named->what, named->function)};
    if (!format) return Error{format.error().kind, format.error().message + "; models are .hf and .vm"};
    ReadReport report;
    const ReadOptions options{
        .unit = unit, .read_companion = files_of_folder(std::filesystem::path(path).parent_path().string())};
    auto scene = decode_scene(*bytes, *format, options, &report);
    if (!scene)
        return Error{scene.error().kind, fmt::format("cannot read '{}' as {}: {}", path,
                                                     scene_read_format_name(*format), scene.error().message)};
    return ReadScene{std::move(*scene), *format, std::move(report)};
}

Json report_json(const ReadScene& in, MeshFormat target) {
    Json out = {{"schema", "frep.convert/1"},
                {"input_format", scene_read_format_name(in.format)},
                {"output_format", format_extension(target).substr(1)},
                {"unit", in.scene.unit.name},
                {"unit_stated", in.report.unit_stated}};
    std::size_t vertices = 0, triangles = 0;
    Json objects = Json::array();
    for (const SceneObject& object : in.scene.objects) {
        objects.push_back({{"name", json_text(object.name)},
                           {"vertices", object.mesh.vertices.size()},
                           {"triangles", object.mesh.triangles.size()},
                           {"normals", !object.mesh.normals.empty()},
                           {"colors", !object.mesh.colors.empty()}});
        vertices += object.mesh.vertices.size();
        triangles += object.mesh.triangles.size();
    }
    out["objects"] = std::move(objects);
    out["vertices"] = vertices;
    out["triangles"] = triangles;
    out["dropped"] = Json::array();
    for (const std::string& what : in.report.dropped) out["dropped"].push_back(json_text(what));
    return out;
}

void summarize(const ReadScene& in, const std::string& path, const ConvertOptions& options) {
    std::size_t vertices = 0, triangles = 0;
    for (const SceneObject& object : in.scene.objects) {
        vertices += object.mesh.vertices.size();
        triangles += object.mesh.triangles.size();
    }
    if (triangles == 0) print_warning("the file has no triangles");
    for (const std::string& what : in.report.dropped) print_note("left out: " + what);
    const std::size_t count = in.scene.objects.size();
    print_summary(fmt::format(
        "{} ({}): {} object{}, {} vertices, {} triangles, in {}{}", path, scene_read_format_name(in.format),
        count, count == 1 ? "" : "s", vertices, triangles, in.scene.unit.name,
        in.report.unit_stated || options.unit ? "" : " (assumed; --unit states another)"));
}

int convert_mesh(const ConvertOptions& options, MeshFormat target) {
    LengthUnit unit{"mm", 0.001};
    if (options.unit) {
        const auto known = length_unit(*options.unit);
        if (!known)
            return usage_error(
                fmt::format("--unit: `{}` is not one of um, mm, cm, m, inch, ft", *options.unit));
        unit = *known;
    }
    if (options.bounds || options.max_gradient)
        return usage_error("--bounds and --max-gradient belong to models");
    auto in = read_mesh_file(options.model.input, unit);
    if (!in) return fail(in.error());
    if (options.merge)
        for (SceneObject& object : in->scene.objects)
            object.mesh = merge_equal_positions(object.mesh, {.as_float32 = false});
    const auto files = encode_scene(
        in->scene, target,
        {.ascii = options.ascii, .stem = *options.output == "-" ? "" : stem_of_path(*options.output)});
    if (!files) return fail(files.error());
    if (const int code = write_converted(options, *files)) return code;
    summarize(*in, options.model.input, options);
    return options.json ? print_result(json_bytes(report_json(*in, target))) : exit_ok;
}

}  // namespace

std::string_view format_extension(MeshFormat format) {
    constexpr std::array<std::string_view, 9> extensions{".off", ".ply", ".stl", ".obj", ".glb",
                                                         ".wrl", ".x3d", ".3mf", ".pov"};
    return extensions[static_cast<std::size_t>(format)];
}

int write_converted(const ConvertOptions& options, const EncodedFiles& files) {
    if (*options.output == "-") return print_result(files.bytes);
    const WritingFile guard;
    if (const Status status = write_files(*options.output, files); !status) return fail(status.error());
    return exit_ok;
}

int run_convert(Arguments arguments) {
    ConvertOptions options;
    CommandLine line(
        "convert", "convert IN -o OUT [options]",
        "Turns a mesh file into another format, or a model into an exchange form.",
        {"frep convert part.stl -o part.glb", "frep convert scan.ply -o scan.obj --unit m --merge",
         "frep convert pot.hf -o pot.pov"});
    declare_convert_options(line, options);
    if (const auto code = line.parse(arguments)) return *code;
    if (options.model.input.empty()) return usage_error("an input is missing: a mesh file or a model");
    const auto target = target_format(options);
    if (!target) return fail(target.error());
    if (options.json && *options.output == "-")
        return usage_error("the result and the report cannot both go to standard output");
    if (is_model(options.model.input)) return convert_model(options, *target);
    return convert_mesh(options, *target);
}

}  // namespace frep::cli
