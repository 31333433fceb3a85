// From points of space to the coordinates of a model and back for derivatives, as an AxisMap says. Used by
// the fields of sampled_field.cpp and narrowed_field.cpp; tested by tests/unit/eval/sampled_field_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/math/interval.h"

namespace frep {

/// Serves one thread; what it hands out holds until its next call.
class AxisColumns {
  public:
    explicit AxisColumns(AxisMap map) : map_(std::move(map)) {}

    const AxisMap& map() const { return map_; }
    std::size_t count() const { return map_.coordinates.size(); }
    /// A column for each coordinate of the model.
    std::span<const double* const> coordinates(const PointSpans& points);
    /// Columns to receive the partial derivatives by the coordinates of the model at `points` points.
    std::span<double* const> partials(std::size_t points);
    /// What they say by x, y, z: sums over the coordinates that an axis feeds.
    void sum_partials(const GradientSpans& out) const;
    /// Coordinate i over a box.
    math::Interval side(const Box3& box, std::size_t i) const;

  private:
    AxisMap map_;
    std::vector<double> frozen_, partials_;
    std::vector<const double*> columns_;
    std::vector<double*> partial_columns_;
};

}  // namespace frep
