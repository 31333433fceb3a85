// Implementation of octree.h: breadth first, level by level, each level's parts in the order of their codes.
#include "frep/contour/octree.h"

#include <algorithm>

#include "frep/base/parallel.h"

namespace frep::contouring {

namespace {

constexpr std::size_t parents_a_task = 64;

/// A cubic part of the lattice with layer: samples lo .. lo + side, both ends included.
struct Part {
    std::array<std::uint32_t, 3> lo{};
    std::uint32_t side = 0;

    bool is_in(const Grid& grid) const {
        for (std::size_t a = 0; a < 3; ++a) {
            if (lo[a] > grid.cells[a] + 1) return false;
        }
        return true;
    }
    /// First and last sample index without layer.
    std::uint32_t first(std::size_t a) const { return lo[a] == 0 ? 0 : lo[a] - 1; }
    std::uint32_t last(const Grid& grid, std::size_t a) const {
        return std::min(lo[a] + side - 1, grid.cells[a]);
    }
    bool has_layer(const Grid& grid) const {
        for (std::size_t a = 0; a < 3; ++a) {
            if (lo[a] == 0 || lo[a] + side >= grid.cells[a] + 2) return true;
        }
        return false;
    }
    Box3 box(const Grid& grid) const {
        return {grid.point(first(0), first(1), first(2)),
                grid.point(last(grid, 0), last(grid, 1), last(grid, 2))};
    }
    /// The samples that belong to this part: those below lo + side.
    std::uint64_t own_samples(const Grid& grid) const {
        std::uint64_t product = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            product *= std::min(lo[a] + side - 2, grid.cells[a]) - first(a) + 1;
        }
        return product;
    }
    /// The position of its first own sample in its first block.
    std::uint32_t first_local() const {
        const auto at = [&](std::size_t a) { return lo[a] == 0 ? 1u : 0u; };
        return (at(2) * block_side + at(1)) * block_side + at(0);
    }
};

/// What one task finds.
struct Found {
    std::vector<std::uint64_t> undecided;
    PlaceTally undefined;
    std::array<bool, 6> touches{};
};

void note_touches(const Part& part, const Grid& grid, std::array<bool, 6>& touches) {
    for (std::size_t a = 0; a < 3; ++a) {
        if (part.first(a) == 0) touches[2 * a] = true;
        if (part.last(grid, a) == grid.cells[a]) touches[2 * a + 1] = true;
    }
}

void judge(const Part& part, std::uint64_t code, int level, const SignRange& range, const Grid& grid,
           bool cap, Found& found) {
    if (!range.can_be_inside && !range.can_be_undefined) return;
    if (!range.can_be_inside && !range.can_be_outside) {
        found.undefined.add(part.own_samples(grid), code << (3 * level), part.first_local());
        return;
    }
    if (!range.can_be_outside && !range.can_be_undefined) {
        note_touches(part, grid, found.touches);
        if (!(cap && part.has_layer(grid))) return;
    }
    found.undecided.push_back(code);
}

/// The children of some parts, those of level `level` (side 8 << level), kept where undecided.
void subdivide(std::span<const std::uint64_t> parents, int level, const Grid& grid, FieldPool& fields,
               const OctreeOptions& options, Found& found) {
    std::vector<std::uint64_t> codes;
    std::vector<Part> parts;
    std::vector<Box3> boxes;
    for (const std::uint64_t parent : parents) {
        for (std::uint64_t c = 0; c < 8; ++c) {
            const std::uint64_t code = parent * 8 + c;
            const std::uint32_t side = block_side << level;
            Part part{morton_decode(code), side};
            for (std::uint32_t& lo : part.lo) lo *= side;
            if (!part.is_in(grid)) continue;
            codes.push_back(code);
            parts.push_back(part);
            boxes.push_back(part.box(grid));
        }
    }
    if (!options.prune) {
        found.undecided = std::move(codes);
        return;
    }
    if (boxes.empty()) return;
    // What stands for F around all of them judges each.
    Box3 around = boxes[0];
    for (const Box3& box : boxes) around = joined(around, box);
    std::vector<SignRange> ranges(boxes.size());
    const FieldPool::Lease field = fields.borrow();
    FieldPart whole{around, nullptr};
    narrow_parts(*field, {&whole, 1}, {ranges.data(), 1});
    (whole.field ? *whole.field : *field).quick_ranges(boxes, ranges);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        judge(parts[i], codes[i], level, ranges[i], grid, options.cap, found);
    }
}

}  // namespace

void PlaceTally::add(std::uint64_t samples, std::uint64_t at_block, std::uint32_t at_local) {
    count += samples;
    if (at_block < block || (at_block == block && at_local < local)) {
        block = at_block;
        local = at_local;
    }
}

void PlaceTally::add(const PlaceTally& other) {
    if (other.count > 0) add(other.count, other.block, other.local);
}

Result<OctreeResult> find_blocks(const Grid& grid, FieldPool& fields, const OctreeOptions& options,
                                 const Job& job) {
    const std::uint32_t longest = std::max({grid.cells[0], grid.cells[1], grid.cells[2]});
    int level = 1;
    while ((block_side << level) < longest + 2) ++level;
    OctreeResult result;
    result.blocks = {0};
    while (level > 0) {
        --level;
        const std::vector<std::uint64_t> parents = std::move(result.blocks);
        const std::size_t tasks = (parents.size() + parents_a_task - 1) / parents_a_task;
        std::vector<Found> found(tasks);
        parallel_for(job, tasks, [&](std::size_t t) {
            const std::size_t begin = t * parents_a_task;
            const std::size_t count = std::min(parents_a_task, parents.size() - begin);
            subdivide({parents.data() + begin, count}, level, grid, fields, options, found[t]);
        });
        if (job.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
        result.blocks = {};
        for (Found& part : found) {
            result.blocks.insert(result.blocks.end(), part.undecided.begin(), part.undecided.end());
            part.undecided = {};
            result.undefined.add(part.undefined);
            for (std::size_t s = 0; s < 6; ++s) result.touches[s] = result.touches[s] || part.touches[s];
        }
        if (result.blocks.size() > options.max_nodes) {
            return Error{
                ErrorKind::over_limit,
                "the grid has more blocks near the surface than the memory limit allows; use fewer cells"};
        }
    }
    return result;
}

}  // namespace frep::contouring
