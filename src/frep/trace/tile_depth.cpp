// Implementation of tile_depth.h. A worker goes through its part of space depth first, the front layer of
// children before the next; a count of pixels without a hit under every tile's footprint says what is hidden.
#include "frep/trace/tile_depth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "frep/base/parallel.h"
#include "frep/eval/prune.h"
#include "frep/trace/tile_columns.h"
#include "frep/trace/tile_worker.h"

namespace frep {
namespace {

constexpr int leaf_side = 8;    ///< voxels along the side of the smallest tile
constexpr int last_split = 2;   ///< children along a side of the tiles above the leaves
constexpr int split = 4;        ///< and of all others; split * split children are the lanes of a pass
constexpr int most_levels = 8;  ///< of tiles: 8, 16, 64, 256, 1024, ...
constexpr std::size_t leaf_columns = leaf_side * leaf_side;
constexpr std::size_t most_columns = leaf_columns * tile_lanes;

/// A cube of voxels; the edges of the picture may cut it. z counts from the back. (Not set at first: arrays
/// of tiles stand in every call.)
struct VoxelTile {
    int x, y, z, level;
};

/// Pixels under a tile without a hit, by tile of one level.
struct Footprints {
    int shift = 0, across = 0;  ///< a side is 1 << shift pixels
    std::vector<int> left;

    void set(int side, int width, int height) {
        shift = std::countr_zero(static_cast<unsigned>(side));
        across = (width + side - 1) / side;
        const int down = (height + side - 1) / side;
        left.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x)
                left[static_cast<std::size_t>(y * across + x)] =
                    std::min(side, width - x * side) * std::min(side, height - y * side);
    }
    int& at(const VoxelTile& tile) {
        return left[static_cast<std::size_t>((tile.y >> shift) * across + (tile.x >> shift))];
    }
};

/// What all workers read; of pixels and footprints each writes its own.
template <class Real>
struct Space {
    const DepthPictureOptions* options = nullptr;
    DepthPicture* out = nullptr;
    PartMiddles<Real> x, y, z;
    CoordinateSources sources;
    int root = 0;  ///< level of the tile that has everything; level 0 has the leaves
    std::array<int, most_levels> side{};
    std::array<Footprints, most_levels> footprints;  ///< below the root

    std::size_t pixel(int px, int py) const {
        return static_cast<std::size_t>(py) * static_cast<std::size_t>(out->width) +
               static_cast<std::size_t>(px);
    }
    bool is_in_picture(const VoxelTile& tile) const {
        return tile.x < options->width && tile.y < options->height && tile.z < options->layers;
    }
    void count_hits(const VoxelTile& leaf, int hits) {
        for (int level = 0; level < root; ++level)
            footprints[static_cast<std::size_t>(level)].at(leaf) -= hits;
    }
};

/// One thread's part of the work.
template <class Real>
class Worker {
  public:
    struct Lanes {
        std::array<VoxelTile, tile_lanes> tiles;
        int count = 0;
    };

    void begin(Space<Real>& space) {
        space_ = &space;
        operations_before_ = pruner_.tile_operations();
        march_.begin(space.sources, space.z, most_columns);
    }
    /// Operations since begin().
    std::size_t tile_operations() const { return pruner_.tile_operations() - operations_before_; }
    std::size_t point_operations() const { return march_.point_operations(); }

    /// Layers of children that go through one pass.
    int layers_a_pass(int level) const { return children_along(level) == split ? 1 : last_split; }
    int children_along(int level) const {
        const auto at = static_cast<std::size_t>(level);
        return space_->side[at] / space_->side[at - 1];
    }

    /// The children of a tile in `count` layers from `layer` backwards that something may be seen of, front
    /// ones first. Layer 0 is at the back.
    Lanes children(const VoxelTile& tile, int layer, int count) const {
        Lanes lanes;
        const int side = space_->side[static_cast<std::size_t>(tile.level - 1)];
        const int along = children_along(tile.level);
        for (int z = layer; z > layer - count; --z)
            for (int k = 0; k < along * along; ++k) {
                const VoxelTile child{tile.x + k % along * side, tile.y + k / along * side, tile.z + z * side,
                                      tile.level - 1};
                if (!space_->is_in_picture(child) || is_hidden(child)) continue;
                lanes.tiles[static_cast<std::size_t>(lanes.count++)] = child;
            }
        return lanes;
    }

    bool is_hidden(const VoxelTile& tile) const {
        return space_->footprints[static_cast<std::size_t>(tile.level)].at(tile) == 0;
    }

