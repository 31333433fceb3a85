// `frep mesh`: the surface of a model as a triangle mesh in a file, the outline of a 2-D model as a drawing,
// or a solid in slices, with checks and promises. Tested by tests/cli/mesh.txt and its neighbours.
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "command_line.h"
#include "mesh_kinds.h"
#include "mesh_options.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

int axes_in_use(const PreparedModel& prepared) {
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) count += prepared.map.uses(axis) ? 1 : 0;
    return count;
}

/// Whether the target suits objects of `axes` axes; tells what would. Settles what nobody named.
int refuse_target(MeshPlan& plan, const PreparedModel& prepared, int axes) {
    if (axes < 2) {
        const int n = prepared.header().coordinates();
        print_error(
            n < 2 ? fmt::format("the object has {} coordinate{}; an outline needs 2, a mesh 3", n,
                                n == 1 ? "" : "s")
                  : std::string("--map: an outline needs two of the axes x, y and z, a mesh all three"));
        return exit_usage;
    }
    if (axes == 2 && plan.layer > 0) return usage_error("--layer slices solids; this object is 2-D");
    if (axes == 2 && plan.print_check)
        return usage_error("--print-check is about solids; this object is 2-D");
    if (!plan.target) return exit_ok;
    if (axes == 2 && plan.target->is_default) {
        plan.target->mesh.reset();
        plan.target->drawing = DrawingFormat::svg;
    }
    if (axes == 2 && !plan.target->drawing) {
        print_error(fmt::format("a 2-D object has an outline and no surface: it cannot become a {} file",
                                plan.target->extension));
        print_help_line(prepared.map_given ? "write it to .svg or .dxf, or let --map use x, y and z"
                                           : "write it to .svg or .dxf");
        return exit_usage;
    }
    if (axes == 3 && plan.target->drawing) {
        print_error(fmt::format("a 3-D object has a surface and no outline: it cannot become a {} file",
                                plan.target->extension));
        print_help_line("--map draws a section: `--map x,y,0.5` the one at z = 0.5; `--layer` slices it all");
        return exit_usage;
    }
    return exit_ok;
}

}  // namespace

int run_mesh(Arguments arguments) {
    const double start = now_seconds();
    MeshOptions options;
    CommandLine line(
        "mesh", "mesh MODEL -o FILE [options]",
        "Makes a triangle mesh of the surface F = 0, an outline of a 2-D object, or slices.",
        {"frep mesh pot.hf -o pot.3mf", "frep mesh pot.hf -o pot.stl --grid 200 --require closed,manifold",
         "frep mesh crest.hf -o crest.svg"});
    declare_mesh_options(line, options);
    if (const auto code = line.parse(arguments)) return *code;
    auto plan = plan_mesh(options);
    if (!plan) return fail(plan.error());
    plan->memory_limit = line.memory_limit();

    std::vector<PreparedModel> models;
    for (const std::string& name : plan->objects) {
        ModelOptions one = options.model;
        if (plan->objects.size() > 1) one.object = name;
        int code = exit_ok;
        auto prepared = prepare_model(one, code);
        if (!prepared) return code;
        models.push_back(std::move(*prepared));
        if (axes_in_use(models.back()) != axes_in_use(models.front()))
            return usage_error("--object: the objects of the list have not the same dimension");
    }
    const int axes = axes_in_use(models.front());
    if (const int refused = refuse_target(*plan, models.front(), axes)) return refused;
    if (axes == 2) return run_outlines(options, *plan, models, start);
    if (plan->layer > 0) return run_layers(options, *plan, models.front(), start);
    return run_solid(options, *plan, models, start);
}

}  // namespace frep::cli
