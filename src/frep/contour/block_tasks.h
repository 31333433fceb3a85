// What the two polygonizers of solids share: blocks in tasks, the fields of a task narrowed together, tallies
// and limits joined. Tested by tests/unit/contour/contour_test.cpp and adaptive_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "frep/base/parallel.h"
#include "frep/contour/block.h"
#include "frep/contour/contour.h"
#include "frep/contour/octree.h"
#include "frep/eval/field_pool.h"

namespace frep::contouring {

inline constexpr std::size_t blocks_a_task = 16;  ///< as many as are narrowed in one pass
/// Estimated memory for a block that is looked at, most of which turn out empty.
inline constexpr std::size_t bytes_a_block = 64;

struct BlockTasks {
    const Grid& grid;
    std::span<const std::uint64_t> codes;  ///< of the blocks
    FieldPool& fields;
    bool prune = true;             ///< narrow the field for each block
    std::size_t most_nodes = 0;    ///< that all blocks may make together
    double share_of_progress = 1;  ///< of the whole job
    bool signs = false;            ///< find a field for the signs, too
};

/// What the tasks found beside the parts of the mesh.
struct BlockFindings {
    PlaceTally undefined;
    PlaceTally tight, hidden;       ///< cells, see ContourResult
    std::array<bool, 6> touches{};  ///< sides -x +x -y +y -z +z reached by the shape
    bool over_limit = false;        ///< more than most_nodes; later blocks were left out
};

/// What stands for F in a block.
struct BlockFields {
    SampledField& part;   ///< in the box of the block, as of SampledField::narrow()
    SampledField& signs;  ///< for the signs alone, as of SampledField::narrow_signs()
    SampledField& whole;
};

/// Null stands for the field before.
inline BlockFields fields_of(const FieldPart& part, const std::shared_ptr<SampledField>& near,
                             SampledField& whole) {
    SampledField& narrowed = part.field ? *part.field : whole;
    return {narrowed, near ? *near : narrowed, whole};
}

/// For each task a worker, make(field), and for each of its blocks made += run(worker, number of the block,
/// its fields): the nodes made. A worker has the members `undefined` and `touches`, and may have `tight` and
/// `hidden`.
template <class Make, class Run>
BlockFindings for_blocks(const BlockTasks& tasks, const Job& job, Make make, Run run) {
    BlockFindings findings;
    const std::size_t count = (tasks.codes.size() + blocks_a_task - 1) / blocks_a_task;
    std::atomic<std::size_t> nodes{0};
    std::atomic<bool> over_limit{false};
    std::size_t tasks_done = 0;
    std::mutex mutex;  // guards the findings and tasks_done
    parallel_for(job, count, [&](std::size_t t) {
        if (over_limit) return;
        const FieldPool::Lease field = tasks.fields.borrow();
        auto worker = make(*field);
        const std::size_t first = t * blocks_a_task;
        std::vector<FieldPart> parts;
        for (std::size_t i = first; i < std::min(first + blocks_a_task, tasks.codes.size()); ++i)
            parts.push_back({block_box(tasks.grid, tasks.codes[i]), nullptr});
        std::vector<SignRange> ranges(parts.size());
        std::vector<std::shared_ptr<SampledField>> near(parts.size());
        if (tasks.prune) {
            narrow_parts(*field, parts, ranges);
            if (tasks.signs) narrow_signs(*field, parts, near);
        }
        std::size_t made = 0;
        for (std::size_t i = 0; i < parts.size(); ++i)
            made += run(worker, first + i, fields_of(parts[i], near[i], *field));
        if ((nodes += made) > tasks.most_nodes) over_limit = true;
        const std::lock_guard lock(mutex);
        findings.undefined.add(worker.undefined);  // sums and minima: the order of arrival does not matter
        if constexpr (requires { worker.tight; }) findings.tight.add(worker.tight);
        if constexpr (requires { worker.hidden; }) findings.hidden.add(worker.hidden);
        for (std::size_t s = 0; s < 6; ++s) findings.touches[s] = findings.touches[s] || worker.touches[s];
        ++tasks_done;
        if (tasks_done % 64 == 0 || tasks_done == count)
            job.report(tasks.share_of_progress * static_cast<double>(tasks_done) /
                       static_cast<double>(count));
    });
    findings.over_limit = over_limit;
    return findings;
}

/// The errors of a job after for_blocks(): cancelled, over_limit.
Status finished(const BlockFindings& findings, const Job& job);

/// Undefined points and touched sides, of the blocks and of what the octree left out, into `result`, whose
/// grid is set.
void add_findings(BlockFindings findings, const OctreeResult& octree, ContourResult& result);

}  // namespace frep::contouring
