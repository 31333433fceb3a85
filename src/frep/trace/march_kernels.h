// The loops of ColumnMarch (tile_columns.h) over rays and hits, compiled once for each instruction set: bare
// pointers and plain data, so that nothing of a wider set can slip into the rest of the program
// (docs/numerics.md, rule 2). All sets give the same bits. Tested by tests/unit/trace/tile_depth_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace frep::march {

/// Numbers of pixels, as wide as Real, so that they move as Real does.
template <class Real>
using Index = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

/// Columns of Rays and Hits need room for this many items more than are used: whole registers are written.
inline constexpr std::size_t slack = 16;

/// Pixels of a picture, `width` x `height` of them (at most 8 wide), rows `row_stride` pixels apart.
template <class Real>
struct PixelBlock {
    const std::uint16_t* layers;    ///< of the first pixel; 0: its ray has met nothing yet
    std::size_t first, row_stride;  ///< number of the first pixel
    const Real *x, *y;              ///< of its columns and rows
    int width, height;
};

/// Rays on their way, by column.
template <class Real>
struct Rays {
    Real *x, *y;
    Real* before;  ///< F at the voxel in front of the next one
    Index<Real>* pixel;
    std::size_t count;
};

/// Where rays have met the surface, by column.
template <class Real>
struct Hits {
    Real *x, *y;
    Real* z;              ///< where the chord between the two voxels meets 0
    Real *inner, *outer;  ///< z of the first voxel inside, and of the one in front of it
    Real* layer;          ///< number of the first
    Index<Real>* pixel;
    std::size_t count;
};

/// F in layers of all rays, front layer first; rows of Rays::count values.
template <class Real>
struct Slab {
    const Real* values;
    const Real* middles;  ///< z of all layers of the picture, from the back
    int front, last;      ///< number of the slab's first layer, and of the picture's front layer
    int count;            ///< of layers in the slab
    int skipped;          ///< layers at the front where no ray has a hit; 0 or 1
    bool is_first;        ///< nothing is known of the voxels in front: Rays::before is not read
};

/// F and its gradient at the hits.
template <class Real>
struct Gradients {
    const Real *value, *x, *y, *z;
};

/// The columns of a picture; `normals` has three numbers a pixel.
struct Canvas {
    std::uint16_t* layers;
    float *z, *normals;
};

template <class Real>
struct Kernels {
    /// Adds the rays of a block that have met nothing yet.
    void (*add)(const PixelBlock<Real>&, Rays<Real>&);
    /// How many these are.
    int (*count_open)(const PixelBlock<Real>&);
    /// Points of `layers` layers of all rays from layer `front` (middles as in Slab) backwards, by column.
    void (*points)(const Rays<Real>&, const Real* middles, int front, int layers, Real* x, Real* y, Real* z);
    /// Rays with a hit in the slab become hits; the others move up and remember the last layer.
    void (*advance)(const Slab<Real>&, Rays<Real>&, Hits<Real>&);
    /// Refines the depths of the hits, one step of Newton's between the two voxels, and writes these and unit
    /// normals, which point out of the solid: (0, 0, 1) in layer `last`, and where F has no gradient.
    void (*paint)(const Hits<Real>&, const Gradients<Real>&, int last, const Canvas&);
};

/// The loops for machine_isa() (eval/isa.h). Real is double or float.
template <class Real>
const Kernels<Real>& kernels();

namespace sse2 {
const Kernels<float>& floats();
const Kernels<double>& doubles();
}  // namespace sse2
namespace avx2 {
const Kernels<float>& floats();
const Kernels<double>& doubles();
}  // namespace avx2
namespace avx512 {
const Kernels<float>& floats();
const Kernels<double>& doubles();
}  // namespace avx512

}  // namespace frep::march
