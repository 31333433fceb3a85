// Implementation of mesh_options.h. Everything that can be refused is refused here, before hours of work.
#include "mesh_options.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "mesh_report.h"
#include "values.h"

namespace frep::cli {

namespace {

Error usage(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }
Error about(std::string_view option, const Error& error) {
    return {error.kind, fmt::format("{}: {}", option, error.message)};
}

constexpr std::string_view format_names = "stl, ply, obj, off, glb, wrl, x3d, 3mf, pov, svg, dxf, cli";

/// The format of files that end in `extension` (".stl"); nothing for others.
std::optional<MeshTarget> target_of(const std::string& extension) {
    MeshTarget target;
    target.extension = lower_case(extension);
    if (const auto mesh = mesh_format_from_path(target.extension)) {
        target.mesh = *mesh;
    } else if (const auto drawing = drawing_format_from_path(target.extension)) {
        target.drawing = *drawing;
    } else if (target.extension == ".cli") {
        target.slices = true;
    } else {
        return std::nullopt;
    }
    return target;
}

Result<MeshTarget> find_target(const MeshOptions& options) {
    if (options.format) {
        if (auto target = target_of("." + *options.format)) return *target;
        return usage(fmt::format("--format: `{}` is not one of {}", *options.format, format_names));
    }
    if (*options.output == "-") {
        MeshTarget target;
        target.is_default = true;
        target.slices = options.layer.has_value();
        if (!target.slices) target.mesh = MeshFormat::stl;
        return target;
    }
    const std::string extension = std::filesystem::path(*options.output).extension().string();
    if (auto target = target_of(extension)) return *target;
    if (extension.empty())
        return usage(fmt::format("'{}' has no extension that names a format; --format takes one of {}",
                                 *options.output, format_names));
    return usage(fmt::format("'{}' is not a format that this verb writes: {}", extension, format_names));
}

Status plan_outputs(const MeshOptions& options, MeshPlan& plan) {
    plan.report_on_stdout = options.json || options.report.value_or("") == "-";
    plan.print_check = options.print_check || options.overhang || options.min_wall;
    const bool asks = plan.report_on_stdout || options.report || options.require || plan.print_check;
    if (!options.output && !asks)
        return usage("-o FILE is missing: where the result goes (.stl, .3mf, .glb, ..., .svg, .dxf, .cli)");
    if (options.output) {
        if (options.output->empty()) return usage("-o: the name of the file is empty");
        if (*options.output == "-" && plan.report_on_stdout)
            return usage("the mesh and the report cannot both go to standard output");
        const auto target = find_target(options);
        if (!target) return target.error();
        plan.target = *target;
        if (const Status folder = check_folder(*options.output); !folder) return folder.error();
    }
    if (options.report)
        if (const Status folder = check_folder(*options.report); !folder) return folder.error();
    if (options.require) {
        auto required = parse_requirements(*options.require);
        if (!required) return about("--require", required.error());
        plan.required = std::move(*required);
    }
    plan.wants_check = asks;
    return {};
}

Status plan_method(const MeshOptions& options, MeshPlan& plan) {
    const std::string method = options.method.value_or("adaptive");
    if (method != "adaptive" && method != "cells")
        return usage(fmt::format("--method: `{}` is not one of adaptive, cells", method));
    plan.is_adaptive = method == "adaptive";
    if (options.tolerance) {
        if (!plan.is_adaptive) return usage("--tolerance belongs to --method adaptive");
        if (options.layer) return usage("--tolerance belongs to meshes of solids, not to slices");
        const auto length = parse_positive(*options.tolerance);
        if (!length) return about("--tolerance", length.error());
        plan.tolerance = *length;
    }
    if (options.grid && options.cell) return usage("give either --grid or --cell");
    return {};
}

Status plan_sampling(const MeshOptions& options, MeshPlan& plan) {
    if (options.grid) {
        const auto count = parse_integer(*options.grid, 1, max_grid_cells);
        if (!count) return about("--grid", count.error());
        plan.cells = static_cast<int>(*count);
    }
    if (options.cell) {
        const auto length = parse_positive(*options.cell);
        if (!length) return about("--cell", length.error());
        plan.cell_length = *length;
    }
    if (options.iso) {
        const auto iso = parse_number(*options.iso);
        if (!iso) return about("--iso", iso.error());
        if (!std::isfinite(*iso)) return usage("--iso: the value must be finite");
        plan.iso = *iso;
    }
    if (options.bounds) {
        const auto box = parse_bounds(*options.bounds);
        if (!box) return about("--bounds", box.error());
        plan.bounds = *box;
    }
    plan.cap = options.cap;
    plan.prune = !options.no_prune;
    return {};
}

/// Slices, the print check and the material.
Status plan_extras(const MeshOptions& options, MeshPlan& plan) {
    if (options.layer) {
        const auto height = parse_positive(*options.layer);
        if (!height) return about("--layer", height.error());
        plan.layer = *height;
    }
    const bool writes_slices = plan.target && plan.target->slices;
    if (writes_slices && plan.layer == 0)
        return usage("--layer LENGTH is missing: the thickness of the layers of a .cli file");
    if (plan.layer > 0 && plan.target && !writes_slices)
        return usage("--layer makes slices, which go to a .cli file");
    if (requires_resolved(plan.required) && (plan.layer > 0 || !plan.is_adaptive))
        return usage("--require resolved belongs to meshes by --method adaptive");
    if (plan.layer > 0 && plan.print_check) return usage("--print-check judges a mesh, not slices");
    if (options.material) {
        const NamedMaterial* material = find_material(*options.material);
        if (!material) {
            std::string names;
            for (const NamedMaterial& m : materials())
                names += (names.empty() ? "" : ", ") + std::string(m.name);
            return usage(fmt::format("--material: `{}` is not one of {}", *options.material, names));
        }
        plan.material = material->look;
    }
    if (options.overhang) {
        std::string_view text = *options.overhang;
        if (text.ends_with("deg")) text.remove_suffix(3);
        const auto angle = parse_number(text);
        if (!angle || !(*angle >= 0 && *angle <= 90))
            return usage(
                fmt::format("--overhang: `{}` is not an angle from 0deg to 90deg", *options.overhang));
        plan.overhang = *angle;
    }
    if (options.min_wall) {
        const auto wall = parse_positive(*options.min_wall);
        if (!wall) return about("--min-wall", wall.error());
        plan.min_wall = *wall;
    }
    return {};
}

Status plan_objects(const MeshOptions& options, MeshPlan& plan) {
    const std::string names = options.model.object.value_or("");
    for (const std::string_view name : split_at_commas(names)) plan.objects.emplace_back(name);
    if (plan.objects.size() < 2) return {};
    if (options.model.input == "-")
        return usage("--object: a list of objects needs the model in a file, not on standard input");
    if (plan.layer > 0) return usage("--layer takes one object");
    for (const std::string& name : plan.objects)
        if (name.empty()) return usage("--object: a name in the list is empty");
    return {};
}

}  // namespace

void declare_mesh_options(CommandLine& line, MeshOptions& options) {
    declare_model_options(line, options.model);
    line.text("-o,--output", options.output, "FILE",
              "solids: .stl .ply .obj .off .glb .wrl .x3d .3mf .pov; 2-D: .svg .dxf; slices: .cli; - for "
              "standard output");
    line.text("--format", options.format, "FORMAT", "stl, ply, ..., whatever the file is called");
    line.flag("--ascii", options.ascii, "text in place of binary (.stl, .ply)");
    line.text("--method", options.method, "METHOD",
              "adaptive (default): sharp edges are kept; cells: uniform cubic cells");
    line.text("--grid", options.grid, "N", "cells along the longest side (default 96; 2-D and slices 256)");
    line.text("--cell", options.cell, "LENGTH", "side of a cell, in place of --grid");
    line.text("--tolerance", options.tolerance, "LENGTH",
              "cells merge where the mesh stays this near to the surface");
    line.text("--layer", options.layer, "LENGTH", "slices of this thickness, for a .cli file");
    line.text("--iso", options.iso, "V", "the surface F = V (default 0)");
    line.flag("--cap", options.cap, "close the shape where the box cuts it");
    line.text("--bounds", options.bounds, "BOX",
              "v, or min,max, or ax,bx,ay,by,az,bz; 2-D: ax,bx,ay,by (default: found)");
    line.text("--report", options.report, "FILE.json", "checks and measures of the mesh");
    line.flag("--json", options.json, "the report on standard output");
    line.text("--require", options.require, "LIST",
              "closed,manifold,oriented,no-self-intersection,resolved: exit code 3 if it is not");
    line.text("--material", options.material, "NAME", "how the surface looks (.glb, .obj, .wrl, .x3d, .pov)");
    line.flag("--print-check", options.print_check, "walls, gaps, overhangs and stand, for 3-D printing");
    line.text("--overhang", options.overhang, "ANGLE", "steepest slope that prints unsupported (45deg)");
    line.text("--min-wall", options.min_wall, "LENGTH", "exit code 3 if a thinner wall is found");
    line.flag("--no-prune", options.no_prune, "evaluate everywhere; the same mesh, slower");
}

Result<MeshPlan> plan_mesh(const MeshOptions& options) {
    MeshPlan plan;
    for (const auto step : {plan_method, plan_sampling, plan_outputs, plan_extras, plan_objects}) {
        if (const Status status = step(options, plan); !status) return status.error();
    }
    return plan;
}

}  // namespace frep::cli
