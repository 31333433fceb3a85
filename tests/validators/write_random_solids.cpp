// write_random_solids BATCH: writes the meshes of random solids (unit/contour/csg_trees.h) by
// contour_adaptive for judges outside of frep (mesh_batch.h): 50 solids, half of them by R-functions, 1,000
// with FREP_FULL=1, at three resolutions and with cells merged; and meshes with a planted fault, which a
// judge must refuse.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frep/contour/adaptive.h"
#include "unit/contour/csg_trees.h"
#include "validators/mesh_batch.h"

namespace {

using namespace frep;
using namespace frep::test;

[[noreturn]] void stop(const std::string& message) {
    std::fprintf(stderr, "write_random_solids: %s\n", message.c_str());
    std::exit(1);
}

/// As the binary formats write it: positions in binary32, equal ones merged.
BatchMesh batch_mesh(const Mesh& mesh, std::string name) {
    const Mesh merged = merge_equal_positions(mesh);
    BatchMesh result{.name = std::move(name)};
    std::vector<std::uint32_t> number(merged.vertices.size(), ~0u);
    std::uint32_t used = 0;
    for (const Triangle& t : merged.triangles) {
        for (const std::uint32_t v : t) {
            if (number[v] == ~0u) {
                number[v] = used++;
                for (const double c : {merged.vertices[v].x, merged.vertices[v].y, merged.vertices[v].z})
                    result.coordinates.push_back(static_cast<float>(c));
            }
            result.corners.push_back(number[v]);
        }
    }
    return result;
}

void write_solid(std::ostream& out, std::uint64_t seed) {
    const auto field = sampled(csg_solid(seed));
    std::vector<BatchMesh> meshes;
    const auto mesh_of = [&](const ContourOptions& options) {
        Job job;
        job.threads = 1;
        auto made = contour_adaptive(*field, options, job);
        if (!made) stop(made.error().message);
        meshes.push_back(batch_mesh(
            made->mesh, fmt::format("solid-{}-at-{}-within-{}", seed, options.cells, options.tolerance)));
        return std::move(made->mesh);
    };
    const Box3 box = Box3::cube(csg_bounds);
    mesh_of({.bounds = box, .cells = 40, .tolerance = 1e-2});
    for (const int cells : {16, 33}) mesh_of({.bounds = box, .cells = cells});
    const auto mesh_at = [&](int cells) { return mesh_of({.bounds = box, .cells = cells}); };
    const VolumeTrial trial = try_volume(*field, seed, mesh_at);
    meshes.back().volume = trial.expected;
    for (const BatchMesh& mesh : meshes) write_mesh(out, mesh);
}

/// A tetrahedron with its first vertex at `at`.
void add_tetrahedron(BatchMesh& mesh, float at) {
    const auto v = static_cast<std::uint32_t>(mesh.coordinates.size() / 3);
    for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f})
        mesh.coordinates.push_back(c + at);
    for (const std::uint32_t c : {0u, 2u, 1u, 0u, 1u, 3u, 0u, 3u, 2u, 1u, 2u, 3u})
        mesh.corners.push_back(v + c);
}

void write_faults(std::ostream& out) {
    BatchMesh whole{.name = "tetrahedron", .volume = 1 / 6.0};
    add_tetrahedron(whole, 0);
    write_mesh(out, whole);

    BatchMesh open{.name = "open", .expected = "open"};
    add_tetrahedron(open, 0);
    open.corners.resize(open.corners.size() - 3);
    write_mesh(out, open);

    BatchMesh turned{.name = "turned", .expected = "misoriented"};
    add_tetrahedron(turned, 0);
    std::swap(turned.corners[0], turned.corners[1]);
    write_mesh(out, turned);

    BatchMesh crossing{.name = "crossing", .expected = "crossing"};
    add_tetrahedron(crossing, 0);
    add_tetrahedron(crossing, 0.1f);
    write_mesh(out, crossing);

    BatchMesh pinched{.name = "pinched", .expected = "pinched"};
    add_tetrahedron(pinched, 0);
    add_tetrahedron(pinched, 2);
    for (std::uint32_t& c : pinched.corners)
        if (c == 4) c = 3;
    write_mesh(out, pinched);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) stop("usage: write_random_solids BATCH");
    std::ofstream out(arguments[1], std::ios::binary);
    write_faults(out);
    const std::uint64_t solids = csg_solids();
    for (std::uint64_t seed = 0; seed < solids; ++seed) write_solid(out, seed);
    out.close();
    if (!out) stop(std::string(arguments[1]) + " cannot be written");
    std::printf("%llu solids\n", static_cast<unsigned long long>(solids));
}
