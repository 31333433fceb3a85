// Implementation of render_options.h.
#include "render_options.h"

#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "terminal.h"
#include "values.h"

namespace frep::cli {

namespace {

Error usage(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }
Error about(std::string_view option, const Error& error) {
    return {error.kind, fmt::format("{}: {}", option, error.message)};
}

struct NamedView {
    std::string_view name;
    double azimuth, elevation;
};
constexpr std::array views{
    NamedView{"front", 0, 0},
    NamedView{"back", 180, 0},
    NamedView{"left", -90, 0},
    NamedView{"right", 90, 0},
    NamedView{"top", 0, 90},
    NamedView{"bottom", 0, -90},
    // The elevation at which the three axes look equally long.
    NamedView{"iso", 45, 35.264389682754654},
};

/// "a, b, c" of the names of a table, and the one meant by a wrong name.
template <class Table>
std::string unknown(std::string_view what, std::string_view given, const Table& table) {
    std::vector<std::string_view> names;
    for (const auto& row : table) names.push_back(row.name);
    const std::string_view near = nearest_name(given, names);
    if (!near.empty()) return fmt::format("no {} `{}`; did you mean `{}`?", what, given, near);
    return fmt::format("no {} `{}`; there are {}", what, given, fmt::join(names, ", "));
}

Status plan_view(const RenderOptionTexts& options, RenderPlan& plan) {
    View& view = plan.picture.view;
    if (options.view) {
        const std::string name = lower_case(*options.view);
        const NamedView* found = nullptr;
        for (const NamedView& row : views)
            if (row.name == name) found = &row;
        if (!found) return usage("--view: " + unknown("view", *options.view, views));
        view.azimuth = found->azimuth;
        view.elevation = found->elevation;
        plan.has_azimuth = plan.has_elevation = true;
    }
    if (options.azimuth) {
        const auto angle = parse_angle(*options.azimuth);
        if (!angle) return about("--azimuth", angle.error());
        view.azimuth = *angle;
        plan.has_azimuth = true;
    }
    if (options.elevation) {
        const auto angle = parse_angle(*options.elevation);
        if (!angle) return about("--elevation", angle.error());
        if (!(*angle >= -90 && *angle <= 90)) return usage("--elevation: the angle must lie in -90..90");
        view.elevation = *angle;
        plan.has_elevation = true;
    }
    if (options.ortho && options.perspective) return usage("give either --ortho or --perspective");
    if (options.ortho) view.field_of_view = 0;
    if (options.perspective) {
        const auto angle = parse_angle(*options.perspective);
        if (!angle) return about("--perspective", angle.error());
        if (!(*angle >= 1 && *angle <= 120)) return usage("--perspective: the angle must lie in 1..120");
        view.field_of_view = *angle;
    }
    if (options.zoom) {
        const auto zoom = parse_positive(*options.zoom);
        if (!zoom) return about("--zoom", zoom.error());
        if (!(*zoom >= 0.01 && *zoom <= 1000)) return usage("--zoom: the factor must lie in 0.01..1000");
        view.zoom = *zoom;
    }
    return {};
}

Status plan_material(const RenderOptionTexts& options, RenderPlan& plan) {
    if (options.material) {
        plan.picture.material = find_material(*options.material);
        if (!plan.picture.material)
            return usage("--material: " + unknown("material", *options.material, materials()));
    }
    if (options.base_color) {
        const auto color = parse_color(*options.base_color);
        if (!color) return about("--base-color", color.error());
        plan.picture.color = *color;
    }
    if (options.section_color) {
        const auto color = parse_color(*options.section_color);
        if (!color) return about("--section-color", color.error());
        plan.picture.section_color = *color;
    }
    const std::string background = lower_case(options.background.value_or("studio"));
    if (background == "transparent") {
        plan.picture.backdrop = Backdrop::transparent;
    } else if (background != "studio") {
        const auto color = parse_color(background);
        if (!color) return usage("--background: not studio, transparent or a color like #ffffff");
        plan.picture.backdrop = Backdrop::plain;
        plan.picture.backdrop_color = *color;
    }
    plan.picture.ground = !options.no_ground;
    const std::string quality = lower_case(options.quality.value_or("normal"));
    if (quality == "draft")
        plan.quality = PictureQuality::draft;
    else if (quality == "high")
        plan.quality = PictureQuality::high;
    else if (quality != "normal")
        return usage(fmt::format("--quality: `{}` is not one of draft, normal, high", *options.quality));
    return {};
}

Status plan_space(const RenderOptionTexts& options, RenderPlan& plan) {
    if (options.size) {
        const auto size = parse_size_pixels(*options.size);
        if (!size) return about("--size", size.error());
        plan.picture.width = size->first;
        plan.picture.height = size->second;
    }
    if (options.bounds) {
        const auto box = parse_bounds(*options.bounds);
        if (!box) return about("--bounds", box.error());
        plan.bounds = *box;
    }
    if (options.iso) {
        const auto iso = parse_number(*options.iso);
        if (!iso) return about("--iso", iso.error());
        if (!std::isfinite(*iso)) return usage("--iso: the value must be finite");
        plan.iso = *iso;
    }
    if (options.section) {
        const std::string text = lower_case(*options.section);
        const bool is_axis = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=';
        if (!is_axis) return usage(fmt::format("--section: `{}` is not like z=0.5", *options.section));
        const auto value = parse_number(text.substr(2));
        if (!value) return about("--section", value.error());
        plan.section = {text[0] - 'x', *value};
    }
    return {};
}

Status plan_turntable(const RenderOptionTexts& options, RenderPlan& plan) {
    if (!options.turntable) return {};
    const auto count = parse_integer(*options.turntable, 1, 3600);
    if (!count) return about("--turntable", count.error());
    plan.turntable = static_cast<int>(*count);
    plan.picture.framed_all_round = true;
    return {};
}

/// A picture goes to a PNG file whose folder is there; a turntable needs names for its files.
Status check_output(const RenderOptionTexts& options, const RenderPlan& plan) {
    if (!options.output) return usage("-o FILE is missing: where the picture goes (.png)");
    const std::string& path = *options.output;
    if (path.empty()) return usage("-o: the name of the file is empty");
    if (path == "-") {
        if (plan.turntable > 0)
            return usage("--turntable makes many files; they cannot go to standard output");
        return {};
    }
    const std::filesystem::path name(path);
    const std::string extension = lower_case(name.extension().string());
    if (extension != ".png")
        return usage(extension.empty()
                         ? fmt::format("'{}' has no extension; pictures are .png files", path)
                         : fmt::format("no picture format {}; pictures are .png files", extension));
    return check_folder(path);
}

}  // namespace

Result<Color> parse_color(std::string_view text) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    const bool is_short = text.size() == 4;
    bool is_good = (is_short || text.size() == 7) && text[0] == '#';
    for (std::size_t i = 1; i < text.size(); ++i) is_good = is_good && digit(text[i]) >= 0;
    if (!is_good) return usage(fmt::format("`{}` is not a color like #8c0a08", text));
    const auto part = [&](std::size_t k) {
        if (is_short) return digit(text[1 + k]) * 17 / 255.0;
        return (digit(text[1 + 2 * k]) * 16 + digit(text[2 + 2 * k])) / 255.0;
    };
    return Color{part(0), part(1), part(2)};
}