    void cut(const Lanes& lanes, const ClauseTape& tape, CutResult& result) {
        BoxLanes boxes;
        boxes.count = lanes.count;
        for (int k = 0; k < lanes.count; ++k) set_box(lanes.tiles[static_cast<std::size_t>(k)], k, boxes);
        pruner_.cut(tape, boxes, Purpose::sign, result);
    }

    /// The tape to go on with in lane k.
    static const ClauseTape& tape_for(const ClauseTape& parent, const CutResult& cut, int k) {
        const std::int8_t number = cut.tape_of[static_cast<std::size_t>(k)];
        return number < 0 ? parent : cut.tapes[static_cast<std::size_t>(number)];
    }

    void descend(const VoxelTile& tile, const ClauseTape& tape) {
        if (tile.level == 0) {
            Lanes one;
            one.tiles[0] = tile;
            one.count = 1;
            return look_into(one, 1, tape);
        }
        const int some = layers_a_pass(tile.level);
        for (int layer = children_along(tile.level) - 1; layer >= 0 && !is_hidden(tile); layer -= some) {
            const Lanes lanes = children(tile, layer, some);
            if (lanes.count == 0) continue;
            CutResult& result = cuts_[static_cast<std::size_t>(tile.level)];
            cut(lanes, tape, result);
            unsigned packed = 0;
            for (int begin = 0, end = 0; begin < lanes.count; begin = end) {
                while (end < lanes.count && z_of(lanes, end) == z_of(lanes, begin)) ++end;
                look(lanes, (1u << end) - (1u << begin), tape, result, packed);
            }
        }
    }

    static int z_of(const Lanes& lanes, int k) { return lanes.tiles[static_cast<std::size_t>(k)].z; }

    /// Fills the lanes of one layer that are inside, and goes on in open ones. Bits of `packed`: tapes of the
    /// result that are packed.
    void look(const Lanes& lanes, unsigned layer, const ClauseTape& tape, CutResult& result,
              unsigned& packed) {
        const unsigned open = result.ranges.open() & layer;
        for (int k = 0; k < lanes.count; ++k) {
            const VoxelTile& tile = lanes.tiles[static_cast<std::size_t>(k)];
            if ((open >> k & 1u) != 0 && tile.level > 0) descend(tile, tape_for(tape, result, k));
            if ((layer & ~open & result.ranges.can_be_inside) >> k & 1u) fill(tile);
        }
        if (lanes.tiles[0].level > 0) return;
        for (int number = -1; number < result.tape_count; ++number) {
            unsigned group = 0;
            for (int k = 0; k < lanes.count; ++k)
                if (std::max<int>(result.tape_of[static_cast<std::size_t>(k)], -1) == number)
                    group |= open & 1u << k;
            if (group != 0) look_into(lanes, group, leaf_tape(tape, number, result, packed));
        }
    }

    /// Tape `number` of the result, or the one that was cut (-1), with packed rows if it is long.
    const ClauseTape& leaf_tape(const ClauseTape& whole, int number, CutResult& result, unsigned& packed) {
        const ClauseTape& tape = number < 0 ? whole : result.tapes[static_cast<std::size_t>(number)];
        if (tape.clauses.size() <= long_leaf_tape) return tape;
        ClauseTape& out = number < 0 ? packed_ : result.tapes[static_cast<std::size_t>(number)];
        const unsigned bit = 1u << (number + 1);
        if ((packed & bit) == 0) {
            if (number < 0) packed_ = whole;  // it is needed again as it is
            pack_rows(out);
            packed |= bit;
        }
        return out;
    }

    /// A tile that is inside throughout. A ray without a hit comes from the front of the box.
    void fill(const VoxelTile& tile) {
        const int side = space_->side[static_cast<std::size_t>(tile.level)];
        const int layer = std::min(tile.z + side, space_->options->layers) - 1;
        for (int y = tile.y; y < std::min(tile.y + side, space_->options->height); y += leaf_side)
            for (int x = tile.x; x < std::min(tile.x + side, space_->options->width); x += leaf_side) {
                const VoxelTile leaf{x, y, tile.z, 0};
                if (!is_hidden(leaf)) fill_leaf(leaf, layer);
            }
    }

