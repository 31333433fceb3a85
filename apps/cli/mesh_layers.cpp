// Slices of a solid for layered manufacturing, from the function itself. Layer k fills the heights (k - 1) L
// to k L and has the outlines of its middle; the file names its top, as the Common Layer Interface does.
#include <algorithm>

#include <fmt/format.h>

#include "box.h"
#include "mesh_kinds.h"
#include "mesh_model.h"
#include "mesh_output.h"
#include "mesh_report.h"
#include "terminal.h"

namespace frep::cli {

namespace {

class LayerRun {
  public:
    LayerRun(const MeshOptions& options, const MeshPlan& plan, const PreparedModel& prepared, double start)
        : options_(options), plan_(plan), prepared_(prepared), start_(start) {
        job_.threads = prepared.threads;
    }

    int run() {
        const auto field = sampled_field(prepared_, plan_.iso);
        if (!field) return fail(field.error());
        const auto box = choose_box(prepared_, plan_.bounds, **field, job_);
        if (!box) return fail(box.error());
        auto result = slice(**field, *box);
        if (!result) return fail(result.error());
        if (result->slices.empty()) print_warning("there are no layers: no surface in the box");
        warn_touches(result->touches, plan_.cap, "layers are");
        warn_samples(prepared_, result->undefined_points, result->first_undefined);
        const LengthUnit unit = model_unit(prepared_);
        if (plan_.target) {
            SliceOptions slicing;
            slicing.unit = unit;
            slicing.label = to_valid_utf8(prepared_.model.program().annotations.title);
            slicing.first_thickness = result->slices.empty() ? 0 : plan_.layer;
            const auto bytes = encode_slices(result->slices, slicing);
            if (!bytes) return fail(bytes.error());
            if (const int code = write_output(options_, {*bytes, {}})) return code;
        }
        print_summary(fmt::format("{} layers{} in {:.2f} s", result->slices.size(), destination(options_),
                                  now_seconds() - start_));
        return plan_.wants_check ? judge(*result, unit) : exit_ok;
    }

  private:
    Result<Slicing> slice(const SampledField& field, const Box3& box) {
        SlicingOptions options;
        options.contour.bounds = box;
        if (plan_.cells) options.contour.cells = *plan_.cells;
        options.contour.cell_length = plan_.cell_length;
        options.contour.cap = plan_.cap;
        options.contour.prune = plan_.prune;
        if (plan_.memory_limit) options.contour.memory_limit = *plan_.memory_limit;
        options.thickness = plan_.layer;
        ProgressBar bar("slicing");
        job_.on_progress = [&bar](double share) { bar.update(share); };
        auto result = slice_layers(field, options, job_);
        job_.on_progress = nullptr;
        return result;
    }

    int judge(const Slicing& slicing, const LengthUnit& unit) const {
        OutlineReport all;
        double least = 0, greatest = 0;
        for (const Slice& layer : slicing.slices) {
            const OutlineReport one = check(layer.outlines);
            all.outlines += one.outlines;
            all.closed += one.closed;
            all.points += one.points;
            all.area += one.area;
            all.length += one.length;
        }
        if (!slicing.slices.empty()) {
            least = slicing.slices.front().z - plan_.layer;
            greatest = slicing.slices.back().z;
        }
        const bool closed = all.outlines > 0 && all.closed == all.outlines;
        Json json = {{"schema", "frep.mesh/1"},
                     {"dimension", 3},
                     {"units", unit.name},
                     {"layers", slicing.slices.size()},
                     {"layer_thickness", json_number(plan_.layer)},
                     {"outlines", all.outlines},
                     {"open_outlines", all.outlines - all.closed},
                     {"points", all.points}};
        json["volume"] = closed ? json_number(all.area * plan_.layer) : Json(nullptr);
        json["length"] = json_number(all.length);
        json["heights"] = Json::array({json_number(least), json_number(greatest)});
        json["undefined_points"] = slicing.undefined_points;
        json["closed"] = closed;
        json["run"] = run_json({now_seconds() - start_, prepared_.threads, prepared_.engine});
        std::vector<std::string> broken;
        if (!closed &&
            std::find(plan_.required.begin(), plan_.required.end(), "closed") != plan_.required.end())
            broken.push_back(fmt::format("--require: the layers are not closed: {} open outlines",
                                         all.outlines - all.closed));
        return deliver_report(options_, json_bytes(json), broken);
    }

    const MeshOptions& options_;
    const MeshPlan& plan_;
    const PreparedModel& prepared_;
    double start_;
    Job job_;
};

}  // namespace

int run_layers(const MeshOptions& options, const MeshPlan& plan, const PreparedModel& prepared,
               double start) {
    return LayerRun(options, plan, prepared, start).run();
}

}  // namespace frep::cli
