// Surfaces of solids: the field of each object, its box, the contour, the scene, the checks.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "box.h"
#include "mesh_kinds.h"
#include "mesh_model.h"
#include "mesh_output.h"
#include "mesh_print.h"
#include "mesh_report.h"
#include "terminal.h"

namespace frep::cli {

namespace {

class SolidRun {
  public:
    SolidRun(const MeshOptions& options, const MeshPlan& plan, const std::vector<PreparedModel>& models,
             double start)
        : options_(options), plan_(plan), models_(models), start_(start) {
        job_.threads = models.front().threads;
    }

    int run() {
        for (const PreparedModel& prepared : models_)
            if (const int code = add_object(prepared)) return code;
        describe_scene();
        if (plan_.target) {
            const auto files =
                encode_scene(scene_, *plan_.target->mesh, {.ascii = options_.ascii, .stem = stem()});
            if (!files) return fail(files.error());
            if (const int code = write_output(options_, *files)) return code;
        }
        const Mesh mesh = models_.size() == 1 ? std::move(scene_.objects.front().mesh) : merged(scene_);
        print_summary(fmt::format("{} vertices, {} triangles{} in {:.2f} s", mesh.vertices.size(),
                                  mesh.triangles.size(), destination(options_), now_seconds() - start_));
        return plan_.wants_check ? judge(mesh) : exit_ok;
    }

  private:
    std::string stem() const {
        return *options_.output == "-" ? std::string() : stem_of_path(*options_.output);
    }

    bool wants_colors(const PreparedModel& prepared) const {
        return plan_.target && plan_.target->mesh != MeshFormat::stl && has_colors(prepared);
    }

    /// Meshes one object into the scene; 0 or an exit code.
    int add_object(const PreparedModel& prepared) {
        const auto field = sampled_field(prepared, plan_.iso, wants_colors(prepared));
        if (!field) return fail(field.error());
        const auto box = choose_box(prepared, plan_.bounds, **field, job_);
        if (!box) return fail(box.error());
        auto result = contour(**field, *box, wants_colors(prepared));
        if (!result) return fail(result.error());
        if (result->mesh.triangles.empty())
            print_warning(models_.size() == 1 ? "the mesh is empty"
                                              : fmt::format("the mesh of {} is empty", name_of(prepared)));
        warn_touches(result->touches, plan_.cap, "mesh is");
        warn_samples(prepared, result->undefined_points, result->first_undefined);
        warn_tight(*result);
        figures_.tight_cells += result->tight_cells;
        figures_.hidden_cells += result->hidden_cells;
        figures_.undefined_points += result->undefined_points;
        if (!figures_.first_undefined) figures_.first_undefined = result->first_undefined;

        SceneObject object;
        object.name = name_of(prepared);
        if (plan_.material) object.material = *plan_.material;
        if (!plan_.material || annotated_color(prepared.model)) object.material.base = base_color(prepared);
        object.mesh = std::move(result->mesh);
        if (result->attributes.size() >= 3) {
            object.mesh.colors = vertex_colors(*result, object.material.base);
            object.material.base = {1, 1, 1};  // it is multiplied with the colors of the vertices
        }
        figures_.objects.push_back({object.name, object.mesh.vertices.size(), object.mesh.triangles.size()});
        if (plan_.wants_check)
            if (const int code = measure(**field, object.mesh, result->grid)) return code;
        scene_.objects.push_back(std::move(object));
        return exit_ok;
    }

    Result<ContourResult> contour(const SampledField& field, const Box3& box, bool colors) {
        ContourOptions options;
        options.bounds = box;
        if (plan_.cells) options.cells = *plan_.cells;
        options.cell_length = plan_.cell_length;
        options.tolerance = plan_.tolerance;
        options.method = plan_.is_adaptive ? ContourMethod::adaptive : ContourMethod::cells;
        options.cap = plan_.cap;
        options.attributes = colors ? 3 : 0;
        options.prune = plan_.prune;
        if (plan_.memory_limit) options.memory_limit = *plan_.memory_limit;
        ProgressBar bar("meshing");
        job_.on_progress = [&bar](double share) { bar.update(share); };
        auto result = contour_solid(field, options, job_);
        job_.on_progress = nullptr;
        return result;
    }

