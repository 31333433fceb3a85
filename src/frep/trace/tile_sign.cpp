// Implementation of tile_sign.h. A worker goes depth first; a level of the recursion has its own cut tapes.
#include "frep/trace/tile_sign.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frep/base/parallel.h"
#include "frep/eval/batch_vm.h"
#include "frep/eval/prune.h"
#include "frep/trace/tile_worker.h"

namespace frep {
namespace {

constexpr int leaf_side = 16;   ///< pixels along the side of the smallest tile
constexpr int split = 4;        ///< a tile has split * split children: the lanes of one pass
constexpr int most_levels = 8;  ///< leaf_side * split^(most_levels - 1) is beyond the largest picture
constexpr std::size_t leaf_pixels = leaf_side * leaf_side;

/// A square of pixels; the picture's edge may cut it.
struct PixelTile {
    int x = 0, y = 0, side = 0;
};

/// The part of a tile that lies in the picture.
struct PixelBlock {
    int x = 0, y = 0, width = 0, height = 0;
};

/// What all workers read.
template <class Real>
struct Scene {
    const SignPictureOptions* options = nullptr;
    SignPixel* pixels = nullptr;
    int width = 0, height = 0;
    PartMiddles<Real> x, y;
    CoordinateSources sources;  ///< axis 0 = to the right, 1 = up

    bool block_of(const PixelTile& tile, PixelBlock& out) const {
        out = {tile.x, tile.y, std::min(tile.side, width - tile.x), std::min(tile.side, height - tile.y)};
        return out.width > 0 && out.height > 0;
    }
};

/// One thread's part of the work.
template <class Real>
class Worker {
  public:
    void begin(const Scene<Real>& scene) {
        scene_ = &scene;
        point_operations_ = 0;
        operations_before_ = pruner_.tile_operations();
        points_.prepare(scene.sources, most_points);
    }
    /// Operations since begin().
    std::size_t tile_operations() const { return pruner_.tile_operations() - operations_before_; }
    std::size_t point_operations() const { return point_operations_; }

    /// Cuts the tape for the children of `tile`; fills what is decided, and evaluates what is open if the
    /// children are leaves. Open children else: their lanes in `open`.
    struct Children {
        std::array<PixelTile, tile_lanes> tiles;
        int count = 0;
        unsigned open = 0;
    };
    void cut(const PixelTile& tile, const ClauseTape& tape, CutResult& cut, Children& children) {
        BoxLanes boxes;
        const int side = tile.side / split;
        children.count = 0;
        for (int k = 0; k < split * split; ++k) {
            const PixelTile child{tile.x + k % split * side, tile.y + k / split * side, side};
            PixelBlock block;
            if (!scene_->block_of(child, block)) continue;
            set_box(block, children.count, boxes);
            children.tiles[static_cast<std::size_t>(children.count++)] = child;
        }
        boxes.count = children.count;
        pruner_.cut(tape, boxes, Purpose::occupancy, cut);
        const RangeLanes& ranges = cut.ranges;
        children.open = ranges.open();
        if (scene_->options->tell_undefined) children.open |= ranges.can_be_undefined;
        for (int k = 0; k < children.count; ++k)
            if ((children.open >> k & 1u) == 0)
                fill(children.tiles[static_cast<std::size_t>(k)], (ranges.can_be_inside >> k & 1u) != 0);
        if (side == leaf_side) evaluate_children(tape, cut, children);
    }

    void descend(const PixelTile& tile, const ClauseTape& tape, std::size_t level) {
        CutResult& result = cuts_[level];
        Children children;
        cut(tile, tape, result, children);
        if (tile.side / split == leaf_side) return;
        for (int k = 0; k < children.count; ++k)
            if ((children.open >> k & 1u) != 0)
                descend(children.tiles[static_cast<std::size_t>(k)], tape_for(tape, result, k), level + 1);
    }

    /// The tape to go on with in child k.
    static const ClauseTape& tape_for(const ClauseTape& parent, const CutResult& cut, int k) {
        const std::int8_t number = cut.tape_of[static_cast<std::size_t>(k)];
        return number < 0 ? parent : cut.tapes[static_cast<std::size_t>(number)];
    }

