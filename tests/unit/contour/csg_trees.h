// Random solids from spheres, boxes, cylinders and tori, for the tests of contour: the same for the same
// seed.
#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "frep/eval/evaluator.h"
#include "frep/eval/sampled_field.h"
#include "frep/field/expression.h"
#include "frep/field/field.h"
#include "frep/geom/mesh_check.h"
#include "unit/contour/test_fields.h"

namespace frep::test {

/// Half the side of a cube around the origin that holds every random_solid().
inline constexpr double csg_bounds = 1.6;

/// A stream of numbers from a seed.
class Chance {
  public:
    explicit Chance(std::uint64_t seed) : seed_(seed) {}
    /// In [low, high).
    double between(double low, double high) { return low + (high - low) * 0.5 * (noise(seed_, next_++) + 1); }
    /// In 0 .. count - 1.
    std::size_t index(std::size_t count) {
        return std::min(static_cast<std::size_t>(between(0, static_cast<double>(count))), count - 1);
    }

  private:
    std::uint64_t seed_, next_ = 1;
};

using Point = std::array<Expression, 3>;

/// x, y, z turned at random and shifted.
inline Point placed(const Point& p, Chance& chance) {
    double q[4], sum = 0;
    for (double& c : q) {
        c = chance.between(-1, 1);
        sum += c * c;
    }
    for (double& c : q) c /= std::sqrt(sum);
    const double w = q[0], a = q[1], b = q[2], c = q[3];
    const double m[3][3] = {{1 - 2 * (b * b + c * c), 2 * (a * b - w * c), 2 * (a * c + w * b)},
                            {2 * (a * b + w * c), 1 - 2 * (a * a + c * c), 2 * (b * c - w * a)},
                            {2 * (a * c - w * b), 2 * (b * c + w * a), 1 - 2 * (a * a + b * b)}};
    const Point s{p[0] - chance.between(-0.6, 0.6), p[1] - chance.between(-0.6, 0.6),
                  p[2] - chance.between(-0.6, 0.6)};
    Point turned;
    for (int i = 0; i < 3; ++i)
        turned[static_cast<std::size_t>(i)] = m[i][0] * s[0] + m[i][1] * s[1] + m[i][2] * s[2];
    return turned;
}

inline Expression random_leaf(const Point& at, Chance& chance) {
    const Point p = placed(at, chance);
    switch (chance.index(4)) {
        case 0: {
            const double r = chance.between(0.2, 0.6);
            return r * r - (square(p[0]) + square(p[1]) + square(p[2]));
        }
        case 1: {
            const double x = chance.between(0.12, 0.45), y = chance.between(0.12, 0.45),
                         z = chance.between(0.12, 0.45);
            return min(min(x - abs(p[0]), y - abs(p[1])), z - abs(p[2]));
        }
        case 2: {
            const double r = chance.between(0.12, 0.4), h = chance.between(0.15, 0.55);
            return min(r - sqrt(square(p[0]) + square(p[1])), h - abs(p[2]));
        }
        default: {
            const double ring = chance.between(0.25, 0.45), tube = chance.between(0.08, 0.2);
            return tube * tube - square(sqrt(square(p[0]) + square(p[1])) - ring) - square(p[2]);
        }
    }
}

/// A tree of 2 to 12 leaves by min and max or by R-functions.
inline Field random_solid(std::uint64_t seed, bool r_functions) {
    auto graph = std::make_shared<Graph>();
    const Point at{Expression(*graph, graph->coordinate(0)), Expression(*graph, graph->coordinate(1)),
                   Expression(*graph, graph->coordinate(2))};
    Chance chance(seed);
    const auto both = [&](Expression a, Expression b) { return r_functions ? r_and(a, b) : min(a, b); };
    const auto either = [&](Expression a, Expression b) { return r_functions ? r_or(a, b) : max(a, b); };
    std::vector<Expression> parts;
    const std::size_t leaves = 2 + chance.index(11);
    for (std::size_t i = 0; i < leaves; ++i) parts.push_back(random_leaf(at, chance));
    while (parts.size() > 1) {
        const std::size_t i = chance.index(parts.size() - 1);
        const Expression a = parts[i], b = parts[i + 1];
        const double kind = chance.between(0, 1);
        parts[i] = kind < 0.55 ? either(a, b) : kind < 0.85 ? both(a, -b) : both(a, b);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    Field field;
    field.value = parts[0].id();
    field.graph = std::move(graph);
    return field;
}

/// The field in space.
inline std::unique_ptr<SampledField> sampled(const Field& field) {
    auto evaluator = make_evaluator(field);
    auto made = make_sampled_field(std::move(*evaluator), AxisMap::standard(field.coordinates));
    return std::move(*made);
}

/// The volume inside by one random point in each of n^3 parts of the cube.
inline double sampled_volume(SampledField& field, double half, int n, std::uint64_t seed) {
    Chance chance(seed);
    const double step = 2 * half / n;
    std::vector<double> x, y, z;
    std::size_t inside = 0;
    for (int k = 0; k < n; ++k) {
        x.clear();
        y.clear();
        z.clear();
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                x.push_back(-half + step * (i + chance.between(0, 1)));
                y.push_back(-half + step * (j + chance.between(0, 1)));
                z.push_back(-half + step * (k + chance.between(0, 1)));
            }
        }
        std::vector<double> values(x.size());
        field.values({x, y, z}, values);
        for (const double v : values) inside += v >= 0 ? 1u : 0u;
    }
    return static_cast<double>(inside) * step * step * step;
}

/// How many solids the tests take: 50; 1,000 with FREP_FULL=1.
inline std::uint64_t csg_solids() {
    const char* full = std::getenv("FREP_FULL");
    return full && full[0] == '1' ? 1000 : 50;
}

/// The solids of the tests, every other one by R-functions.
inline Field csg_solid(std::uint64_t seed) { return random_solid(seed / 2, seed % 2 == 1); }

struct VolumeTrial {
    double found = 0;     ///< of the mesh
    double expected = 0;  ///< from samples
    bool is_right() const { return std::abs(found - expected) <= 0.02 * expected + 1e-4; }
};

/// Compares the volume of mesh_at(cells) with one from samples. What thin parts and the chance of the samples
/// take away must vanish with the resolution: the first of three that is right, or the last.
template <class MeshAt>
VolumeTrial try_volume(SampledField& field, std::uint64_t seed, MeshAt mesh_at) {
    VolumeTrial trial;
    for (const int cells : {64, 128, 192}) {
        trial = {check(mesh_at(cells)).volume.value_or(0), sampled_volume(field, csg_bounds, cells, seed)};
        if (trial.is_right()) break;
    }
    return trial;
}

}  // namespace frep::test
