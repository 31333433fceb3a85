// A model as an isosurface of POV-Ray. Tested by tests/cli/convert.txt.
#include <fmt/format.h>

#include "box.h"
#include "convert.h"
#include "json.h"
#include "surface_slope.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

int refuse_target(const ConvertOptions& options, MeshFormat target) {
    if (target != MeshFormat::pov) {
        print_error(fmt::format("a model has no triangles that {} could hold", format_extension(target)));
        print_help_line(
            fmt::format("`frep mesh {} -o {}` makes a mesh of it", options.model.input, *options.output));
        return exit_usage;
    }
    if (options.unit || options.merge || options.ascii)
        return usage_error("--unit, --merge and --ascii belong to mesh files");
    return exit_ok;
}

}  // namespace

int convert_model(const ConvertOptions& options, MeshFormat target) {
    if (const int refused = refuse_target(options, target)) return refused;
    std::optional<StatedBounds> stated;
    if (options.bounds) {
        const auto box = parse_bounds(*options.bounds);
        if (!box) return usage_error("--bounds: " + box.error().message);
        stated = *box;
    }
    lang::PovIsosurfaceOptions pov;
    if (options.max_gradient) {
        const auto slope = parse_positive(*options.max_gradient);
        if (!slope) return usage_error("--max-gradient: " + slope.error().message);
        pov.max_gradient = *slope;
    }
    int code = exit_ok;
    const auto prepared = prepare_model(options.model, code);
    if (!prepared) return code;
    for (int axis = 0; axis < 3; ++axis)
        if (!prepared->map.uses(axis))
            return usage_error(fmt::format(
                "no coordinate of the object is mapped to {}; an isosurface needs x, y and z", "xyz"[axis]));
    const auto field = sampled_field(*prepared);
    if (!field) return fail(field.error());
    const auto box = choose_box(*prepared, stated, **field, Job{});
    if (!box) return fail(box.error());
    pov.box = *box;
    if (!options.max_gradient)
        if (const auto slope = surface_slope(**field, *box)) pov.max_gradient = 1.25 * slope->largest;
    for (const MappedCoordinate& c : prepared->map.coordinates) pov.coordinates.push_back({c.axis, c.value});
    const auto& notes = prepared->model.program().annotations;
    pov.title = notes.title;
    if (const auto color = annotated_color(prepared->model)) pov.color = {color->r, color->g, color->b};
    pov.source = &prepared->model.source();
    const auto text = lang::pov_isosurface(prepared->field(), pov);
    if (!text) return fail(text.error());
    if (const int failed = write_converted(options, {*text, {}})) return failed;
    print_summary(
        fmt::format("an isosurface of {} bytes, max_gradient {:.6g}", text->size(), pov.max_gradient));
    if (!options.json) return exit_ok;
    const auto corner = [](const Vec3& p) {
        return Json::array({json_number(p.x), json_number(p.y), json_number(p.z)});
    };
    return print_result(json_bytes({{"schema", "frep.convert/1"},
                                    {"input_format", "model"},
                                    {"output_format", "pov"},
                                    {"bounds", Json::array({corner(box->min), corner(box->max)})},
                                    {"max_gradient", json_number(pov.max_gradient)}}));
}

}  // namespace frep::cli