    int measure(const SampledField& field, const Mesh& mesh, const Grid& grid) {
        MeshErrorOptions options;
        options.grid = grid;
        options.prune = plan_.prune;
        if (plan_.memory_limit) options.memory_limit = *plan_.memory_limit;
        ProgressBar bar("measuring");
        job_.on_progress = [&bar](double share) { bar.update(share); };
        const auto error = measure_mesh_error(field, mesh, options, job_);
        job_.on_progress = nullptr;
        if (!error) return fail(error.error());
        if (figures_.error) {
            figures_.error->add(*error);
        } else {
            figures_.error = *error;
        }
        return exit_ok;
    }

    static void warn_tight(const ContourResult& result) {
        const auto warn = [](std::uint64_t cells, const std::optional<Vec3>& first, const char* what,
                             const char* effect) {
            if (cells == 0) return;
            print_warning(fmt::format("{} in {} cell{}, the first near {}; {}: a smaller --cell shows more",
                                      what, cells, cells == 1 ? "" : "s",
                                      point_text(std::array{first->x, first->y, first->z}), effect));
        };
        warn(result.hidden_cells, result.first_hidden, "walls, rods or gaps lie between the samples",
             "the mesh lacks them");
        warn(result.tight_cells, result.first_tight, "walls or gaps are about as thin as a cell",
             "the mesh may be parted or joined there");
    }

    static std::string name_of(const PreparedModel& prepared) {
        return to_valid_utf8(prepared.header().written_name);
    }

    void describe_scene() {
        const lang::Annotations& notes = models_.front().model.program().annotations;
        scene_.unit = model_unit(models_.front());
        figures_.unit = scene_.unit.name;
        scene_.title = to_valid_utf8(notes.title);
        scene_.author = to_valid_utf8(notes.author);
        scene_.license = to_valid_utf8(notes.license);
        scene_.source = to_valid_utf8(notes.source);
    }

    /// The checks, the report and the promises; files are written before.
    int judge(const Mesh& mesh) {
        const MeshReport report = check(mesh, {.self_intersections = true}, job_);
        std::vector<std::string> broken = broken_promises(plan_.required, report, figures_);
        Json json = mesh_json(report, figures_);
        if (plan_.print_check) {
            const auto print = run_print_check(mesh, plan_, scene_.unit, job_);
            if (!print) return fail(print.error());
            json["print"] = print_json(*print, plan_);
            for (std::string& sentence : broken_walls(*print, plan_)) broken.push_back(std::move(sentence));
            if (const int code = tell_print(print_text(*print, plan_))) return code;
        }
        const PreparedModel& first = models_.front();
        json["run"] = run_json({now_seconds() - start_, first.threads, first.engine});
        return deliver_report(options_, json_bytes(json), broken);
    }

    /// The print check is the result when nothing else is.
    int tell_print(std::string text) const {
        if (!options_.output && !options_.report && !plan_.report_on_stdout) return print_result(text);
        while (!text.empty()) {
            const std::size_t end = text.find('\n');
            print_summary(text.substr(0, end));
            text.erase(0, end == std::string::npos ? text.size() : end + 1);
        }
        return exit_ok;
    }

    const MeshOptions& options_;
    const MeshPlan& plan_;
    const std::vector<PreparedModel>& models_;
    double start_;
    Job job_;
    Scene scene_;
    MeshFigures figures_;
};

}  // namespace

int run_solid(const MeshOptions& options, const MeshPlan& plan, const std::vector<PreparedModel>& models,
              double start) {
    return SolidRun(options, plan, models, start).run();
}

}  // namespace frep::cli
