// Implementation of mesh_report.h.
#include "mesh_report.h"

#include <sys/resource.h>

#include <algorithm>

#include <fmt/format.h>

#include "values.h"

namespace frep::cli {

namespace {

constexpr std::size_t most_components = 100;

Json box_json(const Box3& box) { return Json::array({point_json(box.min), point_json(box.max)}); }

Json maybe(const std::optional<double>& value) { return value ? json_number(*value) : Json(nullptr); }

Json inertia_json(const std::optional<Inertia>& inertia) {
    if (!inertia) return nullptr;
    const Inertia& i = *inertia;
    return Json::array({point_json(Vec3{i.xx, i.xy, i.xz}), point_json(Vec3{i.xy, i.yy, i.yz}),
                        point_json(Vec3{i.xz, i.yz, i.zz})});
}

Json components_json(const MeshReport& report) {
    Json list = Json::array();
    for (const ComponentReport& c : report.component_list) {
        if (list.size() == most_components) break;
        list.push_back({{"triangles", c.triangles},
                        {"closed", c.closed},
                        {"euler_characteristic", c.euler_characteristic},
                        {"genus", maybe(c.genus)},
                        {"area", json_number(c.area)},
                        {"volume", maybe(c.volume)},
                        {"bounds", box_json(c.bounds)}});
    }
    return list;
}

Json places_json(const SelfIntersections& found) {
    Json list = Json::array();
    for (const IntersectingPair& pair : found.listed) list.push_back(point_json(pair.place));
    return list;
}

void add_error(const std::optional<MeshError>& error, Json& out) {
    out["max_error"] = error ? maybe(error->largest()) : Json(nullptr);
    out["max_error_at"] = error && error->largest() ? point_json(error->place()) : Json(nullptr);
    if (!error) return;
    out["error"] = {{"mesh_to_surface", maybe(error->mesh_to_surface)},
                    {"surface_to_mesh", maybe(error->surface_to_mesh)},
                    {"samples_on_mesh", error->samples_on_mesh},
                    {"samples_on_surface", error->samples_on_surface},
                    {"unresolved", error->unresolved}};
}

}  // namespace

Json point_json(Vec3 p) { return Json::array({json_number(p.x), json_number(p.y), json_number(p.z)}); }
Json point_json(Vec2 p) { return Json::array({json_number(p.x), json_number(p.y)}); }

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

Json mesh_json(const MeshReport& report, const MeshFigures& figures) {
    Json out = {{"schema", "frep.mesh/1"},
                {"dimension", 3},
                {"units", figures.unit},
                {"vertices", report.vertices},
                {"triangles", report.triangles},
                {"components", report.components},
                {"boundary_edges", report.boundary_edges},
                {"nonmanifold_edges", report.nonmanifold_edges},
                {"nonmanifold_vertices", report.nonmanifold_vertices},
                {"misoriented_edges", report.misoriented_edges}};
    out["self_intersections"] = nullptr;
    if (report.self_intersections) {
        out["self_intersections"] = report.self_intersections->count;
        if (report.self_intersections->count > 0)
            out["self_intersections_at"] = places_json(*report.self_intersections);
    }
    out["euler_characteristic"] = report.euler_characteristic;
    out["genus"] = maybe(report.genus);
    out["area"] = json_number(report.area);
    out["volume"] = maybe(report.volume);
    out["centroid"] = report.centroid ? point_json(*report.centroid) : Json(nullptr);
    out["inertia"] = inertia_json(report.inertia);
    out["bounds"] = report.bounds ? box_json(*report.bounds) : Json(nullptr);
    add_error(figures.error, out);
    out["undefined_points"] = figures.undefined_points;
    if (figures.first_undefined) out["first_undefined"] = point_json(*figures.first_undefined);
    out["tight_cells"] = figures.tight_cells;
    out["hidden_cells"] = figures.hidden_cells;
    out["closed"] = report.closed;
    out["manifold"] = report.manifold;
    out["oriented"] = report.oriented;
    if (figures.objects.size() > 1) {
        Json list = Json::array();
        for (const ObjectFigures& o : figures.objects)
            list.push_back(
                {{"name", json_text(o.name)}, {"vertices", o.vertices}, {"triangles", o.triangles}});
        out["objects"] = std::move(list);
    }
    out["component_list"] = components_json(report);
    return out;
}

Result<std::vector<std::string>> parse_requirements(std::string_view text) {
    constexpr std::string_view known[] = {"closed", "manifold", "oriented", "no-self-intersection",
                                          "resolved"};
    std::vector<std::string> out;
    for (const std::string_view word : split_at_commas(text)) {
        if (std::find(std::begin(known), std::end(known), word) == std::end(known))
            return Error{
                ErrorKind::invalid_argument,
                fmt::format("`{}` is not one of closed, manifold, oriented, no-self-intersection, resolved",
                            word)};
        out.emplace_back(word);
    }
    return out;
}

bool requires_resolved(const std::vector<std::string>& required) {
    return std::find(required.begin(), required.end(), "resolved") != required.end();
}

std::vector<std::string> broken_promises(const std::vector<std::string>& required, const MeshReport& report,
                                         const MeshFigures& figures) {
    std::vector<std::string> out;
    for (const std::string& word : required) {
        if (word == "closed" && !report.closed) {
            out.push_back(report.triangles == 0
                              ? "--require: the mesh is not closed: it has no triangles"
                              : fmt::format("--require: the mesh is not closed: {} boundary edges",
                                            report.boundary_edges));
        } else if (word == "manifold" && !report.manifold) {
            out.push_back(fmt::format("--require: the mesh is not manifold: {} edges, {} vertices",
                                      report.nonmanifold_edges, report.nonmanifold_vertices));
        } else if (word == "oriented" && !report.oriented) {
            out.push_back(
                fmt::format("--require: the mesh is not oriented: {} edges", report.misoriented_edges));
        } else if (word == "no-self-intersection" && report.self_intersections &&
                   report.self_intersections->count > 0) {
            const SelfIntersections& found = *report.self_intersections;
            const Vec3 p = found.listed.empty() ? Vec3{} : found.listed.front().place;
            out.push_back(
                fmt::format("--require: the mesh intersects itself: {} pairs of triangles, the first at "
                            "({:.6g}, {:.6g}, {:.6g})",
                            found.count, p.x, p.y, p.z));
        } else if (word == "resolved" && figures.tight_cells + figures.hidden_cells > 0) {
            out.push_back(fmt::format(
                "--require: the cells are too large: {} with walls or gaps about as thin, {} that hide some",
                figures.tight_cells, figures.hidden_cells));
        }
    }
    return out;
}

}  // namespace frep::cli
