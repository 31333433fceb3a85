// Outlines of 2-D objects as a drawing, with their report.
#include <fmt/format.h>

#include "box.h"
#include "mesh_kinds.h"
#include "mesh_model.h"
#include "mesh_output.h"
#include "mesh_report.h"
#include "terminal.h"

namespace frep::cli {

namespace {

class OutlineRun {
  public:
    OutlineRun(const MeshOptions& options, const MeshPlan& plan, const std::vector<PreparedModel>& models,
               double start)
        : options_(options), plan_(plan), models_(models), start_(start) {
        job_.threads = models.front().threads;
    }

    int run() {
        if (requires_resolved(plan_.required))
            return fail(Error{ErrorKind::invalid_argument,
                              "--require resolved belongs to meshes of solids, not to drawings"});
        for (const PreparedModel& prepared : models_)
            if (const int code = add_object(prepared)) return code;
        const LengthUnit unit = model_unit(models_.front());
        if (plan_.target) {
            const auto bytes = encode_drawing(lines_, plan_.target->drawing.value_or(DrawingFormat::svg),
                                              drawing_options(unit));
            if (!bytes) return fail(bytes.error());
            if (const int code = write_output(options_, {*bytes, {}})) return code;
        }
        const OutlineReport report = check(lines_);
        print_summary(fmt::format("{} outlines, {} points{} in {:.2f} s", report.outlines, report.points,
                                  destination(options_), now_seconds() - start_));
        return plan_.wants_check ? judge(report, unit) : exit_ok;
    }

  private:
    int add_object(const PreparedModel& prepared) {
        const auto field = sampled_field(prepared, plan_.iso);
        if (!field) return fail(field.error());
        const auto box = choose_box(prepared, plan_.bounds, **field, job_);
        if (!box) return fail(box.error());
        PlaneContourOptions options;
        options.bounds = *box;
        options.plane = Plane::across(unused_axis(prepared).value_or(2), 0);
        if (plan_.cells) options.cells = *plan_.cells;
        options.cell_length = plan_.cell_length;
        options.cap = plan_.cap;
        options.prune = plan_.prune;
        if (plan_.memory_limit) options.memory_limit = *plan_.memory_limit;
        const auto result = contour_plane(**field, options, job_);
        if (!result) return fail(result.error());
        if (result->outlines.empty()) print_warning("there are no outlines");
        warn_touches(result->touches, plan_.cap, "outline is");
        warn_samples(prepared, result->undefined_points, result->first_undefined);
        undefined_points_ += result->undefined_points;
        if (!first_undefined_) first_undefined_ = result->first_undefined;
        lines_.insert(lines_.end(), result->outlines.begin(), result->outlines.end());
        return exit_ok;
    }

    DrawingOptions drawing_options(const LengthUnit& unit) const {
        const lang::Annotations& notes = models_.front().model.program().annotations;
        DrawingOptions drawing;
        drawing.unit = unit;
        drawing.title = to_valid_utf8(notes.title);
        for (const auto& [name, text] :
             {std::pair{"author", notes.author}, {"license", notes.license}, {"source", notes.source}}) {
            if (text.empty()) continue;
            if (!drawing.description.empty()) drawing.description += "; ";
            drawing.description += fmt::format("{}: {}", name, to_valid_utf8(text));
        }
        if (const auto color = annotated_color(models_.front().model)) drawing.fill = *color;
        return drawing;
    }

    int judge(const OutlineReport& report, const LengthUnit& unit) const {
        const bool closed = report.outlines > 0 && report.closed == report.outlines;
        Json json = {{"schema", "frep.mesh/1"},
                     {"dimension", 2},
                     {"units", unit.name},
                     {"outlines", report.outlines},
                     {"open_outlines", report.outlines - report.closed},
                     {"points", report.points}};
        json["area"] = closed ? json_number(report.area) : Json(nullptr);
        json["length"] = json_number(report.length);
        json["bounds"] = nullptr;
        if (report.points > 0) json["bounds"] = Json::array({point_json(report.min), point_json(report.max)});
        json["undefined_points"] = undefined_points_;
        if (first_undefined_) json["first_undefined"] = point_json(*first_undefined_);
        json["closed"] = closed;
        const PreparedModel& first = models_.front();
        json["run"] = run_json({now_seconds() - start_, first.threads, first.engine});
        std::vector<std::string> broken;
        for (const std::string& word : plan_.required) {
            if (word != "closed" || closed) continue;  // the other promises hold for all outlines
            broken.push_back(report.outlines == 0
                                 ? std::string("--require: the drawing is not closed: it has no outlines")
                                 : fmt::format("--require: the drawing is not closed: {} open outlines",
                                               report.outlines - report.closed));
        }
        return deliver_report(options_, json_bytes(json), broken);
    }

    const MeshOptions& options_;
    const MeshPlan& plan_;
    const std::vector<PreparedModel>& models_;
    double start_;
    Job job_;
    std::vector<Polyline> lines_;
    std::uint64_t undefined_points_ = 0;
    std::optional<Vec3> first_undefined_;
};

}  // namespace

int run_outlines(const MeshOptions& options, const MeshPlan& plan, const std::vector<PreparedModel>& models,
                 double start) {
    return OutlineRun(options, plan, models, start).run();
}

}  // namespace frep::cli
