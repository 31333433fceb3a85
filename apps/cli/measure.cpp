// `frep measure`: volume, area, centroid, inertia and weight of a shape, each with what is known of its
// error. Tested by tests/cli/measure.txt.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "box.h"
#include "command_line.h"
#include "json.h"
#include "mesh_model.h"
#include "mesh_report.h"
#include "model_input.h"
#include "terminal.h"
#include "time_keeper.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

using math::Interval;

struct MeasureOptions {
    ModelOptions model;
    std::optional<std::string> bounds, relative_error, density, cells, area_cells;
    bool json = false;
};

struct MeasurePlan {
    std::optional<StatedBounds> bounds;
    double relative_error = 1e-3;
    std::optional<double> density;  ///< grams a cubic centimetre
    std::size_t cells = 0;
    int area_cells = 128;
};

Result<MeasurePlan> plan_measure(const MeasureOptions& options) {
    MeasurePlan plan;
    const auto about = [](std::string_view option, const Error& error) {
        return Error{error.kind, fmt::format("{}: {}", option, error.message)};
    };
    if (options.bounds) {
        const auto box = parse_bounds(*options.bounds);
        if (!box) return about("--bounds", box.error());
        plan.bounds = *box;
    }
    if (options.relative_error) {
        const auto error = parse_positive(*options.relative_error);
        if (!error) return about("--relative-error", error.error());
        plan.relative_error = *error;
    }
    if (options.density) {
        const auto density = parse_positive(*options.density);
        if (!density) return about("--density", density.error());
        plan.density = *density;
    }
    if (options.cells) {
        const auto cells = parse_integer(*options.cells, 8, 100'000'000);
        if (!cells) return about("--cells", cells.error());
        plan.cells = static_cast<std::size_t>(*cells);
    }
    if (options.area_cells) {
        const auto cells = parse_integer(*options.area_cells, 8, 1024);
        if (!cells) return about("--area-cells", cells.error());
        plan.area_cells = static_cast<int>(*cells);
    }
    return plan;
}

double middle(const Interval& v) { return v.lo + 0.5 * (v.hi - v.lo); }
double half_width(const Interval& v) { return 0.5 * (v.hi - v.lo); }

/// Seven digits that are surely not above (below) the number.
std::string rounded_down(double v) { return fmt::format("{:.7g}", v == 0 ? v : v - 1e-6 * std::abs(v)); }
std::string rounded_up(double v) { return fmt::format("{:.7g}", v == 0 ? v : v + 1e-6 * std::abs(v)); }
std::string range_text(const Interval& v) {
    return fmt::format("{} .. {}", rounded_down(v.lo), rounded_up(v.hi));
}

Json range_json(const Interval& v) { return Json::array({json_number(v.lo), json_number(v.hi)}); }

template <std::size_t N>
Json ranges_json(const std::array<Interval, N>& values) {
    Json list = Json::array();
    for (const Interval& v : values) list.push_back(range_json(v));
    return list;
}

class MeasureRun {
  public:
    MeasureRun(const MeasureOptions& options, const MeasurePlan& plan, const PreparedModel& prepared,
               std::optional<double> time_limit)
        : options_(options), plan_(plan), prepared_(prepared), start_(now_seconds()) {
        job_.threads = prepared.threads;
        for (int axis = 0; axis < 3; ++axis) axes_[static_cast<std::size_t>(axis)] = prepared.map.uses(axis);
        dimension_ = static_cast<int>(std::count(axes_.begin(), axes_.end(), true));
        unit_ = model_unit(prepared);
        time_limit_ = time_limit;
    }

