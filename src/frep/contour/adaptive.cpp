// contour_adaptive: find the blocks near the surface, sample each, join them. See adaptive.h.
#include "frep/contour/adaptive.h"

#include <algorithm>

#include "frep/contour/block_arena.h"
#include "frep/contour/block_tasks.h"
#include "frep/contour/dual_block.h"
#include "frep/contour/dual_mesh.h"

namespace frep {

namespace {

using namespace contouring;

/// Estimated peak memory for a crossing of an edge with its share of vertices and triangles.
constexpr std::size_t bytes_a_crossing = 200;
/// And for an attribute of it: at the crossing, at vertices, as a color.
constexpr std::size_t bytes_an_attribute = 32;
/// Least distance of vertices from the sides of their leaves, in cells; and in the spacing of binary32
/// numbers at the largest coordinate, so that files keep vertices apart.
constexpr double least_margin = 1e-4;
constexpr double float_spacings = 64;
constexpr double largest_margin = 0.05;

double margin_of(const Grid& grid) {
    const Box3 box = grid.bounds();
    double largest = 0;
    for (const double c : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z})
        largest = std::max(largest, c < 0 ? -c : c);
    const double spacing = 0x1p-24 * largest / grid.cell;
    return std::min(std::max(least_margin, float_spacings * spacing), largest_margin);
}

}  // namespace

Result<ContourResult> contour_adaptive(const SampledField& field, const ContourOptions& options,
                                       const Job& job) {
    if (!(options.tolerance >= 0) || options.tolerance - options.tolerance != 0)
        return Error{ErrorKind::invalid_argument, "the tolerance is not a length"};
    const Result<Grid> grid = make_grid(options.bounds, options.cells, options.cell_length);
    if (!grid) return grid.error();
    FieldPool fields(field);
    Result<OctreeResult> octree = find_blocks(
        *grid, fields,
        {.cap = options.cap, .prune = options.prune, .max_nodes = options.memory_limit / bytes_a_block}, job);
    if (!octree) return octree.error();
    DualOptions dual;
    dual.cap = options.cap;
    dual.attributes = std::min(options.attributes, field.attribute_count());
    dual.margin = margin_of(*grid);
    dual.tolerance = options.tolerance / grid->cell;
    BlockArena memory;
    std::vector<StoredBlock> all(octree->blocks.size());
    const std::size_t crossing_bytes = bytes_a_crossing + dual.attributes * bytes_an_attribute;
    const BlockFindings findings = for_blocks(
        {*grid, octree->blocks, fields, options.prune, options.memory_limit / crossing_bytes, 0.8, true}, job,
        [&](SampledField&) { return DualSampler(*grid, dual); },
        [&](DualSampler& sampler, std::size_t i, const BlockFields& fields_of_block) {
            const DualBlock* const block = sampler.sample(octree->blocks[i], fields_of_block);
            if (block) all[i] = store(*block, memory);
            return block ? block->roots.size() : 0;
        });
    if (const Status status = finished(findings, job); !status) return status.error();
    std::erase(all, nullptr);
    Result<DualMesh> mesh = join_blocks(*grid, dual, std::move(all), job);
    if (!mesh) return mesh.error();

    ContourResult result;
    result.mesh = std::move(mesh->mesh);
    result.attributes = std::move(mesh->attributes);
    result.grid = *grid;
    result.sampled_blocks = octree->blocks.size();
    add_findings(findings, *octree, result);
    job.report(1);
    return result;
}

Result<ContourResult> contour_solid(const SampledField& field, const ContourOptions& options,
                                    const Job& job) {
    if (options.method == ContourMethod::adaptive) return contour_adaptive(field, options, job);
    if (options.tolerance != 0)
        return Error{ErrorKind::invalid_argument, "a tolerance is for the adaptive method only"};
    return contour_cells(field, options, job);
}

}  // namespace frep
