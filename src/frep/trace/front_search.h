// The first point of a solid along each of many neighbouring rays, by proof. A bundle of rays between two
// distances lies in a box; where intervals prove that the box holds nothing of the solid, all its rays go on
// behind it; else the bundle is divided across or along, front parts first, with the part of the field that
// stands for F there (SampledField::narrow). In a small bundle each ray is proved on its own: a stretch is
// empty by proof, or halved; a stretch shorter than `resolution` counts as empty unless F changes its sign
// from its front to its back end. So what a ray misses of the solid is shorter than `resolution` along it.
// Where ranges cost much more than values (SampledField::has_dear_ranges) bundles are divided further, and F
// at places `resolution` apart stands for the proofs of single rays: what is missed is no larger.
// After Duff 1992, "Interval arithmetic and recursive subdivision for implicit functions", and, for what
// stands for a field in a part of space, Keeter 2020, "Massively parallel rendering of complex closed-form
// implicit surfaces". Tested by tests/unit/trace/first_hit_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/trace/ray_columns.h"

namespace frep::tracing {

/// The part of a ray that is searched.
struct Reach {
    double begin = 0, end = -1;  ///< nothing where end <= begin
    std::uint8_t side = 0;       ///< Hit::cut_by of a solid that reaches the beginning; 0: it can not
};

class FrontSearch {
  public:
    /// `spacing`: about the distance between neighbouring rays; `resolution`: see above; in model units, > 0.
    FrontSearch(SampledField& field, double spacing, double resolution)
        : field_(field), spacing_(spacing), resolution_(resolution) {}

    /// hits[i] for rays[i] within reaches[i]. Rays near in number should be near in space: the numbers are
    /// divided into quarters, and these again.
    void search(std::span<const Ray> rays, std::span<const Reach> reaches, std::span<Hit> hits);

  private:
    /// Rays first .. first + count - 1 between two distances, and what stands for F there.
    struct Bundle {
        std::size_t first = 0, count = 0;
        double begin = 0, end = 0;
        SampledField* field = nullptr;
        std::shared_ptr<SampledField> owner;  ///< of `field`, unless it is the whole
        bool dear = false;                    ///< field->has_dear_ranges()
    };
    /// A ray within a small bundle.
    struct Walker {
        std::size_t ray = 0;
        double at = 0;                                ///< proved up to here
        std::vector<std::pair<double, double>> ends;  ///< ends of stretches and F there, the nearest last
    };

    bool is_open(std::size_t ray, const Bundle& bundle) const;
    Box3 box_of(const Bundle& bundle) const;
    double width_of(const Bundle& bundle) const;
    bool is_small(const Bundle& bundle) const;
    void divide(const Bundle& bundle);
    void prove(const Bundle& bundle);
    void take_samples(const Bundle& bundle);
    void start_walkers(const Bundle& bundle);
    void take_stretches(SampledField& field);
    void halve_stretches(SampledField& field);
    void finish(SampledField& field);

    SampledField& field_;
    double spacing_, resolution_;
    std::span<const Ray> rays_;
    std::span<const Reach> reaches_;
    std::span<Hit> hits_;
    std::vector<Bundle> bundles_;  ///< a stack
    std::vector<Bundle> parts_;
    std::vector<Walker> walkers_;
    std::vector<std::size_t> walking_, halved_;
    std::vector<SampledRun> runs_;
    std::vector<Bracket> brackets_;
    std::vector<std::size_t> found_;  ///< rays
    std::vector<Box3> boxes_;
    std::vector<SignRange> ranges_;
    std::vector<std::shared_ptr<SampledField>> fields_;
    RayColumns columns_;
};

}  // namespace frep::tracing
