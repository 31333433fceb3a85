// DepthPainter: the nearest surface of a field as seen from +z along parallel rays, with its normals. Space
// is a grid of voxels; tiles of it are cut into sixteen at a time from front to back (eval/prune.h), tiles
// behind what is already seen are left out, and the columns of open leaves are evaluated from front to back
// (Keeter 2020, on a processor). The layer of each pixel is the one that evaluating the whole tape at all
// voxels gives. Depth is refined between the first voxel inside and the one before it, and the normal is that
// of the refined point, where cut tapes keep the gradient. The same bytes for every number of threads.
// Tested by tests/unit/trace/tile_depth_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/sampled_field.h"

namespace frep {

struct DepthPictureOptions {
    Box3 part = Box3::cube(1);                       ///< of space, what the picture shows
    int width = 1024, height = 1024, layers = 1024;  ///< voxels along x, y and z, 1..16384
    bool prune = true;                               ///< false: evaluate the whole tape everywhere
};

struct DepthPicture {
    int width = 0, height = 0;
    /// By pixel, rows from top (greatest y) to bottom: 0 where the ray meets nothing, else 1 + the number,
    /// from the back, of the first voxel from the front whose middle is inside (F >= 0).
    std::vector<std::uint16_t> layers;
    std::vector<float> z;  ///< where the surface is, model units; NaN where the ray meets nothing
    /// Unit vectors that point out of the solid; (0, 0, 1) where the box cuts it or F has no gradient, 0
    /// where the ray meets nothing.
    std::vector<std::array<float, 3>> normals;
    std::size_t tile_operations = 0;   ///< clauses run on tiles, each tile counted
    std::size_t point_operations = 0;  ///< clauses run on points, each counted, with gradient or without
};

/// Real is double or float, the profile of docs/numerics.md in which points are evaluated.
template <class Real>
class DepthPainter {
  public:
    DepthPainter();
    ~DepthPainter();
    DepthPainter(DepthPainter&&) noexcept;
    DepthPainter& operator=(DepthPainter&&) noexcept;

    /// Paints F, a tape in single assignment (make_clause_tape), with its coordinates as `map` says, into
    /// `out`, whose memory is used again. Errors: invalid_argument for sizes out of range, a part that is
    /// empty or not finite, or a map that does not fit; cancelled.
    Status paint(const ClauseTape& tape, const AxisMap& map, const DepthPictureOptions& options,
                 const Job& job, DepthPicture& out);

  private:
    struct Workers;
    std::unique_ptr<Workers> workers_;
};

extern template class DepthPainter<double>;
extern template class DepthPainter<float>;

}  // namespace frep
