// `frep field`: the function on a plane as a figure. Tested by tests/cli/field.txt and field_usage.txt.
#include <fmt/format.h>

#include "box.h"
#include "command_line.h"
#include "field_options.h"
#include "json.h"
#include "picture_file.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

class FieldRun {
  public:
    FieldRun(const FieldOptionTexts& options, FieldPlan plan, const PreparedModel& prepared)
        : options_(options), plan_(std::move(plan)), prepared_(prepared), start_(now_seconds()) {
        job_.threads = prepared.threads;
    }

    int run() {
        const auto sampled = sampled_field(prepared_);
        if (!sampled) return fail(sampled.error());
        if (const Status status = choose_plane(**sampled); !status) return fail(status.error());
        describe();
        const auto picture = field_picture(**sampled, plan_.picture, job_);
        if (!picture) return fail(picture.error());
        warn(*picture);
        if (options_.output) {
            if (const int code = write_picture(picture->image, prepared_.model, *options_.output))
                return code;
            print_summary(fmt::format(
                "{} x {} pixels to {} in {:.2f} s", picture->image.width, picture->image.height,
                *options_.output == "-" ? "standard output" : *options_.output, now_seconds() - start_));
        }
        return options_.json ? print_result(report(*picture)) : int{exit_ok};
    }

  private:
    /// The stated section; else across the last axis that no coordinate takes, or z, in the middle of the
    /// box.
    Status choose_plane(SampledField& field) {
        const int normal = plan_.section ? plan_.section->first : unused_axis(prepared_).value_or(2);
        FieldPictureOptions& picture = plan_.picture;
        picture.plane = Plane::across(normal, plan_.section ? plan_.section->second : 0);
        const bool box_needed = !plan_.part || (!plan_.section && prepared_.map.uses(normal));
        if (box_needed) {
            const auto box = choose_box(prepared_, plan_.bounds, field, job_);
            if (!box) return box.error();
            const double low[3] = {box->min.x, box->min.y, box->min.z};
            const double high[3] = {box->max.x, box->max.y, box->max.z};
            const double at = low[normal] + (high[normal] - low[normal]) / 2;
            if (!plan_.section && prepared_.map.uses(normal)) picture.plane.at = at;
            if (plan_.section && (picture.plane.at < low[normal] || picture.plane.at > high[normal]))
                print_warning(fmt::format("the section {} lies outside the box", section_text()));
            picture.part = {picture.plane.flat(box->min), picture.plane.flat(box->max)};
        }
        if (plan_.part) picture.part = *plan_.part;
        return {};
    }

    /// The name of the one coordinate that an axis carries, else that of the axis.
    std::string axis_name(int axis) const {
        std::string name;
        int count = 0;
        const auto& coordinates = prepared_.map.coordinates;
        for (std::size_t i = 0; i < coordinates.size(); ++i) {
            if (coordinates[i].axis != axis) continue;
            name = coordinate_name(i);
            ++count;
        }
        return count == 1 ? name : std::string(1, "xyz"[axis]);
    }

    std::string section_text() const {
        const Plane& plane = plan_.picture.plane;
        return fmt::format("{} = {}", axis_name(plane.normal()), number_text(plane.at));
    }

    /// Title and captions.
    void describe() {
        FieldPictureOptions& picture = plan_.picture;
        const auto& notes = prepared_.model.program().annotations;
        const std::string unit = notes.units.empty() ? "" : ", " + notes.units;
        picture.right_name = axis_name(picture.plane.right) + unit;
        picture.up_name = axis_name(picture.plane.up) + unit;
        if (options_.title) {
            picture.title = *options_.title;
            return;
        }
        const bool titled = !notes.title.empty() && can_draw_text(notes.title);
        picture.title = titled ? notes.title : prepared_.header().written_name;
        if (prepared_.map.uses(picture.plane.normal())) picture.title += ", " + section_text();
    }

    static void warn(const FieldPicture& picture) {
        if (picture.undefined == 0) return;
        const double share =
            100 * static_cast<double>(picture.undefined) / static_cast<double>(picture.samples);
        print_warning(fmt::format("F is undefined in {:.3g} % of the picture, hatched there", share));
    }

    std::string report(const FieldPicture& picture) const {
        const Rectangle part = picture.window.rectangle();
        const Plane& plane = plan_.picture.plane;
        const bool defined = picture.undefined < picture.samples;
        Json out = {{"schema", "frep.field/1"},
                    {"object", json_text(prepared_.header().written_name)},
                    {"section", {{"axis", std::string(1, "xyz"[plane.normal()])}, {"value", plane.at}}},
                    {"bounds", {{part.min.x, part.min.y}, {part.max.x, part.max.y}}},
                    {"width", picture.image.width},
                    {"height", picture.image.height},
                    {"samples", picture.samples}};
        out["min"] = defined ? extreme(picture.lowest) : Json(nullptr);
        out["max"] = defined ? extreme(picture.highest) : Json(nullptr);
        out["levels"] = picture.levels;
        out["undefined_share"] =
            static_cast<double>(picture.undefined) / static_cast<double>(picture.samples);
        return json_bytes(out);
    }

    /// A number, or the text inf or -inf.
    static Json extreme(double v) { return v - v == 0 ? Json(v) : Json(number_text(v)); }

    const FieldOptionTexts& options_;
    FieldPlan plan_;
    const PreparedModel& prepared_;
    Job job_;
    double start_;
};

}  // namespace

int run_field(Arguments arguments) {
    FieldOptionTexts options;
    CommandLine line(
        "field", "field MODEL -o FILE.png [options]",
        "Makes a figure of the function on a plane: bands of equal value, F = 0 in bold.",
        {"frep field pot.hf -o pot.png", "frep field pot.hf -o side.png --section y=0 --size 1600x1200",
         "frep field pot.hf -o pot.png --levels -20,-10,0,10,20 --json"});
    declare_field_options(line, options);
    if (const auto code = line.parse(arguments)) return *code;
    auto plan = plan_field(options);
    if (!plan) return fail(plan.error());
    int code = exit_ok;
    const auto prepared = prepare_model(options.model, code);
    if (!prepared) return code;
    return FieldRun(options, std::move(*plan), *prepared).run();
}

}  // namespace frep::cli
