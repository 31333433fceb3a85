// judge_cgal BATCH: the meshes of a batch (mesh_batch.h) by the CGAL library: whether they are closed,
// oriented, manifold surfaces free of self-intersections, which CGAL decides with exact numbers, whether
// they bound a volume, and whether that is within 2 % of the estimate in the batch. A mesh with a stated
// fault must be refused for that fault. CGAL is under the GPL; this program is a test, links no part of
// frep, and is not installed.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "validators/mesh_batch.h"

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using frep::test::BatchMesh;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Surface::Face_index;

struct Verdict {
    std::string fault = "sound";
    double volume = 0;
    std::size_t degenerate = 0;  ///< triangles without an area, which are no fault
};

/// The pairs of triangles that meet elsewhere than in a common vertex or edge.
std::size_t crossings(const Surface& surface, std::size_t& degenerate) {
    std::vector<std::pair<Face, Face>> pairs;
    processing::self_intersections(surface, std::back_inserter(pairs));
    std::size_t count = 0;
    for (const auto& [a, b] : pairs) ++(a == b ? degenerate : count);
    return count;
}

Verdict judge(const BatchMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> triangles;
    for (std::size_t i = 0; i < mesh.coordinates.size(); i += 3) {
        const double x = mesh.coordinates[i], y = mesh.coordinates[i + 1], z = mesh.coordinates[i + 2];
        if (!std::isfinite(x + y + z)) return {"undefined"};
        points.emplace_back(x, y, z);
    }
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
        triangles.push_back({mesh.corners[i], mesh.corners[i + 1], mesh.corners[i + 2]});
    // Edges of two triangles at most, run through in both directions, and a disk around each vertex.
    if (!processing::is_polygon_soup_a_polygon_mesh(triangles)) return {"no manifold"};
    Surface surface;
    processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
    if (!CGAL::is_closed(surface)) return {"open"};
    Verdict verdict;
    if (crossings(surface, verdict.degenerate) > 0) return {"crossing"};
    if (surface.number_of_faces() > 0 && !processing::does_bound_a_volume(surface)) return {"inside out"};
    verdict.volume = processing::volume(surface);
    return verdict;
}

bool as_expected(const BatchMesh& mesh, const Verdict& verdict) {
    const bool no_manifold = mesh.expected == "misoriented" || mesh.expected == "pinched";
    if (verdict.fault != (no_manifold ? "no manifold" : mesh.expected)) return false;
    return !mesh.volume || std::abs(verdict.volume - *mesh.volume) <= 0.02 * *mesh.volume + 1e-4;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: judge_cgal BATCH\n");
        return 2;
    }
    std::ifstream in(arguments[1], std::ios::binary);
    bool broken = !in;
    std::size_t meshes = 0, triangles = 0, controls = 0, measured = 0, degenerate = 0, differences = 0;
    while (const auto mesh = frep::test::read_mesh(in, broken)) {
        const Verdict verdict = judge(*mesh);
        ++meshes;
        triangles += mesh->corners.size() / 3;
        controls += mesh->expected == "sound" ? 0 : 1;
        measured += mesh->volume ? 1 : 0;
        degenerate += verdict.degenerate;
        if (as_expected(*mesh, verdict)) continue;
        ++differences;
        std::printf("%s: %s, not %s; volume %g, not %g\n", mesh->name.c_str(), verdict.fault.c_str(),
                    mesh->expected.c_str(), verdict.volume, mesh->volume.value_or(verdict.volume));
    }
    if (broken) std::printf("%s is no batch\n", arguments[1]);
    std::printf(
        "CGAL: %zu meshes (%zu with a planted fault), %zu triangles (%zu without an area), %zu volumes; "
        "%zu differences\n",
        meshes, controls, triangles, degenerate, measured, differences);
    return !broken && controls > 0 && meshes > controls && differences == 0 ? 0 : 1;
}
