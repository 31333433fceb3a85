// Implementation of plane_samples.h.
#include "frep/trace/plane_samples.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "frep/base/parallel.h"

namespace frep::drawing {

namespace {

constexpr std::size_t rows_a_task = 8;
constexpr int bisections = 8;

/// Coordinates of points of space.
struct Points {
    std::vector<double> x, y, z;

    void clear() {
        x.clear();
        y.clear();
        z.clear();
    }
    void push_back(Vec3 p) {
        x.push_back(p.x);
        y.push_back(p.y);
        z.push_back(p.z);
    }
    PointSpans spans() const { return {x, y, z}; }
};

/// A step of the lattice that the level crosses: from node `key / 2` to the right (key even) or down (odd).
struct Crossing {
    std::uint64_t key;
    double low, high;  ///< the part of the step that holds the border, 0..1; the border is at low's end side
    bool starts_inside;
};

class Tracer {
  public:
    Tracer(const Lattice& lattice, const std::vector<double>& values, double level)
        : lattice_(lattice), values_(values), level_(level), columns_(lattice.columns()) {}

    std::vector<Segment> run(SampledField* field) {
        find_crossings(field != nullptr);
        if (field) bisect(*field);
        for (std::size_t row = 0; row + 1 < lattice_.rows(); ++row) {
            for (std::size_t column = 0; column + 1 < columns_; ++column) add_cell(row * columns_ + column);
        }
        return std::move(segments_);
    }

  private:
    bool inside(double v) const { return v >= level_; }
    bool crosses(double a, double b) const { return a == a && b == b && inside(a) != inside(b); }

    void find_crossings(bool bisected) {
        for (std::size_t node = 0; node < values_.size(); ++node) {
            const double here = values_[node];
            const auto look = [&](std::size_t other, std::uint64_t direction) {
                const double there = values_[other];
                if (!crosses(here, there)) return;
                const double t = (level_ - here) / (there - here);
                const double place = t >= 0 && t <= 1 ? t : 0.5;
                crossings_.push_back({2 * std::uint64_t{node} + direction, bisected ? 0 : place,
                                      bisected ? 1 : place, inside(here)});
            };
            if (node % columns_ + 1 < columns_) look(node + 1, 0);
            if (node + columns_ < values_.size()) look(node + columns_, 1);
        }
    }

    Vec2 place(std::uint64_t key, double t) const {
        const std::uint64_t node = key / 2;
        const double column = static_cast<double>(node % columns_),
                     row = static_cast<double>(node / columns_);
        return key % 2 == 0 ? Vec2{lattice_.pixel(column + t), lattice_.pixel(row)}
                            : Vec2{lattice_.pixel(column), lattice_.pixel(row + t)};
    }

    void bisect(SampledField& field) {
        Points points;
        std::vector<double> found(crossings_.size());
        for (int i = 0; i < bisections; ++i) {
            points.clear();
            for (const Crossing& c : crossings_)
                points.push_back(lattice_.point(place(c.key, (c.low + c.high) / 2)));
            field.values(points.spans(), found);
            for (std::size_t k = 0; k < found.size(); ++k) {
                Crossing& c = crossings_[k];
                const double middle = (c.low + c.high) / 2;
                (inside(found[k]) == c.starts_inside ? c.low : c.high) = middle;
            }
        }
    }

    Vec2 crossing(std::uint64_t node, std::uint64_t direction) const {
        const std::uint64_t key = 2 * node + direction;
        const auto at = std::lower_bound(crossings_.begin(), crossings_.end(), key,
                                         [](const Crossing& c, std::uint64_t k) { return c.key < k; });
        return place(key, (at->low + at->high) / 2);
    }

    /// The pieces in the cell whose upper left corner is `node`.
    void add_cell(std::size_t node) {
        const std::array<double, 4> v{values_[node], values_[node + 1], values_[node + columns_ + 1],
                                      values_[node + columns_]};
        unsigned mask = 0;
        for (unsigned i = 0; i < 4; ++i) {
            if (v[i] != v[i]) return;
            mask |= inside(v[i]) ? 1u << i : 0u;
        }
        if (mask == 0 || mask == 15) return;
        // The sides in turn: top, right, bottom, left; side i joins corners i and i + 1.
        std::array<Vec2, 4> ends;
        std::size_t count = 0;
        for (unsigned i = 0; i < 4; ++i) {
            if (((mask >> i) & 1u) == ((mask >> ((i + 1) % 4)) & 1u)) continue;
            const std::uint64_t start = i == 1 ? node + 1 : i == 2 ? node + columns_ : node;
            ends[count++] = crossing(start, i % 2);
        }
        if (count == 2) {
            segments_.push_back({ends[0], ends[1]});
            return;
        }
        const bool middle = inside((v[0] + v[1] + v[2] + v[3]) / 4);
        // All four sides: the pieces go around the corners that differ from the middle.
        const bool around_first = middle != ((mask & 1u) != 0);
        segments_.push_back(around_first ? Segment{ends[3], ends[0]} : Segment{ends[0], ends[1]});
        segments_.push_back(around_first ? Segment{ends[1], ends[2]} : Segment{ends[2], ends[3]});
    }

    const Lattice& lattice_;
    const std::vector<double>& values_;
    double level_;
    std::size_t columns_;
    std::vector<Crossing> crossings_;  ///< ascending keys
    std::vector<Segment> segments_;
};

}  // namespace

Result<std::vector<double>> sample(FieldPool& fields, const Lattice& lattice, const Job& job) {
    const std::size_t columns = lattice.columns(), rows = lattice.rows();
    std::vector<double> values(columns * rows);
    parallel_for(job, (rows + rows_a_task - 1) / rows_a_task, [&](std::size_t task) {
        const FieldPool::Lease field = fields.borrow();
        const std::size_t end = std::min(rows, (task + 1) * rows_a_task);
        Points points;
        for (std::size_t row = task * rows_a_task; row < end; ++row) {
            points.clear();
            for (std::size_t column = 0; column < columns; ++column) {
                points.push_back(lattice.point(
                    {lattice.pixel(static_cast<double>(column)), lattice.pixel(static_cast<double>(row))}));
            }
            field->values(points.spans(), std::span(values).subspan(row * columns, columns));
        }
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the picture was cancelled"};
    return values;
}

std::vector<Segment> isoline(const Lattice& lattice, const std::vector<double>& values, double level,
                             SampledField* field) {
    FREP_CHECK(values.size() == lattice.columns() * lattice.rows());
    return Tracer(lattice, values, level).run(field);
}

}  // namespace frep::drawing
