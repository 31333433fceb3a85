// Implementation of render_flat.h.
#include "render_flat.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "box.h"
#include "picture_file.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

/// The option that a plane picture has no use for, if one is given.
std::string_view useless_option(const RenderOptionTexts& o) {
    if (o.view) return "--view";
    if (o.azimuth) return "--azimuth";
    if (o.elevation) return "--elevation";
    if (o.perspective) return "--perspective";
    if (o.ortho) return "--ortho";
    if (o.zoom) return "--zoom";
    if (o.material) return "--material";
    if (o.section) return "--section";
    if (o.section_color) return "--section-color";
    if (o.no_ground) return "--no-ground";
    if (o.quality) return "--quality";
    if (o.turntable) return "--turntable";
    return {};
}

/// Tells what a picture needs where the object has less than two axes.
int refuse_thin(const PreparedModel& prepared) {
    const int n = prepared.header().coordinates();
    return usage_error(
        n < 2 ? fmt::format("the object has {} coordinate{}; a picture needs 2 or 3", n, n == 1 ? "" : "s")
              : std::string("--map: a picture needs two or three of the axes x, y and z"));
}

}  // namespace

std::optional<int> refuse_flat(const RenderOptionTexts& options, const PreparedModel& prepared) {
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) axes += prepared.map.uses(axis) ? 1 : 0;
    if (axes < 2) return refuse_thin(prepared);
    const std::string_view name = useless_option(options);
    if (name.empty()) return std::nullopt;
    return usage_error(prepared.map_given
                           ? fmt::format("{} is for solids; --map makes this object 2-D: it leaves {} out",
                                         name, "xyz"[unused_axis(prepared).value_or(2)])
                           : fmt::format("{} is for solids; this object is 2-D", name));
}

PlaneRenderOptions flat_picture(const RenderOptionTexts& options, const RenderPlan& plan,
                                const PreparedModel& prepared, const Box3& box, double longer_side) {
    PlaneRenderOptions picture;
    picture.plane = Plane::across(unused_axis(prepared).value_or(2), 0);
    picture.width = plan.picture.width;
    picture.height = plan.picture.height;
    const std::optional<Color> color =
        plan.picture.color ? plan.picture.color : annotated_color(prepared.model);
    if (color) picture.color = *color;
    picture.attribute_colors = has_colors(prepared) && !options.base_color;
    if (plan.picture.backdrop == Backdrop::transparent) picture.background.reset();
    if (plan.picture.backdrop == Backdrop::plain) picture.background = plan.picture.backdrop_color;
    picture.part = {picture.plane.flat(box.min), picture.plane.flat(box.max)};
    if (options.bounds) picture.margin = 0;
    if (options.size) return picture;
    const double longer = std::max(picture.part.width(), picture.part.height());
    const auto side = [&](double length) {
        return static_cast<int>(std::lround(longer_side * std::clamp(length / longer, 0.25, 1.0)));
    };
    picture.width = side(picture.part.width());
    picture.height = side(picture.part.height());
    return picture;
}

int render_flat(const RenderOptionTexts& options, const RenderPlan& plan, const PreparedModel& prepared) {
    const double start = now_seconds();
    if (const auto code = refuse_flat(options, prepared)) return *code;
    Job job;
    job.threads = prepared.threads;
    const bool colored = has_colors(prepared) && !options.base_color;
    const auto sampled = sampled_field(prepared, plan.iso, colored);
    if (!sampled) return fail(sampled.error());
    const auto box = choose_box(prepared, plan.bounds, **sampled, job);
    if (!box) return fail(box.error());
    const PlaneRenderOptions picture = flat_picture(options, plan, prepared, *box);
    const auto result = render_plane(**sampled, picture, job);
    if (!result) return fail(result.error());
    if (result->area == 0) print_warning("there is nothing to see: the shape is empty in the box");
    if (const int code = write_picture(result->image, prepared.model, *options.output)) return code;
    print_summary(fmt::format("{} x {} pixels to {} in {:.2f} s", picture.width, picture.height,
                              *options.output == "-" ? "standard output" : *options.output,
                              now_seconds() - start));
    return exit_ok;
}

}  // namespace frep::cli
