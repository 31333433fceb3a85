// `frep mesh`: the surface of a model as a triangle mesh in a file, with checks and promises.
// Tested by tests/cli/mesh.txt and its neighbours.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "box.h"
#include "budget.h"
#include "command_line.h"
#include "mesh_options.h"
#include "mesh_report.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

class MeshRun {
  public:
    MeshRun(const MeshOptions& options, MeshPlan plan, const PreparedModel& prepared)
        : options_(options), plan_(std::move(plan)), prepared_(prepared), start_(now_seconds()) {
        job_.threads = prepared.threads;
    }

    int run() {
        auto evaluator = make_evaluator(prepared_.field(), prepared_.evaluator);
        if (!evaluator) return fail(evaluator.error());
        auto sampled = make_sampled_field(std::move(*evaluator), prepared_.map, plan_.iso);
        if (!sampled) return fail(sampled.error());
        const auto box = choose_box(prepared_, plan_.bounds, **sampled, job_);
        if (!box) return fail(box.error());
        plan_.contour.bounds = *box;
        const auto result = contour(**sampled);
        if (!result) return fail(result.error());
        warn(*result);
        return deliver(result->mesh, *result);
    }

  private:
    Result<ContourResult> contour(const SampledField& field) {
        ProgressBar bar("meshing");
        job_.on_progress = [&bar](double share) { bar.update(share); };
        auto result = contour_cells(field, plan_.contour, job_);
        job_.on_progress = nullptr;
        return result;
    }

    void warn(const ContourResult& result) const {
        if (result.mesh.triangles.empty()) print_warning("the mesh is empty");
        if (const std::string sides = side_list(result.touches); !sides.empty())
            print_warning(fmt::format("the surface touches the box at {}: the mesh is {}", sides,
                                      plan_.contour.cap ? "capped there" : "open there (--cap closes it)"));
        if (result.undefined_points == 0 || !result.first_undefined) return;
        const Vec3 p = *result.first_undefined;
        const double axes[3] = {p.x, p.y, p.z};
        std::vector<double> point;
        for (const MappedCoordinate& c : prepared_.map.coordinates)
            point.push_back(c.axis < 0 ? c.value : axes[c.axis]);
        warn_undefined(
            prepared_, prepared_.field().value, point,
            fmt::format("F is undefined at {} sample points, which count as outside; the first is {}",
                        result.undefined_points, point_text(point)));
    }

    /// Writes the mesh and the report; they are written even when a promise is broken.
    int deliver(const Mesh& mesh, const ContourResult& result) const {
        if (plan_.format) {
            if (const int code = write_mesh(mesh)) return code;
        }
        summarize(mesh);
        if (!plan_.wants_check) return exit_ok;
        const MeshReport report = check(mesh);
        const RunFigures run{now_seconds() - start_, prepared_.threads, prepared_.engine};
        const std::string bytes = report_bytes(report, result.undefined_points, run);
        if (options_.report && *options_.report != "-") {
            const WritingFile guard;
            if (const Status status = write_file(*options_.report, bytes); !status)
                return fail(status.error());
        }
        if (options_.json || options_.report.value_or("") == "-")
            if (const int code = print_result(bytes)) return code;
        const std::vector<std::string> broken = broken_promises(plan_.required, report);
        for (const std::string& sentence : broken) print_error("--require: " + sentence);
        return broken.empty() ? exit_ok : exit_check_failed;
    }

    int write_mesh(const Mesh& mesh) const {
        const auto bytes = encode_mesh(mesh, *plan_.format, {.ascii = options_.ascii});
        if (!bytes) return fail(bytes.error());
        if (*options_.output == "-") return print_result(*bytes);
        const WritingFile guard;
        if (const Status status = write_file(*options_.output, *bytes); !status) return fail(status.error());
        return exit_ok;
    }

    void summarize(const Mesh& mesh) const {
        const std::string where = !plan_.format             ? ""
                                  : *options_.output == "-" ? " to standard output"
                                                            : " to " + *options_.output;
        print_summary(fmt::format("{} vertices, {} triangles{} in {:.2f} s", mesh.vertices.size(),
                                  mesh.triangles.size(), where, now_seconds() - start_));
    }

    const MeshOptions& options_;
    MeshPlan plan_;
    const PreparedModel& prepared_;
    Job job_;
    double start_;
};

/// A mesh needs three axes; tells how to get them.
int refuse_flat(const PreparedModel& prepared) {
    const int n = prepared.header().coordinates();
    if (n < 3) {
        print_error(fmt::format("the object has {} coordinate{}; a mesh needs 3", n, n == 1 ? "" : "s"));
        print_help_line("contours of 2-D objects (.svg, .dxf) come with a later version");
        return exit_usage;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (prepared.map.uses(axis)) continue;
        print_error(
            fmt::format("--map: no coordinate is mapped to {}; a mesh needs x, y and z", "xyz"[axis]));
        return exit_usage;
    }
    return exit_ok;
}

}  // namespace

int run_mesh(Arguments arguments) {
    MeshOptions options;
    CommandLine line("mesh", "mesh MODEL -o FILE [options]", "Makes a triangle mesh of the surface F = 0.",
                     {"frep mesh pot.hf -o pot.stl", "frep mesh pot.hf -o pot.ply --grid 200 --bounds -60,60",
                      "frep mesh pot.hf -o pot.stl --require closed,manifold --report pot.json"});
    declare_mesh_options(line, options);
    if (const auto code = line.parse(arguments)) return *code;
    auto plan = plan_mesh(options);
    if (!plan) return fail(plan.error());
    if (const auto bytes = line.memory_limit()) plan->contour.memory_limit = *bytes;
    int code = exit_ok;
    const auto prepared = prepare_model(options.model, code);
    if (!prepared) return code;
    if (const int refused = refuse_flat(*prepared)) return refused;
    return MeshRun(options, std::move(*plan), *prepared).run();
}

}  // namespace frep::cli
