// Implementation of quadtree.h and of plane_grid.h.
#include "frep/contour/quadtree.h"

#include <algorithm>

#include "frep/base/parallel.h"

namespace frep::contouring {

namespace {

constexpr std::size_t parents_a_task = 64;

/// A square part of the lattice with layer: samples lo .. lo + side, both ends included.
struct Part {
    PlaneBlock lo{};
    std::uint32_t side = 0;

    bool is_in(const PlaneGrid& grid) const {
        return lo[0] <= grid.cells[0] + 1 && lo[1] <= grid.cells[1] + 1;
    }
    /// First and last sample index without layer.
    std::uint32_t first(std::size_t a) const { return lo[a] == 0 ? 0 : lo[a] - 1; }
    std::uint32_t last(const PlaneGrid& grid, std::size_t a) const {
        return std::min(lo[a] + side - 1, grid.cells[a]);
    }
    bool has_layer(const PlaneGrid& grid) const {
        for (std::size_t a = 0; a < 2; ++a) {
            if (lo[a] == 0 || lo[a] + side >= grid.cells[a] + 2) return true;
        }
        return false;
    }
    Box3 box(const PlaneGrid& grid) const {
        return {grid.in_space(grid.point(first(0), first(1))),
                grid.in_space(grid.point(last(grid, 0), last(grid, 1)))};
    }
    /// The samples that belong to this part: those below lo + side.
    std::uint64_t own_samples(const PlaneGrid& grid) const {
        std::uint64_t product = 1;
        for (std::size_t a = 0; a < 2; ++a)
            product *= std::min(lo[a] + side - 2, grid.cells[a]) - first(a) + 1;
        return product;
    }
};

/// What one task finds.
struct Found {
    std::vector<PlaneBlock> undecided;
    PlaneTally undefined;
    std::array<bool, 4> touches{};
};

void judge(const Part& part, const PlaneBlock& block, const SignRange& range, const PlaneGrid& grid, bool cap,
           Found& found) {
    if (!range.can_be_inside && !range.can_be_undefined) return;
    if (!range.can_be_inside && !range.can_be_outside) {
        found.undefined.add(part.own_samples(grid), grid.number(part.first(0) + 1, part.first(1) + 1));
        return;
    }
    if (!range.can_be_outside && !range.can_be_undefined) {
        for (std::size_t a = 0; a < 2; ++a) {
            if (part.first(a) == 0) found.touches[2 * a] = true;
            if (part.last(grid, a) == grid.cells[a]) found.touches[2 * a + 1] = true;
        }
        if (!(cap && part.has_layer(grid))) return;
    }
    found.undecided.push_back(block);
}

/// The children of some parts, squares of `side` samples, kept where undecided.
void subdivide(std::span<const PlaneBlock> parents, std::uint32_t side, const PlaneGrid& grid,
               FieldPool& fields, const QuadtreeOptions& options, Found& found) {
    std::vector<PlaneBlock> blocks;
    std::vector<Part> parts;
    std::vector<Box3> boxes;
    for (const PlaneBlock& parent : parents) {
        for (std::uint32_t c = 0; c < 4; ++c) {
            const PlaneBlock block{2 * parent[0] + (c & 1u), 2 * parent[1] + (c >> 1)};
            const Part part{{block[0] * side, block[1] * side}, side};
            if (!part.is_in(grid)) continue;
            blocks.push_back(block);
            parts.push_back(part);
            boxes.push_back(part.box(grid));
        }
    }
    if (!options.prune) {
        found.undecided = std::move(blocks);
        return;
    }
    std::vector<SignRange> ranges(boxes.size());
    const FieldPool::Lease field = fields.borrow();
    field->ranges(boxes, ranges);
    for (std::size_t i = 0; i < blocks.size(); ++i)
        judge(parts[i], blocks[i], ranges[i], grid, options.cap, found);
}

}  // namespace

Result<PlaneGrid> make_plane_grid(const Box3& bounds, const Plane& plane, int count, double cell_length) {
    const std::array<double, 3> lo{bounds.min.x, bounds.min.y, bounds.min.z};
    const std::array<double, 3> hi{bounds.max.x, bounds.max.y, bounds.max.z};
    const auto u = static_cast<std::size_t>(plane.right), v = static_cast<std::size_t>(plane.up);
    const Result<Grid> flat = make_grid({{lo[u], lo[v], 0}, {hi[u], hi[v], 0}}, count, cell_length);
    if (!flat) return flat.error();
    PlaneGrid grid;
    grid.plane = plane;
    grid.origin = {flat->origin.x, flat->origin.y};
    grid.cell = flat->cell;
    grid.cells = {flat->cells[0], flat->cells[1]};
    return grid;
}

Result<QuadtreeResult> find_plane_blocks(const PlaneGrid& grid, FieldPool& fields,
                                         const QuadtreeOptions& options, const Job& job) {
    int level = 1;
    while ((plane_block_side << level) < std::max(grid.cells[0], grid.cells[1]) + 2) ++level;
    QuadtreeResult result;
    result.blocks = {PlaneBlock{0, 0}};
    while (level > 0) {
        --level;
        const std::vector<PlaneBlock> parents = std::move(result.blocks);
        const std::size_t tasks = (parents.size() + parents_a_task - 1) / parents_a_task;
        std::vector<Found> found(tasks);
        parallel_for(job, tasks, [&](std::size_t t) {
            const std::size_t begin = t * parents_a_task;
            const std::size_t count = std::min(parents_a_task, parents.size() - begin);
            subdivide({parents.data() + begin, count}, plane_block_side << level, grid, fields, options,
                      found[t]);
        });
        if (job.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
        result.blocks = {};
        for (Found& part : found) {
            result.blocks.insert(result.blocks.end(), part.undecided.begin(), part.undecided.end());
            part.undecided = {};
            result.undefined.add(part.undefined);
            for (std::size_t s = 0; s < 4; ++s) result.touches[s] = result.touches[s] || part.touches[s];
        }
        if (result.blocks.size() > options.max_nodes) {
            return Error{
                ErrorKind::over_limit,
                "the grid has more blocks near the outline than the memory limit allows; use fewer cells"};
        }
    }
    return result;
}

}  // namespace frep::contouring
