// contour_cells: find the blocks near the surface, contour each, join them. See contour.h.
#include "frep/contour/contour.h"

#include <algorithm>

#include "frep/contour/assemble.h"
#include "frep/contour/block_tasks.h"

namespace frep {

namespace {

using namespace contouring;

/// Estimated peak memory for a vertex with its triangles: in its block, and in the mesh.
constexpr std::size_t bytes_a_vertex = 140;
/// And for an attribute of it: in its block, in the mesh, as a color.
constexpr std::size_t bytes_an_attribute = 24;

}  // namespace

Result<ContourResult> contour_cells(const SampledField& field, const ContourOptions& given, const Job& job) {
    ContourOptions options = given;
    options.attributes = std::min(options.attributes, field.attribute_count());
    const Result<Grid> grid = make_grid(options.bounds, options.cells, options.cell_length);
    if (!grid) return grid.error();
    FieldPool fields(field);
    Result<OctreeResult> octree = find_blocks(
        *grid, fields,
        {.cap = options.cap, .prune = options.prune, .max_nodes = options.memory_limit / bytes_a_block}, job);
    if (!octree) return octree.error();
    std::vector<std::unique_ptr<BlockMesh>> parts(octree->blocks.size());
    const std::size_t vertex_bytes = bytes_a_vertex + options.attributes * bytes_an_attribute;
    const BlockFindings findings = for_blocks(
        {*grid, octree->blocks, fields, options.prune, options.memory_limit / vertex_bytes, 0.9}, job,
        [&](SampledField& whole) {
            return BlockContourer(*grid, whole, {.cap = options.cap, .attributes = options.attributes});
        },
        [&](BlockContourer& contourer, std::size_t i, const BlockFields& block) {
            parts[i] = contourer.contour(octree->blocks[i], block.part);
            return parts[i] ? parts[i]->edges.size() : 0;
        });
    if (const Status status = finished(findings, job); !status) return status.error();
    Result<AssembledMesh> mesh = assemble(octree->blocks, std::move(parts), options.attributes, fields, job);
    if (!mesh) return mesh.error();

    ContourResult result;
    result.mesh = std::move(mesh->mesh);
    result.edge_vertices = mesh->edge_vertices;
    result.attributes = std::move(mesh->attributes);
    result.grid = *grid;
    result.sampled_blocks = octree->blocks.size();
    add_findings(findings, *octree, result);
    job.report(1);
    return result;
}

std::vector<Color> vertex_colors(const ContourResult& result, const Color& undefined) {
    std::vector<Color> colors;
    if (result.attributes.size() < 3) return colors;
    const auto clamped = [](double v) { return v > 0 ? (v < 1 ? v : 1.0) : 0.0; };
    colors.reserve(result.attributes[0].size());
    for (std::size_t v = 0; v < result.attributes[0].size(); ++v) {
        const double r = result.attributes[0][v], g = result.attributes[1][v], b = result.attributes[2][v];
        const bool defined = r == r && g == g && b == b;
        colors.push_back(defined ? Color{clamped(r), clamped(g), clamped(b)} : undefined);
    }
    return colors;
}

std::array<const char*, 6> side_names() { return {"-x", "+x", "-y", "+y", "-z", "+z"}; }

}  // namespace frep
