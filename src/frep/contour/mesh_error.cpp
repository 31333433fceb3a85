// Implementation of mesh_error.h.
#include "frep/contour/mesh_error.h"

#include <algorithm>

#include "frep/base/parallel.h"
#include "frep/contour/contour.h"
#include "frep/contour/sign_change.h"
#include "frep/eval/field_pool.h"
#include "frep/geom/bvh.h"

namespace frep {

namespace {

using namespace contouring;

constexpr std::size_t samples_a_task = 4096;
constexpr double reach_in_cells = 4;
constexpr std::size_t most_refined = 5000;  // lines searched in all directions
/// The finer lattice: its cell as a share of the mesh's, and its shift, in its cells.
constexpr double finest_share = 0.29, coarsest_share = 0.93;
constexpr Vec3 lattice_shift{0.37, 0.41, 0.29};
/// A cap lies in the sides of the box up to this, in cells.
constexpr double sides_of_box_tolerance = 1e-6;

/// Where samples lie on a triangle, as weights of its corners; the first is taken most often.
constexpr Vec3 spots[] = {{1 / 3.0, 1 / 3.0, 1 / 3.0},
                          {0.5, 0.5, 0},
                          {0, 0.5, 0.5},
                          {0.5, 0, 0.5},
                          {2 / 3.0, 1 / 6.0, 1 / 6.0},
                          {1 / 6.0, 2 / 3.0, 1 / 6.0},
                          {1 / 6.0, 1 / 6.0, 2 / 3.0}};

/// True when the triangle lies in a side of the grid's box, as those of a cap do.
bool is_in_side(const Vec3& a, const Vec3& b, const Vec3& c, const Box3& box, double tolerance) {
    const auto all_at = [tolerance](double u, double v, double w, double side) {
        const auto near = [&](double t) { return t >= side - tolerance && t <= side + tolerance; };
        return near(u) && near(v) && near(w);
    };
    return all_at(a.x, b.x, c.x, box.min.x) || all_at(a.x, b.x, c.x, box.max.x) ||
           all_at(a.y, b.y, c.y, box.min.y) || all_at(a.y, b.y, c.y, box.max.y) ||
           all_at(a.z, b.z, c.z, box.min.z) || all_at(a.z, b.z, c.z, box.max.z);
}

/// The samples of the mesh: so many spots a triangle that there are about `wanted`; of large meshes every
/// n-th triangle only.
std::vector<SignProbe> probes_of(const Mesh& mesh, const Grid& grid, std::size_t wanted) {
    std::vector<SignProbe> probes;
    const std::size_t triangles = mesh.triangles.size();
    if (triangles == 0 || wanted == 0) return probes;
    const std::size_t stride = (triangles + wanted - 1) / wanted;
    const std::size_t count = std::clamp<std::size_t>(wanted / triangles, 1, std::size(spots));
    const Box3 box = grid.bounds();
    for (std::size_t i = 0; i < triangles; i += stride) {
        const Triangle& t = mesh.triangles[i];
        const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        if (is_in_side(a, b, c, box, sides_of_box_tolerance * grid.cell)) continue;
        const Vec3 normal = cross(b - a, c - a);
        const double size = length(normal);
        if (!(size > 0)) continue;
        for (std::size_t s = 0; s < count; ++s)
            probes.push_back({a * spots[s].x + b * spots[s].y + c * spots[s].z, normal / size});
    }
    return probes;
}

/// Refines the farthest lines until the farthest of all is a refined one. Every line gets only shorter.
void refine_farthest(std::vector<std::vector<SignLine>>& parts, SignSearch& search, const Job& job) {
    std::vector<SignLine*> order;
    for (std::vector<SignLine>& part : parts)
        for (SignLine& line : part) order.push_back(&line);
    std::stable_sort(order.begin(), order.end(),
                     [](const SignLine* a, const SignLine* b) { return a->high > b->high; });
    double farthest = 0;
    for (std::size_t i = 0; i < order.size() && i < most_refined && !job.cancelled(); ++i) {
        if (order[i]->high <= farthest) break;
        search.refine(*order[i]);
        if (order[i]->way != 0) farthest = std::max(farthest, order[i]->high);
    }
}

void measure_from_mesh(const Mesh& mesh, FieldPool& fields, const MeshErrorOptions& options, const Job& job,
                       MeshError& error) {
    const std::vector<SignProbe> probes = probes_of(mesh, options.grid, options.samples);
    const double reach = reach_in_cells * options.grid.cell, start = 1e-3 * options.grid.cell;
    std::vector<std::vector<SignLine>> parts((probes.size() + samples_a_task - 1) / samples_a_task);
    parallel_for(job, parts.size(), [&](std::size_t t) {
        const FieldPool::Lease field = fields.borrow();
        SignSearch search(*field, reach, start);
        const std::size_t begin = t * samples_a_task;
        parts[t] = search.search({probes.data() + begin, std::min(samples_a_task, probes.size() - begin)});
    });
    if (job.cancelled()) return;
    const FieldPool::Lease field = fields.borrow();
    SignSearch search(*field, reach, start);
    refine_farthest(parts, search, job);
    error.samples_on_mesh = probes.size();
    for (const std::vector<SignLine>& part : parts) {
        for (const SignLine& line : part) {
            if (line.way == 0) {
                ++error.unresolved;
            } else if (!error.mesh_to_surface || line.high > *error.mesh_to_surface) {
                error.mesh_to_surface = line.high;
                error.mesh_place = line.point;
            }
        }
    }
}

/// Points of the surface on the edges of the finer lattice, inside the mesh's grid.
Result<std::vector<Vec3>> surface_points(const SampledField& field, const Mesh& mesh,
                                         const MeshErrorOptions& options, const Job& job) {
    const Grid& grid = options.grid;
    const double per_share = static_cast<double>(mesh.vertices.size()) /
                             static_cast<double>(std::max<std::size_t>(options.samples, 1));
    const double share = std::clamp(__builtin_sqrt(per_share), finest_share, coarsest_share);
    ContourOptions finer;
    finer.cell_length = share * grid.cell;
    const Box3 box = grid.bounds();
    finer.bounds = {box.min + lattice_shift * finer.cell_length, box.max};
    finer.prune = options.prune;
    finer.memory_limit = options.memory_limit;
    const Result<ContourResult> contour = contour_cells(field, finer, job);
    if (!contour) return contour.error();
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < contour->edge_vertices; ++v)
        if (box.contains(contour->mesh.vertices[v])) points.push_back(contour->mesh.vertices[v]);
    return points;
}

void measure_from_surface(const std::vector<Vec3>& points, const Mesh& mesh, const Job& job,
                          MeshError& error) {
    error.samples_on_surface = points.size();
    const TriangleBvh tree(mesh, job);
    if (tree.empty()) return;
    struct Farthest {
        double distance = -1;
        Vec3 place;
    };
    std::vector<Farthest> found((points.size() + samples_a_task - 1) / samples_a_task);
    parallel_for(job, found.size(), [&](std::size_t t) {
        const std::size_t end = std::min((t + 1) * samples_a_task, points.size());
        for (std::size_t i = t * samples_a_task; i < end; ++i) {
            const std::optional<TriangleBvh::Nearest> nearest = tree.nearest(points[i]);
            if (nearest && nearest->distance > found[t].distance) found[t] = {nearest->distance, points[i]};
        }
    });
    for (const Farthest& part : found) {
        if (part.distance < 0 || (error.surface_to_mesh && part.distance <= *error.surface_to_mesh)) continue;
        error.surface_to_mesh = part.distance;
        error.surface_place = part.place;
    }
}

/// Replaces a distance by a larger one.
void keep_larger(std::optional<double>& mine, Vec3& place, const std::optional<double>& other,
                 const Vec3& other_place) {
    if (!other || (mine && *mine >= *other)) return;
    mine = other;
    place = other_place;
}

}  // namespace

