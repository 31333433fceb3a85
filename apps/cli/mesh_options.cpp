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

constexpr std::string_view later_formats = ".obj .glb .wrl .x3d .3mf .pov .svg .dxf";

Result<MeshFormat> format_of(const MeshOptions& options) {
    if (options.format) {
        const auto format = mesh_format_from_path("." + *options.format);
        if (!format) return usage(fmt::format("--format: `{}` is not one of stl, ply, off", *options.format));
        return *format;
    }
    if (*options.output == "-") return MeshFormat::stl;
    const auto format = mesh_format_from_path(*options.output);
    if (format) return *format;
    const std::string extension = lower_case(std::filesystem::path(*options.output).extension().string());
    if (extension.size() > 1 && (std::string(later_formats) + " ").find(extension + " ") != std::string::npos)
        return usage(fmt::format("{} files come with a later version; this one writes .stl, .ply and .off",
                                 extension));
    return usage(format.error().message);
}

/// The folder of an output file must be there before the work begins.
Status check_folder(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::error_code error;
    if (path == "-" || folder.empty() || std::filesystem::is_directory(folder, error)) return {};
    return Error{ErrorKind::io,
                 fmt::format("cannot write '{}': there is no folder '{}'", path, folder.string())};
}

Status plan_outputs(const MeshOptions& options, MeshPlan& plan) {
    const bool report_on_stdout = options.json || options.report.value_or("") == "-";
    if (!options.output && !report_on_stdout && !options.report && !options.require)
        return usage("-o FILE is missing: where the mesh goes (.stl, .ply or .off)");
    if (options.output) {
        if (options.output->empty()) return usage("-o: the name of the file is empty");
        if (*options.output == "-" && report_on_stdout)
            return usage("the mesh and the report cannot both go to standard output");
        const auto format = format_of(options);
        if (!format) return format.error();
        plan.format = *format;
        if (const Status folder = check_folder(*options.output); !folder) return folder.error();
    }
    if (options.report)
        if (const Status folder = check_folder(*options.report); !folder) return folder.error();
    if (options.require) {
        auto required = parse_requirements(*options.require);
        if (!required) return about("--require", required.error());
        plan.required = std::move(*required);
    }
    plan.wants_check = report_on_stdout || options.report || options.require;
    return {};
}

Status plan_method(const MeshOptions& options) {
    if (options.method && *options.method == "adaptive")
        return usage("--method adaptive comes with a later version; this one has --method cells");
    if (options.method && *options.method != "cells")
        return usage(fmt::format("--method: `{}` is not one of adaptive, cells", *options.method));
    if (options.tolerance)
        return usage(
            "--tolerance belongs to --method adaptive, which comes with a later version; "
            "use --grid or --cell");
    if (options.grid && options.cell) return usage("give either --grid or --cell");
    return {};
}

Status plan_sampling(const MeshOptions& options, MeshPlan& plan) {
    if (options.grid) {
        const auto count = parse_integer(*options.grid, 1, max_grid_cells);
        if (!count) return about("--grid", count.error());
        plan.contour.cells = static_cast<int>(*count);
    }
    if (options.cell) {
        const auto length = parse_positive(*options.cell);
        if (!length) return about("--cell", length.error());
        plan.contour.cell_length = *length;
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
    plan.contour.cap = options.cap;
    plan.contour.prune = !options.no_prune;
    return {};
}

}  // namespace

void declare_mesh_options(CommandLine& line, MeshOptions& options) {
    declare_model_options(line, options.model);
    line.text("-o,--output", options.output, "FILE", "the mesh: .stl, .ply, .off; - for standard output");
    line.text("--format", options.format, "FORMAT", "stl, ply or off, whatever the file is called");
    line.flag("--ascii", options.ascii, "text in place of binary (.stl, .ply)");
    line.text("--method", options.method, "METHOD", "cells: the marching of uniform cubic cells");
    line.text("--grid", options.grid, "N", "cubic cells along the longest side (default 96)");
    line.text("--cell", options.cell, "LENGTH", "side of a cell, in place of --grid");
    line.text("--tolerance", options.tolerance, "LENGTH", "of --method adaptive, in a later version");
    line.text("--iso", options.iso, "V", "the surface F = V (default 0)");
    line.flag("--cap", options.cap, "close the shape where the box cuts it");
    line.text("--bounds", options.bounds, "BOX", "v, or min,max, or ax,bx,ay,by,az,bz (default: found)");
    line.text("--report", options.report, "FILE.json", "checks and measures of the mesh");
    line.flag("--json", options.json, "the report on standard output");
    line.text("--require", options.require, "LIST", "closed,manifold,oriented: exit code 3 if it is not");
    line.flag("--no-prune", options.no_prune, "evaluate everywhere; the same mesh, slower");
}

Result<MeshPlan> plan_mesh(const MeshOptions& options) {
    MeshPlan plan;
    if (const Status status = plan_method(options); !status) return status.error();
    if (const Status status = plan_sampling(options, plan); !status) return status.error();
    if (const Status status = plan_outputs(options, plan); !status) return status.error();
    return plan;
}

}  // namespace frep::cli