    int run() {
        if (dimension_ < 2)
            return usage_error(fmt::format("the object has {} axis of space; a measure needs two or three",
                                           dimension_ == 0 ? "no" : "one"));
        const auto sampled = sampled_field(prepared_);
        if (!sampled) return fail(sampled.error());
        const auto box = choose_box(prepared_, plan_.bounds, **sampled, job_);
        if (!box) return fail(box.error());
        box_ = *box;
        const auto field = field_in_space(prepared_.field(), prepared_.map);
        if (!field) return fail(field.error());
        ShapeMeasureOptions options;
        options.bounds = box_;
        options.axes = axes_;
        options.relative_error = plan_.relative_error;
        options.max_cells = plan_.cells;
        options.evaluator = prepared_.evaluator;
        const TimeKeeper keeper(job_, time_limit_);
        {
            ProgressBar bar("measuring");
            job_.on_progress = [&](double share) { bar.update(share); };
            const auto found = measure_shape(*field, options, job_);
            job_.on_progress = nullptr;
            if (!found) return fail(found.error());
            measure_ = *found;
        }
        if (!measure_.is_cancelled) {
            FieldPool fields(**sampled);
            const auto surface = estimate_surface(fields, box_, axes_, plan_.area_cells, job_);
            if (!surface && !job_.cancelled()) return fail(surface.error());
            if (surface) surface_ = *surface;
        }
        if (const int code = options_.json ? print_result(json_bytes(report())) : print_result(text()))
            return code;
        return judge();
    }

  private:
    std::string_view size_name() const { return dimension_ == 3 ? "volume" : "area"; }
    std::string_view surface_name() const { return dimension_ == 3 ? "area" : "perimeter"; }

    /// Grams.
    Interval mass() const {
        const Interval centimetres = Interval(unit_.metres) * Interval(100);
        return measure_.size * Interval(*plan_.density) * centimetres * centimetres * centimetres;
    }