    /// Evaluates leaves of one layer, those of `group`, from front to back.
    void look_into(const Lanes& lanes, unsigned group, const ClauseTape& tape) {
        march_.clear();
        int bottom = 0;
        for (int k = 0; k < lanes.count; ++k) {
            if ((group >> k & 1u) == 0) continue;
            bottom = z_of(lanes, k);
            const VoxelTile& leaf = lanes.tiles[static_cast<std::size_t>(k)];
            if (!is_hidden(leaf)) march_.add(pixels_of(leaf));
        }
        const std::size_t rays = march_.rays();
        if (rays == 0) return;
        // the voxels in front are outside; a refinement starts from their values
        const int front = bottom + leaf_side, last = space_->options->layers - 1;
        DepthPicture& out = *space_->out;
        march_.run(tape, std::min(front, last), bottom, front <= last,
                   {out.layers.data(), out.z.data(), out.normals.data()->data()});
        if (march_.rays() == rays) return;
        for (int k = 0; k < lanes.count; ++k) {
            if ((group >> k & 1u) == 0) continue;
            const VoxelTile& leaf = lanes.tiles[static_cast<std::size_t>(k)];
            const int open = march_.rays() == 0 ? 0 : march_.count_open(pixels_of(leaf));
            if (const int hits = space_->footprints[0].at(leaf) - open; hits > 0)
                space_->count_hits(leaf, hits);
        }
    }

  private:
    void set_box(const VoxelTile& tile, int lane, BoxLanes& boxes) const {
        const Space<Real>& s = *space_;
        const int side = s.side[static_cast<std::size_t>(tile.level)];
        const int right = std::min(tile.x + side, s.options->width) - 1;
        const int below = std::min(tile.y + side, s.options->height) - 1;
        // up to the voxel in front, so that every step from outside to inside lies in a box
        const int front = std::min(tile.z + side, s.options->layers - 1);
        s.sources.set_box({s.x[tile.x], s.y[below], s.z[tile.z]}, {s.x[right], s.y[tile.y], s.z[front]}, lane,
                          boxes);
    }

    void fill_leaf(const VoxelTile& leaf, int layer) {
        int hits = 0;
        for (int y = leaf.y; y < std::min(leaf.y + leaf_side, space_->options->height); ++y)
            for (int x = leaf.x; x < std::min(leaf.x + leaf_side, space_->options->width); ++x) {
                if (space_->out->layers[space_->pixel(x, y)] != 0) continue;
                write(space_->pixel(x, y), layer, static_cast<float>(space_->z[layer]), {0, 0, 1});
                ++hits;
            }
        space_->count_hits(leaf, hits);
    }

    void write(std::size_t pixel, int layer, float z, const std::array<float, 3>& normal) {
        DepthPicture& out = *space_->out;
        out.layers[pixel] = static_cast<std::uint16_t>(layer + 1);
        out.z[pixel] = z;
        out.normals[pixel] = normal;
    }

    march::PixelBlock<Real> pixels_of(const VoxelTile& leaf) const {
        const Space<Real>& s = *space_;
        const std::size_t first = s.pixel(leaf.x, leaf.y);
        return {s.out->layers.data() + first,
                first,
                s.pixel(0, 1),
                s.x.rounded.data() + leaf.x,
                s.y.rounded.data() + leaf.y,
                std::min(leaf_side, s.options->width - leaf.x),
                std::min(leaf_side, s.options->height - leaf.y)};
    }

    Space<Real>* space_ = nullptr;
    Pruner pruner_;
    ColumnMarch<Real> march_;
    std::array<CutResult, most_levels> cuts_;
    std::size_t operations_before_ = 0;
    ClauseTape packed_;
};

}  // namespace

template <class Real>
struct DepthPainter<Real>::Workers {
    Space<Real> space;
    CutResult first_cut;  ///< of a layer of the root's children
    ClauseTape packed;
    WorkerPool<Worker<Real>> pool;

    void set(const AxisMap& map, const DepthPictureOptions& options, DepthPicture& out);
    void paint_all(const ClauseTape& tape, const Job& job);
    void paint_unpruned(const ClauseTape& tape, const Job& job);
    void finish(DepthPicture& out) const;
};

template <class Real>
void DepthPainter<Real>::Workers::set(const AxisMap& map, const DepthPictureOptions& o, DepthPicture& out) {
    out.width = o.width;
    out.height = o.height;
    const std::size_t pixels = static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height);
    out.layers.assign(pixels, 0);
    out.z.resize(pixels);
    out.normals.resize(pixels);
    space.options = &o;
    space.out = &out;
    space.x.set(o.part.min.x, (o.part.max.x - o.part.min.x) / o.width, o.width);
    space.y.set(o.part.max.y, (o.part.min.y - o.part.max.y) / o.height, o.height);
    space.z.set(o.part.min.z, (o.part.max.z - o.part.min.z) / o.layers, o.layers);
    space.sources.set(map, {0, 1, 2}, 0);
    space.side = {leaf_side, leaf_side * last_split};
    space.root = 1;
    for (int& level = space.root;
         space.side[static_cast<std::size_t>(level)] < std::max({o.width, o.height, o.layers}); ++level)
        space.side[static_cast<std::size_t>(level) + 1] = space.side[static_cast<std::size_t>(level)] * split;
    for (std::size_t level = 0; level <= static_cast<std::size_t>(space.root); ++level)
        space.footprints[level].set(space.side[level], o.width, o.height);
    pool.begin([this](Worker<Real>& worker) { worker.begin(space); });
}

