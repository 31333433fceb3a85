// Implementation of cell_walk.h.
#include "frep/trace/cell_walk.h"

#include <utility>

namespace frep::tracing {

namespace {

std::array<double, 3> parts(Vec3 v) { return {v.x, v.y, v.z}; }

constexpr double far_away = 1e300;

}  // namespace

bool clip_to_box(const Ray& ray, const Box3& box, Stretch& stretch, int& side) {
    const auto o = parts(ray.origin), d = parts(ray.direction), lo = parts(box.min), hi = parts(box.max);
    stretch = {0, far_away};
    side = -1;
    for (std::size_t a = 0; a < 3; ++a) {
        if (d[a] == 0) {
            if (o[a] < lo[a] || o[a] > hi[a]) return false;
            continue;
        }
        double in = (lo[a] - o[a]) / d[a], out = (hi[a] - o[a]) / d[a];
        int entry = static_cast<int>(2 * a);
        if (in > out) {
            std::swap(in, out);
            ++entry;
        }
        if (in > stretch.begin) {
            stretch.begin = in;
            side = entry;
        }
        stretch.end = std::min(stretch.end, out);
    }
    return stretch.begin < stretch.end;
}

CellWalk::CellWalk(const DistanceGrid& grid, const Ray& ray, const Stretch& within)
    : at_(within.begin), end_(within.end), done_(!(within.begin < within.end)) {
    const auto o = parts(ray.origin), d = parts(ray.direction), low = parts(grid.origin());
    for (std::size_t a = 0; a < 3; ++a) {
        const double place = (o[a] + d[a] * at_ - low[a]) / grid.step();
        cell_[a] = std::clamp(static_cast<int>(__builtin_floor(place)), 0, grid.cells()[a] - 1);
        step_[a] = d[a] > 0 ? 1 : -1;
        last_[a] = d[a] > 0 ? grid.cells()[a] : -1;
        if (d[a] == 0) {
            next_[a] = delta_[a] = far_away;
            continue;
        }
        const double border = low[a] + (cell_[a] + (d[a] > 0 ? 1 : 0)) * grid.step();
        next_[a] = (border - o[a]) / d[a];
        delta_[a] = grid.step() / __builtin_fabs(d[a]);
    }
}

void CellWalk::advance() {
    std::size_t a = next_[0] <= next_[1] ? 0 : 1;
    if (next_[2] < next_[a]) a = 2;
    at_ = std::max(at_, next_[a]);
    cell_[a] += step_[a];
    next_[a] += delta_[a];
    done_ = cell_[a] == last_[a] || at_ >= end_;
}

bool CellWalk::next(const DistanceGrid& grid, int most, Stretch& run) {
    const auto is_empty = [&] { return grid.state(cell_[0], cell_[1], cell_[2]) == CellState::outside; };
    while (!done_) {
        while (!done_ && is_empty()) advance();
        if (done_) return false;
        run.begin = at_;
        for (int n = 0; n < most && !done_ && !is_empty(); ++n) advance();
        run.end = std::min(at_, end_);
        if (run.begin < run.end) return true;
    }
    return false;
}

}  // namespace frep::tracing
