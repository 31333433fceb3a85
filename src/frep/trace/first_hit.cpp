// Implementation of first_hit.h.
#include "frep/trace/first_hit.h"

#include <algorithm>

#include "frep/trace/cell_walk.h"

namespace frep::tracing {

namespace {

constexpr int cells_a_chunk = 4;
constexpr int most_proofs = 64;  ///< interval evaluations for one chunk of a ray
constexpr int most_steps = 60;   ///< of the search for one root

Vec3 at(const Ray& ray, double t) { return ray.origin + ray.direction * t; }

}  // namespace

struct FirstHit::Segment {
    double begin, end;
};

struct FirstHit::State {
    CellWalk walk;
    Stretch chunk;
    double entry = 0;           ///< where the ray enters the clip box
    int side = -1;              ///< by which side
    bool entry_unknown = true;  ///< whether the solid reaches that point is not known
    std::size_t first_sample = 0, samples = 0;
    bool has_root = false;
    double out = 0, in = 0;      ///< bracket of the root
    double f_out = 0, f_in = 0;  ///< F at its ends
    int stalled = 0;
    int proofs = 0;
    std::vector<Segment> open;  ///< to be proved empty, the front one last
};

FirstHit::FirstHit(const DistanceGrid& grid, SampledField& field, double leaf)
    : grid_(grid), field_(field), leaf_(leaf) {}
FirstHit::~FirstHit() = default;

void FirstHit::evaluate() {
    f_.resize(x_.size());
    if (!x_.empty()) field_.values({x_, y_, z_}, f_);
}

void FirstHit::begin(std::span<const Ray> rays) {
    rays_ = rays;
    if (states_.size() < rays.size()) states_.resize(rays.size());
    active_.clear();
    const std::array<int, 3>& n = grid_.cells();
    const Vec3 far_corner = grid_.origin() + Vec3{n[0] * 1.0, n[1] * 1.0, n[2] * 1.0} * grid_.step();
    const Box3 lattice{grid_.origin(), far_corner};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Stretch within, in_lattice;
        int side = -1, unused = -1;
        if (!clip_to_box(rays[i], grid_.clip(), within, side)) continue;
        if (!clip_to_box(rays[i], lattice, in_lattice, unused)) continue;
        State& s = states_[i];
        s.entry = within.begin;
        s.side = side;
        s.entry_unknown = side >= 0 && within.begin >= in_lattice.begin;
        s.walk = CellWalk(grid_, rays[i],
                          {std::max(within.begin, in_lattice.begin), std::min(within.end, in_lattice.end)});
        active_.push_back(i);
    }
}

void FirstHit::trace(std::span<const Ray> rays, std::span<Hit> hits) {
    std::fill(hits.begin(), hits.end(), Hit{});
    if (!grid_.has_solid()) return;
    begin(rays);
    while (!active_.empty()) {
        next_chunks(hits);
        sample_chunks(hits);
        rooted_.clear();
        for (const std::size_t i : active_)
            if (states_[i].has_root) rooted_.push_back(i);
        find_roots(rooted_);
        if (!grid_.sampled()) verify();
        std::erase_if(active_, [&](std::size_t i) {
            if (!states_[i].has_root) return false;
            hits[i].t = states_[i].in;
            return true;
        });
    }
}

/// The next chunk of every active ray; rays without one are done.
void FirstHit::next_chunks(std::span<Hit>) {
    std::erase_if(active_, [&](std::size_t i) {
        return !states_[i].walk.next(grid_, cells_a_chunk, states_[i].chunk);
    });
}

