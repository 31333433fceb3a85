// A lattice of cells around a solid: for every cell whether it may hold some of the solid (rays skip the
// others), for every corner the approximate distance to the surface (light is traced through that). Made in
// three steps: interval evaluation of blocks of cells, then of their parts (after Duff 1992, "Interval
// arithmetic and recursive subdivision for implicit functions"); near the surface the first-order distance
// F/|grad F|; elsewhere the exact Euclidean distance transform of those corners (distance_transform.h).
//
// Where intervals say nothing (more than half of a coarse lattice stays undecided, as with loops that depend
// on the point), the signs of samples at the corners stand in for them, and a detail thinner than a cell can
// be missed. Tested by tests/unit/trace/distance_grid_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/field_pool.h"
#include "frep/math/vec.h"

namespace frep::tracing {

enum class CellState : std::uint8_t {
    outside,  ///< surely nothing of the solid
    mixed,    ///< not known
    inside,   ///< surely solid everywhere
};

class DistanceGrid {
  public:
    /// The part of the solid that lies in the box `clip`, with `cells` cells along its longest side. Errors:
    /// cancelled.
    static Result<DistanceGrid> make(FieldPool& fields, const Box3& clip, int cells, const Job& job);

    /// False when there is surely nothing in the box; the grid then has no cells.
    bool has_solid() const { return !states_.empty(); }
    /// True when the states come from samples, not from intervals.
    bool sampled() const { return sampled_; }

    const Box3& clip() const { return clip_; }
    /// The lattice: its lowest corner, the side of a cell, the cells along the axes.
    Vec3 origin() const { return origin_; }
    double step() const { return step_; }
    const std::array<int, 3>& cells() const { return cells_; }
    CellState state(int i, int j, int k) const {
        return states_[(static_cast<std::size_t>(k) * size(1) + static_cast<std::size_t>(j)) * size(0) +
                       static_cast<std::size_t>(i)];
    }

    /// The distance to the surface, positive outside, negative inside (there cut off at -2 cells);
    /// trilinear in the lattice, a lower bound beyond it.
    double distance(Vec3 p) const;
    /// The direction in which the distance grows fastest, of unit length; zero where there is none.
    Vec3 direction(Vec3 p) const;

    /// Corners within a cell of the surface: what a camera must see.
    const std::vector<Vec3>& surface_points() const { return surface_points_; }
    /// The least z of the surface, about.
    double lowest() const { return lowest_; }

  private:
    std::size_t size(std::size_t axis) const { return static_cast<std::size_t>(cells_[axis]); }
    std::size_t corners(std::size_t axis) const { return size(axis) + 1; }
    Vec3 corner(int i, int j, int k) const {
        return {origin_.x + i * step_, origin_.y + j * step_, origin_.z + k * step_};
    }
    CellState& state_at(int i, int j, int k);
    Box3 cell_box(std::array<int, 3> lo, int side) const;
    Box3 clipped_box(std::array<int, 3> lo, int side) const;
    void set_states(std::array<int, 3> lo, int side, CellState state);

    void place(const Box3& hull, int cells);
    void classify(FieldPool& fields, const Job& job);
    void classify_by_samples(FieldPool& fields, const Job& job);
    void measure(FieldPool& fields, const Job& job);
    void sample_layer(SampledField& field, int k, std::vector<std::uint8_t>& band,
                      std::vector<float>& values);
    void measure_slopes(int k, const std::vector<std::uint8_t>& band, const std::vector<float>& values);
    void refine_at_crossings(std::vector<std::uint8_t>& band);
    void spread(const std::vector<std::uint8_t>& band, const Job& job);
    void collect_surface(const std::vector<std::uint8_t>& band);

    Box3 clip_;
    Vec3 origin_;
    double step_ = 0, per_unit_ = 0;  ///< side of a cell, cells in a model unit
    std::array<float, 3> far_{};      ///< greatest place of a look-up, in cells
    std::array<int, 3> cells_{};
    bool sampled_ = false;
    std::vector<CellState> states_;
    std::vector<float> distance_;  ///< in cells, by corner, x fastest
    std::vector<Vec3> surface_points_;
    double lowest_ = 0;
};

}  // namespace frep::tracing
