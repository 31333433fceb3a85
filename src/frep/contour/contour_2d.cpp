// Implementation of contour_2d.h: find the blocks near the outline, contour each, chain the pieces.
#include "frep/contour/contour_2d.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "frep/base/parallel.h"
#include "frep/contour/plane_block.h"
#include "frep/contour/quadtree.h"

namespace frep {

namespace {

using namespace contouring;

constexpr std::size_t blocks_a_task = 32;
/// Estimated peak memory for a node with its piece, and for a block that is looked at.
constexpr std::size_t bytes_a_node = 160;
constexpr std::size_t bytes_a_block = 120;
constexpr std::uint32_t none = 0xffffffffu;

/// What the blocks gave.
struct Sampling {
    std::vector<PlanePart> parts;
    PlaneTally undefined;
    std::array<bool, 4> touches{};
    bool over_limit = false;
};

Sampling sample_blocks(const PlaneGrid& grid, const std::vector<PlaneBlock>& blocks, FieldPool& fields,
                       const PlaneContourOptions& options, const Job& job) {
    Sampling result;
    result.parts.resize(blocks.size());
    const std::size_t tasks = (blocks.size() + blocks_a_task - 1) / blocks_a_task;
    const std::size_t most = std::min<std::size_t>(options.memory_limit / bytes_a_node, none - 1);
    std::atomic<std::size_t> nodes{0};
    std::atomic<bool> over_limit{false};
    std::size_t tasks_done = 0;
    std::mutex mutex;  // guards result's tallies and tasks_done
    parallel_for(job, tasks, [&](std::size_t t) {
        if (over_limit) return;
        const FieldPool::Lease field = fields.borrow();
        PlaneContourer contourer(grid, *field, options.cap);
        std::size_t made = 0;
        const std::size_t end = std::min((t + 1) * blocks_a_task, blocks.size());
        for (std::size_t i = t * blocks_a_task; i < end; ++i) {
            result.parts[i] = contourer.contour(blocks[i]);
            made += result.parts[i].nodes.size();
        }
        if ((nodes += made) > most) over_limit = true;
        const std::lock_guard lock(mutex);
        result.undefined.add(contourer.undefined);  // sums and minima: the order of arrival does not matter
        for (std::size_t s = 0; s < 4; ++s) result.touches[s] = result.touches[s] || contourer.touches[s];
        ++tasks_done;
        if (tasks_done % 64 == 0 || tasks_done == tasks)
            job.report(0.9 * static_cast<double>(tasks_done) / static_cast<double>(tasks));
    });
    result.over_limit = over_limit;
    return result;
}

/// The nodes of all blocks in the order of their ids, each with the node that follows.
class Chains {
  public:
    explicit Chains(const PlaneGrid& grid) : grid_(grid) {}

    /// False when a piece names a node that is not there.
    bool link(std::vector<PlanePart>& parts) {
        for (PlanePart& part : parts) {
            nodes_.insert(nodes_.end(), part.nodes.begin(), part.nodes.end());
            part.nodes = {};
        }
        std::sort(nodes_.begin(), nodes_.end(),
                  [](const PlaneNode& a, const PlaneNode& b) { return a.id < b.id; });
        next_.assign(nodes_.size(), none);
        previous_.assign(nodes_.size(), none);
        for (PlanePart& part : parts) {
            for (const PlanePiece& piece : part.pieces) {
                const std::uint32_t from = find(piece.from), to = find(piece.to);
                if (from == none || to == none) return false;
                next_[from] = to;
                previous_[to] = from;
            }
            part.pieces = {};
        }
        return true;
    }

    std::vector<Polyline> lines() {
        std::vector<std::uint32_t> starts;
        std::vector<bool> is_seen(nodes_.size());
        for (const bool open : {true, false}) {
            for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
                if (is_seen[i] || next_[i] == none || (open && previous_[i] != none)) continue;
                starts.push_back(i);
                for (std::uint32_t k = i; k != none && !is_seen[k]; k = next_[k]) is_seen[k] = true;
            }
        }
        std::sort(starts.begin(), starts.end());
        std::vector<Polyline> lines;
        lines.reserve(starts.size());
        for (const std::uint32_t start : starts) lines.push_back(line_from(start));
        return lines;
    }

