// Implementation of surface_points.h.
#include "frep/shapes/surface_points.h"

#include <algorithm>
#include <array>
#include <optional>

#include "frep/math/number.h"
#include "frep/shapes/at_point.h"

namespace frep::shapes {

namespace {

constexpr std::size_t most_samples = 1u << 18;
constexpr int bisections = 36;
/// Nodes of the graph that all evaluations together may pass, some seconds of work.
constexpr std::size_t most_work = std::size_t{1} << 26;

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
Vec3 along(int axis, double length) {
    return {axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

/// The lattice of half the spacing over the box, and whether its points are inside.
struct Lattice {
    std::size_t count[3] = {1, 1, 1};
    Vec3 origin, step;
    std::vector<char> inside;

    Vec3 at(std::size_t i, std::size_t j, std::size_t k) const {
        return origin + Vec3{step.x * static_cast<double>(i), step.y * static_cast<double>(j),
                             step.z * static_cast<double>(k)};
    }
    std::size_t number(std::size_t i, std::size_t j, std::size_t k) const {
        return (k * count[1] + j) * count[0] + i;
    }

    /// False when it would have too many points.
    bool divide(const SurfaceSearch& search) {
        origin = search.dimension == 3 ? search.box.min : Vec3{search.box.min.x, search.box.min.y, 0};
        double steps[3] = {0, 0, 0};
        double all = 1;
        for (int axis = 0; axis < search.dimension; ++axis) {
            const double length = component(search.box.max, axis) - component(search.box.min, axis);
            const double cells = math::max(1.0, -math::floor(-length / (0.5 * search.spacing)));
            all *= cells + 1;
            if (!(all <= static_cast<double>(most_samples))) return false;
            count[axis] = static_cast<std::size_t>(cells) + 1;
            steps[axis] = length / cells;
        }
        step = {steps[0], steps[1], steps[2]};
        return true;
    }
};

class Finder {
  public:
    Finder(Build& build, Expression f, Array x) : build_(build), f_(f), x_(x) {}

    /// True once there was too much to do; values are missing from then on.
    bool exhausted() const { return work_ > most_work; }

    /// Samples the lattice; false where f has no value anywhere.
    bool sample(Lattice& lattice) {
        bool any = false;
        for (std::size_t k = 0; k < lattice.count[2]; ++k)
            for (std::size_t j = 0; j < lattice.count[1]; ++j)
                for (std::size_t i = 0; i < lattice.count[0]; ++i) {
                    const auto value = evaluate(lattice.at(i, j, k));
                    any = any || value;
                    lattice.inside.push_back(value && value->value >= 0);
                }
        return any;
    }

    /// The point between an inside and an outside place, by bisection.
    std::optional<SurfacePoint> crossing(Vec3 inside, Vec3 outside) {
        for (int step = 0; step < bisections; ++step) {
            const Vec3 middle = inside * 0.5 + outside * 0.5;
            const auto value = evaluate(middle);
            (value && value->value >= 0 ? inside : outside) = middle;
        }
        const auto there = evaluate(inside);
        if (!there) return std::nullopt;
        const double slope = length(there->gradient);
        if (!(slope > 0 && slope < math::infinity)) return std::nullopt;
        return SurfacePoint{inside, there->gradient / slope};
    }

  private:
    std::optional<LocalValue> evaluate(const Vec3& p) {
        work_ += f_.id() + 1;
        return exhausted() ? std::nullopt : value_at(build_, f_, x_, p);
    }

    Build& build_;
    Expression f_;
    Array x_;
    std::size_t work_ = 0;
};

/// The farthest point from those chosen, again and again, until all are near one (Gonzalez 1985).
std::vector<SurfacePoint> thinned(const std::vector<SurfacePoint>& all, double spacing) {
    std::vector<SurfacePoint> out;
    std::vector<double> distance(all.size(), math::infinity);
    std::size_t next = 0;
    while (!all.empty() && distance[next] >= spacing) {
        out.push_back(all[next]);
        for (std::size_t i = 0; i < all.size(); ++i)
            distance[i] = std::min(distance[i], length(all[i].place - out.back().place));
        next =
            static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    }
    return out;
}

}  // namespace

SurfacePoints surface_points(Build& build, Expression f, Array x, const SurfaceSearch& search) {
    Lattice lattice;
    if (!lattice.divide(search)) return {{}, "the spacing is too small for the box"};
    Finder finder(build, f, x);
    const std::string too_much = "its boundary needs too many evaluations: enlarge the spacing";
    const bool defined = finder.sample(lattice);
    if (finder.exhausted()) return {{}, too_much};
    if (!defined) return {{}, "it is no function of x alone, or it has no value in the box"};
    std::vector<SurfacePoint> all;
    for (std::size_t k = 0; k < lattice.count[2]; ++k)
        for (std::size_t j = 0; j < lattice.count[1]; ++j)
            for (std::size_t i = 0; i < lattice.count[0]; ++i) {
                const std::array<std::size_t, 3> here{i, j, k};
                for (int axis = 0; axis < search.dimension; ++axis) {
                    const auto a = static_cast<std::size_t>(axis);
                    if (here[a] + 1 == lattice.count[a]) continue;
                    std::array<std::size_t, 3> beside = here;
                    ++beside[a];
                    const bool in = lattice.inside[lattice.number(i, j, k)];
                    if (in ==
                        static_cast<bool>(lattice.inside[lattice.number(beside[0], beside[1], beside[2])]))
                        continue;
                    const Vec3 low = lattice.at(i, j, k),
                               high = low + along(axis, component(lattice.step, axis));
                    if (const auto point = finder.crossing(in ? low : high, in ? high : low))
                        all.push_back(*point);
                }
            }
    if (finder.exhausted()) return {{}, too_much};
    if (all.empty()) return {{}, "it has no boundary within the box"};
    return {thinned(all, search.spacing), {}};
}

}  // namespace frep::shapes