    /// All pixels of a tile.
    void evaluate_tile(const PixelTile& tile, const ClauseTape& tape) {
        for (int y = 0; y < tile.side; y += leaf_side)
            for (int x = 0; x < tile.side; x += leaf_side)
                add_leaf({tile.x + x, tile.y + y, leaf_side}, tape);
        evaluate(tape);
    }

  private:
    static constexpr std::size_t most_points = leaf_pixels * tile_lanes;

    void set_box(const PixelBlock& block, int lane, BoxLanes& boxes) const {
        // rows run from top to bottom, y from bottom to top
        const int right = block.x + block.width - 1, bottom = block.y + block.height - 1;
        scene_->sources.set_box({scene_->x[block.x], scene_->y[bottom], 0},
                                {scene_->x[right], scene_->y[block.y], 0}, lane, boxes);
    }

    SignPixel* row(int x, int y) const {
        return scene_->pixels + static_cast<std::size_t>(y) * static_cast<std::size_t>(scene_->width) +
               static_cast<std::size_t>(x);
    }

    void fill(const PixelTile& tile, bool inside) const {
        PixelBlock block;
        scene_->block_of(tile, block);
        const SignPixel pixel = inside ? SignPixel::inside : SignPixel::outside;
        for (int y = 0; y < block.height; ++y)
            std::fill_n(row(block.x, block.y + y), static_cast<std::size_t>(block.width), pixel);
    }

    void evaluate_children(const ClauseTape& parent, CutResult& cut, const Children& children) {
        for (int number = -1; number < cut.tape_count; ++number) {
            const ClauseTape* tape = number < 0 ? &parent : &cut.tapes[static_cast<std::size_t>(number)];
            for (int k = 0; k < children.count; ++k) {
                const auto lane = static_cast<std::size_t>(k);
                const int of = cut.tape_of[lane] < 0 ? -1 : cut.tape_of[lane];
                if ((children.open >> k & 1u) != 0 && of == number) add_leaf(children.tiles[lane], *tape);
            }
            if (blocks_ == 0) continue;
            if (tape->clauses.size() > long_leaf_tape) {
                // the parent's tape is needed again as it is
                if (number < 0) packed_ = parent;
                ClauseTape& packed = number < 0 ? packed_ : cut.tapes[static_cast<std::size_t>(number)];
                pack_rows(packed);
                tape = &packed;
            }
            evaluate(*tape);
        }
    }

    /// Adds the pixels of a leaf to the batch.
    void add_leaf(const PixelTile& tile, const ClauseTape& tape) {
        PixelBlock block;
        if (!scene_->block_of(tile, block)) return;
        if (blocks_ == waiting_.size()) evaluate(tape);
        waiting_[blocks_++] = block;
        for (int y = 0; y < block.height; ++y) {
            std::copy_n(scene_->x.rounded.data() + block.x, block.width, points_.axis[0].data() + count_);
            std::fill_n(points_.axis[1].data() + count_, block.width,
                        scene_->y.rounded[static_cast<std::size_t>(block.y + y)]);
            count_ += static_cast<std::size_t>(block.width);
        }
    }

    void evaluate(const ClauseTape& tape) {
        if (blocks_ == 0) return;
        vm_.values(tape, points_.coordinates(), count_, values_.data());
        point_operations_ += count_ * tape.clauses.size();
        const Real* value = values_.data();
        for (std::size_t i = 0; i < blocks_; ++i) {
            const PixelBlock& block = waiting_[i];
            for (int y = 0; y < block.height; ++y, value += block.width)
                store(value, static_cast<std::size_t>(block.width), row(block.x, block.y + y));
        }
        blocks_ = count_ = 0;
    }

    void store(const Real* values, std::size_t count, SignPixel* to) const {
        for (std::size_t i = 0; i < count; ++i)
            to[i] = static_cast<SignPixel>(static_cast<std::uint8_t>(values[i] >= 0));
        if (!scene_->options->tell_undefined) return;
        for (std::size_t i = 0; i < count; ++i)
            if (values[i] != values[i]) to[i] = SignPixel::undefined;
    }

