// The first point of a solid along each of a batch of rays: by proof (front_search.h), within the lattice of
// a DistanceGrid. Where ranges of small boxes cost thousands of values (loops that depend on the point), the
// rays walk through the cells that may hold some of the solid, by the lattice's own ranges, and F is sampled
// at the resolution: nothing thicker is missed there either. Where intervals say nothing at all
// (DistanceGrid::sampled) F is sampled half a cell apart; what is thinner may then be missed. Tested by
// tests/unit/trace/first_hit_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/trace/cell_walk.h"
#include "frep/trace/distance_grid.h"
#include "frep/trace/front_search.h"

namespace frep::tracing {

/// How the first point is found: by proof, at samples one resolution apart in cells that are not proved
/// empty, or at samples half a cell apart.
enum class HitSearch : unsigned char { proofs, close_samples, samples };

class FirstHit {
  public:
    /// `spacing`: about the distance between neighbouring rays; `resolution`: the solid is found where it is
    /// that thick along the ray, or thicker; both in model units, > 0.
    FirstHit(const DistanceGrid& grid, SampledField& field, double spacing, double resolution,
             HitSearch how = HitSearch::proofs)
        : grid_(grid),
          field_(field),
          search_(field, spacing, resolution),
          how_(how),
          resolution_(resolution) {}

    /// hits[i] for rays[i]. Rays near in number should be near in space (FrontSearch::search).
    void trace(std::span<const Ray> rays, std::span<Hit> hits);

  private:
    void find_reaches(std::span<const Ray> rays);
    void sample(std::span<const Ray> rays, std::span<Hit> hits);
    void sample_run(std::span<const Ray> rays, std::span<Hit> hits);

    /// A ray that walks through the cells of the lattice, where samples look for the solid.
    struct Walker {
        std::size_t ray = 0;
        CellWalk walk;
        Stretch run;
    };

    const DistanceGrid& grid_;
    SampledField& field_;
    FrontSearch search_;
    HitSearch how_;
    double resolution_;
    std::vector<Reach> reaches_;
    std::vector<Walker> walkers_;
    std::vector<SampledRun> runs_;
    std::vector<Bracket> brackets_;
    std::vector<std::size_t> found_;  ///< rays
    RayColumns columns_;
};

}  // namespace frep::tracing
