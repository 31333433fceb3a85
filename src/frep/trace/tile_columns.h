// ColumnMarch: parallel rays through a block of voxels, evaluated together from front to back, several layers
// a batch; rays that have met the surface leave, and where they met it depth and normal are found. Its loops
// are compiled for each instruction set (march_kernels.h). The inner part of tile_depth.h, which tests it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/eval/batch_vm.h"
#include "frep/trace/march_kernels.h"
#include "frep/trace/tile_worker.h"

namespace frep {

/// Real is double or float.
template <class Real>
class ColumnMarch {
  public:
    /// Points of a batch that is evaluated before it is known which rays are done.
    static constexpr std::size_t batch_points = 1024;

    /// For at most `most_rays` rays, in a picture whose layers have the middles `z`.
    void begin(const CoordinateSources& sources, const PartMiddles<Real>& z, std::size_t most_rays) {
        sources_ = &sources;
        z_ = &z;
        most_rays_ = most_rays;
        const std::size_t room = most_rays + march::slack;
        points_.prepare(sources, room + batch_points);
        surface_.prepare(sources, room);
        values_.resize(room + batch_points);
        for (auto& column : columns_) column.resize(room);
        for (auto& column : pixels_) column.resize(room);
        partials_.resize(room * sources.count);
        rays_ = {columns_[0].data(), columns_[1].data(), columns_[2].data(), pixels_[0].data(), 0};
        hits_ = {
            surface_.axis[0].data(), surface_.axis[1].data(), surface_.axis[2].data(), columns_[3].data(),
            columns_[4].data(),      columns_[5].data(),      pixels_[1].data(),       0};
        point_operations_ = 0;
    }

    /// No rays, no hits.
    void clear() { rays_.count = hits_.count = 0; }
    /// The rays of a block that have met nothing yet.
    void add(const march::PixelBlock<Real>& block) { loops_->add(block, rays_); }
    int count_open(const march::PixelBlock<Real>& block) const { return loops_->count_open(block); }
    std::size_t rays() const { return rays_.count; }

    /// Follows the rays from layer `front` to layer `back` and paints where they meet the surface. With
    /// `is_before`, layer `front` holds no hit: only the values that lie before the first one.
    void run(const ClauseTape& tape, int front, int back, bool is_before, const march::Canvas& canvas) {
        const Real* const middles = z_->rounded.data();
        const int last = static_cast<int>(z_->rounded.size()) - 1;
        for (int z = front; z >= back && rays_.count > 0;) {
            const int fitting = static_cast<int>(std::max<std::size_t>(1, batch_points / rays_.count));
            const int count = std::min(fitting, z - back + 1);
            evaluate(tape, z, count);
            loops_->advance(
                {values_.data(), middles, z, last, count, is_before && z == front ? 1 : 0, z == front}, rays_,
                hits_);
            z -= count;
        }
        if (hits_.count > 0) loops_->paint(hits_, gradients(tape), last, canvas);
    }

    /// Clauses run on points since begin().
    std::size_t point_operations() const { return point_operations_; }

  private:
    /// F in layers z, z - 1, ... of all rays.
    void evaluate(const ClauseTape& tape, int z, int count) {
        const std::size_t points = rays_.count * static_cast<std::size_t>(count);
        loops_->points(rays_, z_->rounded.data(), z, count, points_.axis[0].data(), points_.axis[1].data(),
                       points_.axis[2].data());
        vm_.values(tape, points_.coordinates(), points, values_.data());
        point_operations_ += points * tape.clauses.size();
    }

    /// F and its gradient at the hits: a cut tape keeps it on the surface, which they are near.
    march::Gradients<Real> gradients(const ClauseTape& tape) {
        const std::size_t count = hits_.count;
        std::array<Real*, max_coordinates> partials{};
        for (std::size_t k = 0; k < sources_->count; ++k)
            partials[k] = partials_.data() + k * (most_rays_ + march::slack);
        vm_.gradients(tape, surface_.coordinates(), count, values_.data(),
                      std::span(partials.data(), sources_->count));
        point_operations_ += count * tape.clauses.size();
        // an axis moves all coordinates that take it (the columns of the points are free again)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real* const sum = points_.axis[axis].data();
            bool is_empty = true;
            for (std::size_t k = 0; k < sources_->count; ++k) {
                if (sources_->axis[k] != static_cast<int>(axis)) continue;
                for (std::size_t i = 0; i < count; ++i)
                    sum[i] = (is_empty ? Real(0) : sum[i]) + partials[k][i];
                is_empty = false;
            }
            if (is_empty) std::fill_n(sum, count, Real(0));
        }
        return {values_.data(), points_.axis[0].data(), points_.axis[1].data(), points_.axis[2].data()};
    }

    const march::Kernels<Real>* loops_ = &march::kernels<Real>();
    const CoordinateSources* sources_ = nullptr;
    const PartMiddles<Real>* z_ = nullptr;
    std::size_t most_rays_ = 0, point_operations_ = 0;
    BatchVm<Real> vm_;
    PointBatch<Real> points_;   ///< on the way
    PointBatch<Real> surface_;  ///< where hits_ stands
    std::vector<Real> values_, partials_;
    march::Rays<Real> rays_{};
    march::Hits<Real> hits_{};
    std::array<std::vector<Real>, 6> columns_;  ///< of the rays and the hits
    std::array<std::vector<march::Index<Real>>, 2> pixels_;
};

}  // namespace frep