    std::string text() const {
        const std::string_view unit = unit_.name;
        const auto power = [&](int p) { return fmt::format("{}^{}", unit, p); };
        std::string out =
            fmt::format("{:<10}{:.7g} +- {:.2g} {}   in {}\n", size_name(), middle(measure_.size),
                        half_width(measure_.size), power(dimension_), range_text(measure_.size));
        if (surface_)
            out +=
                fmt::format("{:<10}{:.7g} {}   estimate, error about {:.2g}\n", surface_name(),
                            surface_->size, dimension_ == 3 ? power(2) : std::string(unit), surface_->error);
        if (plan_.density && dimension_ == 3)
            out += fmt::format("{:<10}{:.7g} +- {:.2g} g   in {}\n", "weight", middle(mass()),
                               half_width(mass()), range_text(mass()));
        if (!(measure_.size.hi > 0)) return out + "the shape is empty in the box\n";
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!axes_[axis]) continue;
            const Interval& c = measure_.centroid[axis];
            out += fmt::format("centroid {} {:.7g} +- {:.2g}   in {}\n", "xyz"[axis], middle(c),
                               half_width(c), range_text(c));
        }
        constexpr std::string_view names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
        for (std::size_t k = 0; k < 6; ++k) {
            if (!is_in_plane(k)) continue;
            const Interval& v = measure_.inertia[k];
            out += fmt::format("inertia {} {:.7g} +- {:.2g}   in {}\n", names[k], middle(v), half_width(v),
                               range_text(v));
        }
        return out;
    }

    /// False for a product of inertia with an axis that is not measured, which is 0.
    bool is_in_plane(std::size_t k) const {
        constexpr std::array<std::array<std::size_t, 2>, 6> axes{
            {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
        return k < 3 || (axes_[axes[k][0]] && axes_[axes[k][1]]);
    }

    Json report() const {
        Json out = {{"schema", "frep.measure/1"},
                    {"model", json_text(prepared_.model.source().name())},
                    {"object", json_text(prepared_.header().written_name)},
                    {"dimension", dimension_},
                    {"units", unit_.name},
                    {"bounds", Json::array({point_json(box_.min), point_json(box_.max)})},
                    {"relative_error", plan_.relative_error},
                    {"reached", measure_.is_reached}};
        out[std::string(size_name())] = range_json(measure_.size);
        out[std::string(surface_name()) + "_estimate"] =
            surface_ ? Json({{"value", json_number(surface_->size)}, {"error", json_number(surface_->error)}})
                     : Json(nullptr);
        out["centroid"] = measure_.size.hi > 0 ? ranges_json(measure_.centroid) : Json(nullptr);
        out["inertia"] = ranges_json(measure_.inertia);
        if (plan_.density && dimension_ == 3) {
            out["density"] = *plan_.density;
            out["weight"] = range_json(mass());
        }
        out["cut"] = Json::array();
        constexpr std::string_view sides[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
        for (std::size_t side = 0; side < 6; ++side)
            if (measure_.cut[side]) out["cut"].push_back(sides[side]);
        out["maybe_undefined"] = measure_.maybe_undefined;
        out["second_order"] = measure_.has_planes;
        out["cells"] = measure_.evaluated;
        out["open_cells"] = measure_.open;
        out["run"] = run_json({now_seconds() - start_, prepared_.threads, prepared_.engine});
        return out;
    }

    /// Warnings, and the exit code.
    int judge() const {
        if (const std::string sides = side_list(measure_.cut); !sides.empty())
            print_warning(
                fmt::format("the box cuts the shape at {}: only what lies in the box is measured", sides));
        if (measure_.is_reached) return exit_ok;
        if (measure_.is_cancelled) {
            print_error("stopped at the time limit, before the relative error was reached");
            return exit_over_limit;
        }
        print_error(
            fmt::format("the relative error {} was not reached: {} cells were looked at, {} are undecided",
                        number_text(plan_.relative_error), measure_.evaluated, measure_.open));
        print_help_line(
            measure_.has_planes
                ? "--cells allows more of them, --relative-error asks for less"
                : "the function has an operation without derivatives (noise, sums over skeletons, "
                  "loops that depend on the point), so that only signs count; --cells allows more "
                  "cells, --relative-error asks for less");
        return exit_check_failed;
    }

    const MeasureOptions& options_;
    const MeasurePlan& plan_;
    const PreparedModel& prepared_;
    double start_;
    std::optional<double> time_limit_;
    LengthUnit unit_;
    Job job_;
    std::array<bool, 3> axes_{};
    int dimension_ = 3;
    Box3 box_;
    ShapeMeasure measure_;
    std::optional<SurfaceSize> surface_;
};

}  // namespace

int run_measure(Arguments arguments) {
    MeasureOptions options;
    CommandLine line(
        "measure", "measure MODEL [options]",
        "Volume (of a flat shape: area), centroid and inertia from the function itself, each with an "
        "interval that surely holds it; the area of the surface as an estimate.",
        {"frep measure pot.hf", "frep measure pot.hf --density 2.4 --relative-error 1e-4",
         "frep measure pot.hf --param height=70 --json > pot.json"});
    declare_model_options(line, options.model);
    line.text("--relative-error", options.relative_error, "E",
              "half the interval over its middle, of the volume (default 1e-3)");
    line.text("--density", options.density, "G", "grams a cubic centimetre: gives the weight");
    line.text("--bounds", options.bounds, "BOX", "v, or min,max, or ax,bx,ay,by,az,bz (default: found)");
    line.text("--cells", options.cells, "N",
              "undecided cells held at most (default 1000000; 20000 with loops "
              "that depend on the point)");
    line.text("--area-cells", options.area_cells, "N",
              "cells a side for the estimate of the area (default 128)");
    line.flag("--json", options.json, "the report as one JSON object on standard output");
    if (const auto code = line.parse(arguments)) return *code;
    const auto plan = plan_measure(options);
    if (!plan) return usage_error(plan.error().message);
    int code = exit_ok;
    const auto prepared = prepare_model(options.model, code);
    if (!prepared) return code;
    return MeasureRun(options, *plan, *prepared, line.time_limit()).run();
}

}  // namespace frep::cli