    const Scene<Real>* scene_ = nullptr;
    Pruner pruner_;
    BatchVm<Real> vm_;
    std::array<CutResult, most_levels> cuts_;
    std::size_t operations_before_ = 0;
    std::size_t point_operations_ = 0;
    ClauseTape packed_;
    std::array<PixelBlock, tile_lanes> waiting_;  ///< leaves of the batch
    std::size_t blocks_ = 0, count_ = 0;
    PointBatch<Real> points_;
    std::vector<Real> values_ = std::vector<Real>(most_points);
};

Status check(const ClauseTape& tape, const AxisMap& map, const SignPictureOptions& o) {
    if (!std::isfinite(o.part.min.x + o.part.min.y + o.plane.at))
        return Error{ErrorKind::invalid_argument, "the part is empty or not finite"};
    return check_tiles(tape, map, {o.width, o.height}, {o.part.width(), o.part.height()});
}

template <class Real>
void set_scene(const AxisMap& map, const SignPictureOptions& o, SignPicture& out, Scene<Real>& scene) {
    out.width = o.width;
    out.height = o.height;
    out.pixels.resize(static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height));
    scene.options = &o;
    scene.pixels = out.pixels.data();
    scene.width = o.width;
    scene.height = o.height;
    scene.x.set(o.part.min.x, o.part.width() / o.width, o.width);
    scene.y.set(o.part.max.y, -o.part.height() / o.height, o.height);
    std::array<int, 3> axes{};
    axes.fill(CoordinateSources::fixed);
    axes[static_cast<std::size_t>(o.plane.right)] = 0;
    axes[static_cast<std::size_t>(o.plane.up)] = 1;
    scene.sources.set(map, axes, o.plane.at);
}

}  // namespace

template <class Real>
struct SignPainter<Real>::Workers {
    Scene<Real> scene;
    CutResult first_cut;  ///< of the whole picture
    typename Worker<Real>::Children first_children;
    ClauseTape packed;
    WorkerPool<Worker<Real>> pool;
};

template <class Real>
SignPainter<Real>::SignPainter() : workers_(std::make_unique<Workers>()) {}
template <class Real>
SignPainter<Real>::~SignPainter() = default;
template <class Real>
SignPainter<Real>::SignPainter(SignPainter&&) noexcept = default;
template <class Real>
SignPainter<Real>& SignPainter<Real>::operator=(SignPainter&&) noexcept = default;

template <class Real>
Status SignPainter<Real>::paint(const ClauseTape& tape, const AxisMap& map, const SignPictureOptions& options,
                                const Job& job, SignPicture& out) {
    if (const Status status = check(tape, map, options); !status) return status;
    Workers& w = *workers_;
    set_scene(map, options, out, w.scene);
    w.pool.begin([&w](Worker<Real>& worker) { worker.begin(w.scene); });
    PixelTile root{0, 0, leaf_side * split};
    while (root.side < std::max(options.width, options.height)) root.side *= split;
    const int side = root.side / split;
    Worker<Real>& first = w.pool.take();
    if (options.prune) {
        first.cut(root, tape, w.first_cut, w.first_children);
    } else {
        w.packed = tape;
        pack_rows(w.packed);
        w.first_children.open = (1u << split * split) - 1;
    }
    w.pool.give(first);
    const bool done = options.prune && side == leaf_side;
    parallel_for(job, done ? 0 : split * split, [&](std::size_t i) {
        if ((w.first_children.open >> i & 1u) == 0) return;
        Worker<Real>& worker = w.pool.take();
        if (options.prune) {
            const auto& tile_tape = Worker<Real>::tape_for(tape, w.first_cut, static_cast<int>(i));
            worker.descend(w.first_children.tiles[i], tile_tape, 0);
        } else {
            const int k = static_cast<int>(i);
            worker.evaluate_tile({k % split * side, k / split * side, side}, w.packed);
        }
        w.pool.give(worker);
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "cancelled"};
    out.tile_operations = out.point_operations = 0;
    for (const auto& worker : w.pool.all()) {
        out.tile_operations += worker->tile_operations();
        out.point_operations += worker->point_operations();
    }
    return {};
}

template class SignPainter<double>;
template class SignPainter<float>;

}  // namespace frep
