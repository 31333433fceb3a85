// Points on rays at which a field is evaluated together, and the search for roots between two points of a
// ray, many rays at a time. Tested through tests/unit/trace/first_hit_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/trace/camera.h"

namespace frep::tracing {

/// The point at distance t along a ray.
inline Vec3 at(const Ray& ray, double t) { return ray.origin + ray.direction * t; }

/// Where a ray meets a solid: its surface, or a side of the clip box.
struct Hit {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double t = never;         ///< along the ray, at the inside end of the root's bracket
    std::uint8_t cut_by = 0;  ///< 0: the surface F = 0; else 1 + number of -x +x -y +y -z +z
    Vec3 gradient;            ///< of F at that point

    bool is_hit() const { return t < never; }
};

/// Points in columns and F there; keeps its memory.
class RayColumns {
  public:
    void clear() { x_.clear(), y_.clear(), z_.clear(); }
    void add(Vec3 p) { x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z); }
    std::size_t size() const { return x_.size(); }
    PointSpans points() const { return {x_, y_, z_}; }
    /// F at the points added since clear().
    std::span<const double> values(SampledField& field);
    /// The gradient of F at point n, after gradients().
    void gradients(SampledField& field);
    Vec3 gradient(std::size_t n) const { return {gx_[n], gy_[n], gz_[n]}; }

  private:
    std::vector<double> x_, y_, z_, f_, gx_, gy_, gz_;
};

/// A ray's point outside of the solid and a later one inside, with F there (-inf where it is not known).
struct Bracket {
    std::size_t ray = 0;
    double out = 0, in = 0;
    double f_out = 0, f_in = 0;
    int stalled = 0;  ///< working memory of find_roots()
};

/// A part of a ray at which F is sampled: `samples` places apart evenly after `begin`, the last at `end`.
struct SampledRun {
    std::size_t ray = 0;
    double begin = 0, end = 0;
    std::size_t samples = 1;

    double place(std::size_t n) const {
        return begin + (end - begin) * (static_cast<double>(n) / static_cast<double>(samples));
    }
};

/// The samples of a run that lie no more than `distance` > 0 apart.
inline std::size_t samples_within(double begin, double end, double distance) {
    return static_cast<std::size_t>(std::max(1.0, __builtin_ceil((end - begin) / distance)));
}

/// Calls found(run, bracket) for each run with a sample in the solid, with the first such sample and the one
/// before it; bracket.in = bracket.out = run.begin where the run begins in the solid.
template <class Found>
void find_crossings(std::span<const Ray> rays, SampledField& field, std::span<const SampledRun> runs,
                    RayColumns& columns, Found found) {
    columns.clear();
    for (const SampledRun& run : runs)
        for (std::size_t n = 0; n <= run.samples; ++n) columns.add(at(rays[run.ray], run.place(n)));
    const double* f = columns.values(field).data();
    for (const SampledRun& run : runs) {
        const double* own = f;
        f += run.samples + 1;
        std::size_t n = 0;
        while (n <= run.samples && !(own[n] >= 0)) ++n;
        if (n > run.samples) continue;
        const std::size_t before = n == 0 ? 0 : n - 1;
        found(run, Bracket{run.ray, run.place(before), run.place(n), own[before], own[n], 0});
    }
}

/// Narrows brackets to 1e-9 of their distance: false position, the weight of an end that stays halved (Dowell
/// and Jarratt 1971, "Illinois"), halving where that does not gain or F is no number.
void find_roots(std::span<const Ray> rays, SampledField& field, std::span<Bracket> brackets,
                RayColumns& columns);

}  // namespace frep::tracing
