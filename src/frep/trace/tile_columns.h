// ColumnMarch: parallel rays through a block of voxels, evaluated together from front to back, several layers
// a batch; rays that have met the surface leave, and where they met it depth and normal are found. The inner
// part of tile_depth.h, which tests it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "frep/eval/batch_vm.h"
#include "frep/trace/tile_worker.h"

namespace frep {

/// Where a ray has met the surface.
struct ColumnHit {
    std::uint32_t pixel = 0;
    std::int32_t layer = 0;  ///< of the first voxel inside
};

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
        points_.prepare(sources, most_rays + batch_points);
        values_.resize(most_rays + batch_points);
        for (auto* column : {&x_, &y_, &before_, &hit_x_, &hit_y_, &hit_before_, &hit_value_})
            column->resize(most_rays);
        for (auto& column : gradient_) column.resize(most_rays);
        partials_.resize(most_rays * sources.count);
        heights_.resize(most_rays);
        reached_.resize(most_rays);
        pixel_.resize(most_rays);
        lane_.resize(most_rays);
        hits_.resize(most_rays);
        point_operations_ = 0;
    }

    /// No rays, no hits.
    void clear() {
        rays_ = hit_count_ = 0;
        lane_hits_.fill(0);
    }
    /// A ray of pixel `pixel`; `lane` tells whose hits are counted together.
    void add(Real x, Real y, std::size_t pixel, int lane) {
        x_[rays_] = x;
        y_[rays_] = y;
        before_[rays_] = std::numeric_limits<Real>::quiet_NaN();
        pixel_[rays_] = static_cast<std::uint32_t>(pixel);
        lane_[rays_] = static_cast<std::uint8_t>(lane);
        ++rays_;
    }
    std::size_t rays() const { return rays_; }

    /// Follows the rays from layer `front` to layer `back`. With `is_before`, layer `front` holds no hit:
    /// only the values that lie before the first one.
    void run(const ClauseTape& tape, int front, int back, bool is_before) {
        for (int z = front; z >= back && rays_ > 0;) {
            const int fitting = static_cast<int>(std::max<std::size_t>(1, batch_points / rays_));
            const int count = std::min(fitting, z - back + 1);
            evaluate(tape, z, count);
            find_hits(count, is_before && z == front ? 1 : 0);
            take_hits(z, count);
            z -= count;
        }
        if (hit_count_ > 0) refine(tape);
    }

    std::size_t hit_count() const { return hit_count_; }
    const ColumnHit& hit(std::size_t i) const { return hits_[i]; }
    int hits_of(int lane) const { return lane_hits_[static_cast<std::size_t>(lane)]; }
    /// Where hit i is, and the unit normal there; (0, 0, 1) where the box cuts the solid or F has no
    /// gradient.
    float height(std::size_t i) const { return static_cast<float>(heights_[i]); }
    std::array<float, 3> normal(std::size_t i) const {
        return {static_cast<float>(gradient_[0][i]), static_cast<float>(gradient_[1][i]),
                static_cast<float>(gradient_[2][i])};
    }
    /// Clauses run on points since begin().
    std::size_t point_operations() const { return point_operations_; }

  private:
    using Count = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

    /// F in layers z, z - 1, ... of all rays.
    void evaluate(const ClauseTape& tape, int z, int count) {
        for (int i = 0; i < count; ++i) {
            const std::size_t at = static_cast<std::size_t>(i) * rays_;
            std::copy_n(x_.data(), rays_, points_.axis[0].data() + at);
            std::copy_n(y_.data(), rays_, points_.axis[1].data() + at);
            std::fill_n(points_.axis[2].data() + at, rays_, z_->rounded[static_cast<std::size_t>(z - i)]);
        }
        const std::size_t points = rays_ * static_cast<std::size_t>(count);
        vm_.values(tape, points_.coordinates(), points, values_.data());
        point_operations_ += points * tape.clauses.size();
    }

    /// By ray the first of the layers that is inside, or `count`.
    void find_hits(int count, int first) {
        Count* const reached = reached_.data();
        std::fill_n(reached, rays_, static_cast<Count>(count));
        for (int i = count; i-- > first;) {
            const Real* const values = values_.data() + static_cast<std::size_t>(i) * rays_;
            const auto number = static_cast<Count>(i);
            for (std::size_t c = 0; c < rays_; ++c) reached[c] = values[c] >= 0 ? number : reached[c];
        }
    }

    /// Moves the rays that are done to the hits; the others move up.
    void take_hits(int z, int count) {
        const std::size_t rays = rays_;
        const Real* const last = values_.data() + static_cast<std::size_t>(count - 1) * rays;
        rays_ = 0;
        for (std::size_t c = 0; c < rays; ++c) {
            const auto layer = static_cast<std::size_t>(reached_[c]);
            if (layer == static_cast<std::size_t>(count)) {
                x_[rays_] = x_[c];
                y_[rays_] = y_[c];
                before_[rays_] = last[c];
                pixel_[rays_] = pixel_[c];
                lane_[rays_++] = lane_[c];
                continue;
            }
            const Real* const value = values_.data() + layer * rays + c;
            hit_x_[hit_count_] = x_[c];
            hit_y_[hit_count_] = y_[c];
            hit_value_[hit_count_] = *value;
            hit_before_[hit_count_] = layer > 0 ? *(value - rays) : before_[c];
            hits_[hit_count_++] = {pixel_[c], z - static_cast<std::int32_t>(layer)};
            ++lane_hits_[lane_[c]];
        }
    }

    /// Depth and normals: the gradient where the chord between the two voxels meets 0, and from there one
    /// more step towards the root, between the two.
    void refine(const ClauseTape& tape) {
        const std::size_t count = hit_count_;
        const Real* const middles = z_->rounded.data();
        for (std::size_t i = 0; i < count; ++i) {
            const auto layer = static_cast<std::size_t>(hits_[i].layer);
            const Real share = hit_value_[i] / (hit_value_[i] - hit_before_[i]);
            const bool chord = share >= 0 && share <= 1;
            const Real z = middles[layer];
            points_.axis[2][i] = chord ? z + share * (middles[layer + 1] - z) : z;
        }
        std::copy_n(hit_x_.data(), count, points_.axis[0].data());
        std::copy_n(hit_y_.data(), count, points_.axis[1].data());
        std::array<Real*, max_coordinates> partials{};
        for (std::size_t k = 0; k < sources_->count; ++k) partials[k] = partials_.data() + k * most_rays_;
        vm_.gradients(tape, points_.coordinates(), count, values_.data(),
                      std::span(partials.data(), sources_->count));
        point_operations_ += count * tape.clauses.size();
        for (auto& column : gradient_) std::fill_n(column.data(), count, Real(0));
        for (std::size_t k = 0; k < sources_->count; ++k) {
            if (sources_->axis[k] < 0) continue;
            Real* const sum = gradient_[static_cast<std::size_t>(sources_->axis[k])].data();
            for (std::size_t i = 0; i < count; ++i) sum[i] += partials[k][i];
        }
        find_heights(count);
        find_normals(count);
    }

    void find_heights(std::size_t count) {
        const Real* const middles = z_->rounded.data();
        const std::size_t front = z_->rounded.size() - 1;
        for (std::size_t i = 0; i < count; ++i) {
            const auto layer = static_cast<std::size_t>(hits_[i].layer);
            const Real low = middles[layer], high = middles[std::min(layer + 1, front)];
            const Real z = points_.axis[2][i], better = z - values_[i] / gradient_[2][i];
            heights_[i] = better >= low && better <= high ? better : z;
        }
    }

    /// Gradients become unit vectors that point out of the solid.
    void find_normals(std::size_t count) {
        Real *const x = gradient_[0].data(), *const y = gradient_[1].data(), *const z = gradient_[2].data();
        for (std::size_t i = 0; i < count; ++i) {
            const Real size = std::max(std::max(std::fabs(x[i]), std::fabs(y[i])), std::fabs(z[i]));
            const Real a = x[i] / size, b = y[i] / size, c = z[i] / size;
            const Real length = -std::sqrt(a * a + b * b + c * c);
            const bool good = size > 0 && size <= std::numeric_limits<Real>::max();
            x[i] = good ? a / length : Real(0);
            y[i] = good ? b / length : Real(0);
            z[i] = good ? c / length : Real(1);
        }
        const auto front = static_cast<std::int32_t>(z_->rounded.size()) - 1;
        for (std::size_t i = 0; i < count; ++i)
            if (hits_[i].layer == front) x[i] = y[i] = Real(0), z[i] = Real(1);
    }

    const CoordinateSources* sources_ = nullptr;
    const PartMiddles<Real>* z_ = nullptr;
    std::size_t most_rays_ = 0, rays_ = 0, hit_count_ = 0, point_operations_ = 0;
    BatchVm<Real> vm_;
    PointBatch<Real> points_;
    std::vector<Real> values_;
    // rays
    std::vector<Real> x_, y_, before_;  ///< before_: F at the voxel in front of the next one
    std::vector<Count> reached_;
    std::vector<std::uint32_t> pixel_;
    std::vector<std::uint8_t> lane_;
    // hits
    std::vector<ColumnHit> hits_;
    std::vector<Real> hit_x_, hit_y_, hit_before_, hit_value_, heights_, partials_;
    std::array<std::vector<Real>, 3> gradient_;  ///< then the normals
    std::array<int, tile_lanes> lane_hits_{};
};

}  // namespace frep
