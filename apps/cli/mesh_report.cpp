// Implementation of mesh_report.h. The keys self_intersections and max_error of the contract come with the
// versions that can measure them; until then they are absent.
#include "mesh_report.h"

#include <sys/resource.h>

#include <fmt/format.h>

#include "json.h"
#include "values.h"

namespace frep::cli {

namespace {

Json point_json(Vec3 p) { return Json::array({json_number(p.x), json_number(p.y), json_number(p.z)}); }

Json run_json(const RunFigures& run) {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
    };
    return {{"seconds", run.seconds},
            {"cpu_seconds", seconds(usage.ru_utime) + seconds(usage.ru_stime)},
            {"peak_memory_bytes", static_cast<std::int64_t>(usage.ru_maxrss) * 1024},
            {"threads", run.threads},
            {"engine", run.engine}};
}

}  // namespace

std::string report_bytes(const MeshReport& report, std::size_t undefined_points, const RunFigures& run) {
    Json out = {{"schema", "frep.mesh/1"},
                {"vertices", report.vertices},
                {"triangles", report.triangles},
                {"components", report.components},
                {"boundary_edges", report.boundary_edges},
                {"nonmanifold_edges", report.nonmanifold_edges},
                {"nonmanifold_vertices", report.nonmanifold_vertices},
                {"misoriented_edges", report.misoriented_edges},
                {"euler_characteristic", report.euler_characteristic}};
    out["genus"] = report.genus ? json_number(*report.genus) : Json(nullptr);
    out["area"] = json_number(report.area);
    out["volume"] = report.volume ? json_number(*report.volume) : Json(nullptr);
    out["centroid"] = report.centroid ? point_json(*report.centroid) : Json(nullptr);
    out["bounds"] = nullptr;
    if (report.bounds)
        out["bounds"] = Json::array({point_json(report.bounds->min), point_json(report.bounds->max)});
    out["undefined_points"] = undefined_points;
    out["closed"] = report.closed;
    out["manifold"] = report.manifold;
    out["oriented"] = report.oriented;
    out["run"] = run_json(run);
    return json_bytes(out);
}

Result<std::vector<std::string>> parse_requirements(std::string_view text) {
    std::vector<std::string> out;
    for (const std::string_view word : split_at_commas(text)) {
        if (word == "no-self-intersection")
            return Error{ErrorKind::invalid_argument,
                         "the check for self-intersections comes with a later version"};
        if (word != "closed" && word != "manifold" && word != "oriented")
            return Error{ErrorKind::invalid_argument,
                         fmt::format("`{}` is not one of closed, manifold, oriented", word)};
        out.emplace_back(word);
    }
    return out;
}

std::vector<std::string> broken_promises(const std::vector<std::string>& required, const MeshReport& report) {
    std::vector<std::string> out;
    for (const std::string& word : required) {
        if (word == "closed" && !report.closed) {
            out.push_back(report.triangles == 0 ? "the mesh is not closed: it has no triangles"
                                                : fmt::format("the mesh is not closed: {} boundary edges",
                                                              report.boundary_edges));
        } else if (word == "manifold" && !report.manifold) {
            out.push_back(fmt::format("the mesh is not manifold: {} edges, {} vertices",
                                      report.nonmanifold_edges, report.nonmanifold_vertices));
        } else if (word == "oriented" && !report.oriented) {
            out.push_back(fmt::format("the mesh is not oriented: {} edges", report.misoriented_edges));
        }
    }
    return out;
}

}  // namespace frep::cli