Result<double> parse_angle(std::string_view text) {
    std::string_view rest = text;
    double value = 0;
    const bool is_number = take_number(rest, value);
    if (!is_number || !(rest.empty() || rest == "deg") || !std::isfinite(value))
        return usage(fmt::format("`{}` is not an angle in degrees like 30 or 30deg", text));
    return value;
}

Result<std::pair<int, int>> parse_size_pixels(std::string_view text) {
    const std::size_t mark = text.find_first_of("xX");
    const auto width = parse_integer(text.substr(0, mark), 1, PictureOptions::most_side);
    const auto height =
        mark == text.npos ? width : parse_integer(text.substr(mark + 1), 1, PictureOptions::most_side);
    if (!width || !height)
        return usage(fmt::format("`{}` is not like 1200x900, or 800 for a square, with 1 to {} pixels a side",
                                 text, PictureOptions::most_side));
    if (*width * *height > PictureOptions::most_pixels)
        return usage(fmt::format("{} has more than {} pixels", text, PictureOptions::most_pixels));
    return std::pair{static_cast<int>(*width), static_cast<int>(*height)};
}

void declare_render_options(CommandLine& line, RenderOptionTexts& options) {
    line.text("-o,--output", options.output, "FILE", "the picture: .png; - for standard output");
    line.text("--turntable", options.turntable, "N",
              "N pictures of one turn: FILE-001.png, FILE-002.png, ...");
    line.text("--matrix", options.matrix, "NAME=A:B:N",
              "N states along a coordinate or parameter in one picture; two, with a comma: across and down");
    declare_look_options(line, options);
}

