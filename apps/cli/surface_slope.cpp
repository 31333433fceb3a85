// Slopes at a surface. See surface_slope.h.
#include "surface_slope.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace frep::cli {

std::optional<SurfaceSlope> surface_slope(SampledField& field, const Box3& box) {
    constexpr std::size_t samples_a_side = 32;
    const std::size_t n = samples_a_side, batch = n * n;
    const Vec3 step = (box.max - box.min) / static_cast<double>(n);
    const double reach = std::sqrt(dot(step, step));
    const std::size_t layers = step.z > 0 ? n : 1;
    std::vector<double> columns[7], near, all;
    for (auto& column : columns) column.resize(batch);
    for (std::size_t k = 0; k < layers; ++k) {
        for (std::size_t p = 0; p < batch; ++p) {
            columns[0][p] = box.min.x + (static_cast<double>(p % n) + 0.5) * step.x;
            columns[1][p] = box.min.y + (static_cast<double>(p / n) + 0.5) * step.y;
            columns[2][p] = box.min.z + (static_cast<double>(k) + 0.5) * step.z;
        }
        field.gradients({columns[0], columns[1], columns[2]}, columns[3],
                        {columns[4], columns[5], columns[6]});
        for (std::size_t p = 0; p < batch; ++p) {
            const Vec3 g{columns[4][p], columns[5][p], columns[6][p]};
            const double slope = std::sqrt(dot(g, g));
            if (!(slope > 0) || !std::isfinite(slope) || !std::isfinite(columns[3][p])) continue;
            all.push_back(slope);
            if (std::fabs(columns[3][p]) <= 2 * reach * slope) near.push_back(slope);
        }
    }
    std::vector<double>& slopes = near.empty() ? all : near;
    if (slopes.empty()) return std::nullopt;
    std::sort(slopes.begin(), slopes.end());
    return SurfaceSlope{slopes.back(), slopes[slopes.size() / 2]};
}

}  // namespace frep::cli
