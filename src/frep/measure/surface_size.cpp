// Implementation of surface_size.h: blocks of the lattice that the surface may cross, one task each.
#include "frep/measure/surface_size.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "frep/base/parallel.h"
#include "frep/measure/measured_box.h"

namespace frep {

namespace {

using Point = std::array<double, 3>;

/// Cells along a side of a block; even, so that the coarse lattice has whole cells.
constexpr std::size_t block_cells = 8;
constexpr std::size_t samples_a_side = block_cells + 1;

Vec3 vec(const Point& p) { return {p[0], p[1], p[2]}; }

/// The lattice: blocks along each axis (1 along one that is not measured), the step of the fine lattice.
struct Lattice {
    std::vector<std::size_t> axes;
    Point low{};
    std::array<std::size_t, 3> blocks{1, 1, 1};
    Point step{};

    std::size_t count() const { return blocks[0] * blocks[1] * blocks[2]; }
    std::array<std::size_t, 3> place(std::size_t block) const {
        return {block % blocks[0], block / blocks[0] % blocks[1], block / blocks[0] / blocks[1]};
    }
    double coordinate(std::size_t axis, std::size_t sample) const {
        return low[axis] + static_cast<double>(sample) * step[axis];
    }
    Box3 box(std::size_t block) const {
        Point a = low, b = low;
        const auto at = place(block);
        for (const std::size_t axis : axes) {
            a[axis] = coordinate(axis, at[axis] * block_cells);
            b[axis] = coordinate(axis, (at[axis] + 1) * block_cells);
        }
        return {vec(a), vec(b)};
    }
};

/// The size of the part of F = 0 in a simplex of `corners` points, D = corners - 1.
double level_size(std::span<const Point> at, std::span<const double> f) {
    std::array<std::size_t, 4> inside{}, outside{};
    std::size_t in = 0, out = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
        if (f[k] >= 0)
            inside[in++] = k;
        else
            outside[out++] = k;
    }
    if (in == 0 || out == 0) return 0;
    std::array<Vec3, 4> crossing;
    std::size_t count = 0;
    for (std::size_t i = 0; i < in; ++i) {
        for (std::size_t o = 0; o < out; ++o) {
            const double a = f[inside[i]], b = f[outside[o]];
            crossing[count++] =
                vec(at[inside[i]]) + (vec(at[outside[o]]) - vec(at[inside[i]])) * (a / (a - b));
        }
    }
    if (count == 2) return length(crossing[1] - crossing[0]);
    // three points, or four: 0 1 of one inside corner, 2 3 of the other
    double area = 0.5 * length(cross(crossing[1] - crossing[0], crossing[2] - crossing[0]));
    if (count == 4) area += 0.5 * length(cross(crossing[1] - crossing[3], crossing[2] - crossing[3]));
    return area;
}

/// Samples of one block and the sizes that they give.
class Block {
  public:
    Block(const Lattice& lattice, std::size_t block, SampledField& field) : lattice_(lattice) {
        const auto at = lattice.place(block);
        std::size_t count = 1;
        for (std::size_t k = 0; k < lattice.axes.size(); ++k) count *= samples_a_side;
        std::vector<double> x(count), y(count), z(count);
        values_.resize(count);
        points_.resize(count);
        for (std::size_t n = 0; n < count; ++n) {
            Point p = lattice.low;
            for (std::size_t k = 0, rest = n; k < lattice.axes.size(); ++k, rest /= samples_a_side) {
                const std::size_t axis = lattice.axes[k];
                p[axis] = lattice.coordinate(axis, at[axis] * block_cells + rest % samples_a_side);
            }
            points_[n] = p;
            x[n] = p[0];
            y[n] = p[1];
            z[n] = p[2];
        }
        field.values({x, y, z}, values_);
        for (double& f : values_)
            if (f == f) f = std::clamp(f, -1e300, 1e300);
    }

    /// With cells of `stride` fine ones a side.
    double size(std::size_t stride) const {
        const std::size_t d = lattice_.axes.size(), side = block_cells / stride;
        std::size_t cells = 1;
        for (std::size_t k = 0; k < d; ++k) cells *= side;
        double sum = 0;
        for (std::size_t c = 0; c < cells; ++c) {
            std::size_t first = 0, step = 1;
            for (std::size_t k = 0, rest = c; k < d; ++k, rest /= side, step *= samples_a_side)
                first += rest % side * stride * step;
            sum += cell_size(first, stride);
        }
        return sum;
    }

  private:
    double cell_size(std::size_t first, std::size_t stride) const {
        const std::size_t d = lattice_.axes.size();
        std::array<std::size_t, 3> order{0, 1, 2};
        const std::array<std::size_t, 3> step{stride, stride * samples_a_side,
                                              stride * samples_a_side * samples_a_side};
        double sum = 0;
        do {
            std::array<Point, 4> at{};
            std::array<double, 4> f{};
            std::size_t sample = first;
            double largest = 0;
            for (std::size_t k = 0; k <= d; ++k) {
                at[k] = points_[sample];
                f[k] = values_[sample];
                if (f[k] == f[k]) largest = std::max(largest, std::abs(f[k]));
                if (k < d) sample += step[order[k]];
            }
            // where F ends the surface is taken half way
            for (std::size_t k = 0; k <= d; ++k)
                if (f[k] != f[k]) f[k] = largest > 0 ? -largest : -1;
            sum += level_size({at.data(), d + 1}, {f.data(), d + 1});
        } while (std::next_permutation(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(d)));
        return sum;
    }

    const Lattice& lattice_;
    std::vector<Point> points_;
    std::vector<double> values_;
};

/// False where the surface surely does not pass.
bool may_pass(SampledField& field, const Box3& box) {
    if (field.has_dear_ranges()) return true;
    SignRange range;
    field.ranges({&box, 1}, {&range, 1});
    return range.can_be_inside && (range.can_be_outside || range.can_be_undefined);
}

}  // namespace

Result<SurfaceSize> estimate_surface(FieldPool& fields, const Box3& box, const std::array<bool, 3>& axes,
                                     int cells, const Job& job) {
    if (cells < 8 || cells > 1024)
        return Error{ErrorKind::invalid_argument, "a surface is estimated with 8 to 1024 cells a side"};
    const auto measured = measuring::measured_box(box, axes, 2);
    if (!measured) return measured.error();
    Lattice lattice;
    lattice.axes = measured->axes;
    lattice.low = measured->cell.low;
    for (const std::size_t axis : lattice.axes) {
        const double side = measured->cell.high[axis] - lattice.low[axis];
        const double wanted = cells * side / measured->longest / static_cast<double>(block_cells);
        lattice.blocks[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(wanted)));
        lattice.step[axis] = side / static_cast<double>(lattice.blocks[axis] * block_cells);
    }
    std::vector<std::array<double, 2>> sizes(lattice.count());
    parallel_for(job, sizes.size(), [&](std::size_t block) {
        const FieldPool::Lease field = fields.borrow();
        if (!may_pass(*field, lattice.box(block))) return;
        const Block samples(lattice, block, *field);
        sizes[block] = {samples.size(1), samples.size(2)};
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "cancelled"};
    SurfaceSize out;
    double coarse = 0;
    for (const auto& [fine, wide] : sizes) {
        out.size += fine;
        coarse += wide;
    }
    out.error = std::abs(out.size - coarse);
    return out;
}

}  // namespace frep