template <class Real>
void DepthPainter<Real>::Workers::paint_all(const ClauseTape& tape, const Job& job) {
    const VoxelTile root{0, 0, 0, space.root};
    Worker<Real>& first = pool.take();
    for (int layer = first.children_along(space.root) - 1; layer >= 0; --layer) {
        const auto lanes = first.children(root, layer, 1);
        if (lanes.count == 0) continue;
        first.cut(lanes, tape, first_cut);
        const unsigned open = first_cut.ranges.open();
        parallel_for(job, static_cast<std::size_t>(lanes.count), [&](std::size_t k) {
            Worker<Real>& worker = pool.take();
            if ((open >> k & 1u) != 0) {
                worker.descend(lanes.tiles[k], Worker<Real>::tape_for(tape, first_cut, static_cast<int>(k)));
            } else if ((first_cut.ranges.can_be_inside >> k & 1u) != 0) {
                worker.fill(lanes.tiles[k]);
            }
            pool.give(worker);
        });
        if (job.cancelled()) break;
    }
    pool.give(first);
}

template <class Real>
void DepthPainter<Real>::Workers::paint_unpruned(const ClauseTape& tape, const Job& job) {
    packed = tape;
    pack_rows(packed);
    const auto across = static_cast<std::size_t>(space.footprints[0].across);
    parallel_for(job, space.footprints[0].left.size(), [&](std::size_t i) {
        Worker<Real>& worker = pool.take();
        VoxelTile leaf{static_cast<int>(i % across) * leaf_side, static_cast<int>(i / across) * leaf_side, 0,
                       0};
        for (leaf.z = (space.options->layers - 1) / leaf_side * leaf_side; leaf.z >= 0; leaf.z -= leaf_side)
            worker.descend(leaf, packed);
        pool.give(worker);
    });
}

template <class Real>
void DepthPainter<Real>::Workers::finish(DepthPicture& out) const {
    const Footprints& leaves = space.footprints[0];
    for (std::size_t leaf = 0; leaf < leaves.left.size(); ++leaf) {
        if (leaves.left[leaf] == 0) continue;
        const int x = static_cast<int>(leaf) % leaves.across * leaf_side;
        const int y = static_cast<int>(leaf) / leaves.across * leaf_side;
        const int some = std::min(leaf_side, out.width - x), rows = std::min(leaf_side, out.height - y);
        const bool empty = leaves.left[leaf] == some * rows;
        for (int row = y; row < y + rows; ++row) {
            const std::size_t first = space.pixel(x, row), end = first + static_cast<std::size_t>(some);
            for (std::size_t p = first; p < end; ++p) {
                if (!empty && out.layers[p] != 0) continue;
                out.z[p] = std::numeric_limits<float>::quiet_NaN();
                out.normals[p] = {0, 0, 0};
            }
        }
    }
    out.tile_operations = out.point_operations = 0;
    for (const auto& worker : pool.all()) {
        out.tile_operations += worker->tile_operations();
        out.point_operations += worker->point_operations();
    }
}

template <class Real>
DepthPainter<Real>::DepthPainter() : workers_(std::make_unique<Workers>()) {}
template <class Real>
DepthPainter<Real>::~DepthPainter() = default;
template <class Real>
DepthPainter<Real>::DepthPainter(DepthPainter&&) noexcept = default;
template <class Real>
DepthPainter<Real>& DepthPainter<Real>::operator=(DepthPainter&&) noexcept = default;

template <class Real>
Status DepthPainter<Real>::paint(const ClauseTape& tape, const AxisMap& map,
                                 const DepthPictureOptions& options, const Job& job, DepthPicture& out) {
    const Vec3 size = options.part.max - options.part.min, corner = options.part.min;
    if (!std::isfinite(corner.x + corner.y + corner.z))
        return Error{ErrorKind::invalid_argument, "the part is empty or not finite"};
    const Status status =
        check_tiles(tape, map, {options.width, options.height, options.layers}, {size.x, size.y, size.z});
    if (!status) return status;
    workers_->set(map, options, out);
    if (options.prune) {
        workers_->paint_all(tape, job);
    } else {
        workers_->paint_unpruned(tape, job);
    }
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the picture was cancelled"};
    workers_->finish(out);
    return {};
}

template class DepthPainter<double>;
template class DepthPainter<float>;

}  // namespace frep
