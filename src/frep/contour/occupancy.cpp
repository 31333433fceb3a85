// Implementation of occupancy.h.
#include "frep/contour/occupancy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "frep/base/parallel.h"

namespace frep {

namespace {

Error wrong(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

/// Sets of cells that are joined (Tarjan 1975, by halving paths).
class Joined {
  public:
    explicit Joined(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace

double Occupancy::size() const {
    std::size_t count = 0;
    for (const std::uint8_t cell : inside) count += cell;
    return static_cast<double>(count) * cell_size;
}

int Occupancy::components() const {
    Joined sets(inside.size());
    const std::array<std::size_t, 3> n{static_cast<std::size_t>(cells[0]), static_cast<std::size_t>(cells[1]),
                                       static_cast<std::size_t>(cells[2])};
    const std::array<std::size_t, 3> stride{1, n[0], n[0] * n[1]};
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (!inside[i]) continue;
        for (std::size_t a = 0; a < 3; ++a) {
            const bool has_next = i / stride[a] % n[a] + 1 < n[a];
            if (has_next && inside[i + stride[a]])
                sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + stride[a]));
        }
    }
    int count = 0;
    for (std::uint32_t i = 0; i < inside.size(); ++i) count += inside[i] && sets.root(i) == i ? 1 : 0;
    return count;
}

Result<Occupancy> sample_occupancy(FieldPool& fields, const Box3& box, int longest, const Job& job) {
    if (longest < 8 || longest > 512)
        return wrong("a grid of samples has 8 to 512 cells along its longest side");
    const std::array<double, 3> low{box.min.x, box.min.y, box.min.z};
    const Vec3 extent = box.max - box.min;
    const std::array<double, 3> side{extent.x, extent.y, extent.z};
    const double most = *std::max_element(side.begin(), side.end());
    const auto flat = std::count_if(side.begin(), side.end(), [](double s) { return !(s > 0); });
    if (flat > 1 || !(most - most == 0))
        return wrong("a grid of samples needs a box with at least two sides");
    Occupancy out;
    std::array<double, 3> step{};
    out.cell_size = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        if (!(side[a] > 0)) continue;
        out.cells[a] = std::max(1, static_cast<int>(std::lround(longest * side[a] / most)));
        step[a] = side[a] / out.cells[a];
        out.cell_size *= step[a];
    }
    const std::size_t row = static_cast<std::size_t>(out.cells[0]),
                      rows = static_cast<std::size_t>(out.cells[1]);
    const auto layers = static_cast<std::size_t>(out.cells[2]);
    out.inside.resize(row * rows * layers);
    parallel_for(job, rows * layers, [&](std::size_t task) {
        const FieldPool::Lease field = fields.borrow();
        std::vector<double> x(row), y(row), z(row), value(row);
        for (std::size_t i = 0; i < row; ++i) {
            x[i] = low[0] + (static_cast<double>(i) + 0.5) * step[0];
            y[i] = low[1] + (static_cast<double>(task % rows) + 0.5) * step[1];
            z[i] = low[2] + (static_cast<double>(task / rows) + 0.5) * step[2];
        }
        field->values({x, y, z}, value);
        for (std::size_t i = 0; i < row; ++i) out.inside[task * row + i] = value[i] >= 0 ? 1 : 0;
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "cancelled"};
    return out;
}

double difference(const Occupancy& a, const Occupancy& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.inside.size(); ++i) count += a.inside[i] != b.inside[i];
    return static_cast<double>(count) * a.cell_size;
}

}  // namespace frep
