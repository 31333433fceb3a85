// Implementation of axis_columns.h.
#include "frep/eval/axis_columns.h"

#include <algorithm>
#include <array>

namespace frep {

std::span<const double* const> AxisColumns::coordinates(const PointSpans& points) {
    const std::size_t size = points.size();
    const std::array<const double*, 3> axes{points.x.data(), points.y.data(), points.z.data()};
    frozen_.resize(count() * size);
    columns_.clear();
    for (std::size_t i = 0; i < count(); ++i) {
        const MappedCoordinate& source = map_.coordinates[i];
        if (source.axis >= 0) {
            columns_.push_back(axes[static_cast<std::size_t>(source.axis)]);
            continue;
        }
        double* column = frozen_.data() + i * size;
        std::fill_n(column, size, source.value);
        columns_.push_back(column);
    }
    return columns_;
}

std::span<double* const> AxisColumns::partials(std::size_t points) {
    partials_.resize(count() * points);
    partial_columns_.clear();
    for (std::size_t i = 0; i < count(); ++i) partial_columns_.push_back(partials_.data() + i * points);
    return partial_columns_;
}

void AxisColumns::sum_partials(const GradientSpans& out) const {
    const std::array<std::span<double>, 3> axes{out.x, out.y, out.z};
    for (const std::span<double>& axis : axes) std::fill(axis.begin(), axis.end(), 0.0);
    for (std::size_t i = 0; i < count(); ++i) {
        if (map_.coordinates[i].axis < 0) continue;
        const std::span<double>& axis = axes[static_cast<std::size_t>(map_.coordinates[i].axis)];
        for (std::size_t p = 0; p < axis.size(); ++p) axis[p] += partial_columns_[i][p];
    }
}

math::Interval AxisColumns::side(const Box3& box, std::size_t i) const {
    const MappedCoordinate& source = map_.coordinates[i];
    switch (source.axis) {
        case 0:
            return {box.min.x, box.max.x};
        case 1:
            return {box.min.y, box.max.y};
        case 2:
            return {box.min.z, box.max.z};
        default:
            return {source.value, source.value};
    }
}

}  // namespace frep
