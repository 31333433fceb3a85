// contour_adaptive: find the blocks near the surface, sample each, join them. See adaptive.h.
#include "frep/contour/adaptive.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "frep/base/parallel.h"
#include "frep/contour/block.h"
#include "frep/contour/dual_block.h"
#include "frep/contour/dual_mesh.h"
#include "frep/contour/field_pool.h"
#include "frep/contour/octree.h"

namespace frep {

namespace {

using namespace contouring;

constexpr std::size_t blocks_a_task = 16;  // as many as are narrowed in one pass
/// Estimated peak memory for a crossing of an edge with its share of vertices and triangles.
constexpr std::size_t bytes_a_crossing = 200;
/// And for an attribute of it: at the crossing, at vertices, as a color.
constexpr std::size_t bytes_an_attribute = 32;
/// Estimated memory for a block that is looked at, most of which turn out empty.
constexpr std::size_t bytes_a_block = 64;
/// Least distance of vertices from the sides of their leaves, in cells; and in the spacing of binary32
/// numbers at the largest coordinate, so that files keep vertices apart.
constexpr double least_margin = 1e-4;
constexpr double float_spacings = 64;
constexpr double largest_margin = 0.05;

/// What the blocks gave.
struct Sampling {
    std::vector<std::unique_ptr<DualBlock>> blocks;
    UndefinedTally undefined;
    std::array<bool, 6> touches{};
    bool over_limit = false;
};

Sampling sample_blocks(const Grid& grid, const std::vector<std::uint64_t>& codes, FieldPool& fields,
                       const DualOptions& options, bool prune, std::size_t memory_limit, const Job& job) {
    Sampling result;
    std::vector<std::unique_ptr<DualBlock>> all(codes.size());
    const std::size_t tasks = (codes.size() + blocks_a_task - 1) / blocks_a_task;
    const std::size_t crossing_bytes = bytes_a_crossing + options.attributes * bytes_an_attribute;
    std::atomic<std::size_t> crossings{0};
    std::atomic<bool> over_limit{false};
    std::size_t tasks_done = 0;
    std::mutex mutex;  // guards result's tallies and tasks_done
    parallel_for(job, tasks, [&](std::size_t t) {
        if (over_limit) return;
        const FieldPool::Lease field = fields.borrow();
        DualSampler sampler(grid, options);
        const std::size_t first = t * blocks_a_task;
        std::vector<FieldPart> parts;
        for (std::size_t i = first; i < std::min(first + blocks_a_task, codes.size()); ++i)
            parts.push_back({block_box(grid, codes[i]), nullptr});
        std::vector<SignRange> ranges(parts.size());
        if (prune) narrow_parts(*field, parts, ranges);
        std::size_t made = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            std::unique_ptr<DualBlock>& block = all[first + i];
            block = sampler.sample(codes[first + i], parts[i].field ? *parts[i].field : *field, *field);
            if (block) made += block->roots.size();
        }
        if ((crossings += made) > memory_limit / crossing_bytes) over_limit = true;
        const std::lock_guard lock(mutex);
        result.undefined.add(sampler.undefined);  // sums and minima: the order of arrival does not matter
        for (std::size_t s = 0; s < 6; ++s) result.touches[s] = result.touches[s] || sampler.touches[s];
        ++tasks_done;
        if (tasks_done % 64 == 0 || tasks_done == tasks) {
            job.report(0.8 * static_cast<double>(tasks_done) / static_cast<double>(tasks));
        }
    });
    result.over_limit = over_limit;
    for (auto& block : all) {
        if (block) result.blocks.push_back(std::move(block));
    }
    return result;
}

/// The point of the first undefined sample of a tally.
Vec3 place_of(const UndefinedTally& tally, const Grid& grid) {
    Lattice at = morton_decode(tally.block);
    const Lattice local = local_of(tally.local);
    for (std::size_t a = 0; a < 3; ++a) at[a] = at[a] * block_side + local[a] - 1;
    return grid.point(at[0], at[1], at[2]);
}

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
    Sampling sampling =
        sample_blocks(*grid, octree->blocks, fields, dual, options.prune, options.memory_limit, job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
    if (sampling.over_limit) {
        return Error{ErrorKind::over_limit,
                     "the mesh would take more memory than the limit; use fewer cells"};
    }
    Result<DualMesh> mesh = join_blocks(*grid, dual, std::move(sampling.blocks), job);
    if (!mesh) return mesh.error();

    ContourResult result;
    result.mesh = std::move(mesh->mesh);
    result.edge_vertices = mesh->edge_vertices;
    result.attributes = std::move(mesh->attributes);
    result.grid = *grid;
    result.sampled_blocks = octree->blocks.size();
    sampling.undefined.add(octree->undefined);
    result.undefined_points = sampling.undefined.count;
    if (result.undefined_points > 0) result.first_undefined = place_of(sampling.undefined, *grid);
    for (std::size_t s = 0; s < 6; ++s) result.touches[s] = sampling.touches[s] || octree->touches[s];
    job.report(1);
    return result;
}

}  // namespace frep