std::optional<double> MeshError::largest() const {
    if (!mesh_to_surface || !surface_to_mesh) return mesh_to_surface ? mesh_to_surface : surface_to_mesh;
    return std::max(*mesh_to_surface, *surface_to_mesh);
}

Vec3 MeshError::place() const {
    const bool from_surface = surface_to_mesh && (!mesh_to_surface || *surface_to_mesh > *mesh_to_surface);
    return from_surface ? surface_place : mesh_place;
}

void MeshError::add(const MeshError& other) {
    keep_larger(mesh_to_surface, mesh_place, other.mesh_to_surface, other.mesh_place);
    keep_larger(surface_to_mesh, surface_place, other.surface_to_mesh, other.surface_place);
    samples_on_mesh += other.samples_on_mesh;
    samples_on_surface += other.samples_on_surface;
    unresolved += other.unresolved;
}

Result<MeshError> measure_mesh_error(const SampledField& field, const Mesh& mesh,
                                     const MeshErrorOptions& options, const Job& job) {
    MeshError error;
    FieldPool fields(field);
    measure_from_mesh(mesh, fields, options, job, error);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "measuring was cancelled"};
    const Result<std::vector<Vec3>> points = surface_points(field, mesh, options, job);
    if (!points) return points.error();
    measure_from_surface(*points, mesh, job, error);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "measuring was cancelled"};
    return error;
}

}  // namespace frep