  private:
    std::uint32_t find(std::uint64_t id) const {
        const auto at = std::lower_bound(nodes_.begin(), nodes_.end(), id,
                                         [](const PlaneNode& node, std::uint64_t v) { return node.id < v; });
        return at != nodes_.end() && at->id == id ? static_cast<std::uint32_t>(at - nodes_.begin()) : none;
    }

    bool is_cap(std::uint32_t i) const { return i != none && nodes_[i].id % 3 == cap_node; }

    /// A node of the cap between two others on the same side of the box.
    bool is_needless(std::uint32_t i) const {
        if (!is_cap(i) || !is_cap(next_[i]) || !is_cap(previous_[i])) return false;
        const std::uint64_t row = std::uint64_t{grid_.cells[0]} + 3;
        const std::uint64_t e = nodes_[i].id / 3 % row, f = nodes_[i].id / 3 / row;
        const bool is_corner = (e == 1 || e == grid_.cells[0] + 1) && (f == 1 || f == grid_.cells[1] + 1);
        return !is_corner;
    }

    Polyline line_from(std::uint32_t start) const {
        Polyline line;
        line.closed = previous_[start] != none;
        std::uint32_t i = start;
        do {
            if (!is_needless(i)) line.points.push_back(nodes_[i].point);
            i = next_[i];
        } while (i != none && i != start);
        return line;
    }

    const PlaneGrid& grid_;
    std::vector<PlaneNode> nodes_;
    std::vector<std::uint32_t> next_, previous_;
};

bool is_plane(const Plane& plane) {
    const auto is_axis = [](int a) { return a >= 0 && a <= 2; };
    return is_axis(plane.right) && is_axis(plane.up) && plane.right != plane.up && plane.at - plane.at == 0;
}

}  // namespace

Result<PlaneContour> contour_plane(FieldPool& fields, const PlaneContourOptions& options, const Job& job) {
    if (!is_plane(options.plane))
        return Error{ErrorKind::invalid_argument, "a plane needs two different axes and a finite height"};
    const Result<PlaneGrid> grid =
        make_plane_grid(options.bounds, options.plane, options.cells, options.cell_length);
    if (!grid) return grid.error();
    const Result<QuadtreeResult> tree = find_plane_blocks(
        *grid, fields,
        {.cap = options.cap, .prune = options.prune, .max_nodes = options.memory_limit / bytes_a_block}, job);
    if (!tree) return tree.error();
    Sampling sampling = sample_blocks(*grid, tree->blocks, fields, options, job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
    if (sampling.over_limit) {
        return Error{ErrorKind::over_limit,
                     "the outlines would take more memory than the limit; use fewer cells"};
    }
    Chains chains(*grid);
    if (!chains.link(sampling.parts)) {
        return Error{ErrorKind::invalid_argument,
                     "the intervals of the field contradict its values; contour without pruning"};
    }
    PlaneContour result;
    result.outlines = chains.lines();
    result.cell = grid->cell;
    result.min = grid->origin;
    result.max = grid->point(grid->cells[0], grid->cells[1]);
    result.sampled_blocks = tree->blocks.size();
    sampling.undefined.add(tree->undefined);
    result.undefined_points = sampling.undefined.count;
    if (result.undefined_points > 0)
        result.first_undefined = grid->in_space(grid->place(sampling.undefined.first));
    const std::array<int, 2> axes{options.plane.right, options.plane.up};
    for (std::size_t s = 0; s < 4; ++s) {
        const auto side = 2 * static_cast<std::size_t>(axes[s / 2]) + s % 2;
        result.touches[side] = sampling.touches[s] || tree->touches[s];
    }
    job.report(1);
    return result;
}

Result<PlaneContour> contour_plane(const SampledField& field, const PlaneContourOptions& options,
                                   const Job& job) {
    FieldPool fields(field);
    return contour_plane(fields, options, job);
}

OutlineReport check(const std::vector<Polyline>& outlines) {
    OutlineReport report;
    report.outlines = outlines.size();
    for (const Polyline& line : outlines) {
        report.closed += line.closed ? 1 : 0;
        report.area += signed_area(line);
        report.length += length(line);
        for (const Vec2& p : line.points) {
            if (report.points++ == 0) report.min = report.max = p;
            report.min = {std::min(report.min.x, p.x), std::min(report.min.y, p.y)};
            report.max = {std::max(report.max.x, p.x), std::max(report.max.y, p.y)};
        }
    }
    return report;
}

}  // namespace frep
