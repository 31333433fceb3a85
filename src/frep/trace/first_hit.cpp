// Implementation of first_hit.h.
#include "frep/trace/first_hit.h"

#include <algorithm>

namespace frep::tracing {

namespace {

constexpr int cells_a_run = 4;
constexpr double samples_a_cell = 2;

}  // namespace

void FirstHit::trace(std::span<const Ray> rays, std::span<Hit> hits) {
    std::fill(hits.begin(), hits.end(), Hit{});
    if (!grid_.has_solid()) return;
    find_reaches(rays);
    if (how_ == HitSearch::proofs)
        search_.search(rays, reaches_, hits);
    else
        sample(rays, hits);
}

/// Where each ray is both in the clip box and in the lattice, beyond which there is nothing.
void FirstHit::find_reaches(std::span<const Ray> rays) {
    reaches_.assign(rays.size(), Reach{});
    const std::array<int, 3>& n = grid_.cells();
    const Vec3 far_corner = grid_.origin() + Vec3{n[0] * 1.0, n[1] * 1.0, n[2] * 1.0} * grid_.step();
    const Box3 lattice{grid_.origin(), far_corner};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Stretch within, in_lattice;
        int side = -1, unused = -1;
        if (!clip_to_box(rays[i], grid_.clip(), within, side)) continue;
        if (!clip_to_box(rays[i], lattice, in_lattice, unused)) continue;
        const bool is_cut = side >= 0 && within.begin >= in_lattice.begin;
        reaches_[i] = {std::max(within.begin, in_lattice.begin), std::min(within.end, in_lattice.end),
                       static_cast<std::uint8_t>(is_cut ? 1 + side : 0)};
    }
}

void FirstHit::sample(std::span<const Ray> rays, std::span<Hit> hits) {
    walkers_.clear();
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (reaches_[i].begin < reaches_[i].end)
            walkers_.push_back({i, CellWalk(grid_, rays[i], {reaches_[i].begin, reaches_[i].end}), {}});
    brackets_.clear();
    while (!walkers_.empty()) {
        std::erase_if(walkers_, [&](Walker& w) { return !w.walk.next(grid_, cells_a_run, w.run); });
        sample_run(rays, hits);
    }
    find_roots(rays, field_, brackets_, columns_);
    for (const Bracket& b : brackets_) hits[b.ray].t = b.in;
    columns_.clear();
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits[i].is_hit()) columns_.add(at(rays[i], hits[i].t));
    columns_.gradients(field_);
    std::size_t next = 0;
    for (Hit& hit : hits)
        if (hit.is_hit()) hit.gradient = columns_.gradient(next++);
}

/// The first change of sign in the present run of each walker, and solids that begin where it begins. Walkers
/// that found something are done.
void FirstHit::sample_run(std::span<const Ray> rays, std::span<Hit> hits) {
    runs_.clear();
    const double apart = grid_.step() / samples_a_cell;
    const double step = how_ == HitSearch::close_samples ? std::min(apart, resolution_) : apart;
    for (const Walker& w : walkers_)
        runs_.push_back({w.ray, w.run.begin, w.run.end, samples_within(w.run.begin, w.run.end, step)});
    found_.clear();
    find_crossings(rays, field_, runs_, columns_, [&](const SampledRun& run, const Bracket& found) {
        found_.push_back(run.ray);
        if (found.in > run.begin) {
            brackets_.push_back(found);
            return;
        }
        // The solid begins at the clip box, or the root lies a rounding error before this run.
        const bool is_entry = run.begin <= reaches_[run.ray].begin;
        hits[run.ray].t = run.begin;
        hits[run.ray].cut_by = is_entry ? reaches_[run.ray].side : std::uint8_t{0};
    });
    std::size_t next = 0;  // both are in the order of the rays
    std::erase_if(walkers_, [&](const Walker& w) {
        const bool is_done = next < found_.size() && found_[next] == w.ray;
        if (is_done) ++next;
        return is_done;
    });
}

}  // namespace frep::tracing
