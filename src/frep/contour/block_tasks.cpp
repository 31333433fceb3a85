// Implementation of block_tasks.h.
#include "frep/contour/block_tasks.h"

namespace frep::contouring {

namespace {

/// The point of the first place of a tally: a sample, or the lower corner of a cell.
Vec3 place_of(const PlaceTally& tally, const Grid& grid) {
    const std::array<std::uint32_t, 3> block = morton_decode(tally.block);
    const std::uint32_t at = tally.local;
    return grid.point(block[0] * block_side + at % block_side - 1,
                      block[1] * block_side + at / block_side % block_side - 1,
                      block[2] * block_side + at / (block_side * block_side) - 1);
}

}  // namespace

Status finished(const BlockFindings& findings, const Job& job) {
    if (job.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
    if (findings.over_limit)
        return Error{ErrorKind::over_limit,
                     "the mesh would take more memory than the limit; use fewer cells"};
    return {};
}

void add_findings(BlockFindings findings, const OctreeResult& octree, ContourResult& result) {
    findings.undefined.add(octree.undefined);
    result.undefined_points = findings.undefined.count;
    if (result.undefined_points > 0) result.first_undefined = place_of(findings.undefined, result.grid);
    result.tight_cells = findings.tight.count;
    if (result.tight_cells > 0) result.first_tight = place_of(findings.tight, result.grid);
    result.hidden_cells = findings.hidden.count;
    if (result.hidden_cells > 0) result.first_hidden = place_of(findings.hidden, result.grid);
    for (std::size_t s = 0; s < 6; ++s) result.touches[s] = findings.touches[s] || octree.touches[s];
}

}  // namespace frep::contouring