/// Samples about a cell apart; finds the first change of sign, and solids that begin at the clip box.
void FirstHit::sample_chunks(std::span<Hit> hits) {
    x_.clear(), y_.clear(), z_.clear();
    const double spacing = grid_.step() * (grid_.sampled() ? 0.5 : 1.0);
    for (const std::size_t i : active_) {
        State& s = states_[i];
        s.first_sample = x_.size();
        const double size = s.chunk.end - s.chunk.begin;
        s.samples = static_cast<std::size_t>(std::max(1.0, __builtin_ceil(size / spacing)));
        for (std::size_t n = 0; n <= s.samples; ++n) {
            const double share = static_cast<double>(n) / static_cast<double>(s.samples);
            const Vec3 p = at(rays_[i], s.chunk.begin + size * share);
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
    }
    evaluate();
    std::erase_if(active_, [&](std::size_t i) {
        State& s = states_[i];
        const double* f = f_.data() + s.first_sample;
        s.has_root = false;
        if (f[0] >= 0) {
            // The solid begins at the clip box, or the root lies a rounding error before this chunk.
            hits[i].t = s.chunk.begin;
            if (s.entry_unknown && s.chunk.begin <= s.entry)
                hits[i].cut_by = static_cast<std::uint8_t>(1 + s.side);
            return true;
        }
        s.entry_unknown = false;
        const double size = s.chunk.end - s.chunk.begin;
        for (std::size_t n = 1; n <= s.samples && !s.has_root; ++n) {
            if (!(f[n] >= 0)) continue;
            const auto place = [&](std::size_t k) {
                return s.chunk.begin + size * (static_cast<double>(k) / static_cast<double>(s.samples));
            };
            s.has_root = true;
            s.out = place(n - 1), s.f_out = f[n - 1];
            s.in = place(n), s.f_in = f[n];
        }
        return false;
    });
}

/// Narrows the brackets of some rays to 1e-12 of their distance: false position, the weight of an end that
/// stays halved (Dowell and Jarratt 1971, "Illinois"), halving where that does not gain or F is no number.
void FirstHit::find_roots(const std::vector<std::size_t>& which) {
    std::vector<std::size_t> open = which;
    std::vector<double> places;
    for (const std::size_t i : open) states_[i].stalled = 0;
    for (int step = 0; step < most_steps && !open.empty(); ++step) {
        x_.clear(), y_.clear(), z_.clear(), places.clear();
        std::erase_if(open, [&](std::size_t i) {
            const State& s = states_[i];
            return s.in - s.out <= 1e-12 * __builtin_fabs(s.in) || s.f_in == 0;
        });
        for (const std::size_t i : open) {
            const State& s = states_[i];
            double t = s.out + (s.in - s.out) * (s.f_out / (s.f_out - s.f_in));
            const bool halve = step % 4 == 3 && step > 8;
            if (halve || !(t > s.out && t < s.in)) t = s.out + 0.5 * (s.in - s.out);
            places.push_back(t);
            const Vec3 p = at(rays_[i], t);
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
        evaluate();
        for (std::size_t n = 0; n < open.size(); ++n) {
            State& s = states_[open[n]];
            if (f_[n] >= 0) {
                if (s.stalled > 0) s.f_out *= 0.5;
                s.in = places[n], s.f_in = f_[n];
                s.stalled = 1;
            } else {
                if (s.stalled < 0) s.f_in *= 0.5;
                s.out = places[n], s.f_out = f_[n];
                s.stalled = -1;
            }
        }
    }
}

/// Proves that nothing lies between the beginning of each chunk and its root, or finds what does.
void FirstHit::verify() {
    const double smallest = grid_.step() / 64;
    std::vector<std::size_t> open;
    std::vector<Segment> segments;
    for (const std::size_t i : active_) {
        State& s = states_[i];
        s.open.clear();
        s.proofs = 0;
        const double end = s.has_root ? s.out - leaf_ : s.chunk.end;
        if (end > s.chunk.begin) {
            s.open.push_back({s.chunk.begin, end});
            open.push_back(i);
        }
    }
    while (!open.empty()) {
        boxes_.clear(), segments.clear();
        for (const std::size_t i : open) {
            const Segment segment = states_[i].open.back();
            states_[i].open.pop_back();
            ++states_[i].proofs;
            segments.push_back(segment);
            const Vec3 a = at(rays_[i], segment.begin), b = at(rays_[i], segment.end);
            boxes_.push_back({{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                              {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}});
        }
        ranges_.resize(boxes_.size());
        field_.ranges(boxes_, ranges_);
        // Halve what is not proved.
        x_.clear(), y_.clear(), z_.clear();
        std::vector<std::size_t> halved;
        for (std::size_t n = 0; n < open.size(); ++n) {
            const Segment& segment = segments[n];
            const bool goes_on = ranges_[n].can_be_inside && segment.end - segment.begin > smallest &&
                                 states_[open[n]].proofs < most_proofs;
            if (!goes_on) continue;
            halved.push_back(n);
            const Vec3 p = at(rays_[open[n]], 0.5 * (segment.begin + segment.end));
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
        evaluate();
        rooted_.clear();
        std::vector<double> middles = f_;
        for (std::size_t h = 0; h < halved.size(); ++h) {
            const std::size_t n = halved[h];
            State& s = states_[open[n]];
            const double middle = 0.5 * (segments[n].begin + segments[n].end);
            if (middles[h] >= 0) {
                s.open.clear();
                s.has_root = true;
                s.out = segments[n].begin, s.f_out = -__builtin_inf();
                s.in = middle, s.f_in = middles[h];
                rooted_.push_back(open[n]);
            } else {
                s.open.push_back({middle, segments[n].end});
                s.open.push_back({segments[n].begin, middle});
            }
        }
        find_roots(rooted_);
        for (std::size_t h = 0; h < halved.size(); ++h) {
            const std::size_t n = halved[h];
            State& s = states_[open[n]];
            if (middles[h] >= 0 && s.out - leaf_ > segments[n].begin)
                s.open.push_back({segments[n].begin, s.out - leaf_});
        }
        std::erase_if(open, [&](std::size_t i) { return states_[i].open.empty(); });
    }
}

}  // namespace frep::tracing
