// SignPainter: the picture of where a field is inside on a plane, one byte a pixel. Tiles of pixels are cut
// into sixteen, whose ranges are found in one pass; what is decided is filled, what is open goes on with a
// tape that holds only what matters there (eval/prune.h), until a tile is small enough to evaluate its pixels
// (MPR, Keeter 2020, on a processor). The picture equals the one that evaluates the whole tape at each
// pixel's middle: pruning leaves the sign of every point as it is. The same bytes for every number of
// threads. Tested by tests/unit/trace/tile_sign_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/plane.h"
#include "frep/eval/sampled_field.h"

namespace frep {

/// What a byte of the picture says of F in the middle of its pixel.
enum class SignPixel : std::uint8_t {
    outside = 0,
    inside = 1,     ///< F >= 0
    undefined = 2,  ///< only with SignPictureOptions::tell_undefined; else outside
};

struct SignPictureOptions {
    Plane plane;
    Rectangle part{{-1, -1}, {1, 1}};  ///< of the plane: what the picture shows, in model units
    int width = 1024, height = 1024;   ///< pixels, 1..16384
    bool tell_undefined = false;
    bool prune = true;  ///< false: evaluate the whole tape everywhere
};

struct SignPicture {
    int width = 0, height = 0;
    std::vector<SignPixel> pixels;     ///< rows from top to bottom
    std::size_t tile_operations = 0;   ///< clauses run on tiles, each tile counted
    std::size_t point_operations = 0;  ///< clauses run on pixels, each pixel counted
};

/// Real is double or float, the profile of docs/numerics.md in which pixels are evaluated.
template <class Real>
class SignPainter {
  public:
    SignPainter();
    ~SignPainter();
    SignPainter(SignPainter&&) noexcept;
    SignPainter& operator=(SignPainter&&) noexcept;

    /// Paints F, a tape in single assignment (make_clause_tape), with its coordinates as `map` says, into
    /// `out`, whose memory is used again. Errors: invalid_argument for sizes out of range, a part that is
    /// empty or not finite, or a map that does not fit; cancelled.
    Status paint(const ClauseTape& tape, const AxisMap& map, const SignPictureOptions& options,
                 const Job& job, SignPicture& out);

  private:
    struct Workers;
    std::unique_ptr<Workers> workers_;
};

extern template class SignPainter<double>;
extern template class SignPainter<float>;

}  // namespace frep
