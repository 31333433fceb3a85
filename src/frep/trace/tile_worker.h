// What the two tile pictures (tile_sign.h, tile_depth.h) share: where the model's coordinates come from, and
// a pool of workers. Tested with them.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "frep/base/result.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/prune.h"
#include "frep/eval/sampled_field.h"

namespace frep {

/// Cut tapes of leaves with more clauses get packed rows.
inline constexpr std::size_t long_leaf_tape = 24;

/// The largest side of a picture.
inline constexpr int most_side_pixels = 16384;

/// Middles of `count` equal parts that begin at `from`, exact and rounded.
template <class Real>
struct PartMiddles {
    std::vector<double> exact;
    std::vector<Real> rounded;

    void set(double from, double step, int count) {
        exact.resize(static_cast<std::size_t>(count));
        rounded.resize(exact.size());
        for (std::size_t i = 0; i < exact.size(); ++i) {
            exact[i] = from + (static_cast<double>(i) + 0.5) * step;
            rounded[i] = static_cast<Real>(exact[i]);
        }
    }
    double operator[](int i) const { return exact[static_cast<std::size_t>(i)]; }
};

/// By coordinate of the model: the axis of the picture that it takes, or a number.
struct CoordinateSources {
    static constexpr int fixed = -1;
    std::array<int, max_coordinates> axis{};
    std::array<double, max_coordinates> value{};
    std::size_t count = 0;

    /// Coordinates by `map`, where axis i of space is axis picture_axis[i] of the picture, or fixed at `at`.
    void set(const AxisMap& map, const std::array<int, 3>& picture_axis, double at) {
        count = map.coordinates.size();
        for (std::size_t i = 0; i < count; ++i) {
            const MappedCoordinate& c = map.coordinates[i];
            axis[i] = c.axis < 0 ? fixed : picture_axis[static_cast<std::size_t>(c.axis)];
            value[i] = c.axis < 0 ? c.value : at;
        }
    }
    /// Sets lane k of `boxes` to the box from lo to hi of the picture's axes.
    void set_box(const std::array<double, 3>& lo, const std::array<double, 3>& hi, int lane,
                 BoxLanes& boxes) const {
        const auto k = static_cast<std::size_t>(lane);
        for (std::size_t i = 0; i < count; ++i) {
            const auto a = static_cast<std::size_t>(axis[i]);
            boxes.lo[i][k] = axis[i] == fixed ? value[i] : lo[a];
            boxes.hi[i][k] = axis[i] == fixed ? value[i] : hi[a];
        }
    }
};

/// Points to evaluate: by axis of the picture an array, and what the model's coordinates read.
template <class Real>
class PointBatch {
  public:
    std::array<std::vector<Real>, 3> axis;

    void prepare(const CoordinateSources& sources, std::size_t most_points) {
        count_ = sources.count;
        for (auto& column : axis) column.resize(most_points);
        for (std::size_t i = 0; i < count_; ++i) {
            if (sources.axis[i] == CoordinateSources::fixed)
                fixed_[i].assign(most_points, static_cast<Real>(sources.value[i]));
            columns_[i] = sources.axis[i] == CoordinateSources::fixed
                              ? fixed_[i].data()
                              : axis[static_cast<std::size_t>(sources.axis[i])].data();
        }
    }
    std::span<const Real* const> coordinates() const { return {columns_.data(), count_}; }

  private:
    std::size_t count_ = 0;
    std::array<std::vector<Real>, max_coordinates> fixed_;
    std::array<const Real*, max_coordinates> columns_{};
};

/// Errors that both pictures know: sides, the size of the part (finite and above 0), the map.
inline Status check_tiles(const ClauseTape& tape, const AxisMap& map, std::initializer_list<int> sides,
                          std::initializer_list<double> lengths) {
    const auto bad = [](const char* message) { return Error{ErrorKind::invalid_argument, message}; };
    for (const int side : sides)
        if (side < 1 || side > most_side_pixels) return bad("a side of the picture is not 1 to 16384");
    for (const double length : lengths)
        if (!(length > 0 && std::isfinite(length))) return bad("the part is empty or not finite");
    if (map.coordinates.size() != static_cast<std::size_t>(tape.data->coordinates))
        return bad("the map has not one entry for each coordinate");
    return {};
}

/// Workers, each used by one thread at a time. Which thread gets which worker changes no result.
template <class Worker>
class WorkerPool {
  public:
    /// Calls begin(worker) for all workers, now or when one is made.
    template <class Begin>
    void begin(Begin prepare) {
        prepare_ = prepare;
        free_.clear();
        for (const auto& worker : all_) {
            prepare_(*worker);
            free_.push_back(worker.get());
        }
    }
    Worker& take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) {
            all_.push_back(std::make_unique<Worker>());
            prepare_(*all_.back());
            return *all_.back();
        }
        Worker& worker = *free_.back();
        free_.pop_back();
        return worker;
    }
    void give(Worker& worker) {
        const std::lock_guard lock(mutex_);
        free_.push_back(&worker);
    }
    const std::vector<std::unique_ptr<Worker>>& all() const { return all_; }

  private:
    std::vector<std::unique_ptr<Worker>> all_;
    std::vector<Worker*> free_;
    std::function<void(Worker&)> prepare_;
    std::mutex mutex_;
};

}  // namespace frep
