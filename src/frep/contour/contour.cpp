// contour_cells: find the blocks near the surface, contour each, join them. See contour.h.
#include "frep/contour/contour.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "frep/base/parallel.h"
#include "frep/contour/assemble.h"
#include "frep/contour/block.h"
#include "frep/contour/field_pool.h"
#include "frep/contour/octree.h"

namespace frep {

namespace {

using namespace contouring;

constexpr std::size_t blocks_a_task = 16;  // as many as are narrowed in one pass
/// Estimated peak memory for a vertex with its triangles: in its block, and in the mesh.
constexpr std::size_t bytes_a_vertex = 140;
/// And for an attribute of it: in its block, in the mesh, as a color.
constexpr std::size_t bytes_an_attribute = 24;
/// Estimated memory for a block that is looked at, most of which turn out empty.
constexpr std::size_t bytes_a_block = 64;

/// What the blocks gave.
struct Sampling {
    std::vector<std::unique_ptr<BlockMesh>> parts;
    UndefinedTally undefined;
    std::array<bool, 6> touches{};
    bool over_limit = false;
};

Sampling sample_blocks(const Grid& grid, const std::vector<std::uint64_t>& blocks, FieldPool& fields,
                       const ContourOptions& options, const Job& job) {
    Sampling result;
    result.parts.resize(blocks.size());
    const std::size_t tasks = (blocks.size() + blocks_a_task - 1) / blocks_a_task;
    const std::size_t vertex_bytes = bytes_a_vertex + options.attributes * bytes_an_attribute;
    std::atomic<std::size_t> vertices{0};
    std::atomic<bool> over_limit{false};
    std::size_t tasks_done = 0;
    std::mutex mutex;  // guards result's tallies and tasks_done
    parallel_for(job, tasks, [&](std::size_t t) {
        if (over_limit) return;
        const FieldPool::Lease field = fields.borrow();
        BlockContourer contourer(grid, *field, {.cap = options.cap, .attributes = options.attributes});
        const std::size_t first = t * blocks_a_task;
        std::vector<FieldPart> parts;
        for (std::size_t i = first; i < std::min(first + blocks_a_task, blocks.size()); ++i)
            parts.push_back({block_box(grid, blocks[i]), nullptr});
        std::vector<SignRange> ranges(parts.size());
        if (options.prune) narrow_parts(*field, parts, ranges);
        std::size_t made = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            std::unique_ptr<BlockMesh>& mesh = result.parts[first + i];
            mesh = contourer.contour(blocks[first + i], parts[i].field.get());
            if (mesh) made += mesh->edges.size();
        }
        if ((vertices += made) > options.memory_limit / vertex_bytes) over_limit = true;
        const std::lock_guard lock(mutex);
        result.undefined.add(contourer.undefined);  // sums and minima: the order of arrival does not matter
        for (std::size_t s = 0; s < 6; ++s) result.touches[s] = result.touches[s] || contourer.touches[s];
        ++tasks_done;
        if (tasks_done % 64 == 0 || tasks_done == tasks) {
            job.report(0.9 * static_cast<double>(tasks_done) / static_cast<double>(tasks));
        }
    });
    result.over_limit = over_limit;
    return result;
}

/// The point of the first undefined sample of a tally.
Vec3 place_of(const UndefinedTally& tally, const Grid& grid) {
    const std::array<std::uint32_t, 3> block = morton_decode(tally.block);
    const std::uint32_t at = tally.local;
    return grid.point(block[0] * block_side + at % block_side - 1,
                      block[1] * block_side + at / block_side % block_side - 1,
                      block[2] * block_side + at / (block_side * block_side) - 1);
}

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
    Sampling sampling = sample_blocks(*grid, octree->blocks, fields, options, job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
    if (sampling.over_limit) {
        return Error{ErrorKind::over_limit,
                     "the mesh would take more memory than the limit; use fewer cells"};
    }
    Result<AssembledMesh> mesh =
        assemble(octree->blocks, std::move(sampling.parts), options.attributes, fields, job);
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
