// Implementation of field_options.h.
#include "field_options.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "render_options.h"
#include "values.h"

namespace frep::cli {

namespace {

Error usage(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }
Error about(std::string_view option, const Error& error) {
    return {error.kind, fmt::format("{}: {}", option, error.message)};
}

Status plan_section(const std::string& text, FieldPlan& plan) {
    const std::string name = lower_case(text.substr(0, 1));
    if (text.size() < 3 || text[1] != '=' || name[0] < 'x' || name[0] > 'z')
        return usage(fmt::format("--section: `{}` is not like z=0.5", text));
    const auto value = parse_number(std::string_view(text).substr(2));
    if (!value) return about("--section", value.error());
    if (!std::isfinite(*value)) return usage("--section: the value must be finite");
    plan.section = {name[0] - 'x', *value};
    return {};
}

Status plan_size(const std::string& text, FieldPlan& plan) {
    const auto size = parse_size_pixels(text);
    if (!size) return about("--size", size.error());
    plan.picture.width = size->first;
    plan.picture.height = size->second;
    return {};
}

/// A whole number is a number of levels; a list is the levels themselves.
Status plan_levels(const std::string& text, FieldPlan& plan) {
    if (text.find(',') == text.npos) {
        const auto count = parse_integer(text, 1, 1000);
        if (!count)
            return usage(
                fmt::format("--levels: `{}` is neither a number of levels nor a list such as -1,0,1", text));
        plan.picture.level_count = static_cast<int>(*count);
        return {};
    }
    const auto values = parse_numbers(text);
    if (!values) return about("--levels", values.error());
    for (const double v : *values)
        if (!std::isfinite(v)) return usage("--levels: a level must be finite");
    plan.picture.levels = *values;
    return {};
}

/// As everywhere, and `ax,bx,ay,by` for the two axes of the plane.
Status plan_bounds(const std::string& text, FieldPlan& plan) {
    const auto numbers = parse_numbers(text);
    if (numbers && numbers->size() == 4) {
        const std::vector<double>& v = *numbers;
        if (!(v[0] < v[1] && v[2] < v[3]) || !std::isfinite(v[1] - v[0]) || !std::isfinite(v[3] - v[2]))
            return usage(fmt::format("--bounds: `{}` is not a rectangle ax,bx,ay,by", text));
        plan.part = Rectangle{{v[0], v[2]}, {v[1], v[3]}};
        return {};
    }
    const auto box = parse_bounds(text);
    if (!box) return about("--bounds", box.error());
    plan.bounds = *box;
    return {};
}

Status check_output(const FieldOptionTexts& options) {
    if (!options.output)
        return options.json ? Status() : usage("-o FILE.png is missing: where the picture goes");
    const std::string& path = *options.output;
    if (path == "-")
        return options.json ? usage("--json and -o - cannot both have standard output") : Status();
    const std::filesystem::path name(path);
    const std::string extension = lower_case(name.extension().string());
    if (extension != ".png")
        return usage(fmt::format("-o: '{}' is not a .png file, the format of pictures", path));
    return check_folder(path);
}

}  // namespace

void declare_field_options(CommandLine& line, FieldOptionTexts& options) {
    declare_model_options(line, options.model);
    line.text("-o,--output", options.output, "FILE", "the picture: .png; - for standard output");
    line.text("--section", options.section, "AXIS=V",
              "the plane x=V, y=V or z=V (default: the middle of the box)");
    line.text("--levels", options.levels, "N|V,V,...", "about N levels (default 12), or the levels");
    line.text("--size", options.size, "WxH", "pixels (default: from the shape of the section)");
    line.text("--bounds", options.bounds, "BOX",
              "v, or min,max, or ax,bx,ay,by,az,bz, or ax,bx,ay,by of the plane (default: found)");
    line.text("--title", options.title, "TEXT", "above the picture (default: the model's title)");
    line.flag("--json", options.json, "print levels, extreme values and the undefined share");
}

Result<FieldPlan> plan_field(const FieldOptionTexts& options) {
    FieldPlan plan;
    if (const Status status = check_output(options); !status) return status.error();
    if (options.section)
        if (const Status status = plan_section(*options.section, plan); !status) return status.error();
    if (options.size)
        if (const Status status = plan_size(*options.size, plan); !status) return status.error();
    if (options.levels)
        if (const Status status = plan_levels(*options.levels, plan); !status) return status.error();
    if (options.bounds)
        if (const Status status = plan_bounds(*options.bounds, plan); !status) return status.error();
    return plan;
}

}  // namespace frep::cli