void declare_look_options(CommandLine& line, RenderOptionTexts& options) {
    declare_model_options(line, options.model);
    line.text("--size", options.size, "WxH",
              "pixels (default 1200x900; 2-D: the object's shape); 800 is 800x800");
    line.text("--view", options.view, "NAME", "front, back, left, right, top, bottom or iso");
    line.text("--azimuth", options.azimuth, "ANGLE",
              "degrees around Z, from the front to the right (default 30)");
    line.text("--elevation", options.elevation, "ANGLE", "degrees above the horizon (default 20)");
    line.text("--perspective", options.perspective, "ANGLE",
              "angle of view across the longer side (default 20)");
    line.flag("--ortho", options.ortho, "parallel rays: no perspective");
    line.text("--zoom", options.zoom, "FACTOR", "more than 1 comes closer (default 1: all is seen)");
    line.text("--material", options.material, "NAME",
              "clay, lacquer, metal, stone, porcelain, wood or skin (default: the model's)");
    line.text("--base-color", options.base_color, "#RRGGBB", "color of the material (default: the model's)");
    line.text("--section", options.section, "AXIS=V", "cut open at x=V, y=V or z=V, towards the viewer");
    line.text("--section-color", options.section_color, "#RRGGBB", "color of the cut face");
    line.text("--background", options.background, "WHAT", "studio (default), transparent or #RRGGBB");
    line.flag("--no-ground", options.no_ground, "no table: the object floats, without a shadow");
    line.text("--color-by", options.color_by, "NAME=A:B:N",
              "N states along a coordinate or parameter at one place, from blue to red");
    line.text("--iso", options.iso, "V", "the surface F = V (default 0)");
    line.text("--bounds", options.bounds, "BOX",
              "v, or min,max, or ax,bx,ay,by,az,bz; 2-D: ax,bx,ay,by (default: found)");
    line.text("--quality", options.quality, "NAME", "draft, normal (default) or high");
}

Result<RenderPlan> plan_look(const RenderOptionTexts& options) {
    RenderPlan plan;
    if (const Status status = plan_view(options, plan); !status) return status.error();
    if (const Status status = plan_material(options, plan); !status) return status.error();
    if (const Status status = plan_space(options, plan); !status) return status.error();
    return plan;
}

Result<RenderPlan> plan_render(const RenderOptionTexts& options) {
    auto plan = plan_look(options);
    if (!plan) return plan.error();
    if (const Status status = plan_turntable(options, *plan); !status) return status.error();
    if (const Status status = check_output(options, *plan); !status) return status.error();
    return plan;
}

void take_wishes(const RenderOptionTexts& options, const PreparedModel& prepared, RenderPlan& plan,
                 NamedMaterial& finish) {
    PictureOptions& picture = plan.picture;
    const auto& notes = prepared.model.program().annotations;
    if (!picture.color) picture.color = annotated_color(prepared.model);
    if (notes.view.size() == 2) {
        if (!plan.has_azimuth) picture.view.azimuth = notes.view[0];
        if (!plan.has_elevation) picture.view.elevation = notes.view[1];
    }
    if (!picture.material && !notes.material.empty()) {
        picture.material = find_material(notes.material);
        if (!picture.material) print_warning(fmt::format("--@ material: no material `{}`", notes.material));
    }
    const bool colored = has_colors(prepared);
    if (!picture.material && colored && !options.base_color) picture.material = find_material("skin");
    if (!picture.material) picture.material = &materials().front();
    if (colored && !options.base_color && !picture.material->uses_attributes) {
        finish = *picture.material;  // the model's own colors, with the finish of the material
        finish.uses_attributes = true;
        picture.material = &finish;
    }
    if (picture.material->uses_attributes && !colored)
        print_warning("the model has no colors: material `skin` needs three attributes s[1..3]");
}

}  // namespace frep::cli
